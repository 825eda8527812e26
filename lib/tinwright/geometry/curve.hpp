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

/// An index with the upper 64 bits of its key's place on the curve.
struct CurveItem {
    std::uint64_t code;
    std::uint32_t index;
};

/// Number of low bits of each coordinate that `curve_code` leaves out when coordinates go up to `largest`.
int curve_bits_dropped(double largest);
/// Number of bits that codes then have.
int curve_code_bits(double largest);

/// The place of a key on the curve, without the `dropped` lowest bits of its coordinates.
std::uint64_t curve_code(Key2 key, int dropped);

/// Sorts items by code, then index; codes have `code_bits` bits at most. `scratch` has the same size; what it
/// holds afterwards is unspecified. Most significant digits first, O(n) a digit; parallel inside the caller's
/// task arena, same result for any number of threads.
void sort_curve_items(std::span<CurveItem> items, std::span<CurveItem> scratch, int code_bits);

/// Indices of `keys` (fewer than 2^32) sorted along the curve; equal keys by ascending index.
/// O(n) for scattered keys, parallel inside the caller's task arena. Scratch: 32 bytes a key.
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
