#include "tinwright/mesh/mesh_walk.hpp"

#include <cstdint>

namespace tinwright {

std::vector<HalfEdgeId> find_starts(const TriangleMesh& mesh) {
    std::vector<HalfEdgeId> starts(mesh.vertex_count(), kNoHalfEdge);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        const TriangleMesh::Face& face = mesh.face({f});
        const bool is_ghost = face.vertex[2] == kGhostVertex;
        for (unsigned corner = 0; corner < (is_ghost ? 2U : 3U); ++corner) {
            HalfEdgeId& start = starts[face.vertex[corner].value];
            if (!is_ghost || start == kNoHalfEdge) {
                start = half_edge({f}, corner);
            }
        }
    }
    return starts;
}

std::vector<std::uint32_t> number_terrain(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> numbers(mesh.slot_count(), kNoNumber);
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_terrain({f})) {
            numbers[f] = next++;
        }
    }
    return numbers;
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
