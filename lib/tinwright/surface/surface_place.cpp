#include "tinwright/surface/surface_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tinwright {

namespace {

constexpr double kLargestAt = 0x1p50;  // predicates take four times as much: places beside the TIN are near

}  // namespace

QueryLattice::QueryLattice(const Tin& tin) : lattice_(tin.lattice) {
    double largest = 1;
    for (const Key2& key : tin.keys) {
        largest = std::max(largest, std::max(key.x, key.y));
    }
    while (largest * scale_ * 2 <= kLargestAt) {
        scale_ *= 2;
    }
    step_ = tin.lattice.quantum() / scale_;
}

Key2 QueryLattice::at(Point2 position) const {
    const auto axis = [&](double coordinate, double origin, double steps_per_unit) {
        const double steps = coordinate * steps_per_unit;
        const double nearest = std::nearbyint(steps);
        // A decimal coordinate and its product with a power of ten are each rounded once.
        const double rounding = std::abs(steps) * 2 * std::numeric_limits<double>::epsilon();
        const double key = std::abs(steps - nearest) <= rounding ? nearest - origin : steps - origin;
        return std::nearbyint(key * scale_);
    };
    const double steps_per_unit = lattice_.steps_per_unit();
    const Key2 origin = lattice_.origin();
    return {axis(position.x, origin.x, steps_per_unit), axis(position.y, origin.y, steps_per_unit)};
}

bool QueryLattice::is_near(Key2 at) {
    constexpr double kLimit = 0x1p52;
    return std::abs(at.x) <= kLimit && std::abs(at.y) <= kLimit;
}

Point2 QueryLattice::position(Key2 at) const { return lattice_.position({at.x / scale_, at.y / scale_}); }

}  // namespace tinwright
