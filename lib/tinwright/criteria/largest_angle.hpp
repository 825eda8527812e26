#ifndef TINWRIGHT_CRITERIA_LARGEST_ANGLE_HPP
#define TINWRIGHT_CRITERIA_LARGEST_ANGLE_HPP

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/geometry/predicates_internal.hpp"

/// The largest angle of a face, of which angle, height and eccentricity are made. Built without contraction
/// of multiply and add; not installed.
namespace tinwright::internal {

/// The corner opposite the longest edge and what is seen from there, in keys.
struct LargestAngle {
    unsigned corner = 0;
    double longest_square = 0;  ///< squared length of the edge opposite
    double inner = 0;           ///< inner product of the two edges at the corner: below zero if obtuse
    double doubled_area = 0;    ///< positive
};

/// Below this part of its terms' size a difference of products is worked out again in integers: what is left
/// to doubles errs by 65 half units in the last place at most.
inline constexpr double kCancellation = 1.0 / 64;

/// |a x b| for two edges from `origin`, to 2^-46 of it.
inline double doubled_area_of(Key2 origin, Key2 p, Key2 q, const LocalKey& a, const LocalKey& b) {
    const double left = a.x * b.y;
    const double right = a.y * b.x;
    const double area = std::abs(left - right);
    const double size = std::abs(left) + std::abs(right);
    const bool is_good = size < kExactIntegers || area > kCancellation * size;
    return is_good ? area : std::abs(doubled_area(origin, p, q));
}

/// a . b for two edges from `origin`, to 2^-46 of it; its sign is right.
inline double inner_product_of(Key2 origin, Key2 p, Key2 q, const LocalKey& a, const LocalKey& b) {
    const double left = a.x * b.x;
    const double right = a.y * b.y;
    const double inner = left + right;
    const double size = std::abs(left) + std::abs(right);
    const bool is_good = size < kExactIntegers || std::abs(inner) > kCancellation * size;
    return is_good ? inner : inner_product(p, origin, q);
}

/// Whether the corner `p`, opposite an edge q r, has a larger angle than the corner `q`, opposite p r, or the
/// same and comes first; `qr` and `pr` are the squared lengths as `localize` gives them.
inline bool is_larger_angle(Key2 p, Key2 q, Key2 r, double qr, double pr) {
    const int fast = compare_squares(qr, pr);
    const int sign = fast != kUnsure ? fast : compare_distances_int128(q, r, p, r);
    return sign > 0 || (sign == 0 && precedes(p, q));
}

/// The largest angle of the face a b c (counter-clockwise), the same bits whichever corner is named first. Of
/// two equal ones that of the lexicographically first corner is taken.
inline LargestAngle find_largest_angle(Key2 a, Key2 b, Key2 c) {
    const LocalKey ab = localize(b, a);
    const LocalKey bc = localize(c, b);
    const LocalKey ca = localize(a, c);
    unsigned corner = is_larger_angle(b, a, c, ca.square, bc.square) ? 1 : 0;
    double longest = corner == 0 ? bc.square : ca.square;
    if (is_larger_angle(c, corner == 0 ? a : b, corner == 0 ? b : a, ab.square, longest)) {
        corner = 2;
        longest = ab.square;
    }
    const LocalKey& in = corner == 0 ? ca : corner == 1 ? ab : bc;
    const LocalKey& out = corner == 0 ? ab : corner == 1 ? bc : ca;
    const Key2 apex = corner == 0 ? a : corner == 1 ? b : c;
    const Key2 before = corner == 0 ? c : corner == 1 ? a : b;
    const Key2 after = corner == 0 ? b : corner == 1 ? c : a;
    const LocalKey back{-in.x, -in.y, in.square};
    return {corner, longest, inner_product_of(apex, before, after, back, out),
            doubled_area_of(apex, before, after, back, out)};
}

/// The corner with the obtuse angle as a set of one corner (bit i: corner i), empty if there is none. Exact.
inline unsigned obtuse_corner(Key2 a, Key2 b, Key2 c) {
    const LargestAngle angle = find_largest_angle(a, b, c);
    return angle.inner < 0 ? 1U << angle.corner : 0U;
}

}  // namespace tinwright::internal

#endif
