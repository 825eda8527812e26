#include "tinwright/delaunay/constrained_delaunay.hpp"

#include <algorithm>
#include <string>

#include "tinwright/delaunay/cavity.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

std::vector<SegmentEdge> insert_segments(TriangleMesh& mesh, std::span<const Key2> keys,
                                         std::span<const Segment> segments) {
    std::vector<SegmentEdge> edges;
    if (segments.empty()) {
        return edges;
    }
    edges.reserve(segments.size());
    std::vector<HalfEdgeId> starts = find_starts(mesh);
    Cavity cavity;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        // Beginning at the smaller vertex makes faces and slots independent of the segment's direction.
        const VertexId last = std::max(segments[i].a, segments[i].b);
        for (VertexId from = std::min(segments[i].a, segments[i].b); from != last; from = cavity.end) {
            find_cavity(mesh, keys, starts[from.value], last, cavity);
            if (cavity.obstacle) {
                throw InputError("segment " + std::to_string(i) +
                                 " crosses a constrained edge: lines have to be noded first");
            }
            HalfEdgeId h{};
            if (cavity.edge) {
                h = *cavity.edge;
            } else {
                h = retriangulate_cavity(mesh, keys, cavity);
                for (const FaceId slot : cavity.slots) {
                    for (unsigned corner = 0; corner < 3; ++corner) {
                        starts[mesh.vertex(slot, corner).value] = half_edge(slot, corner);
                    }
                }
            }
            mesh.set_constrained(h, true);
            edges.push_back({std::min(cavity.begin, cavity.end), std::max(cavity.begin, cavity.end),
                             static_cast<std::uint32_t>(i)});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace tinwright
