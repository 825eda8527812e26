#ifndef TINWRIGHT_OPTIMAL_MIN_MAX_LENGTH_HPP
#define TINWRIGHT_OPTIMAL_MIN_MAX_LENGTH_HPP

#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/optimize.hpp"

/// Min-max length: the longest edge as short as it can be [tan1993, Ch. 5; edelsbrunner1991].
namespace tinwright {

/// Triangulates the terrain anew where that makes its longest edge shorter, the constrained edges and those
/// of the border, which all triangulations share, counted in.
///
/// The relative neighbourhood graph of what vertices see of each other is part of an optimum (Subgraph
/// Theorem [tan1993, Sec. 5.2, 5.9]). Together with the constrained edges it divides the terrain into
/// polygons, and each is made optimal by itself: its longest edge is as short as it can be, whatever the
/// others are like. A polygon whose faces are as good as any keeps them. `Criterion::Length` and `norm` of
/// `options` are what counts; the scope is always the longest edge. Budget and progress as in `optimize`.
///
/// Lengths are compared exactly, equal ones in the order of `LengthOrder`, so the optimum is proven with ties
/// too, and no flat face is made. In a norm other than the Euclidean the TIN is constrained Delaunay within
/// its relative neighbourhood graph before its polygons are looked at.
///
/// About O(n log n) for samples that are spread somehow; O(m^2) for a polygon of m sides at worst.
OptimizeReport minimize_longest_edge(Tin& tin, const OptimizeOptions& options);

}  // namespace tinwright

#endif
