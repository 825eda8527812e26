#ifndef TINWRIGHT_GEOMETRY_CURVE_HPP
#define TINWRIGHT_GEOMETRY_CURVE_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

/// The order in which vertices are numbered: along the Z-order curve of their keys (x's bit before y's at
/// each level). It is canonical, cheap, and close in the plane is mostly close in memory.
namespace tinwright {

/// Whether `a` comes before `b` on the curve.
bool precedes_on_curve(Key2 a, Key2 b);

/// Indices of `keys` sorted along the curve; equal keys by ascending index.
/// n below 2^32. O(n) passes over 64-bit codes, then small sorts in cache; parallel inside the caller's
/// task arena, same result for any number of threads. Scratch: 32 bytes a key.
std::vector<std::uint32_t> sort_along_curve(std::span<const Key2> keys);

/// Where the curve first divides a sorted range: the first index whose key lies in the upper half of the
/// smallest aligned cell that holds the whole range, and the axis (0: x, 1: y) that divides it.
struct CurveSplit {
    std::size_t middle = 0;
    int axis = 0;
};

/// `keys`: two or more distinct keys in curve order. O(log n).
CurveSplit find_curve_split(std::span<const Key2> keys);

}  // namespace tinwright

#endif
