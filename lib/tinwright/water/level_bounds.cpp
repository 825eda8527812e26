#include "tinwright/water/level_bounds.hpp"

#include <algorithm>

namespace tinwright {

namespace {

bool is_given(const LevelNode& node) { return node.lowest == node.highest; }

/// Of each step the highest lower bound in it and below it, and the lowest upper bound in it and above it.
/// Nodes that `counts` refuses have no bounds.
template <class Counts>
std::vector<LevelRange> spread_bounds(std::span<const LevelNode> nodes, const FlowSteps& steps,
                                      const FallGraph& graph, const Counts& counts) {
    std::vector<LevelRange> ranges(steps.count);
    for (std::uint32_t node = 0; node < nodes.size(); ++node) {
        if (counts(node)) {
            LevelRange& range = ranges[steps.step[node]];
            range.lowest = std::max(range.lowest, nodes[node].lowest);
            range.highest = std::min(range.highest, nodes[node].highest);
        }
    }
    for (std::uint32_t step = 0; step < steps.count; ++step) {
        for (const std::uint32_t upper : graph.uppers(step)) {
            ranges[step].highest = std::min(ranges[step].highest, ranges[upper].highest);
        }
    }
    for (auto step = static_cast<std::uint32_t>(steps.count); step-- > 0;) {
        for (const std::uint32_t lower : graph.lowers(step)) {
            ranges[step].lowest = std::max(ranges[step].lowest, ranges[lower].lowest);
        }
    }
    return ranges;
}

class BoundSearch {
  public:
    BoundSearch(std::span<const LevelNode> nodes, std::vector<Fall> falls)
        : nodes_(nodes),
          bounds_{std::move(falls), {}, FallGraph(0, {}), {}, {}, {}},
          is_dropped_(nodes.size(), false) {}

    LevelBounds run() {
        const bool has_bounds = std::any_of(nodes_.begin(), nodes_.end(), [](const LevelNode& node) {
            return LevelRange{node.lowest, node.highest} != LevelRange{};
        });
        find_steps();
        if (has_bounds) {
            cut_between_given();
            drop(spread([&](std::uint32_t node) { return is_given(nodes_[node]); }));
            drop(spread([&](std::uint32_t node) { return !is_dropped_[node]; }));
        }
        bounds_.ranges = spread([&](std::uint32_t node) { return has_bounds && !is_dropped_[node]; });
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            if (is_dropped_[node]) {
                bounds_.dropped.push_back(node);
            }
        }
        return std::move(bounds_);
    }

  private:
    template <class Counts>
    std::vector<LevelRange> spread(const Counts& counts) const {
        return spread_bounds(nodes_, bounds_.steps, bounds_.graph, counts);
    }

    void find_steps() {
        bounds_.steps = find_flow_steps(FallGraph(nodes_.size(), bounds_.falls));
        bounds_.graph = FallGraph(bounds_.steps.count, falls_between(bounds_.steps, bounds_.falls));
    }

    void cut_between_given() {
        const auto ranges = spread([&](std::uint32_t node) { return is_given(nodes_[node]); });
        const auto range_of = [&](std::uint32_t node) { return ranges[bounds_.steps.step[node]]; };
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            const double level = nodes_[node].lowest;
            const auto [lowest, highest] = range_of(node);
            if (is_given(nodes_[node]) && (level < lowest || level > highest)) {
                const bool asks_up =
                    level < lowest && (level <= highest || lowest - level >= level - highest);
                bounds_.contradicted.emplace_back(node, asks_up ? lowest : highest);
            }
        }
        if (bounds_.contradicted.empty()) {
            return;
        }
        std::erase_if(bounds_.falls, [&](const Fall& fall) {
            const LevelNode& upper = nodes_[fall.upper];
            const LevelNode& lower = nodes_[fall.lower];
            return (is_given(upper) && upper.lowest < range_of(fall.lower).lowest) ||
                   (is_given(lower) && lower.highest > range_of(fall.upper).highest);
        });
        find_steps();
    }

    /// Drops the bounds, but those of given levels, that these do not allow.
    void drop(const std::vector<LevelRange>& ranges) {
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            const LevelRange& range = ranges[bounds_.steps.step[node]];
            is_dropped_[node] =
                is_dropped_[node] || (!is_given(nodes_[node]) && (nodes_[node].highest < range.lowest ||
                                                                  nodes_[node].lowest > range.highest));
        }
    }

    std::span<const LevelNode> nodes_;
    LevelBounds bounds_;
    std::vector<bool> is_dropped_;
};

}  // namespace

LevelBounds find_level_bounds(std::span<const LevelNode> nodes, std::vector<Fall> falls) {
    return BoundSearch(nodes, std::move(falls)).run();
}

}  // namespace tinwright
