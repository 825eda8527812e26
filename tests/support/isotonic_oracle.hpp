#ifndef TINWRIGHT_TESTS_SUPPORT_ISOTONIC_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_ISOTONIC_ORACLE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/water/isotonic_regression.hpp"

/// Levels and flow by slow means that share nothing with the library but its records.
namespace tinwright_tests::oracle {

/// Whether water gets from each node to each other; to itself always.
std::vector<std::vector<bool>> find_reach(std::size_t node_count, std::span<const tinwright::Fall> falls);

/// The least squares along a chain, first node uppermost, by the textbook formula: of all stretches that
/// begin at or above a node, the least of the greatest mean of those that end at or below it. Ranges do
/// not count. O(n^2).
std::vector<double> chain_levels(std::span<const tinwright::LevelNode> nodes);

/// The least squares by trial of all partitions into sets of one level, or nothing where ranges allow none.
/// Up to some nine nodes.
std::optional<std::vector<double>> best_levels(std::span<const tinwright::LevelNode> nodes,
                                               std::span<const tinwright::Fall> falls);

/// How far from the least squares levels are at most that satisfy all falls and ranges, as a part of what
/// they should be: forces along falls that are level must hold each node against the pull of its target
/// (the theorem of Karush, Kuhn and Tucker), and a maximum flow tells how much of them they can. 0: they
/// are best but for rounding.
double unbalanced_part(std::span<const tinwright::LevelNode> nodes, std::span<const tinwright::Fall> falls,
                       std::span<const double> levels);

/// `fit_levels` word for word, for few nodes: what contradicts is found by comparing all pairs.
tinwright::LevelFit slow_fit(std::span<const tinwright::LevelNode> nodes,
                             std::span<const tinwright::Fall> falls, tinwright::RiverFit fit);

/// Where the flow divides, from all simple circles of neighbours: up to some seven nodes.
std::vector<std::uint32_t> slow_braids(std::size_t node_count, std::span<const tinwright::Fall> falls);

}  // namespace tinwright_tests::oracle

#endif
