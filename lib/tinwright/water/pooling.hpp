#ifndef TINWRIGHT_WATER_POOLING_HPP
#define TINWRIGHT_WATER_POOLING_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/water/level_bounds.hpp"

namespace tinwright {

/// Nodes that get one level, as the sums that it follows from.
struct LevelPool {
    long double weight = 0;
    long double moment = 0;  ///< weights times targets
    LevelRange range;

    /// The level that is nearest to the targets, within the range.
    double level() const {
        const auto mean = static_cast<double>(moment / weight);
        return mean < range.lowest ? range.lowest : mean > range.highest ? range.highest : mean;
    }
    void join(const LevelPool& other) {
        weight += other.weight;
        moment += other.moment;
        range.lowest = range.lowest > other.range.lowest ? range.lowest : other.range.lowest;
        range.highest = range.highest < other.range.highest ? range.highest : other.range.highest;
    }
};

/// Pools and falls between them; falls never go to a smaller number, and neither end of the ranges rises
/// along one.
struct PooledFalls {
    std::vector<LevelPool> pools;
    FallGraph graph;
};

/// Joins neighbours that rise downstream where the upper one has no other lower neighbour and the lower one
/// no other upper: along chains [ayer1955]. These are equal in the best levels, whatever is around them.
struct PooledChains {
    PooledFalls left;
    std::vector<std::uint32_t> pool_of;  ///< of each of the former pools
};
/// O(n).
PooledChains pool_chains(const PooledFalls& falls);

/// Where no pool has more than one lower neighbour: from the springs down each pool is joined with the lowest
/// of those above it that are lower. Of each pool the last of those that it has one level with. `lower`: of
/// each pool, or its own number; never smaller. O(n log n).
std::vector<std::uint32_t> pool_tree(std::vector<LevelPool> pools, std::span<const std::uint32_t> lower);

}  // namespace tinwright

#endif
