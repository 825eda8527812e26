#ifndef TINWRIGHT_DELAUNAY_DELAUNAY_HPP
#define TINWRIGHT_DELAUNAY_DELAUNAY_HPP

#include <cstddef>
#include <span>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// The Delaunay triangulation of `vertices`: no vertex lies inside the circumcircle of a face, and among
/// co-circular vertices `incircle_perturbed` decides, so the triangulation is unique.
///
/// `vertices`: n distinct keys in curve order, n from 2 to 2^29. The mesh has exactly 2n - 2 face slots,
/// ghosts included; when all vertices are collinear, all of them are ghosts. Slots do not depend on the
/// number of threads. `spare_vertices`: that many can be added to the mesh later without moving it in memory.
/// Divide and conquer [guibas1985], on triangles with ghosts rather than on edges [shewchuk1996], split
/// where the curve splits. O(n log n), parallel inside the caller's task arena.
TriangleMesh make_delaunay(std::span<const Key2> vertices, std::size_t spare_vertices = 0);

}  // namespace tinwright

#endif
