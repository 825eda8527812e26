#ifndef TINWRIGHT_SURFACE_CELL_SHARES_HPP
#define TINWRIGHT_SURFACE_CELL_SHARES_HPP

#include <span>
#include <vector>

#include "tinwright/surface/vertex_neighbors.hpp"

namespace tinwright {

/// For each vertex adjacent to another the share of that one's Voronoi cell that would be its own if the
/// other were not there [sibson1981]; they sum to one. Cells are those among these vertices alone, which in
/// a Delaunay TIN is all that counts, and where a cell is longer than 64 times the farthest of them it is
/// cut off. `neighbors`: of a closed fan. O(k^3) for k neighbours, k^2 of them mostly trivial.
std::vector<double> find_cell_shares(std::span<const VertexNeighbor> neighbors);

}  // namespace tinwright

#endif
