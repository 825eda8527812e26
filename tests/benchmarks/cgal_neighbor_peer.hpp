#ifndef TINWRIGHT_TESTS_BENCHMARKS_CGAL_NEIGHBOR_PEER_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_CGAL_NEIGHBOR_PEER_HPP

#include <span>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/grid.hpp"

#include "benchmarks/measure.hpp"

/// CGAL's natural neighbour interpolation; see `cgal_peer.hpp`.
namespace tinwright_benchmarks {

/// Measures the cells of a raster, row by row, on a Delaunay triangulation that is there already:
/// `natural_neighbor_coordinates_2`, begun at the face of the cell before, and `linear_interpolation`.
/// Elevations are kept with the vertices, the quickest way. Notes the sum of the values.
void measure_cgal_natural_neighbors(std::span<const tinwright::Point3> points,
                                    const tinwright::GridGeometry& grid, Meter& meter);

}  // namespace tinwright_benchmarks

#endif
