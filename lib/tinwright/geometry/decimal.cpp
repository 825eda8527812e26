#include "tinwright/geometry/decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace tinwright {

namespace {

constexpr Int128 kStepLimit = static_cast<Int128>(1'000'000'000'000'000'000) * 1'000'000'000'000'000'000;

double read(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

}  // namespace

Decimal shortest_decimal(double value) {
    std::array<char, 64> text{};
    const auto written =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific);
    Decimal decimal;
    bool after_point = false;
    bool negative = false;
    const char* at = text.data();
    for (; at != written.ptr && *at != 'e'; ++at) {
        if (*at == '-') {
            negative = true;
        } else if (*at == '.') {
            after_point = true;
        } else {
            decimal.digits = 10 * decimal.digits + (*at - '0');
            decimal.exponent -= after_point ? 1 : 0;
        }
    }
    if (at != written.ptr) {
        decimal.exponent += std::atoi(at + 1);
    }
    while (decimal.digits != 0 && decimal.digits % 10 == 0) {
        decimal.digits /= 10;
        ++decimal.exponent;
    }
    if (decimal.digits == 0) {
        return {};
    }
    decimal.digits = negative ? -decimal.digits : decimal.digits;
    return decimal;
}

std::optional<Int128> whole_steps(Decimal decimal, int exponent) {
    Int128 steps = decimal.digits;
    if (steps == 0) {
        return steps;
    }
    int shift = decimal.exponent - exponent;
    if (shift > 36) {
        return std::nullopt;
    }
    for (; shift > 0; --shift) {
        if (steps > kStepLimit / 10 || steps < -(kStepLimit / 10)) {
            return std::nullopt;
        }
        steps *= 10;
    }
    for (; shift < 0; ++shift) {
        if (steps % 10 != 0) {
            return std::nullopt;
        }
        steps /= 10;
    }
    return steps;
}

double from_steps(Int128 steps, int exponent) {
    std::string digits;
    const bool negative = steps < 0;
    for (Int128 rest = negative ? -steps : steps; rest != 0; rest /= 10) {
        digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(rest % 10)));
    }
    if (digits.empty()) {
        return 0;
    }
    return read((negative ? "-" : "") + digits + "e" + std::to_string(exponent));
}

double scaled_decimal(double value, int power) {
    const Decimal decimal = shortest_decimal(value);
    return from_steps(decimal.digits, decimal.exponent + power);
}

std::string decimal_text(double value) {
    std::array<char, 64> text{};
    const double size = std::abs(value);
    // "6.7e+06" is shorter than "6700000", but nobody writes coordinates like that.
    const auto written =
        size >= 1e-6 && size < 1e15
            ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed)
            : std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), written.ptr};
}

std::string location_text(Point2 location) {
    std::string text = "(";
    text += decimal_text(location.x);
    text += ", ";
    text += decimal_text(location.y);
    text += ")";
    return text;
}

}  // namespace tinwright
