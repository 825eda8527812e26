#ifndef TINWRIGHT_GEOMETRY_DECIMAL_HPP
#define TINWRIGHT_GEOMETRY_DECIMAL_HPP

#include <cstdint>
#include <optional>
#include <string>

#include "tinwright/geometry/point.hpp"

/// The decimal number a user means by a double: 0.1 is a tenth here, not the double next to it.
namespace tinwright {

__extension__ using Int128 = __int128;

/// digits * 10^exponent.
struct Decimal {
    std::int64_t digits = 0;
    int exponent = 0;
};

/// The decimal with the fewest digits (at most 17) that reads back as `value`, which must be finite. Exact.
Decimal shortest_decimal(double value);

/// `decimal` as a whole number of steps of 10^exponent; nothing if it is not a whole number of them or has
/// a magnitude beyond 10^36. Exact.
std::optional<Int128> whole_steps(Decimal decimal, int exponent);

/// `steps` * 10^exponent, correctly rounded.
double from_steps(Int128 steps, int exponent);

/// The decimal of `value` times 10^power, correctly rounded: scaled_decimal(0.57, 2) is 57.
double scaled_decimal(double value, int power);

/// The shortest text that reads back as `value`, without an exponent from 10^-6 up to 10^15: for people.
std::string decimal_text(double value);

/// "(x, y)" in the same way.
std::string location_text(Point2 location);

}  // namespace tinwright

#endif
