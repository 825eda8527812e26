#ifndef TINWRIGHT_IO_READ_NUMBER_HPP
#define TINWRIGHT_IO_READ_NUMBER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tinwright::io {

/// 10^0 to 10^22: the powers of ten that a double holds exactly.
inline constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Reads the number that starts at `p`, correctly rounded, and moves `p` behind it; `point` is the decimal
/// mark. Returns false, `p` unmoved, when there is no number or it is not one that the short way below reads
/// exactly. The text must be followed by a byte that no number contains, such as the line's end.
///
/// At most 19 digits whose integer m is at most 2^53, with |e| <= 22: m and 10^|e| are doubles, so the one
/// multiplication or division that is left rounds correctly [clinger1990].
inline bool read_short_decimal(const char*& p, char point, double& value) {
    const char* q = p;
    const bool is_negative = *q == '-';
    if (is_negative || *q == '+') {
        ++q;
    }
    std::uint64_t mantissa = 0;
    const auto digit = [&] { return static_cast<unsigned>(static_cast<unsigned char>(*q)) - unsigned{'0'}; };
    const char* const digits = q;
    for (unsigned d = digit(); d <= 9; d = digit()) {
        mantissa = 10 * mantissa + d;
        ++q;
    }
    auto count = q - digits;
    std::ptrdiff_t fraction = 0;
    if (*q == point) {
        const char* const first = ++q;
        for (unsigned d = digit(); d <= 9; d = digit()) {
            mantissa = 10 * mantissa + d;
            ++q;
        }
        fraction = q - first;
        count += fraction;
    }
    constexpr std::uint64_t kExact = std::uint64_t{1} << 53U;
    if (count == 0 || count > 19 || mantissa > kExact || *q == 'e' || *q == 'E') {
        return false;
    }
    const double magnitude = static_cast<double>(static_cast<std::int64_t>(mantissa)) /
                             kPowersOfTen[static_cast<std::size_t>(fraction)];
    value = is_negative ? -magnitude : magnitude;
    p = q;
    return true;
}

/// The number that `text` is, correctly rounded: sign, digits with `point`, exponent; blanks around it are
/// ignored. "nan" and "inf" in their usual spellings, and numbers beyond the range of doubles, give a value
/// that is not finite. Nothing when it is not a number.
std::optional<double> parse_number(std::string_view text, char point = '.');

}  // namespace tinwright::io

#endif
