#include "tinwright/optimal/expandable_edge.hpp"

#include <algorithm>
#include <tuple>

namespace tinwright::internal {

std::optional<ExpandableEdgeSearch::Diagonal> ExpandableEdgeSearch::find(VertexId a, VertexId b,
                                                                         const Poll& poll) {
    known_.clear();
    for (std::uint32_t position = 0; position < polygon_.size(); ++position) {
        if (!poll()) {
            return std::nullopt;
        }
        polygon_.look(position, a, b, sights_);
        note(position);
    }
    std::sort(known_.begin(), known_.end(), [](const HalfKnown& x, const HalfKnown& y) {
        return std::tie(x.low, x.high, x.is_from_high) < std::tie(y.low, y.high, y.is_from_high);
    });
    candidates_ += known_.size() / 2;

    std::optional<Diagonal> best;
    for (std::size_t k = 0; k + 1 < known_.size(); k += 2) {
        const HalfKnown& of_low = known_[k];
        const HalfKnown& of_high = known_[k + 1];
        const auto is_shorter = [&](const Diagonal& than) {
            return polygon_.order().is_shorter(polygon_.vertex(of_low.low), polygon_.vertex(of_low.high),
                                               polygon_.vertex(than.low), polygon_.vertex(than.high));
        };
        if (is_crossed_on_both_sides(of_low, of_high) && (!best || is_shorter(*best))) {
            best = Diagonal{of_low.low, of_low.high};
        }
    }
    return best;
}

/// Step 2: for each 2-edge from `eye` the empty lines next to it. The first and the last line are sides.
void ExpandableEdgeSearch::note(std::uint32_t eye) {
    const std::size_t count = sights_.size();
    behind_.assign(count, 0);
    for (std::size_t k = count; k-- > 1;) {
        behind_[k - 1] = sights_[k].is_right_empty ? sights_[k].position : behind_[k];
    }
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const WallPolygon::Sight& sight = sights_[k];
        if (!sight.is_left_empty && !sight.is_right_empty) {
            known_.push_back({std::min(eye, sight.position), std::max(eye, sight.position),
                              eye > sight.position, before, behind_[k]});
        }
        if (sight.is_left_empty) {
            before = sight.position;
        }
    }
}

/// Step 3: on each side of the 2-edge the empty lines from its two ends meet or cross; by the order of their
/// other ends along the ring (Crossing Lemma).
bool ExpandableEdgeSearch::is_crossed_on_both_sides(const HalfKnown& of_low, const HalfKnown& of_high) const {
    const std::uint32_t n = polygon_.size();
    const auto way = [&](std::uint32_t position) { return (position + n - of_low.high) % n; };
    return of_high.behind <= of_low.before && way(of_low.behind) <= way(of_high.before);
}

}  // namespace tinwright::internal
