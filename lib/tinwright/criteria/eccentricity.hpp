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
        return std::copysign(steps * steps, steps);
    }

    /// Cuts the search for an edge q s short: a face q p s that is obtuse at p has at least half the
    /// eccentricity that s is ahead of p in the direction from q to p, so no s that is ahead by twice the
    /// eccentricity to improve, or more, will do; the same holds for r (docs/criteria.md).
    class Cut {
      public:
        static constexpr unsigned kLevels = 1;
        struct State {};

        Cut(const EccentricityCriterion& criterion, VertexId q, VertexId p, VertexId r, double measure)
            : keys_(criterion.keys_), p_(line(q, p, measure)), r_(line(q, r, measure)) {}

        static State start() { return {}; }

        /// Whether anything in sight behind the edge a b can do.
        bool cross(State& /*state*/, VertexId a, VertexId b) const {
            const Key2 at_a = keys_[a.value];
            const Key2 at_b = keys_[b.value];
            return !(is_beyond(p_, at_a) && is_beyond(p_, at_b)) &&
                   !(is_beyond(r_, at_a) && is_beyond(r_, at_b));
        }

      private:
        /// What is ahead of `from` by `least` or more in a direction not of unit length.
        struct Beyond {
            Key2 from;
            internal::Direction ahead;
            double least;
        };

        [[nodiscard]] Beyond line(VertexId q, VertexId from, double measure) const {
            constexpr double kSlack = 1 + 1e-12;
            const Key2 at = keys_[from.value];
            const internal::Direction ahead = internal::direction(at, keys_[q.value]);
            return {at, ahead, std::sqrt(measure * (ahead.x * ahead.x + ahead.y * ahead.y)) * kSlack};
        }
        static bool is_beyond(const Beyond& line, Key2 key) {
            // More than the roundings of two products and their sum.
            constexpr double kRounding = 1e-15;
            const internal::Direction way = internal::direction(key, line.from);
            const double x = way.x * line.ahead.x;
            const double y = way.y * line.ahead.y;
            return x + y - kRounding * (std::abs(x) + std::abs(y)) >= line.least;
        }

        std::span<const Key2> keys_;
        Beyond p_;
        Beyond r_;
    };

  private:
    std::span<const Key2> keys_;
    double quantum_;
};

}  // namespace tinwright

#endif
