#ifndef TINWRIGHT_OPTIMAL_EDGE_INSERTION_HPP
#define TINWRIGHT_OPTIMAL_EDGE_INSERTION_HPP

#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/optimize.hpp"

/// Edge insertion: the engine that makes a TIN optimal under a criterion [tan1993, Ch. 3; bern1993].
namespace tinwright {

/// Improves the faces of `tin` under a criterion by edge insertion, without crossing a constrained edge or
/// leaving the terrain. Vertices, constrained edges and the domain stay; the number of faces too.
///
/// For length, which meets neither condition [tan1993, Fig. 5.2], a heuristic: nothing is proven.
///
/// Meant to start from a Delaunay TIN. From the same TIN always the same result; without ties the result of
/// scope vector is unique, whatever the faces at the start. Stopped early, `tin` is a valid triangulation
/// that is better than at the start.
///
/// `tin`: at least one terrain face. Throws InputError, with the sample, for an elevation beyond 1e100.
/// Cost: seconds for 10^6 samples, growing about linearly (docs/benchmarks.md); at worst quadratic for angle
/// and height. About 50 bytes a vertex of scratch.
OptimizeReport improve_by_insertions(Tin& tin, const OptimizeOptions& options);

}  // namespace tinwright

#endif
