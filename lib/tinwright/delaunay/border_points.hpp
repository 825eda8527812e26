#ifndef TINWRIGHT_DELAUNAY_BORDER_POINTS_HPP
#define TINWRIGHT_DELAUNAY_BORDER_POINTS_HPP

#include <span>
#include <vector>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// Places for vertices where segments cross edges of a triangulation: what a segment needs that is to lie on
/// a surface all along. Each is a lattice point exactly on its segment, the one next to the crossing;
/// segments with few such points (between ends of the refined lattice) get none.
///
/// `mesh`: on `keys`, convex border, without constrained edges in the way. Returns distinct keys in curve
/// order, none of `keys` among them. O(edges crossed) and a sort.
std::vector<Key2> find_border_points(const TriangleMesh& mesh, std::span<const Key2> keys,
                                     std::span<const Segment> segments);

}  // namespace tinwright

#endif
