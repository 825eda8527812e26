#ifndef TINWRIGHT_DELAUNAY_CIRCLE_POINTS_HPP
#define TINWRIGHT_DELAUNAY_CIRCLE_POINTS_HPP

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/delaunay/lines_in_disks.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {

/// A place on a blocking circle that may become a vertex: the ends of the walls of [tan1993, Sec. 6.2.2].
struct CirclePoint {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    Key2 key{};  ///< rounded to the lattice
    std::uint32_t line_edge =
        kNone;  ///< the line's edge that meets the circle there; kNone: another circle does
    std::uint32_t disk = 0;
    bool is_done = false;  ///< whether it has become one, or cannot
};

/// All such places, in an index.
class CirclePoints {
  public:
    CirclePoints(const BlockingDisks& disks, std::span<const Key2> keys, const LinesInDisks& lines);

    [[nodiscard]] CirclePoint& operator[](std::uint32_t i) { return points_[i]; }

    /// Of the points that are not done, strictly left of the line a -> b and inside the circle through a, b,
    /// c, and for which `accepts(point)`: the one that sees a and b under the greatest angle. a, b, c
    /// counter-clockwise, the angle at c obtuse.
    template <class Accepts>
    [[nodiscard]] std::optional<std::uint32_t> find_in_cap(Key2 a, Key2 b, Key2 c,
                                                           const Accepts& accepts) const {
        const Cap cap(a, b, c);
        std::optional<std::uint32_t> best;
        Key2 top = c;
        index_.visit_meeting(
            cap.box(), [&](const KeyBox& box) { return cap.is_apart(box); },
            [&](std::uint32_t i) {
                const CirclePoint& point = points_[i];
                if (!point.is_done && orient2d(a, b, point.key) > 0) {
                    const int inside = incircle(a, b, top, point.key);
                    if ((inside > 0 || (inside == 0 && best && i < *best)) && accepts(point)) {
                        best = i;
                        top = point.key;
                    }
                }
                return true;
            });
        return best;
    }

  private:
    /// The part of the disk through a, b, c on the side of c, roughly: it is never taken for less.
    class Cap {
      public:
        Cap(Key2 a, Key2 b, Key2 c);
        [[nodiscard]] const KeyBox& box() const { return box_; }
        [[nodiscard]] bool is_apart(const KeyBox& box) const;

      private:
        Key2 a_;
        Key2 b_;
        Offset normal_;  // of length 1, to the left
        double height_;
        KeyBox box_;
    };

    std::vector<CirclePoint> points_;
    BoxTree index_;
};

}  // namespace tinwright

#endif
