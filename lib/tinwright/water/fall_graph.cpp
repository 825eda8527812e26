#include "tinwright/water/fall_graph.hpp"

#include <algorithm>
#include <limits>

namespace tinwright {

namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

/// Depth-first search that closes a step when nothing below it leads back above it (Tarjan's), with a stack
/// of its own: rivers are long.
class StepSearch {
  public:
    explicit StepSearch(const FallGraph& graph)
        : graph_(graph),
          steps_{std::vector<std::uint32_t>(graph.size(), kUnseen), 0},
          seen_(graph.size(), kUnseen),
          reach_(graph.size(), 0),
          next_(graph.size(), 0) {}

    FlowSteps run() {
        for (std::uint32_t node = 0; node < graph_.size(); ++node) {
            if (seen_[node] == kUnseen) {
                search(node);
            }
        }
        // Steps are closed from the mouth upward; they are numbered downward.
        for (std::uint32_t& step : steps_.step) {
            step = static_cast<std::uint32_t>(steps_.count) - 1 - step;
        }
        return std::move(steps_);
    }

  private:
    void enter(std::uint32_t node) {
        seen_[node] = reach_[node] = clock_++;
        way_.push_back(node);
        open_.push_back(node);
    }

    void search(std::uint32_t start) {
        enter(start);
        while (!way_.empty()) {
            const std::uint32_t node = way_.back();
            if (next_[node] < graph_.lowers(node).size()) {
                const std::uint32_t lower = graph_.lowers(node)[next_[node]++];
                if (seen_[lower] == kUnseen) {
                    enter(lower);
                } else if (steps_.step[lower] == kUnseen) {
                    reach_[node] = std::min(reach_[node], seen_[lower]);
                }
            } else {
                leave(node);
            }
        }
    }

    void leave(std::uint32_t node) {
        way_.pop_back();
        if (!way_.empty()) {
            reach_[way_.back()] = std::min(reach_[way_.back()], reach_[node]);
        }
        if (reach_[node] != seen_[node]) {
            return;
        }
        std::uint32_t member = kUnseen;
        do {
            member = open_.back();
            open_.pop_back();
            steps_.step[member] = static_cast<std::uint32_t>(steps_.count);
        } while (member != node);
        ++steps_.count;
    }

    const FallGraph& graph_;
    FlowSteps steps_;
    std::vector<std::uint32_t> seen_;   ///< when a node was entered
    std::vector<std::uint32_t> reach_;  ///< the earliest open node that it is known to lead to
    std::vector<std::size_t> next_;
    std::vector<std::uint32_t> way_;
    std::vector<std::uint32_t> open_;
    std::uint32_t clock_ = 0;
};

}  // namespace

std::vector<Fall> make_distinct(std::span<const Fall> falls) {
    std::vector<Fall> result;
    result.reserve(falls.size());
    std::copy_if(falls.begin(), falls.end(), std::back_inserter(result),
                 [](const Fall& fall) { return fall.upper != fall.lower; });
    if (!std::is_sorted(result.begin(), result.end())) {
        std::sort(result.begin(), result.end());
    }
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

FallGraph::FallGraph(std::size_t node_count, std::span<const Fall> falls)
    : lower_starts_(node_count + 1, 0),
      lowers_(falls.size()),
      upper_starts_(node_count + 1, 0),
      uppers_(falls.size()) {
    for (const Fall& fall : falls) {
        ++lower_starts_[fall.upper + 1];
        ++upper_starts_[fall.lower + 1];
    }
    for (std::size_t node = 0; node < node_count; ++node) {
        lower_starts_[node + 1] += lower_starts_[node];
        upper_starts_[node + 1] += upper_starts_[node];
    }
    std::vector<std::uint32_t> ends = upper_starts_;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        lowers_[i] = falls[i].lower;
        uppers_[ends[falls[i].lower]++] = falls[i].upper;
    }
}

FlowSteps find_flow_steps(const FallGraph& graph) { return StepSearch(graph).run(); }

std::vector<Fall> falls_between(const FlowSteps& steps, std::span<const Fall> falls) {
    std::vector<Fall> result(falls.begin(), falls.end());
    for (Fall& fall : result) {
        fall = {steps.step[fall.upper], steps.step[fall.lower]};
    }
    return make_distinct(result);
}

}  // namespace tinwright
