#ifndef TINWRIGHT_CRITERIA_SLOPE_HPP
#define TINWRIGHT_CRITERIA_SLOPE_HPP

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/criteria/largest_angle.hpp"

namespace tinwright {

/// Min-max slope [tan1993, Sec. 4.3]: the length of a face's gradient. Measured by its square, z units over
/// keys.
class SlopeCriterion {
  public:
    static constexpr CriterionTraits kTraits{.name = "slope",
                                             .measure = "slope",
                                             .unit = MeasureUnit::Ratio,
                                             .is_greater_better = false,
                                             .condition = InsertionCondition::Weak};

    explicit SlopeCriterion(const Tin& tin) : keys_(tin.keys), z_(tin.z), quantum_(tin.lattice.quantum()) {}

    /// Differences are taken from the corner of least number, so that the bits do not depend on the order.
    [[nodiscard]] double measure(VertexId a, VertexId b, VertexId c) const {
        if (b < a) {
            std::swap(a, b);
        }
        if (c < a) {
            std::swap(a, c);
        }
        const Key2 origin = keys_[a.value];
        const internal::LocalKey u = internal::localize(keys_[b.value], origin);
        const internal::LocalKey v = internal::localize(keys_[c.value], origin);
        const double du = z_[b.value] - z_[a.value];
        const double dv = z_[c.value] - z_[a.value];
        const double area = internal::doubled_area_of(origin, keys_[b.value], keys_[c.value], u, v);
        const double x = (du * v.y - dv * u.y) / area;
        const double y = (u.x * dv - v.x * du) / area;
        return x * x + y * y;
    }

    /// The corners whose line of steepest descent runs through the face. Floating point may leave two in
    /// question. None if there are two for certain, when an edge runs along the gradient: no triangulation
    /// breaks the face at both; and none if it is level.
    [[nodiscard]] unsigned anchors(VertexId a, VertexId b, VertexId c) const;

    [[nodiscard]] double to_report(double measure) const { return std::sqrt(measure) / quantum_; }
    [[nodiscard]] double from_report(double ratio) const {
        const double steps = ratio * quantum_;
        return steps * steps;
    }

  private:
    std::span<const Key2> keys_;
    std::span<const double> z_;
    double quantum_;
};

}  // namespace tinwright

#endif
