#ifndef TINWRIGHT_DELAUNAY_CAVITY_HPP
#define TINWRIGHT_DELAUNAY_CAVITY_HPP

#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// What a segment that leaves a vertex meets on its way to the next vertex that lies on it.
struct Cavity {
    VertexId begin;
    VertexId end;  ///< the next vertex on the segment
    /// The edge from `begin` to `end` when it is there already; then everything below is empty.
    std::optional<HalfEdgeId> edge;
    /// A constrained edge in the way, at which the walk stopped.
    std::optional<HalfEdgeId> obstacle;
    std::vector<FaceId> slots;  ///< faces crossed, from begin to end
    /// Half-edges of crossed faces on the cavity's rim, from begin to end, left and right of the segment.
    std::vector<HalfEdgeId> left_rim;
    std::vector<HalfEdgeId> right_rim;
};

/// Walks from the origin of `start` towards vertex `to`, as far as the first vertex on the way. `cavity` is
/// filled anew. O(degree of the origin + edges crossed). Exact.
void find_cavity(const TriangleMesh& mesh, std::span<const Key2> keys, HalfEdgeId start, VertexId to,
                 Cavity& cavity);

/// Triangulates the two polygons that the segment leaves of a cavity, each as the constrained Delaunay
/// triangulation of its vertices [anglada1997], and puts them into the mesh. Returns the half-edge from begin
/// to end. O(k log k) as a rule, O(k^2) worst for k faces.
HalfEdgeId retriangulate_cavity(TriangleMesh& mesh, std::span<const Key2> keys, const Cavity& cavity);

}  // namespace tinwright

#endif
