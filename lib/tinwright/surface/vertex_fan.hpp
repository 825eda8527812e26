#ifndef TINWRIGHT_SURFACE_VERTEX_FAN_HPP
#define TINWRIGHT_SURFACE_VERTEX_FAN_HPP

#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

/// Whether a smooth surface ends at an edge of a terrain face: at sharp edges and at the border.
inline bool is_wall(const TriangleMesh& mesh, const SharpEdges& sharp, HalfEdgeId h) {
    return sharp.is_sharp(h) || !mesh.is_terrain(face_of(mesh.twin(h)));
}

/// The next half-edge from the same origin, clockwise.
inline HalfEdgeId next_clockwise(const TriangleMesh& mesh, HalfEdgeId h) { return next(mesh.twin(h)); }

/// The terrain faces around a vertex between one wall and the next, counter-clockwise, each by its half-edge
/// from the vertex; all faces around the vertex where it has no wall.
struct VertexFan {
    HalfEdgeId first{};  ///< of a closed fan the one to the vertex of smallest id
    HalfEdgeId last{};
    bool is_closed = false;
};

/// The fan of a terrain face, given by its half-edge from the vertex. O(degree).
inline VertexFan find_fan(const TriangleMesh& mesh, const SharpEdges& sharp, HalfEdgeId corner) {
    HalfEdgeId first = corner;
    HalfEdgeId least = corner;
    while (!is_wall(mesh, sharp, first)) {
        first = next_clockwise(mesh, first);
        least = mesh.destination(first) < mesh.destination(least) ? first : least;
        if (first == corner) {
            return {least, next_clockwise(mesh, least), true};
        }
    }
    HalfEdgeId last = corner;
    while (!is_wall(mesh, sharp, previous(last))) {
        last = next_around(mesh, last);
    }
    return {first, last, false};
}

/// Calls `visit` with each half-edge of a fan.
template <class Visit>
void visit_fan(const TriangleMesh& mesh, const VertexFan& fan, Visit visit) {
    for (HalfEdgeId h = fan.first;; h = next_around(mesh, h)) {
        visit(h);
        if (h == fan.last) {
            return;
        }
    }
}

/// The vertex across the last edge of an open fan: that of its first edge where the fan goes all around the
/// end of a line.
inline VertexId last_neighbor(const TriangleMesh& mesh, const VertexFan& fan) {
    return mesh.origin(previous(fan.last));
}

}  // namespace tinwright

#endif
