#ifndef TINWRIGHT_WATER_FLAT_POINTS_HPP
#define TINWRIGHT_WATER_FLAT_POINTS_HPP

#include <cstddef>
#include <span>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/water/flat_axes.hpp"

namespace tinwright::internal {

/// Puts a vertex at each node that has an elevation (not NaN) other than its contour's: splits the edge, or
/// the face, on a lattice refined for that. A node whose lattice point would turn a face round is left out.
/// New vertices are sorted into the curve's order. Returns their number. O(n).
std::size_t insert_axis_points(Tin& tin, const FlatAxes& axes, std::span<const double> z);

/// Flips edges of terrain that are not constrained until all are Delaunay. O(slots), and O(1) a flip.
void restore_delaunay(Tin& tin);

}  // namespace tinwright::internal

#endif
