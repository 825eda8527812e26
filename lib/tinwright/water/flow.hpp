#ifndef TINWRIGHT_WATER_FLOW_HPP
#define TINWRIGHT_WATER_FLOW_HPP

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tinwright/water/isotonic_regression.hpp"

/// Which way water runs through a network.
namespace tinwright {

/// A stretch of water between two nodes, of which it is not known yet which is the upper one.
struct FlowLink {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

/// Nodes that water leaves the network at: of each connected part, the ends (nodes of one link) that are
/// lower than their neighbour; where there is none, the lowest node, of equals first of all an end. Nodes
/// without a link to another are no part. Ascending. `elevations`: one a node. O(n).
std::vector<std::uint32_t> find_outlets(std::span<const double> elevations, std::span<const FlowLink> links);

/// Gives every link a direction such that water gets from everywhere to an outlet, over as low a way as there
/// is: nodes are taken from the outlets upward, always the lowest next to those taken (as in
/// priority-flooding [barnes2014]), and links run from the later taken to the earlier. True: from b to a.
/// The directions make no cycle but for links of a node with itself. Parts without an outlet run to their
/// lowest node. Ties go to the smaller number. O(n log n).
std::vector<bool> orient_links(std::span<const double> elevations, std::span<const FlowLink> links,
                               std::span<const std::uint32_t> outlets);

/// For each node the number of the cycle of falls that it is on, or `kNoCycle`; cycles that share a node are
/// one. Numbers ascend with the smallest node. Falls of a node to itself are no cycles. O(n).
inline constexpr std::uint32_t kNoCycle = std::numeric_limits<std::uint32_t>::max();
std::vector<std::uint32_t> find_cycles(std::size_t node_count, std::span<const Fall> falls);

/// Where water divides and comes together again: of each biconnected part of the network of falls (taken
/// without directions) with two falls or more between different pairs of nodes, the node that the flow
/// divides at, the most upstream one (of several the one with the smallest number); parts that are nothing
/// but a cycle of falls are left out. Repeated falls count once. Ascending, distinct. O(n).
std::vector<std::uint32_t> find_braids(std::size_t node_count, std::span<const Fall> falls);

}  // namespace tinwright

#endif
