#ifndef TINWRIGHT_TOOLS_OPTION_VALUES_HPP
#define TINWRIGHT_TOOLS_OPTION_VALUES_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

/// The texts that options take, as values. Everything throws UsageError naming the option and the text.
namespace tinwright::tools {

/// The whole of `text` as a number ("5", "-1e3", "+.5", "nan"), or nothing.
std::optional<double> find_number(std::string_view text);

/// A finite number.
double number_value(std::string_view option, const std::string& text);
/// A finite number above zero.
double positive_value(std::string_view option, const std::string& text);
/// A whole number from `least` to 2^31 - 1.
std::int64_t whole_value(std::string_view option, const std::string& text, std::int64_t least);

/// The entry of `choices` named `text`.
template <class Value, std::size_t N>
Value choice_value(std::string_view option, const std::string& text,
                   const std::array<std::pair<std::string_view, Value>, N>& choices) {
    std::string names;
    for (std::size_t i = 0; i < N; ++i) {
        if (text == choices[i].first) {
            return choices[i].second;
        }
        names += i == 0 ? "" : i + 1 < N ? ", " : " or ";
        names += choices[i].first;
    }
    throw UsageError(std::string(option) + " takes " + names + ", not " + io::quoted(text));
}

/// The name of a choice.
template <class Value, std::size_t N>
std::string choice_name(Value value, const std::array<std::pair<std::string_view, Value>, N>& choices) {
    for (const auto& [name, candidate] : choices) {
        if (candidate == value) {
            return std::string(name);
        }
    }
    return {};
}

}  // namespace tinwright::tools

#endif
