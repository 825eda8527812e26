#include "tinwright/delaunay/delaunay_edges.hpp"

#include <algorithm>
#include <vector>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {
namespace {

/// Whether an edge that is not in the Delaunay triangulation could be, had ties been broken in another way.
/// Otherwise its ends have on them, or between them, a face with a circle around the far end.
bool is_tied(const TriangleMesh& mesh, std::span<const Key2> keys, HalfEdgeId start, Key2 a, Key2 b) {
    HalfEdgeId h = start;
    do {
        if (!mesh.is_ghost(face_of(h))) {
            const Key2 u = keys[mesh.destination(h).value];
            const Key2 v = keys[mesh.origin(previous(h)).value];
            if (orient2d(a, u, b) > 0 && orient2d(a, v, b) < 0) {
                return incircle(a, u, v, b) == 0;
            }
        }
        h = next_around(mesh, h);
    } while (h != start);
    return false;  // it runs through another vertex
}

}  // namespace

std::size_t count_edges_without_disk(std::span<const Key2> keys,
                                     std::span<const std::pair<std::uint32_t, std::uint32_t>> edges) {
    std::vector<Key2> places;
    std::vector<std::uint32_t> place_of(keys.size());
    for (const std::uint32_t i : sort_along_curve(keys)) {
        if (places.empty() || !(places.back() == keys[i])) {
            places.push_back(keys[i]);
        }
        place_of[i] = static_cast<std::uint32_t>(places.size() - 1);
    }
    const TriangleMesh mesh = make_delaunay(places);
    const std::vector<HalfEdgeId> starts = find_starts(mesh);
    return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
        const VertexId a{place_of[edge.first]};
        const VertexId b{place_of[edge.second]};
        const HalfEdgeId start = starts[a.value];
        return !find_half_edge(mesh, start, b) &&
               !is_tied(mesh, places, start, places[a.value], places[b.value]);
    }));
}

}  // namespace tinwright
