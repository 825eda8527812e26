#include "tinwright/optimal/delaunay_order.hpp"

#include <algorithm>
#include <optional>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright::internal {

namespace {

template <class Value>
bool holds(const std::vector<Value>& values, Value value) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

bool is_barrier_in(const TriangleMesh& mesh, HalfEdgeId h) {
    return mesh.is_constrained(h) || !mesh.is_terrain(face_of(h)) || !mesh.is_terrain(face_of(mesh.twin(h)));
}

}  // namespace

DelaunayOrder::DelaunayOrder(const Tin& start) : start_(start.mesh), starts_(find_starts(start.mesh)) {}

bool DelaunayOrder::is_barrier(HalfEdgeId h) const { return is_barrier_in(start_, h); }

// Constrained edges are the same in both meshes: the first one clockwise of the corner leads over.
HalfEdgeId DelaunayOrder::corner_at_start(const TriangleMesh& now, HalfEdgeId corner) const {
    const HalfEdgeId any = starts_[now.origin(corner).value];
    HalfEdgeId h = corner;
    do {
        if (is_barrier_in(now, h)) {
            return find_half_edge(start_, any, now.destination(h)).value_or(any);
        }
        h = next(now.twin(h));
    } while (h != corner);
    return any;
}

void DelaunayOrder::visit(const Tin& now, const std::array<Key2, 3>& circle, HalfEdgeId corner) {
    const VertexId v = start_.origin(corner);
    if (!holds(inside_, v)) {
        if (incircle(circle[0], circle[1], circle[2], now.key(v)) <= 0) {
            return;
        }
        inside_.push_back(v);
    }
    pending_.push_back(corner);
}

// All faces around the corner's vertex that lie on the same side of constrained edges.
void DelaunayOrder::visit_sector(const Tin& now, const std::array<Key2, 3>& circle, HalfEdgeId corner) {
    const auto visit_face = [&](HalfEdgeId h) {
        seen_.push_back(h);
        visit(now, circle, next(h));
        visit(now, circle, previous(h));
    };
    HalfEdgeId h = corner;
    visit_face(h);
    while (!is_barrier(previous(h))) {
        h = start_.twin(previous(h));
        if (h == corner) {
            return;
        }
        visit_face(h);
    }
    h = corner;
    while (!is_barrier(h)) {
        h = next(start_.twin(h));
        visit_face(h);
    }
}

bool DelaunayOrder::is_at_most(const Tin& now, const std::array<HalfEdgeId, 3>& corner, int order) {
    const auto limit = static_cast<std::size_t>(order);
    const std::array circle{now.key(now.mesh.origin(corner[0])), now.key(now.mesh.origin(corner[1])),
                            now.key(now.mesh.origin(corner[2]))};
    pending_.clear();
    seen_.clear();
    inside_.clear();
    for (const HalfEdgeId h : corner) {
        pending_.push_back(corner_at_start(now.mesh, h));
    }
    while (!pending_.empty() && inside_.size() <= limit) {
        const HalfEdgeId h = pending_.back();
        pending_.pop_back();
        if (!holds(seen_, h)) {
            visit_sector(now, circle, h);
        }
    }
    return inside_.size() <= limit;
}

}  // namespace tinwright::internal
