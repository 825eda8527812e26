#ifndef TINWRIGHT_WATER_FLAT_POINTS_HPP
#define TINWRIGHT_WATER_FLAT_POINTS_HPP

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/water/flat_axes.hpp"

namespace tinwright::internal {

using AxisEdge = std::pair<VertexId, VertexId>;  // the smaller first

struct InsertedPoints {
    std::size_t count = 0;
    /// The edges between points that are linked, and from those on ways out to the vertex across; ascending.
    std::vector<AxisEdge> edges;
};

/// Puts a vertex at each node that has an elevation (not NaN) other than its contour's: splits the edge, or
/// the face, on a lattice refined for that. A node whose lattice point would turn a face round is left out.
/// New vertices are sorted into the curve's order. O(n log n).
InsertedPoints insert_axis_points(Tin& tin, const FlatAxes& axes, std::span<const double> z);

/// Flips edges of terrain that are not constrained until all are Delaunay. O(slots), and O(1) a flip.
void restore_delaunay(Tin& tin);
/// The same, but for edges among `kept`, ascending, and flips that make a flat face. O(log n) a flip.
void restore_delaunay_around(Tin& tin, std::span<const AxisEdge> kept);

}  // namespace tinwright::internal

#endif
