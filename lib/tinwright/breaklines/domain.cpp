#include "tinwright/breaklines/domain.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <vector>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/mesh/border.hpp"

namespace tinwright {

namespace {

constexpr double kNeedleRatio = 0.1;  // height over the border edge, by the edge's length

/// A border edge that could be opened by dropping its face.
struct Opening {
    double rank = 0;  ///< the smaller, the sooner
    HalfEdgeId edge;  ///< in the face
    std::array<VertexId, 3> vertex;

    friend bool operator<(const Opening& a, const Opening& b) {
        return std::tie(a.rank, a.vertex) > std::tie(b.rank, b.vertex);  // the queue's top is the greatest
    }
};

double squared_length(const Tin& tin, HalfEdgeId h) {
    return squared_distance(tin.key(tin.mesh.origin(h)), tin.key(tin.mesh.destination(h)));
}

/// Height of a face over one of its edges, by the edge's length.
double height_ratio(const Tin& tin, HalfEdgeId h) {
    const TriangleMesh& mesh = tin.mesh;
    return doubled_area(tin.key(mesh.origin(h)), tin.key(mesh.destination(h)),
                        tin.key(mesh.origin(previous(h)))) /
           squared_length(tin, h);
}

/// `length` in keys; where it is decimal and so is the lattice, exactly the number meant.
double squared_in_keys(const Lattice& lattice, double length) {
    const double keys = lattice.decimals() >= 0
                            ? std::ldexp(scaled_decimal(length, lattice.decimals()), lattice.refinement())
                            : std::ldexp(length, -lattice.exponent());
    return keys * keys;
}

/// Opens border edges, best rank first, as long as the opposite vertex is not on the border. `rank_of(h)`
/// must be negative for edges to be opened.
template <class RankOf>
std::size_t open_border(Tin& tin, const RankOf& rank_of) {
    TriangleMesh& mesh = tin.mesh;
    std::vector<bool> is_on_border(mesh.vertex_count());
    std::priority_queue<Opening> queue;
    const std::vector<HalfEdgeId> border = find_border(mesh);
    for (const HalfEdgeId h : border) {
        is_on_border[mesh.origin(h).value] = true;
        is_on_border[mesh.destination(h).value] = true;
    }
    const auto consider = [&](HalfEdgeId h) {
        if (mesh.is_constrained(h)) {
            return;
        }
        const VertexId apex = mesh.origin(previous(h));
        if (is_on_border[apex.value]) {
            return;
        }
        const double rank = rank_of(h);
        if (rank < 0) {
            queue.push({rank, h, {mesh.origin(h), mesh.destination(h), apex}});
        }
    };
    for (const HalfEdgeId h : border) {
        consider(h);
    }
    std::size_t dropped = 0;
    while (!queue.empty()) {
        const Opening opening = queue.top();
        queue.pop();
        if (is_on_border[opening.vertex[2].value]) {
            continue;
        }
        mesh.set_terrain(face_of(opening.edge), false);
        is_on_border[opening.vertex[2].value] = true;
        ++dropped;
        consider(mesh.twin(next(opening.edge)));
        consider(mesh.twin(previous(opening.edge)));
    }
    return dropped;
}

}  // namespace

std::size_t apply_domain(Tin& tin, const DomainRule& rule) {
    if (rule.kind == DomainRule::Kind::Trimmed) {
        return open_border(tin, [&](HalfEdgeId h) { return height_ratio(tin, h) - kNeedleRatio; });
    }
    if (rule.kind == DomainRule::Kind::Concave) {
        const double limit = squared_in_keys(tin.lattice, rule.length);
        return open_border(tin, [&](HalfEdgeId h) { return limit - squared_length(tin, h); });
    }
    return 0;
}

std::size_t drop_long_faces(Tin& tin, double length, const std::vector<bool>& is_kept,
                            const GroundMeasures& ground) {
    const PlaneBand band = ground.band_around(length);
    const double shorter = squared_in_keys(tin.lattice, band.shorter);
    const double longer =
        std::isfinite(band.longer) ? squared_in_keys(tin.lattice, band.longer) : band.longer;
    const auto is_long = [&](HalfEdgeId h) {
        const double squared = squared_length(tin, h);
        if (squared <= shorter || squared > longer) {
            return squared > longer;
        }
        const Point3 a = tin.position(tin.mesh.origin(h));
        const Point3 b = tin.position(tin.mesh.destination(h));
        return ground.length({a.x, a.y}, {b.x, b.y}) > length;
    };
    std::size_t dropped = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f}) || (!is_kept.empty() && is_kept[f])) {
            continue;
        }
        if (is_long(half_edge({f}, 0)) || is_long(half_edge({f}, 1)) || is_long(half_edge({f}, 2))) {
            tin.mesh.set_terrain({f}, false);
            ++dropped;
        }
    }
    return dropped;
}

void constrain_border(Tin& tin) {
    for (const HalfEdgeId h : find_border(tin.mesh)) {
        tin.mesh.set_constrained(h, true);
    }
}

}  // namespace tinwright
