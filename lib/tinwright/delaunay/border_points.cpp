#include "tinwright/delaunay/border_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "tinwright/delaunay/cavity.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

/// The half-edge of a face with another face behind it.
HalfEdgeId shared_edge(const TriangleMesh& mesh, FaceId face, FaceId other) {
    HalfEdgeId h = half_edge(face, 0);
    while (face_of(mesh.twin(h)) != other) {
        h = next(h);
    }
    return h;
}

/// A segment's lattice points: a + i * step, 0 <= i <= count.
struct Steps {
    Key2 a;
    Key2 step;
    double count;

    Steps(Key2 from, Key2 to) : a(from) {
        const auto whole = [](double value) { return static_cast<std::int64_t>(value); };
        count = static_cast<double>(std::gcd(whole(to.x - from.x), whole(to.y - from.y)));
        step = {(to.x - from.x) / count, (to.y - from.y) / count};
    }
};

}  // namespace

std::vector<Key2> find_border_points(const TriangleMesh& mesh, std::span<const Key2> keys,
                                     std::span<const Segment> segments) {
    constexpr double kFewest = 1024;  // lattice points of a segment that are too few to choose from
    const std::vector<HalfEdgeId> starts = find_starts(mesh);
    std::vector<Key2> places;
    Cavity cavity;
    for (const auto& [from, to] : segments) {
        for (VertexId v = from; v != to; v = cavity.end) {
            find_cavity(mesh, keys, starts[v.value], to, cavity);
            const Key2 a = keys[cavity.begin.value];
            const Key2 b = keys[cavity.end.value];
            const Steps steps(a, b);
            for (std::size_t i = 0; steps.count >= kFewest && i + 1 < cavity.slots.size(); ++i) {
                const HalfEdgeId h = shared_edge(mesh, cavity.slots[i], cavity.slots[i + 1]);
                const Key2 p = keys[mesh.origin(h).value];
                const Key2 q = keys[mesh.destination(h).value];
                const double before = doubled_area(p, q, a);
                const double share = before / (before - doubled_area(p, q, b));
                const double at = std::round(share * steps.count);
                if (at > 0 && at < steps.count) {
                    places.push_back({a.x + at * steps.step.x, a.y + at * steps.step.y});
                }
            }
        }
    }
    std::sort(places.begin(), places.end(), precedes_on_curve);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::erase_if(places, [&](Key2 place) {
        return std::binary_search(keys.begin(), keys.end(), place, precedes_on_curve);
    });
    return places;
}

}  // namespace tinwright
