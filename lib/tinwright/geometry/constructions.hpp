#ifndef TINWRIGHT_GEOMETRY_CONSTRUCTIONS_HPP
#define TINWRIGHT_GEOMETRY_CONSTRUCTIONS_HPP

#include <cstdint>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/lattice.hpp"

/// Quantities made from keys, with what is known of their errors. No sign is decided here.
namespace tinwright {

/// Twice the signed area of the triangle a b c in squared keys, positive counter-clockwise; rounded once, so
/// its sign is right. Keys of magnitude up to 2^52.
inline double doubled_area(Key2 a, Key2 b, Key2 c) {
    const auto product = [](double left, double right) {
        return static_cast<Int128>(static_cast<std::int64_t>(left)) * static_cast<std::int64_t>(right);
    };
    return static_cast<double>(product(b.x - a.x, c.y - a.y) - product(b.y - a.y, c.x - a.x));
}

/// Squared distance of two keys; each of the three operations rounds.
inline double squared_distance(Key2 a, Key2 b) {
    return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
}

/// Inner product of a - apex and b - apex in squared keys; rounded once, so its sign is right.
inline double inner_product(Key2 a, Key2 apex, Key2 b) {
    const auto product = [](double left, double right) {
        return static_cast<Int128>(static_cast<std::int64_t>(left)) * static_cast<std::int64_t>(right);
    };
    return static_cast<double>(product(a.x - apex.x, b.x - apex.x) + product(a.y - apex.y, b.y - apex.y));
}

}  // namespace tinwright

#endif
