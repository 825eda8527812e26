#ifndef TINWRIGHT_CRITERIA_ECCENTRICITY_HPP
#define TINWRIGHT_CRITERIA_ECCENTRICITY_HPP

#include <cmath>
#include <span>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/criteria/largest_angle.hpp"

namespace tinwright {

/// Min-max eccentricity [tan1993, Sec. 4.4]: how far the centre of a face's circumcircle lies outside the
/// face, zero unless it is obtuse. For an angle A opposite an edge of length L this is L |cot A| / 2;
/// measured by the square of L cot A, in keys.
class EccentricityCriterion {
  public:
    static constexpr CriterionTraits kTraits{.name = "eccentricity",
                                             .measure = "eccentricity",
                                             .unit = MeasureUnit::Length,
                                             .is_greater_better = false,
                                             .condition = InsertionCondition::Weak};

    explicit EccentricityCriterion(const Tin& tin) : keys_(tin.keys), quantum_(tin.lattice.quantum()) {}

    [[nodiscard]] double measure(VertexId a, VertexId b, VertexId c) const {
        const internal::LargestAngle angle =
            internal::find_largest_angle(keys_[a.value], keys_[b.value], keys_[c.value]);
        if (angle.inner >= 0) {
            return 0;
        }
        const double cotangent = angle.inner / angle.doubled_area;
        return angle.longest_square * (cotangent * cotangent);
    }

    /// None has less than zero, so only obtuse faces have an anchor.
    [[nodiscard]] unsigned anchors(VertexId a, VertexId b, VertexId c) const {
        return internal::obtuse_corner(keys_[a.value], keys_[b.value], keys_[c.value]);
    }

    [[nodiscard]] double to_report(double measure) const { return std::sqrt(measure) * quantum_ / 2; }
    [[nodiscard]] double from_report(double eccentricity) const {
        const double steps = 2 * eccentricity / quantum_;
        return steps * steps;
    }

  private:
    std::span<const Key2> keys_;
    double quantum_;
};

}  // namespace tinwright

#endif
