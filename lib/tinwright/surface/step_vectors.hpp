#ifndef TINWRIGHT_SURFACE_STEP_VECTORS_HPP
#define TINWRIGHT_SURFACE_STEP_VECTORS_HPP

#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/predicates_internal.hpp"

/// Vectors between places of a `QueryLattice`. Their coordinates are whole steps, hence exact.
namespace tinwright::steps {

inline Point2 vector_to(const internal::LocalKey& a) { return {a.x, a.y}; }
inline Point2 vector_between(const internal::LocalKey& a, const internal::LocalKey& b) {
    return {b.x - a.x, b.y - a.y};
}
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
inline double square(Point2 a) { return dot(a, a); }
/// A quarter turn clockwise.
inline Point2 turned(Point2 a) { return {a.y, -a.x}; }
inline void add(Point2& sum, double factor, Point2 term) {
    sum.x += factor * term.x;
    sum.y += factor * term.y;
}

/// Twice the area between two vectors, with a relative error of some dozen units in the last place.
inline double precise_cross(Point2 a, Point2 b) {
    constexpr double kThin = 0x1p-5;  // beside the terms, below which the area is computed exactly
    const double left = a.x * b.y;
    const double right = a.y * b.x;
    const double area = left - right;
    if (std::abs(area) > kThin * (std::abs(left) + std::abs(right))) [[likely]] {
        return area;
    }
    return doubled_area({0, 0}, {a.x, a.y}, {b.x, b.y});
}

}  // namespace tinwright::steps

#endif
