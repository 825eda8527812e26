#ifndef TINWRIGHT_CRITERIA_LENGTH_HPP
#define TINWRIGHT_CRITERIA_LENGTH_HPP

#include <algorithm>
#include <span>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/norm.hpp"

namespace tinwright {

/// Min-max length [tan1993, Ch. 5]: the longest edge of a face, in keys. Edge insertion gets caught in local
/// optima under it [tan1993, Fig. 5.2]; what makes it optimal is `optimal/min_max_length.hpp`.
class LengthCriterion {
  public:
    static constexpr CriterionTraits kTraits{.name = "length",
                                             .measure = "longest edge",
                                             .unit = MeasureUnit::Length,
                                             .is_greater_better = false,
                                             .condition = InsertionCondition::None};

    explicit LengthCriterion(const Tin& tin, Norm norm = {})
        : keys_(tin.keys), quantum_(tin.lattice.quantum()), norm_(norm) {}

    [[nodiscard]] double measure(VertexId a, VertexId b, VertexId c) const {
        const Key2 p = keys_[a.value];
        const Key2 q = keys_[b.value];
        const Key2 r = keys_[c.value];
        return std::max({length(norm_, p, q), length(norm_, q, r), length(norm_, r, p)});
    }

    /// The corner opposite the longest edge, which has to go; of several equally long ones all have to. Not
    /// quite what the concept asks for: an edge from elsewhere may cut the longest edge off too, which is why
    /// insertions from here can get caught.
    [[nodiscard]] unsigned anchors(VertexId a, VertexId b, VertexId c) const {
        const Key2 p = keys_[a.value];
        const Key2 q = keys_[b.value];
        const Key2 r = keys_[c.value];
        const bool is_pq = compare_lengths(norm_, p, q, q, r) >= 0 && compare_lengths(norm_, p, q, r, p) >= 0;
        const bool is_qr = compare_lengths(norm_, q, r, p, q) >= 0 && compare_lengths(norm_, q, r, r, p) >= 0;
        const bool is_rp = compare_lengths(norm_, r, p, p, q) >= 0 && compare_lengths(norm_, r, p, q, r) >= 0;
        return (is_qr ? 1U : 0U) | (is_rp ? 2U : 0U) | (is_pq ? 4U : 0U);
    }

    [[nodiscard]] double to_report(double measure) const { return quantum_ * measure; }
    [[nodiscard]] double from_report(double length) const { return length / quantum_; }

  private:
    std::span<const Key2> keys_;
    double quantum_;
    Norm norm_;
};

}  // namespace tinwright

#endif
