#ifndef TINWRIGHT_CRITERIA_HEIGHT_HPP
#define TINWRIGHT_CRITERIA_HEIGHT_HPP

#include <algorithm>
#include <cmath>
#include <span>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/criteria/largest_angle.hpp"

namespace tinwright {

/// Max-min height [tan1993, Sec. 4.2]: the least distance of a corner from the line through the other two.
/// Measured by the inverse of its square, in keys.
class HeightCriterion {
  public:
    static constexpr CriterionTraits kTraits{.name = "height",
                                             .measure = "least height",
                                             .unit = MeasureUnit::Length,
                                             .is_greater_better = true,
                                             .condition = InsertionCondition::Strong};

    explicit HeightCriterion(const Tin& tin) : keys_(tin.keys), quantum_(tin.lattice.quantum()) {}

    [[nodiscard]] double measure(VertexId a, VertexId b, VertexId c) const {
        const internal::LargestAngle angle =
            internal::find_largest_angle(keys_[a.value], keys_[b.value], keys_[c.value]);
        return angle.longest_square / (angle.doubled_area * angle.doubled_area);
    }

    /// A worst face that is not obtuse cannot be improved [tan1993, Lemma 4.5], so only obtuse ones have an
    /// anchor.
    [[nodiscard]] unsigned anchors(VertexId a, VertexId b, VertexId c) const {
        return internal::obtuse_corner(keys_[a.value], keys_[b.value], keys_[c.value]);
    }

    [[nodiscard]] double to_report(double measure) const { return quantum_ / std::sqrt(measure); }
    [[nodiscard]] double from_report(double height) const {
        const double steps = std::max(height, 0.0) / quantum_;
        return 1 / (steps * steps);
    }

  private:
    std::span<const Key2> keys_;
    double quantum_;
};

}  // namespace tinwright

#endif
