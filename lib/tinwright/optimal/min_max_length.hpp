#ifndef TINWRIGHT_OPTIMAL_MIN_MAX_LENGTH_HPP
#define TINWRIGHT_OPTIMAL_MIN_MAX_LENGTH_HPP

#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/optimize.hpp"

/// Min-max length: the longest edge as short as it can be [tan1993, Ch. 5; edelsbrunner1991].
namespace tinwright {

/// Triangulates the terrain anew where its longest edge depends on it, the constrained edges and those of the
/// border, which all triangulations share, counted in.
///
/// The relative neighbourhood graph of what vertices see of each other is part of an optimum (Subgraph
/// Theorem [tan1993, Sec. 5.2, 5.9]). Together with the constrained edges it divides the terrain into
/// polygons. No longest edge is shorter than the longest of these walls, nor than what any polygon needs;
/// only polygons with an edge longer than all that is known to be needed are looked at, and in the end only
/// those with an edge longer than the optimum get new faces. Edges of these that are not Delaunay are then
/// flipped, unless to one longer than the optimum. So the TIN is locally Delaunay but at constrained edges
/// and where a flip would make too long an edge. If its longest edge cannot be shorter, nothing is changed.
///
/// `Criterion::Length` and `norm` of `options` are what counts; the scope is always the longest edge. Budget
/// and progress as in `optimize`.
///
/// Lengths are compared exactly, equal ones in the order of `LengthOrder`, so the optimum is proven with ties
/// too, and no flat face is made. In a norm other than the Euclidean the graph's edges are inserted in any
/// case, and then all edges but the constrained ones may be flipped back.
///
/// About O(n log n) for samples that are spread somehow; O(m^2) for a polygon of m sides at worst.
OptimizeReport minimize_longest_edge(Tin& tin, const OptimizeOptions& options);

}  // namespace tinwright

#endif
