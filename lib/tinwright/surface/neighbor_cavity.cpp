#include "tinwright/surface/neighbor_cavity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tinwright/surface/step_vectors.hpp"

namespace tinwright {

namespace {

using internal::LocalKey;
using steps::add;
using steps::dot;
using steps::precise_cross;
using steps::square;
using steps::turned;
using steps::vector_between;
using steps::vector_to;

/// What a face of the cavity adds to 8 a of its corners.
struct FaceShares {
    double x = 0;
    double y = 0;
    double w = 0;
};

/// Corners counter-clockwise.
[[gnu::always_inline]] inline FaceShares shares_of_face(const LocalKey& x, const LocalKey& y,
                                                        const LocalKey& w) {
    const Point2 xy = vector_between(x, y);
    const Point2 yw = vector_between(y, w);
    const Point2 wx = vector_between(w, x);
    const double inverse = -1 / precise_cross(xy, yw);
    // The cotangent at the corner across times the difference of the ends' squared distances from q.
    const double of_xy = dot(yw, wx) * inverse * dot(xy, {x.x + y.x, x.y + y.y});
    const double of_yw = dot(wx, xy) * inverse * dot(yw, {y.x + w.x, y.y + w.y});
    const double of_wx = dot(xy, yw) * inverse * dot(wx, {w.x + x.x, w.y + x.y});
    return {of_xy - of_wx, of_yw - of_xy, of_wx - of_yw};
}

/// The triangle of the place, q, and two neighbours in turn, a and b.
struct RimTriangle {
    RimTriangle(const LocalKey& a, const LocalKey& b)
        : side(vector_between(a, b)),
          inverse(1 / precise_cross(vector_to(a), vector_to(b))),
          cotangent_a(-dot(vector_to(a), side) * inverse),
          cotangent_b(dot(vector_to(b), side) * inverse) {}

    Point2 side;     // from a to b
    double inverse;  // of d = a x b
    double cotangent_a;
    double cotangent_b;
};

/// Twice the centre of the circle through q, a and b.
Point2 doubled_center(const RimTriangle& triangle, const LocalKey& a, const LocalKey& b) {
    const Point2 u = turned(vector_to(a));
    const Point2 v = turned(vector_to(b));
    return {(a.square * v.x - b.square * u.x) * triangle.inverse,
            (a.square * v.y - b.square * u.y) * triangle.inverse};
}

}  // namespace

NeighborCavity::NeighborCavity(const NeighborMesh& mesh, const QueryLattice& lattice)
    : tin_(mesh.tin()), sharp_(mesh.sharp()), circles_(mesh.circles()), lattice_(lattice) {
    make_room(16);
}

[[gnu::always_inline]] inline void NeighborCavity::add_neighbor(VertexId v, Key2 at) {
    NaturalNeighbor& added = neighbors_[count_++];
    added.at = internal::localize(lattice_.scaled(tin_.key(v)), at);
    added.vertex = v;
    added.share = 0;
}

// Which edges the cavity goes on through is anyone's guess, so no branch depends on it: an edge is written
// where the next edge to cross goes, and where the next rim edge goes, and one of the two stays.
[[gnu::always_inline]] inline void NeighborCavity::look_at(const Side& side, Key2 at) {
    const FaceId beyond = face_of(tin_.mesh.twin(side.edge));
    __builtin_prefetch(&tin_.mesh.face(beyond));  // crossed soon, or never
    const bool is_open = !sharp_.is_sharp(side.edge) && circles_.is_inside(beyond, at);
    crossed_[crossed_count_] = side;
    rim_[rim_count_] = side;
    crossed_count_ += is_open ? 1 : 0;
    rim_count_ += is_open ? 0 : 1;
}

template <bool kAreas>
void NeighborCavity::grow(const NeighborPlace& place, Key2 at) {
    const auto add_shares = [&](NaturalNeighbor& x, NaturalNeighbor& y, NaturalNeighbor& w) {
        if constexpr (kAreas) {
            const FaceShares shares = shares_of_face(x.at, y.at, w.at);
            x.share += shares.x;
            y.share += shares.y;
            w.share += shares.w;
        }
    };
    const TriangleMesh& mesh = tin_.mesh;
    count_ = 0;
    crossed_count_ = 0;
    rim_count_ = 0;
    const std::array<HalfEdgeId, 3> first{place.edge, next(place.edge), previous(place.edge)};
    for (const HalfEdgeId edge : first) {
        add_neighbor(mesh.origin(edge), at);
    }
    add_shares(neighbors_[0], neighbors_[1], neighbors_[2]);
    is_on_edge_ = place.kind == NeighborPlace::Kind::Edge;
    if (!is_on_edge_) {
        look_at({first[0], 0, 1}, at);
    }
    look_at({first[1], 1, 2}, at);
    look_at({first[2], 2, 0}, at);
    // Every face beyond brings one more neighbour.
    for (std::size_t i = 0; i < crossed_count_; ++i) {
        const Side side = crossed_[i];
        const HalfEdgeId across = mesh.twin(side.edge);
        const auto s = static_cast<std::uint32_t>(count_);
        if (count_ + 3 > neighbors_.size()) {
            make_room(2 * neighbors_.size());
        }
        add_neighbor(mesh.origin(previous(across)), at);
        add_shares(neighbors_[side.b], neighbors_[side.a], neighbors_[s]);
        look_at({next(across), side.a, s}, at);
        look_at({previous(across), s, side.b}, at);
    }
}

void NeighborCavity::make_room(std::size_t count) {
    neighbors_.resize(count);
    crossed_.resize(2 * count);  // one for each neighbour but three, and those of the rim still to be crossed
    rim_.resize(count);
}

void NeighborCavity::find(const NeighborPlace& place, Key2 at, ShareKind kind) {
    if (kind == ShareKind::Sibson) {
        grow<true>(place, at);
    } else {
        grow<false>(place, at);
    }
    neighbors_[0].next = 1;  // on an edge, which is no side of a triangle with the place
    neighbors_[0].edge = place.edge;
    for (std::size_t i = 0; i < rim_count_; ++i) {
        const Side side = rim_[i];
        NaturalNeighbor& a = neighbors_[side.a];
        NaturalNeighbor& b = neighbors_[side.b];
        a.next = side.b;
        a.edge = side.edge;
        const RimTriangle triangle(a.at, b.at);
        const bool is_area = kind == ShareKind::Sibson;
        a.share += is_area ? b.at.square * triangle.cotangent_a : triangle.cotangent_b;
        b.share += is_area ? a.at.square * triangle.cotangent_b : triangle.cotangent_a;
    }
    if (is_on_edge_) {
        set_edge_shares(kind);
    } else if (kind == ShareKind::Sibson) {
        correct_areas();
    }
}

// Beside faces a million times longer than wide, areas as large as their squared length cancel, and what
// rounding leaves of sum a_i p_i = 0 would show on planes. It is taken away by as small relative changes of
// the areas as do it: by the least squares weighted by the areas. The axes are the direction of a neighbour
// that counts and that across it, where narrow cavities are narrow, so that little cancels here.
void NeighborCavity::correct_areas() {
    constexpr double kEnough = 0x1p-47;
    double total = 0;
    double heaviest = 0;
    double clearance = neighbors_.front().at.square;
    Point2 rest{0, 0};
    Point2 u{};
    for (const NaturalNeighbor& neighbor : neighbors()) {
        total += neighbor.share;
        add(rest, neighbor.share, vector_to(neighbor.at));
        clearance = std::min(clearance, neighbor.at.square);
        const double weight = std::abs(neighbor.share) * neighbor.at.square;
        u = weight > heaviest ? vector_to(neighbor.at) : u;
        heaviest = std::max(weight, heaviest);
    }
    if (square(rest) <= kEnough * kEnough * total * total * clearance) {
        return;
    }
    for (int pass = 0; pass < 2; ++pass) {
        double uu = 0;
        double uv = 0;
        double vv = 0;
        double u_rest = 0;
        double v_rest = 0;
        for (const NaturalNeighbor& neighbor : neighbors()) {
            const double along = dot(u, vector_to(neighbor.at));
            const double across = precise_cross(u, vector_to(neighbor.at));
            uu += neighbor.share * along * along;
            uv += neighbor.share * along * across;
            vv += neighbor.share * across * across;
            u_rest += neighbor.share * along;
            v_rest += neighbor.share * across;
        }
        const double determinant = uu * vv - uv * uv;
        const double by_u = (u_rest * vv - v_rest * uv) / determinant;
        const double by_v = (v_rest * uu - u_rest * uv) / determinant;
        if (!std::isfinite(by_u) || !std::isfinite(by_v)) {
            return;
        }
        for (NaturalNeighbor& neighbor : std::span(neighbors_).first(count_)) {
            const double along = dot(u, vector_to(neighbor.at));
            const double across = precise_cross(u, vector_to(neighbor.at));
            neighbor.share *= 1 - (by_u * along + by_v * across);
        }
    }
}

void NeighborCavity::find_with_gradients(const NeighborPlace& place, Key2 at, ShareKind kind) {
    find(place, at, kind);
    gradients_.assign(count_, {0, 0});
    if (is_on_edge_) {
        set_edge_gradients(kind);
    } else if (kind == ShareKind::Sibson) {
        set_area_gradients();
    } else {
        set_side_gradients();
    }
}

// The cell's side towards a neighbour moves outward with the place, at each point x of it by x dq / |p_i|:
// the gradient of a_i is lambda_i times the centre of the side.
void NeighborCavity::set_area_gradients() {
    sides_.assign(count_, 0);
    for (std::size_t i = 0; i < count_; ++i) {
        const std::size_t j = neighbors_[i].next;
        const LocalKey& a = neighbors_[i].at;
        const LocalKey& b = neighbors_[j].at;
        const RimTriangle triangle(a, b);
        const Point2 center = doubled_center(triangle, a, b);
        sides_[i] += triangle.cotangent_b;
        sides_[j] += triangle.cotangent_a;
        add(gradients_[i], 1, center);
        add(gradients_[j], 1, center);
    }
    for (std::size_t i = 0; i < count_; ++i) {
        gradients_[i] = {gradients_[i].x * sides_[i], gradients_[i].y * sides_[i]};
    }
}

// With d = a x b, the gradients are that of d: the side a - b, turned; of a (a - b): -(a - b); of b (b - a):
// -(b - a).
void NeighborCavity::set_side_gradients() {
    for (std::size_t i = 0; i < count_; ++i) {
        const std::size_t j = neighbors_[i].next;
        const RimTriangle triangle(neighbors_[i].at, neighbors_[j].at);
        const Point2 side = triangle.side;
        const Point2 of_d{-turned(side).x, -turned(side).y};
        const double ca = triangle.cotangent_a;
        const double cb = triangle.cotangent_b;
        add(gradients_[j], triangle.inverse, {side.x - ca * of_d.x, side.y - ca * of_d.y});
        add(gradients_[i], -triangle.inverse, {side.x + cb * of_d.x, side.y + cb * of_d.y});
    }
}

// From here on: q on the edge between a and b, the first two neighbours.

void NeighborCavity::set_edge_shares(ShareKind kind) {
    across_.clear();
    for (NaturalNeighbor& neighbor : std::span(neighbors_).first(count_)) {
        across_.push_back(neighbor.share);
        neighbor.share = 0;
    }
    const double s = std::sqrt(neighbors_[0].at.square);
    const double t = std::sqrt(neighbors_[1].at.square);
    neighbors_[0].share = kind == ShareKind::Sibson ? s * t * t : t;
    neighbors_[1].share = kind == ShareKind::Sibson ? s * s * t : s;
}

void NeighborCavity::set_edge_gradients(ShareKind kind) {
    const double s = std::sqrt(neighbors_[0].at.square);
    const double t = std::sqrt(neighbors_[1].at.square);
    const Point2 side = vector_between(neighbors_[0].at, neighbors_[1].at);
    const double length = std::sqrt(square(side));
    const Point2 along{side.x / length, side.y / length};
    const Point2 inward{-along.y, along.x};
    for (std::size_t i = 0; i < count_; ++i) {
        gradients_[i] = {inward.x * across_[i], inward.y * across_[i]};
    }
    const double of_a = kind == ShareKind::Sibson ? t * t - 2 * s * t : -1;
    const double of_b = kind == ShareKind::Sibson ? 2 * s * t - s * s : 1;
    add(gradients_[0], of_a, along);
    add(gradients_[1], of_b, along);
}

}  // namespace tinwright
