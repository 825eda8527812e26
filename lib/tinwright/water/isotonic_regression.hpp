#ifndef TINWRIGHT_WATER_ISOTONIC_REGRESSION_HPP
#define TINWRIGHT_WATER_ISOTONIC_REGRESSION_HPP

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Levels that never rise downstream and are as near as can be to those that were measured.
namespace tinwright {

/// A place of a network of water, with the level that it should have.
struct LevelNode {
    double target = 0;
    double weight = 1;  ///< above 0: the length that it stands for
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();  ///< lowest == highest: the level is given
};

/// That water runs from one node to another: the level of `upper` is not below that of `lower`.
struct Fall {
    std::uint32_t upper = 0;
    std::uint32_t lower = 0;
    friend auto operator<=>(const Fall&, const Fall&) = default;
};

enum class RiverFit : std::uint8_t {
    Isotonic,  ///< least squares: lifts as well as digs
    Min        ///< digs, and lifts only to a bound: each level is the lowest target upstream of it
};

struct LevelFit {
    std::vector<double> levels;  ///< one a node
    /// Nodes whose bounds cannot be kept together with all falls, ascending: their levels are at the bound,
    /// and falls that end or start there may rise. Given levels come first, other bounds give way to them.
    std::vector<std::uint32_t> beyond;
    /// What these would have been without bounds of their own; one each. Of given levels that contradict each
    /// other: the nearest level that the others allow; the falls between them do not count for the rest.
    std::vector<double> wanted;
};

/// The levels within the bounds that satisfy all falls. Isotonic: those that minimise the sum over the nodes
/// of weight times squared distance from the target; chains and trees by pooling adjacent violators
/// [ayer1955], what is left by dividing the nodes at thresholds, each division a minimum cut [picard1976;
/// luss2012]. Min: of the target of each node and the levels above it the lowest, raised where a bound of it
/// or downstream asks for that. Nodes on a cycle of falls get one level, unless given levels contradict each
/// other there. Every fall holds exactly, also after rounding to double precision, but for those of `beyond`.
/// `falls`: any order, repeated or not. The result does not depend on it or on numbers of nodes. O(n log n)
/// for chains and trees; cuts touch only connected parts with violations that pooling leaves, near-linear in
/// practice.
LevelFit fit_levels(std::span<const LevelNode> nodes, std::span<const Fall> falls, RiverFit fit);

}  // namespace tinwright

#endif
