#ifndef TINWRIGHT_CRITERIA_ANGLE_HPP
#define TINWRIGHT_CRITERIA_ANGLE_HPP

#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/criteria/largest_angle.hpp"

namespace tinwright {

/// Min-max angle [tan1993, Sec. 4.1]. Measured by the negated cotangent of the largest angle, which grows
/// with it, takes one division, and keeps its relative precision up to 180 degrees, where a cosine loses it.
class AngleCriterion {
  public:
    static constexpr CriterionTraits kTraits{.name = "angle",
                                             .measure = "largest angle",
                                             .unit = MeasureUnit::Degree,
                                             .is_greater_better = false,
                                             .condition = InsertionCondition::Strong};

    explicit AngleCriterion(const Tin& tin) : keys_(tin.keys) {}

    [[nodiscard]] double measure(VertexId a, VertexId b, VertexId c) const {
        const internal::LargestAngle angle =
            internal::find_largest_angle(keys_[a.value], keys_[b.value], keys_[c.value]);
        return (0.0 - angle.inner) / angle.doubled_area;  // never a negative zero
    }

    /// A triangulation without obtuse faces is optimal, so only obtuse ones have an anchor.
    [[nodiscard]] unsigned anchors(VertexId a, VertexId b, VertexId c) const {
        return internal::obtuse_corner(keys_[a.value], keys_[b.value], keys_[c.value]);
    }

    [[nodiscard]] static double to_report(double measure) {
        return std::atan2(1.0, -measure) * (180 / std::numbers::pi);
    }
    [[nodiscard]] static double from_report(double degrees) {
        constexpr double kNone = std::numeric_limits<double>::infinity();
        if (degrees <= 0 || degrees >= 180) {
            return degrees <= 0 ? -kNone : kNone;
        }
        return std::tan((degrees - 90) * (std::numbers::pi / 180));  // -cot, zero at 90
    }

  private:
    std::span<const Key2> keys_;
};

}  // namespace tinwright

#endif
