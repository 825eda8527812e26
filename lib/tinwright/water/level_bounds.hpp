#ifndef TINWRIGHT_WATER_LEVEL_BOUNDS_HPP
#define TINWRIGHT_WATER_LEVEL_BOUNDS_HPP

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/water/fall_graph.hpp"

namespace tinwright {

struct LevelRange {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    friend bool operator==(const LevelRange&, const LevelRange&) = default;
};

/// Which falls and bounds can be kept together.
struct LevelBounds {
    std::vector<Fall> falls;  ///< those that given levels do not contradict
    FlowSteps steps;          ///< of these falls
    FallGraph graph;          ///< from step to step
    /// Of each step: what the bounds that are kept leave, those above and below it included. Never empty, and
    /// neither end rises downstream.
    std::vector<LevelRange> ranges;
    /// Given levels that others contradict, with the nearest that these would allow; ascending.
    std::vector<std::pair<std::uint32_t, double>> contradicted;
    /// Nodes whose bounds are not kept: those that given levels contradict, and of the others all that
    /// contradict each other; ascending.
    std::vector<std::uint32_t> dropped;
};

/// `falls`: ascending and distinct, none of a node to itself. Given levels are kept, and where one is
/// lower than another downstream of it, falls between them are left out: those from the upper node and to the
/// lower node by which water gets from one to the other. O(n log n).
LevelBounds find_level_bounds(std::span<const LevelNode> nodes, std::vector<Fall> falls);

}  // namespace tinwright

#endif
