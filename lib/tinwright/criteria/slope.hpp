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
        return std::copysign(steps * steps, steps);
    }

    /// Cuts the search for an edge q s short. In an improvement no face is steeper than the face to improve,
    /// of slope M, so along the edge it rises at some rate g with |g| < M, and where it crosses an edge a b
    /// of the old faces at y it differs from a by less than M |y - a|, and from b likewise
    /// (docs/criteria.md).
    class Cut {
      public:
        /// Asked at every fourth level of the search: it costs as much as a step and bounds them all.
        static constexpr unsigned kLevels = 4;

        /// The rates still possible.
        struct State {
            double least = 0;
            double greatest = 0;
        };

        Cut(const SlopeCriterion& criterion, VertexId q, VertexId /*p*/, VertexId /*r*/, double measure)
            : criterion_(criterion), q_(q), slope_(std::sqrt(measure)) {}

        [[nodiscard]] State start() const { return {-slope_, slope_}; }

        /// Narrows `state` for edges that cross a b; returns whether a rate is left.
        bool cross(State& state, VertexId a, VertexId b) const {
            // Far more than roundings add up to.
            constexpr double kSlack = 1e-9;
            const std::span<const Key2> keys = criterion_.keys_;
            const std::span<const double> z = criterion_.z_;
            const Key2 at_a = keys[a.value];
            const Key2 at_b = keys[b.value];
            const Key2 at_q = keys[q_.value];
            const double farthest =
                std::max(length_at_most(at_a, at_q), length_at_most(at_b, at_q)) * (1 + kSlack);
            const double length = length_at_most(at_a, at_b);
            const double nearest = farthest * (kLeastShare * (1 - 3 * kSlack)) - length;
            if (nearest <= 0) {
                return true;
            }
            // With |y - a| + |y - b| = |a b| the two bounds from below meet halfway, so do those from above.
            const double middle = ((z[a.value] - z[q_.value]) + (z[b.value] - z[q_.value])) / 2;
            const double lower = middle - slope_ * length / 2;
            const double upper = middle + slope_ * length / 2;
            state.least = std::max(state.least, lower / (lower > 0 ? farthest : nearest));
            state.greatest = std::min(state.greatest, upper / (upper < 0 ? farthest : nearest));
            return state.least <= state.greatest + kSlack * slope_;
        }

      private:
        /// The distance of two keys or up to a twelfth more, without a square root.
        static double length_at_most(Key2 a, Key2 b) {
            constexpr double kDiagonal = 0.41421356237309515;  // sqrt(2) - 1, rounded up
            const double x = std::abs(a.x - b.x);
            const double y = std::abs(a.y - b.y);
            return std::max(x, y) + kDiagonal * std::min(x, y);
        }
        /// A distance is at least this share of `length_at_most`: cos(pi / 8), rounded down.
        static constexpr double kLeastShare = 0.9238795325112867;

        const SlopeCriterion& criterion_;
        VertexId q_;
        double slope_;
    };

  private:
    std::span<const Key2> keys_;
    std::span<const double> z_;
    double quantum_;
};

}  // namespace tinwright

#endif
