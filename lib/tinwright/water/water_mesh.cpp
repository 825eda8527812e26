#include "tinwright/water/water_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"

namespace tinwright {

namespace {

// Walks the mesh from outside the hull; each ring edge passed changes the side.
void mark_outside(TriangleMesh& mesh) {
    enum class Side : std::uint8_t { Unknown, Outside, Inside };
    std::vector<Side> sides(mesh.slot_count(), Side::Unknown);
    std::vector<FaceId> reached;
    for (FaceId f{0}; f.value < mesh.slot_count(); ++f.value) {
        if (mesh.is_ghost(f)) {
            sides[f.value] = Side::Outside;
            reached.push_back(f);
        }
    }
    while (!reached.empty()) {
        const FaceId f = reached.back();
        reached.pop_back();
        const Side here = sides[f.value];
        if (here == Side::Outside) {
            mesh.set_terrain(f, false);
        }
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(f, corner);
            const FaceId beyond = face_of(mesh.twin(h));
            if (sides[beyond.value] == Side::Unknown) {
                const bool is_inside = (here == Side::Inside) != mesh.is_constrained(h);
                sides[beyond.value] = is_inside ? Side::Inside : Side::Outside;
                reached.push_back(beyond);
            }
        }
    }
}

}  // namespace

Point2 WaterMesh::middle(HalfEdgeId h) const {
    const Key2 a = key(mesh.origin(h));
    const Key2 b = key(mesh.destination(h));
    return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

double WaterMesh::length(HalfEdgeId h) const {
    return std::sqrt(squared_distance(key(mesh.origin(h)), key(mesh.destination(h))));
}

WaterMesh make_water_mesh(std::span<const std::vector<Key2>> rings) {
    std::vector<Key2> unsorted;
    for (const std::vector<Key2>& ring : rings) {
        unsorted.insert(unsorted.end(), ring.begin(), ring.end());
    }
    const std::vector<std::uint32_t> order = sort_along_curve(unsorted);
    WaterMesh water;
    water.keys.reserve(order.size());
    std::vector<VertexId> vertices(order.size());
    for (const std::uint32_t i : order) {
        vertices[i] = {static_cast<std::uint32_t>(water.keys.size())};
        water.keys.push_back(unsorted[i]);
    }
    std::vector<Segment> segments;
    segments.reserve(order.size());
    auto begin = vertices.cbegin();
    for (const std::vector<Key2>& ring : rings) {
        const auto end = begin + static_cast<std::ptrdiff_t>(ring.size());
        water.rings.emplace_back(begin, end);
        VertexId before = *(end - 1);
        for (; begin != end; ++begin) {
            segments.push_back({std::min(before, *begin), std::max(before, *begin)});
            before = *begin;
        }
    }
    // Face slots depend on the order of the segments.
    std::sort(segments.begin(), segments.end(),
              [](const Segment& x, const Segment& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    water.mesh = make_delaunay(water.keys);
    insert_segments(water.mesh, water.keys, segments);
    mark_outside(water.mesh);
    return water;
}

}  // namespace tinwright
