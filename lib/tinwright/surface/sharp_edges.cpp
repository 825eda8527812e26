#include "tinwright/surface/sharp_edges.hpp"

#include <algorithm>

#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

/// Whether each trace's line is sharp, the edges of the traces being in ascending order.
struct EdgeLines {
    bool has_lines = false;
    bool is_sharp = false;
};

EdgeLines lines_along(const Tin& tin, const std::vector<bool>& is_line_sharp, VertexId a, VertexId b) {
    EdgeLines lines;
    const LineTrace edge{std::min(a, b), std::max(a, b), 0, 0};
    for (auto trace = std::lower_bound(tin.traces.begin(), tin.traces.end(), edge);
         trace != tin.traces.end() && trace->a == edge.a && trace->b == edge.b; ++trace) {
        lines.has_lines = true;
        lines.is_sharp = lines.is_sharp || trace->line >= is_line_sharp.size() || is_line_sharp[trace->line];
    }
    return lines;
}

}  // namespace

SharpEdges::SharpEdges(const Tin& tin, const std::vector<bool>& is_line_sharp) {
    const TriangleMesh& mesh = tin.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const HalfEdgeId other = mesh.twin(h);
            if (!mesh.is_constrained(h) || other < h || !mesh.is_terrain(face_of(other))) {
                continue;
            }
            const VertexId a = mesh.origin(h);
            const VertexId b = mesh.destination(h);
            const EdgeLines lines = lines_along(tin, is_line_sharp, a, b);
            if (lines.has_lines && !lines.is_sharp) {
                continue;
            }
            edges_.resize(mesh.slot_count());
            vertices_.resize(tin.vertex_count());
            edges_[f] = static_cast<std::uint8_t>(edges_[f] | 1U << corner);
            std::uint8_t& of_other = edges_[face_of(other).value];
            of_other = static_cast<std::uint8_t>(of_other | 1U << corner_of(other));
            vertices_[a.value] = true;
            vertices_[b.value] = true;
        }
    }
}

}  // namespace tinwright
