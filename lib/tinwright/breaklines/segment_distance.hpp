#ifndef TINWRIGHT_BREAKLINES_SEGMENT_DISTANCE_HPP
#define TINWRIGHT_BREAKLINES_SEGMENT_DISTANCE_HPP

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"

/// How far a point is from a segment, and where the segment is nearest: for the distances that users give.
/// Whether a point is on a segment is decided exactly, and apart from any distance.
namespace tinwright {

struct SegmentDistance {
    double squared = 0;   ///< in squared keys; a few units in the last place off
    double fraction = 0;  ///< of the way from a to b, where the segment is nearest; 0 to 1
};

/// `a` and `b` distinct.
inline SegmentDistance measure_distance(Key2 point, Key2 a, Key2 b) {
    const double along = inner_product(point, a, b);
    if (along <= 0) {
        return {squared_distance(point, a), 0};
    }
    const double whole = squared_distance(a, b);
    if (along >= whole) {
        return {squared_distance(point, b), 1};
    }
    const double across = doubled_area(a, b, point);
    return {across * across / whole, along / whole};
}

/// Whether a point is on the closed segment from a to b. Exact.
inline bool is_on_segment(Key2 point, Key2 a, Key2 b) {
    return std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= point.y &&
           point.y <= std::max(a.y, b.y) && orient2d(a, b, point) == 0;
}

/// Whether two closed segments have a point in common. Exact.
inline bool do_segments_meet(Key2 a, Key2 b, Key2 c, Key2 d) {
    const int c_side = orient2d(a, b, c);
    const int d_side = orient2d(a, b, d);
    const int a_side = orient2d(c, d, a);
    const int b_side = orient2d(c, d, b);
    if (c_side != d_side && a_side != b_side) {
        return true;
    }
    return (c_side == 0 && is_on_segment(c, a, b)) || (d_side == 0 && is_on_segment(d, a, b)) ||
           (a_side == 0 && is_on_segment(a, c, d)) || (b_side == 0 && is_on_segment(b, c, d));
}

/// Elevation on a segment with `z_a` and `z_b` at its ends; NaN where one of them is.
inline double elevation_at(double z_a, double z_b, double fraction) {
    return fraction == 0 ? z_a : fraction == 1 ? z_b : z_a + fraction * (z_b - z_a);
}

}  // namespace tinwright

#endif
