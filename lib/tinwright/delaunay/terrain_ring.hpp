#ifndef TINWRIGHT_DELAUNAY_TERRAIN_RING_HPP
#define TINWRIGHT_DELAUNAY_TERRAIN_RING_HPP

#include <optional>
#include <span>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/delaunay/drape.hpp"
#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// The convex hull of everything that has an elevation, samples and points of lines, as a closed ring with
/// every such place on it; empty when no point to be draped lies outside it. Its own points are to be draped:
/// it has nothing to say to the lines it meets. `drape`: of the samples at `keys`, on
/// `lattice`. O(h + p log p) for h samples on their hull and p points of lines.
std::optional<Breakline> find_terrain_ring(std::span<const Breakline> lines, const Drape& drape,
                                           const Lattice& lattice, std::span<const Key2> keys);

}  // namespace tinwright

#endif
