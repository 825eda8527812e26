#include "option_values.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace tinwright::tools {

namespace {

[[noreturn]] void refuse(std::string_view option, const std::string& needed, const std::string& text) {
    throw UsageError(std::string(option) + " needs " + needed + ", not " + io::quoted(text));
}

}  // namespace

std::optional<double> find_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) {
        text.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

double number_value(std::string_view option, const std::string& text) {
    const std::optional<double> value = find_number(text);
    if (!value || !std::isfinite(*value)) {
        refuse(option, "a number", text);
    }
    return *value;
}

double positive_value(std::string_view option, const std::string& text) {
    const std::optional<double> value = find_number(text);
    if (!value || !std::isfinite(*value) || *value <= 0) {
        refuse(option, "a number above zero", text);
    }
    return *value;
}

std::int64_t whole_value(std::string_view option, const std::string& text, std::int64_t least) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least ||
        value > std::numeric_limits<std::int32_t>::max()) {
        refuse(option, "a whole number from " + std::to_string(least) + " up", text);
    }
    return value;
}

}  // namespace tinwright::tools
