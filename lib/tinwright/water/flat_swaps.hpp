#ifndef TINWRIGHT_WATER_FLAT_SWAPS_HPP
#define TINWRIGHT_WATER_FLAT_SWAPS_HPP

#include <cstddef>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/water/flat_regions.hpp"

namespace tinwright::internal {

/// Flips openings of flat faces whose quadrilateral is strictly convex, the steepest new edge first, ties by
/// its vertices: both new faces have a vertex at another elevation, so each flip leaves one flat face less.
/// Goes on until there is none to flip. Returns the number of flips. O(n + s log s) for s flips.
std::size_t swap_flat_edges(Tin& tin, const FlatRegions& regions);

}  // namespace tinwright::internal

#endif
