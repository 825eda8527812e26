#include "tinwright/io/read_number.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

namespace tinwright::io {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The result of a number that is out of range: its exponent says on which side.
double out_of_range(std::string_view text) {
    const bool is_negative = text.front() == '-';
    const std::size_t e = text.find_first_of("eE");
    const std::string_view digits = text.substr(is_negative ? 1 : 0);
    const bool is_tiny = e != std::string_view::npos ? e + 1 < text.size() && text[e + 1] == '-'
                                                     : digits.front() == '0' || digits.front() == '.';
    const double magnitude = is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return is_negative ? -magnitude : magnitude;
}

}  // namespace

std::optional<double> parse_number(std::string_view text, char point) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') {
        text.remove_prefix(1);
        if (!text.empty() && text.front() == '-') {
            return std::nullopt;
        }
    }
    std::string with_point;
    if (point != '.') {
        if (text.find('.') != std::string_view::npos) {
            return std::nullopt;
        }
        with_point = text;
        std::replace(with_point.begin(), with_point.end(), point, '.');
        text = with_point;
    }
    if (text.empty()) {
        return std::nullopt;
    }
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) {
        return std::nullopt;
    }
    return error == std::errc() ? value : out_of_range(text);
}

}  // namespace tinwright::io
