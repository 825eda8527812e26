#include "tinwright/surface/face_circles.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/step_vectors.hpp"

namespace tinwright {

FaceCircles::FaceCircles(const Tin& tin, const QueryLattice& lattice) : tin_(tin), lattice_(lattice) {
    circles_.resize(tin.mesh.slot_count());
    using Slots = tbb::blocked_range<std::uint32_t>;
    tbb::parallel_for(Slots(0, static_cast<std::uint32_t>(circles_.size()), 4096), [&](const Slots& slots) {
        for (std::uint32_t f = slots.begin(); f < slots.end(); ++f) {
            circles_[f] = tin.mesh.is_terrain({f}) ? make_circle({f}) : Circle{0, 0, -1, 0};
        }
    });
}

// Let C be the centre, c what is kept of it, P a corner and Q the place. Then |P - C|^2 - |Q - C|^2 differs
// from the same with c by 2 (C - c)(Q - P), at most 2 |C - c| (r + d) for the distances r of P and d of Q.
// For d up to 2 r that is 6 |C - c| r, and rounding adds some units of r^2. For greater d the depth is beyond
// r^2 / 2 anyway, provided that c is not far off.
FaceCircles::Circle FaceCircles::make_circle(FaceId f) const {
    using internal::kUnit;
    const auto key = [&](unsigned i) { return lattice_.scaled(tin_.key(tin_.mesh.vertex(f, i))); };
    const Key2 p = key(0);
    const Point2 b{key(1).x - p.x, key(1).y - p.y};
    const Point2 c{key(2).x - p.x, key(2).y - p.y};
    const double bb = steps::square(b);
    const double cc = steps::square(c);
    const double half = 0.5 / steps::precise_cross(b, c);
    Circle circle{};
    circle.x = p.x + (c.y * bb - b.y * cc) * half;
    circle.y = p.y + (b.x * cc - c.x * bb) * half;
    circle.square = (circle.x - p.x) * (circle.x - p.x) + (circle.y - p.y) * (circle.y - p.y);
    // The area is off by up to 50 units, the terms over it by less than 10, the sums with p by one.
    const double terms = ((std::abs(c.y) + std::abs(c.x)) * bb + (std::abs(b.y) + std::abs(b.x)) * cc) * half;
    const double off = kUnit * (80 * terms + 2 * (std::abs(circle.x) + std::abs(circle.y)));
    const double radius = std::sqrt(circle.square);
    circle.doubt = 16 * off <= radius ? 8 * off * radius + 64 * kUnit * circle.square
                                      : std::numeric_limits<double>::infinity();
    return circle;
}

bool FaceCircles::is_inside_exactly(FaceId f, Key2 at) const {
    const auto key = [&](unsigned i) { return lattice_.scaled(tin_.key(tin_.mesh.vertex(f, i))); };
    return incircle(key(0), key(1), key(2), at) > 0;
}

}  // namespace tinwright
