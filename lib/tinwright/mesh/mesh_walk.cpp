#include "tinwright/mesh/mesh_walk.hpp"

#include <cstdint>

namespace tinwright {

std::vector<HalfEdgeId> find_starts(const TriangleMesh& mesh) {
    std::vector<HalfEdgeId> starts(mesh.vertex_count(), kNoHalfEdge);
    const auto visit_faces = [&](bool ghosts) {
        for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
            if (mesh.is_ghost({f}) != ghosts) {
                continue;
            }
            for (unsigned corner = 0; corner < (ghosts ? 2U : 3U); ++corner) {
                starts[mesh.vertex({f}, corner).value] = half_edge({f}, corner);
            }
        }
    };
    // Ghosts first, so that real faces prevail.
    visit_faces(true);
    visit_faces(false);
    return starts;
}

std::optional<HalfEdgeId> find_half_edge(const TriangleMesh& mesh, HalfEdgeId start, VertexId to) {
    HalfEdgeId h = start;
    do {
        if (mesh.destination(h) == to) {
            return h;
        }
        h = next_around(mesh, h);
    } while (h != start);
    return std::nullopt;
}

}  // namespace tinwright
