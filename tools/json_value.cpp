#include "json_value.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <json-c/json.h>

namespace tinwright::tools {

namespace {

json_object* new_number(double value) {
    if (!std::isfinite(value)) {
        return nullptr;
    }
    std::array<char, 32> digits{};
    *std::to_chars(digits.data(), digits.data() + digits.size() - 1, value).ptr = '\0';
    return json_object_new_double_s(value, digits.data());
}

json_object* new_text(const std::string& text) {
    const int length = static_cast<int>(text.size());
    if (CPLIsUTF8(text.data(), length) != 0) {
        return json_object_new_string_len(text.data(), length);
    }
    char* const ascii = CPLForceToASCII(text.data(), length, '?');
    json_object* const value = json_object_new_string(ascii);
    CPLFree(ascii);
    return value;
}

}  // namespace

JsonValue::JsonValue() = default;
JsonValue::JsonValue(json_object* owned)
    : value_(owned, [](json_object* value) { json_object_put(value); }) {}
JsonValue::JsonValue(bool value) : JsonValue(json_object_new_boolean(value ? 1 : 0)) {}
JsonValue::JsonValue(double value) : JsonValue(new_number(value)) {}
JsonValue::JsonValue(const std::string& value) : JsonValue(new_text(value)) {}
JsonValue::JsonValue(const char* value) : JsonValue(std::string(value)) {}
JsonValue::JsonValue(Whole value) : JsonValue(json_object_new_int64(value.value)) {}

JsonValue JsonValue::object() { return JsonValue(json_object_new_object()); }
JsonValue JsonValue::array() { return JsonValue(json_object_new_array()); }

JsonValue JsonValue::array_of(const std::vector<double>& values) {
    JsonValue list = array();
    for (const double value : values) {
        list.append(value);
    }
    return list;
}

JsonValue JsonValue::array_of(const std::vector<std::string>& values) {
    JsonValue list = array();
    for (const std::string& value : values) {
        list.append(value);
    }
    return list;
}

JsonValue& JsonValue::set(const std::string& key, const JsonValue& value) {
    json_object_object_add(value_.get(), key.c_str(), json_object_get(value.value_.get()));
    return *this;
}

JsonValue& JsonValue::append(const JsonValue& value) {
    json_object_array_add(value_.get(), json_object_get(value.value_.get()));
    return *this;
}

std::string JsonValue::text() const {
    constexpr int kFlags = JSON_C_TO_STRING_PRETTY | JSON_C_TO_STRING_SPACED | JSON_C_TO_STRING_NOSLASHESCAPE;
    return std::string(json_object_to_json_string_ext(value_.get(), kFlags)) + "\n";
}

}  // namespace tinwright::tools
