#ifndef TINWRIGHT_WATER_FALL_GRAPH_HPP
#define TINWRIGHT_WATER_FALL_GRAPH_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/water/isotonic_regression.hpp"

namespace tinwright {

/// The falls in ascending order, each once, none of a node to itself.
std::vector<Fall> make_distinct(std::span<const Fall> falls);

/// Falls by their nodes.
class FallGraph {
  public:
    /// `falls`: ascending and distinct. O(n).
    FallGraph(std::size_t node_count, std::span<const Fall> falls);

    std::size_t size() const { return lower_starts_.size() - 1; }
    /// The nodes that water runs to from a node, ascending.
    std::span<const std::uint32_t> lowers(std::uint32_t node) const {
        return row(lowers_, lower_starts_, node);
    }
    /// The nodes that it comes from, ascending.
    std::span<const std::uint32_t> uppers(std::uint32_t node) const {
        return row(uppers_, upper_starts_, node);
    }

  private:
    static std::span<const std::uint32_t> row(const std::vector<std::uint32_t>& items,
                                              const std::vector<std::uint32_t>& starts, std::uint32_t node) {
        return std::span(items).subspan(starts[node], starts[node + 1] - starts[node]);
    }

    std::vector<std::uint32_t> lower_starts_;
    std::vector<std::uint32_t> lowers_;
    std::vector<std::uint32_t> upper_starts_;
    std::vector<std::uint32_t> uppers_;
};

/// Nodes that water gets to from each other are one step, any other node is one by itself.
struct FlowSteps {
    std::vector<std::uint32_t> step;  ///< of each node; falls never go to a smaller number
    std::size_t count = 0;
};

/// O(n).
FlowSteps find_flow_steps(const FallGraph& graph);

/// Those between different steps, as falls from step to step; ascending and distinct.
std::vector<Fall> falls_between(const FlowSteps& steps, std::span<const Fall> falls);

}  // namespace tinwright

#endif
