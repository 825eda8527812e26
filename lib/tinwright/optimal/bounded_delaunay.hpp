#ifndef TINWRIGHT_OPTIMAL_BOUNDED_DELAUNAY_HPP
#define TINWRIGHT_OPTIMAL_BOUNDED_DELAUNAY_HPP

#include <cstddef>
#include <span>
#include <utility>

#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright::internal {

/// Flips edges that are not locally Delaunay to those that are, unless these were longer than the pair
/// `longest`: a triangulation all of whose edges are as short stays one, and its faces become as well-shaped
/// as flips can make them. Constrained edges stay.
///
/// `faces`: with the edges to begin with, those that may not be Delaunay. The result depends on these edges
/// as a set, not on face slots. Returns the number of flips. Each lowers the surface of the lifted vertices,
/// so it ends; O(slots) once, and O(degree) a flip.
std::size_t flip_to_delaunay(TriangleMesh& mesh, const LengthOrder& order, std::span<const FaceId> faces,
                             std::pair<VertexId, VertexId> longest);

}  // namespace tinwright::internal

#endif
