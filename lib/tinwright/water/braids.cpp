#include <algorithm>
#include <limits>
#include <utility>

#include "tinwright/water/fall_graph.hpp"
#include "tinwright/water/flow.hpp"

namespace tinwright {

namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

/// Divides the falls, taken without directions, into biconnected parts: depth-first search with a stack of
/// falls (Hopcroft's and Tarjan's), without recursion.
class BiconnectedSearch {
  public:
    BiconnectedSearch(const FallGraph& graph, std::span<const Fall> falls)
        : starts_(graph.size() + 1, 0),
          ends_(2 * falls.size()),
          seen_(graph.size(), kUnseen),
          reach_(graph.size(), 0),
          next_(graph.size(), 0) {
        // A fall and its reverse are two ways to the same neighbour, which makes no part of its own.
        std::size_t used = 0;
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            const auto lowers = graph.lowers(node);
            const auto uppers = graph.uppers(node);
            const auto begin = ends_.begin() + static_cast<std::ptrdiff_t>(used);
            const auto end =
                std::set_union(lowers.begin(), lowers.end(), uppers.begin(), uppers.end(), begin);
            used = static_cast<std::size_t>(end - ends_.begin());
            starts_[node + 1] = used;
        }
    }

    /// Calls `visit` with the pairs of neighbours of each part.
    template <class Visit>
    void run(const Visit& visit) {
        for (std::uint32_t node = 0; node < seen_.size(); ++node) {
            if (seen_[node] == kUnseen) {
                search(node, visit);
            }
        }
    }

  private:
    struct Visited {
        std::uint32_t node;
        std::uint32_t before;  ///< where the search came from
    };

    void enter(std::uint32_t node, std::uint32_t before) {
        seen_[node] = reach_[node] = clock_++;
        next_[node] = starts_[node];
        way_.push_back({node, before});
    }

    template <class Visit>
    void search(std::uint32_t start, const Visit& visit) {
        enter(start, kUnseen);
        while (!way_.empty()) {
            const auto [node, before] = way_.back();
            if (next_[node] == starts_[node + 1]) {
                way_.pop_back();
                if (before != kUnseen) {
                    leave(node, before, visit);
                }
                continue;
            }
            const std::uint32_t neighbor = ends_[next_[node]++];
            if (seen_[neighbor] == kUnseen) {
                pairs_.emplace_back(node, neighbor);
                enter(neighbor, node);
            } else if (neighbor != before && seen_[neighbor] < seen_[node]) {
                pairs_.emplace_back(node, neighbor);
                reach_[node] = std::min(reach_[node], seen_[neighbor]);
            }
        }
    }

    template <class Visit>
    void leave(std::uint32_t node, std::uint32_t before, const Visit& visit) {
        reach_[before] = std::min(reach_[before], reach_[node]);
        if (reach_[node] < seen_[before]) {
            return;
        }
        const auto first = std::find(pairs_.rbegin(), pairs_.rend(), std::pair(before, node)).base() - 1;
        visit(std::span<const std::pair<std::uint32_t, std::uint32_t>>(first, pairs_.end()));
        pairs_.erase(first, pairs_.end());
    }

    std::vector<std::size_t> starts_;  ///< of the neighbours of each node
    std::vector<std::uint32_t> ends_;
    std::vector<std::uint32_t> seen_;   ///< when a node was entered
    std::vector<std::uint32_t> reach_;  ///< the earliest node next to it or to what was entered after it
    std::vector<std::size_t> next_;
    std::vector<Visited> way_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    std::uint32_t clock_ = 0;
};

/// Finds where the flow divides in a part, given by its pairs of neighbours.
class PartDivide {
  public:
    PartDivide(const FallGraph& graph, const FlowSteps& steps)
        : graph_(graph), steps_(steps), lowers_(graph.size(), 0), has_inflow_(steps.count, false) {}

    std::uint32_t find(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs) {
        nodes_.clear();
        falls_ = 0;
        for (const auto& [p, q] : pairs) {
            add(p, q);
            add(q, p);
        }
        std::sort(nodes_.begin(), nodes_.end());
        nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
        const bool is_one_step = std::all_of(nodes_.begin(), nodes_.end(), [&](std::uint32_t node) {
            return steps_.step[node] == steps_.step[nodes_.front()];
        });
        std::uint32_t divide = kUnseen;
        if (!is_one_step || falls_ > nodes_.size()) {
            divide = *std::find_if(nodes_.begin(), nodes_.end(), [&](std::uint32_t node) {
                return lowers_[node] > 1 && !has_inflow_[steps_.step[node]];
            });
        }
        for (const std::uint32_t node : nodes_) {
            lowers_[node] = 0;
            has_inflow_[steps_.step[node]] = false;
        }
        return divide;
    }

  private:
    void add(std::uint32_t upper, std::uint32_t lower) {
        const auto below = graph_.lowers(upper);
        if (!std::binary_search(below.begin(), below.end(), lower)) {
            return;
        }
        nodes_.push_back(upper);
        nodes_.push_back(lower);
        ++lowers_[upper];
        ++falls_;
        if (steps_.step[upper] != steps_.step[lower]) {
            has_inflow_[steps_.step[lower]] = true;
        }
    }

    const FallGraph& graph_;
    const FlowSteps& steps_;
    std::vector<std::uint32_t> lowers_;  ///< of each node: how many lower neighbours it has in the part
    std::vector<bool> has_inflow_;       ///< of each step: from another one, in the part
    std::vector<std::uint32_t> nodes_;
    std::size_t falls_ = 0;
};

}  // namespace

std::vector<std::uint32_t> find_braids(std::size_t node_count, std::span<const Fall> falls) {
    const std::vector<Fall> distinct = make_distinct(falls);
    const FallGraph graph(node_count, distinct);
    const FlowSteps steps = find_flow_steps(graph);
    PartDivide divide(graph, steps);
    std::vector<std::uint32_t> braids;
    BiconnectedSearch(graph, distinct)
        .run([&](std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs) {
            if (pairs.size() < 2) {
                return;
            }
            const std::uint32_t node = divide.find(pairs);
            if (node != kUnseen) {
                braids.push_back(node);
            }
        });
    std::sort(braids.begin(), braids.end());
    braids.erase(std::unique(braids.begin(), braids.end()), braids.end());
    return braids;
}

}  // namespace tinwright
