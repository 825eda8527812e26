#include "tinwright/surface/ring_prediction.hpp"

#include <array>
#include <cstddef>
#include <limits>

#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

struct Spoke {
    Key2 offset;
    double square;  // of its length
    double z;       // from that of the vertex
};

double cross(Key2 a, Key2 b) { return a.x * b.y - a.y * b.x; }

/// Of the triangles around the vertex the one that comes closest below it when all are lifted to a
/// paraboloid: that of the Delaunay triangulation.
struct Enclosure {
    double lift = std::numeric_limits<double>::infinity();
    double z = 0;

    void consider(const Spoke& a, const Spoke& b, const Spoke& c) {
        const double of_a = cross(b.offset, c.offset);
        const double of_b = cross(c.offset, a.offset);
        const double of_c = cross(a.offset, b.offset);
        const double area = of_a + of_b + of_c;
        if (!(of_a >= 0 && of_b >= 0 && of_c >= 0 && area > 0)) {
            return;
        }
        const double lifted = (of_a * a.square + of_b * b.square + of_c * c.square) / area;
        if (lifted < lift) {
            lift = lifted;
            z = (of_a * a.z + of_b * b.z + of_c * c.z) / area;
        }
    }
};

}  // namespace

std::optional<double> ring_prediction_error(const Tin& tin, const VertexFan& fan) {
    if (!fan.is_closed) {
        return std::nullopt;
    }
    std::array<Spoke, kMostSpokes> spokes{};
    std::size_t count = 0;
    bool is_hub = false;
    const VertexId center = tin.mesh.origin(fan.first);
    visit_fan(tin.mesh, fan, [&](HalfEdgeId h) {
        is_hub = is_hub || count == kMostSpokes;
        if (!is_hub) {
            const VertexId v = tin.mesh.destination(h);
            const Key2 from = tin.key(center);
            const Key2 to = tin.key(v);
            spokes[count++] = {{to.x - from.x, to.y - from.y},
                               squared_distance(from, to),
                               tin.z[v.value] - tin.z[center.value]};
        }
    });
    if (is_hub) {
        return std::nullopt;
    }
    Enclosure enclosure;
    for (std::size_t i = 0; i + 2 < count; ++i) {
        for (std::size_t j = i + 1; j + 1 < count; ++j) {
            for (std::size_t k = j + 1; k < count; ++k) {
                enclosure.consider(spokes[i], spokes[j], spokes[k]);  // they turn counter-clockwise
            }
        }
    }
    if (enclosure.lift == std::numeric_limits<double>::infinity()) {
        return std::nullopt;
    }
    return -enclosure.z;
}

}  // namespace tinwright
