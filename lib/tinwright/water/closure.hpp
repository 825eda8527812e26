#ifndef TINWRIGHT_WATER_CLOSURE_HPP
#define TINWRIGHT_WATER_CLOSURE_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/water/fall_graph.hpp"

namespace tinwright {

__extension__ using Gain = __int128;

/// Of all sets of nodes that have with a node all that are above it, the largest of those with the greatest
/// sum of gains [picard1976]: a minimum cut, found by pushing gains upstream until they meet losses they make
/// up for. Exact. True: the node is in the set. The sum of the gains' amounts is below 2^126.
/// O(n^2 sqrt(m)) at worst for n nodes and m falls, near-linear in practice where falls go to greater
/// numbers.
std::vector<bool> find_largest_closure(const FallGraph& graph, std::vector<Gain> gains);

}  // namespace tinwright

#endif
