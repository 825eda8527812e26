#include "tinwright/optimal/bounded_delaunay.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright::internal {

namespace {

using VertexPair = std::pair<VertexId, VertexId>;

/// The corners of the two faces at an edge.
struct Quadrilateral {
    VertexId a;
    VertexId b;
    VertexId left;
    VertexId right;
};

Quadrilateral around(const TriangleMesh& mesh, HalfEdgeId h) {
    return {mesh.origin(h), mesh.destination(h), mesh.origin(previous(h)),
            mesh.origin(previous(mesh.twin(h)))};
}

}  // namespace

std::size_t flip_to_delaunay(TriangleMesh& mesh, const LengthOrder& order, std::span<const FaceId> faces,
                             VertexPair longest) {
    const std::span<const Key2> keys = order.keys();
    const auto should_flip = [&](HalfEdgeId h) {
        if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(h)) ||
            !mesh.is_terrain(face_of(mesh.twin(h)))) {
            return false;
        }
        const Quadrilateral q = around(mesh, h);
        return incircle_perturbed(keys[q.a.value], keys[q.b.value], keys[q.left.value], keys[q.right.value]) >
                   0 &&
               order.compare(q.left, q.right, longest.first, longest.second) <= 0;
    };
    std::vector<VertexPair> edges;
    for (const FaceId face : faces) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge(face, i);
            if (should_flip(h)) {
                edges.push_back(std::minmax({mesh.origin(h), mesh.destination(h)}));
            }
        }
    }
    // By vertices, not half-edges, which a flip gives to other edges: what comes next must not depend on
    // slots.
    std::sort(edges.begin(), edges.end());
    std::deque<VertexPair> pending(edges.begin(), edges.end());
    std::vector<HalfEdgeId> starts = edges.empty() ? std::vector<HalfEdgeId>() : find_starts(mesh);
    std::size_t flips = 0;
    for (; !pending.empty(); pending.pop_front()) {
        const auto [from, to] = pending.front();
        const auto h = find_half_edge(mesh, starts[from.value], to);
        if (!h || !should_flip(*h)) {
            continue;
        }
        const Quadrilateral q = around(mesh, *h);
        flip_edge(mesh, *h);
        ++flips;
        for (const FaceId face : {face_of(*h), face_of(mesh.twin(*h))}) {
            for (unsigned i = 0; i < 3; ++i) {
                starts[mesh.vertex(face, i).value] = half_edge(face, i);
            }
        }
        const auto [a, b] = std::minmax({q.a, q.b});
        const auto [c, d] = std::minmax({q.left, q.right});
        for (const VertexPair& side :
             {VertexPair{a, c}, VertexPair{a, d}, VertexPair{b, c}, VertexPair{b, d}}) {
            pending.push_back(side);
        }
    }
    return flips;
}

}  // namespace tinwright::internal
