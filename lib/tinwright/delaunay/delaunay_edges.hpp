#ifndef TINWRIGHT_DELAUNAY_DELAUNAY_EDGES_HPP
#define TINWRIGHT_DELAUNAY_DELAUNAY_EDGES_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// How many of the edges have no empty disk, that is, no circle through their ends without a vertex inside:
/// whatever triangulation they are in, they are in no Delaunay triangulation of the vertices.
///
/// `keys`: of the vertices, not all on one line; locations may be repeated. `edges`: pairs of indices with
/// different locations. Exact; found anew from the Delaunay triangulation of all vertices. O(n log n + e d)
/// for degrees d.
std::size_t count_edges_without_disk(std::span<const Key2> keys,
                                     std::span<const std::pair<std::uint32_t, std::uint32_t>> edges);

}  // namespace tinwright

#endif
