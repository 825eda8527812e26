#include "tinwright/optimal/expandable_edge.hpp"

#include <algorithm>
#include <tuple>

namespace tinwright::internal {

std::optional<ExpandableEdgeSearch::Diagonal> ExpandableEdgeSearch::find_among_many(VertexPair at_least,
                                                                                    VertexPair before,
                                                                                    const Poll& poll) {
    const std::size_t size = polygon_.size();
    known_.reserve(std::min(size * size, kMostKnown) + size);
    for (VertexPair from = at_least; is_shorter(from, before);) {
        VertexPair limit = before;
        known_.clear();
        for (std::uint32_t position = 0; position < polygon_.size(); ++position) {
            if (!poll()) {
                return std::nullopt;
            }
            note(position, from, limit, polygon_.look(position, before, space_));
            if (known_.size() > kMostKnown) {
                limit = keep_shorter_half();
            }
        }
        if (const auto best = find_among_known()) {
            return best;
        }
        from = limit;
    }
    return std::nullopt;
}

/// Returns the pair that all that were kept come before.
VertexPair ExpandableEdgeSearch::keep_shorter_half() {
    const auto middle = known_.begin() + static_cast<std::ptrdiff_t>(known_.size() / 2);
    std::nth_element(known_.begin(), middle, known_.end(), [this](const HalfKnown& x, const HalfKnown& y) {
        return is_shorter(ends(x.edge), ends(y.edge));
    });
    const VertexPair limit = ends(middle->edge);
    std::erase_if(known_, [&](const HalfKnown& half) { return !is_shorter(ends(half.edge), limit); });
    return limit;
}

/// Step 3 for all 2-edges that are known from both ends.
std::optional<ExpandableEdgeSearch::Diagonal> ExpandableEdgeSearch::find_among_known() {
    std::sort(known_.begin(), known_.end(), [](const HalfKnown& x, const HalfKnown& y) {
        return std::tie(x.edge.low, x.edge.high, x.is_from_high) <
               std::tie(y.edge.low, y.edge.high, y.is_from_high);
    });
    candidates_ += known_.size() / 2;
    std::optional<Diagonal> best;
    for (std::size_t k = 0; k + 1 < known_.size(); k += 2) {
        const Diagonal& edge = known_[k].edge;
        if (is_crossed_on_both_sides(known_[k], known_[k + 1]) &&
            (!best || is_shorter(ends(edge), ends(*best)))) {
            best = edge;
        }
    }
    return best;
}

/// Step 2 for all 2-edges from `eye` that come before `limit` but not before `from`: the empty lines next to
/// them. The first and the last line are sides.
void ExpandableEdgeSearch::note(std::uint32_t eye, VertexPair from, VertexPair limit,
                                std::span<const WallPolygon::Sight> sights) {
    const std::size_t count = sights.size();
    behind_.assign(count, 0);
    for (std::size_t k = count; k-- > 1;) {
        behind_[k - 1] = sights[k].is_right_empty ? sights[k].position : behind_[k];
    }
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const WallPolygon::Sight& sight = sights[k];
        if (!sight.is_left_empty && !sight.is_right_empty &&
            !is_shorter({polygon_.vertex(eye), sight.vertex}, from) &&
            is_shorter({polygon_.vertex(eye), sight.vertex}, limit)) {
            known_.push_back({{std::min(eye, sight.position), std::max(eye, sight.position)},
                              eye > sight.position,
                              before,
                              behind_[k]});
        }
        if (sight.is_left_empty) {
            before = sight.position;
        }
    }
}

std::optional<ExpandableEdgeSearch::Diagonal> ExpandableEdgeSearch::find_among_few(VertexPair at_least,
                                                                                   VertexPair before) {
    collect_pairs(at_least, before);
    polygon_.keep_sights(before);
    for (const Diagonal& pair : pairs_) {
        const auto of_low = know(pair.low, pair.high, before);
        if (!of_low) {
            continue;
        }
        ++candidates_;
        const auto of_high = know(pair.high, pair.low, before);
        if (is_crossed_on_both_sides(*of_low, *of_high)) {
            return pair;
        }
    }
    return std::nullopt;
}

/// The pairs of corners in question, shortest first. Neighbours are among them if a side is so long.
void ExpandableEdgeSearch::collect_pairs(VertexPair at_least, VertexPair before) {
    pairs_.clear();
    for (std::uint32_t low = 0; low + 2 < polygon_.size(); ++low) {
        for (std::uint32_t high = low + 2; high < polygon_.size(); ++high) {
            const VertexPair pair{polygon_.vertex(low), polygon_.vertex(high)};
            if (pair.first != pair.second && is_shorter(pair, before) && !is_shorter(pair, at_least)) {
                pairs_.push_back({low, high});
            }
        }
    }
    std::sort(pairs_.begin(), pairs_.end(),
              [this](const Diagonal& x, const Diagonal& y) { return is_shorter(ends(x), ends(y)); });
}

/// Steps 1 and 2 for the line from `eye` to the corner `other`; empty if there is none, or it is no 2-edge.
std::optional<ExpandableEdgeSearch::HalfKnown> ExpandableEdgeSearch::know(std::uint32_t eye,
                                                                          std::uint32_t other,
                                                                          VertexPair before) {
    const std::span<const WallPolygon::Sight> sights = polygon_.look(eye, before, space_);
    const auto found = std::find_if(sights.begin(), sights.end(),
                                    [&](const auto& sight) { return sight.position == other; });
    if (found == sights.end() || found->is_left_empty || found->is_right_empty) {
        return std::nullopt;
    }
    auto nearest_before = found;
    while (!nearest_before->is_left_empty) {
        --nearest_before;
    }
    auto nearest_behind = found;
    while (!nearest_behind->is_right_empty) {
        ++nearest_behind;
    }
    return HalfKnown{{std::min(eye, other), std::max(eye, other)},
                     eye > other,
                     nearest_before->position,
                     nearest_behind->position};
}

/// Step 3: on each side of the 2-edge the empty lines from its two ends meet or cross; by the order of their
/// other ends along the ring (Crossing Lemma).
bool ExpandableEdgeSearch::is_crossed_on_both_sides(const HalfKnown& of_low, const HalfKnown& of_high) const {
    const std::uint32_t n = polygon_.size();
    const auto way = [&](std::uint32_t position) { return (position + n - of_low.edge.high) % n; };
    return of_high.behind <= of_low.before && way(of_low.behind) <= way(of_high.before);
}

}  // namespace tinwright::internal
