#ifndef TINWRIGHT_TOOLS_JSON_VALUE_HPP
#define TINWRIGHT_TOOLS_JSON_VALUE_HPP

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct json_object;

namespace tinwright::tools {

/// A JSON value, built once and printed: a thin owner over json-c, which GDAL brings along. Keys keep the
/// order in which they are set; numbers are printed with the fewest digits that read back as the same
/// number, and those that are not finite as null; text that is not UTF-8 has its foreign bytes replaced.
class JsonValue {
  public:
    JsonValue();  ///< null
    JsonValue(bool value);
    JsonValue(double value);
    JsonValue(const std::string& value);
    JsonValue(const char* value);
    template <std::integral Integer>
    requires(!std::same_as<Integer, bool>) JsonValue(Integer value)
        : JsonValue(Whole{static_cast<std::int64_t>(value)}) {}

    static JsonValue object();
    static JsonValue array();
    static JsonValue array_of(const std::vector<double>& values);
    static JsonValue array_of(const std::vector<std::string>& values);

    /// Sets a key of an object; returns this object.
    JsonValue& set(const std::string& key, const JsonValue& value);
    /// Appends to an array; returns this array.
    JsonValue& append(const JsonValue& value);

    /// Indented by two spaces, with a newline at the end.
    [[nodiscard]] std::string text() const;

  private:
    struct Whole {
        std::int64_t value;
    };
    explicit JsonValue(Whole value);
    explicit JsonValue(json_object* owned);

    std::shared_ptr<json_object> value_;
};

}  // namespace tinwright::tools

#endif
