#include "tinwright/delaunay/steiner_point.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

double coordinate(Key2 key, bool is_x) { return is_x ? key.x : key.y; }

/// The way from a to b that has been gone at `key`, as a share.
double share_of_way(Key2 a, Key2 b, Key2 key) { return inner_product(key, a, b) / inner_product(b, a, b); }

}  // namespace

SteinerInserter::SteinerInserter(Tin& tin)
    : tin_(tin), old_count_(tin.vertex_count()), start_(find_starts(tin.mesh)) {
    for (const LineTrace& trace : tin.traces) {
        if (line_edges_.empty() || line_edges_.back() != std::pair(trace.a, trace.b)) {
            line_edges_.emplace_back(trace.a, trace.b);
        }
    }
}

std::optional<HalfEdgeId> SteinerInserter::find_half_edge(VertexId a, VertexId b) const {
    return tinwright::find_half_edge(tin_.mesh, start_[a.value], b);
}

std::uint32_t SteinerInserter::line_edge_of(VertexId a, VertexId b) const {
    for (const VertexId v : {a, b}) {
        if (v.value >= old_count_) {
            return line_edge_[v.value - old_count_];
        }
    }
    const auto found =
        std::lower_bound(line_edges_.begin(), line_edges_.end(), std::pair(std::min(a, b), std::max(a, b)));
    const bool is_found = found != line_edges_.end() && *found == std::pair(std::min(a, b), std::max(a, b));
    return is_found ? static_cast<std::uint32_t>(found - line_edges_.begin()) : kFree;
}

std::optional<VertexId> SteinerInserter::split(HalfEdgeId h, double t) {
    const VertexId a = tin_.mesh.origin(h);
    const VertexId b = tin_.mesh.destination(h);
    const std::uint32_t line_edge = line_edge_of(a, b);
    find_places(line_edge, tin_.key(a), tin_.key(b), t);
    const auto place = std::find_if(places_.begin(), places_.end(),
                                    [&](const Place& candidate) { return keeps_faces(h, candidate.key); });
    if (place == places_.end()) {
        return std::nullopt;
    }
    const auto [begin, end] = line_edges_[line_edge];
    const double share = share_of_way(tin_.key(begin), tin_.key(end), place->key);
    const double z = tin_.z[begin.value] + share * (tin_.z[end.value] - tin_.z[begin.value]);
    const VertexId v = add_vertex(place->key, z, line_edge);
    split_edge(tin_.mesh, h);
    start_[v.value] = next(h);
    settle(v);
    return v;
}

// Lattice points next to the line's edge, strictly between two ends, from the place t outward. Off that place
// by even a step, a point leaves the vertex it keeps away from in the disk of one of the parts.
void SteinerInserter::find_places(std::uint32_t line_edge, Key2 from, Key2 to, double t) {
    constexpr int kReach = 3;
    const Key2 begin = tin_.key(line_edges_[line_edge].first);
    const Key2 end = tin_.key(line_edges_[line_edge].second);
    const bool is_x = std::abs(end.x - begin.x) >= std::abs(end.y - begin.y);
    const double ratio = (coordinate(end, !is_x) - coordinate(begin, !is_x)) /
                         (coordinate(end, is_x) - coordinate(begin, is_x));
    const double first = coordinate(from, is_x);
    const double last = coordinate(to, is_x);
    const double aim = Lattice::nearest_integer(first + t * (last - first));
    places_.clear();
    for (int i = -kReach; i <= kReach; ++i) {
        const double along = aim + i;
        if (along > std::min(first, last) && along < std::max(first, last)) {
            const double across = Lattice::nearest_integer(coordinate(begin, !is_x) +
                                                           ratio * (along - coordinate(begin, is_x)));
            const Key2 key = is_x ? Key2{along, across} : Key2{across, along};
            places_.push_back({std::abs(doubled_area(begin, end, key)), std::abs(along - aim), key});
        }
    }
    std::sort(places_.begin(), places_.end(), [](const Place& p, const Place& q) {
        return std::tie(p.offset, p.distance, p.key.x, p.key.y) <
               std::tie(q.offset, q.distance, q.key.x, q.key.y);
    });
}

bool SteinerInserter::keeps_faces(HalfEdgeId h, Key2 place) const {
    const TriangleMesh& mesh = tin_.mesh;
    for (const HalfEdgeId side : {h, mesh.twin(h)}) {
        const Key2 a = tin_.key(mesh.origin(side));
        const Key2 b = tin_.key(mesh.destination(side));
        const VertexId apex = mesh.origin(previous(side));
        if (apex == kGhostVertex || orient2d(a, place, tin_.key(apex)) <= 0 ||
            orient2d(place, b, tin_.key(apex)) <= 0) {
            return false;
        }
    }
    return true;
}

// A half-edge of the face that holds `key`, with `key` left of it or on it; where it is on an edge, that
// edge.
HalfEdgeId SteinerInserter::locate(Key2 key, VertexId near) const {
    const TriangleMesh& mesh = tin_.mesh;
    HalfEdgeId h = start_[near.value];
    // Where not all edges are Delaunay, a walk that always asks edges in the same order can go round in
    // circles.
    std::uint32_t turn = 1;
    for (;;) {
        turn = 1664525U * turn + 1013904223U;
        h = (turn >> 31U) == 0 ? h : next(h);
        HalfEdgeId on_edge = h;
        bool is_inside = true;
        for (unsigned i = 0; i < 3 && is_inside; ++i, h = next(h)) {
            const int side = orient2d(tin_.key(mesh.origin(h)), tin_.key(mesh.destination(h)), key);
            if (side < 0) {
                is_inside = false;
                break;
            }
            on_edge = side == 0 ? h : on_edge;
        }
        if (is_inside) {
            return on_edge;
        }
        h = mesh.twin(h);
        if (mesh.is_ghost(face_of(h))) {
            return h;
        }
    }
}

std::optional<VertexId> SteinerInserter::insert(Key2 key, double z, VertexId near) {
    TriangleMesh& mesh = tin_.mesh;
    const HalfEdgeId h = locate(key, near);
    if (mesh.is_ghost(face_of(h))) {
        return std::nullopt;
    }
    const bool is_on_edge = orient2d(tin_.key(mesh.origin(h)), tin_.key(mesh.destination(h)), key) == 0;
    const bool is_vertex = key == tin_.key(mesh.origin(h)) || key == tin_.key(mesh.destination(h)) ||
                           key == tin_.key(mesh.origin(previous(h)));
    if (is_vertex || (is_on_edge && (mesh.is_constrained(h) || mesh.is_ghost(face_of(mesh.twin(h)))))) {
        return std::nullopt;
    }
    const VertexId v = add_vertex(key, z, kFree);
    if (is_on_edge) {
        split_edge(mesh, h);
        start_[v.value] = next(h);
    } else {
        split_face(mesh, face_of(h));
        start_[v.value] = half_edge(face_of(h), 2);
    }
    settle(v);
    return v;
}

std::optional<VertexId> SteinerInserter::insert(Key2 key, VertexId near) {
    const HalfEdgeId h = locate(key, near);
    if (tin_.mesh.is_ghost(face_of(h))) {
        return std::nullopt;
    }
    const auto& [a, b, c] = tin_.mesh.face(face_of(h)).vertex;
    const double area_a = doubled_area(tin_.key(b), tin_.key(c), key);
    const double area_b = doubled_area(tin_.key(c), tin_.key(a), key);
    const double area_c = doubled_area(tin_.key(a), tin_.key(b), key);
    const double z = (area_a * tin_.z[a.value] + area_b * tin_.z[b.value] + area_c * tin_.z[c.value]) /
                     (area_a + area_b + area_c);
    return insert(key, z, a);
}

VertexId SteinerInserter::add_vertex(Key2 key, double z, std::uint32_t line_edge) {
    tin_.keys.push_back(key);
    tin_.z.push_back(z);
    tin_.sample.push_back(Tin::kNoSample);
    start_.push_back(kNoHalfEdge);
    line_edge_.push_back(line_edge);
    return {static_cast<std::uint32_t>(tin_.keys.size() - 1)};
}

void SteinerInserter::take_starts(FaceId f) {
    for (unsigned corner = 0; corner < 3; ++corner) {
        start_[tin_.mesh.vertex(f, corner).value] = half_edge(f, corner);
    }
}

void SteinerInserter::settle(VertexId v) {
    TriangleMesh& mesh = tin_.mesh;
    touched_.clear();
    unsettled_.clear();
    // Every edge of the new faces: rounding may have put the vertex out of the circle of one of them.
    const HalfEdgeId first = start_[v.value];
    HalfEdgeId h = first;
    do {
        unsettled_.push_back(next(h));
        unsettled_.push_back(h);
        take_starts(face_of(h));
        h = next_around(mesh, h);
    } while (h != first);
    while (!unsettled_.empty()) {
        h = unsettled_.back();
        unsettled_.pop_back();
        const HalfEdgeId t = mesh.twin(h);
        if (mesh.is_constrained(h)) {
            touched_.push_back(h);
            continue;
        }
        if (mesh.is_ghost(face_of(h)) || mesh.is_ghost(face_of(t)) ||
            incircle_perturbed(tin_.key(mesh.origin(h)), tin_.key(mesh.destination(h)),
                               tin_.key(mesh.origin(previous(h))), tin_.key(mesh.origin(previous(t)))) <= 0) {
            continue;
        }
        flip_edge(mesh, h);
        for (const HalfEdgeId side : {h, mesh.twin(h)}) {
            take_starts(face_of(side));
            unsettled_.push_back(next(side));
            unsettled_.push_back(previous(side));
        }
    }
}

// Moves the new vertices to their places in the curve's order; returns everybody's new number.
std::vector<VertexId> SteinerInserter::sort_in() {
    const std::size_t count = tin_.vertex_count();
    struct Made {
        Key2 key;
        double z;
        std::uint32_t sample;
        std::size_t was;
        std::size_t before;  // old vertices that come before it
    };
    std::vector<Made> made;
    made.reserve(count - old_count_);
    const auto old_end = tin_.keys.begin() + static_cast<std::ptrdiff_t>(old_count_);
    for (std::size_t v = old_count_; v < count; ++v) {
        const Key2 key = tin_.keys[v];
        const auto after = std::lower_bound(tin_.keys.begin(), old_end, key, precedes_on_curve);
        made.push_back(
            {key, tin_.z[v], tin_.sample[v], v, static_cast<std::size_t>(after - tin_.keys.begin())});
    }
    std::sort(made.begin(), made.end(), [](const Made& a, const Made& b) {
        return a.before != b.before ? a.before < b.before : precedes_on_curve(a.key, b.key);
    });
    std::vector<VertexId> new_ids(count);
    std::size_t end = old_count_;  // of the old vertices that are yet to be moved
    for (std::size_t i = made.size(); i > 0; --i) {
        const Made& vertex = made[i - 1];
        for (; end > vertex.before; --end) {
            const std::size_t to = end - 1 + i;
            tin_.keys[to] = tin_.keys[end - 1];
            tin_.z[to] = tin_.z[end - 1];
            tin_.sample[to] = tin_.sample[end - 1];
            new_ids[end - 1] = {static_cast<std::uint32_t>(to)};
        }
        const std::size_t to = end + i - 1;
        tin_.keys[to] = vertex.key;
        tin_.z[to] = vertex.z;
        tin_.sample[to] = vertex.sample;
        new_ids[vertex.was] = {static_cast<std::uint32_t>(to)};
    }
    for (std::size_t v = 0; v < end; ++v) {
        new_ids[v] = {static_cast<std::uint32_t>(v)};
    }
    return new_ids;
}

void SteinerInserter::finish() {
    const std::size_t count = tin_.vertex_count();
    if (count == old_count_) {
        return;
    }
    // The chain of vertices along each edge of a line.
    struct OnEdge {
        std::uint32_t line_edge;
        double way;
        VertexId vertex;
        auto operator<=>(const OnEdge&) const = default;
    };
    std::vector<OnEdge> chains;
    for (std::size_t v = old_count_; v < count; ++v) {
        const std::uint32_t line_edge = line_edge_[v - old_count_];
        if (line_edge != kFree) {
            const auto [a, b] = line_edges_[line_edge];
            const VertexId vertex{static_cast<std::uint32_t>(v)};
            chains.push_back({line_edge, inner_product(tin_.key(vertex), tin_.key(a), tin_.key(b)), vertex});
        }
    }
    std::sort(chains.begin(), chains.end());

    const std::vector<VertexId> new_ids = sort_in();
    renumber_vertices(tin_.mesh, new_ids);

    std::vector<LineTrace> traces;
    traces.reserve(tin_.traces.size() + chains.size());
    const auto add = [&](VertexId a, VertexId b, const LineTrace& whole) {
        const auto [first, second] = std::minmax(new_ids[a.value], new_ids[b.value]);
        traces.push_back({first, second, whole.line, whole.runs});
    };
    auto on_edge = chains.begin();
    for (std::size_t i = 0, line_edge = 0; i < tin_.traces.size(); ++line_edge) {
        const auto [a, b] = line_edges_[line_edge];
        const auto chain_end = std::find_if(on_edge, chains.end(), [line_edge](const OnEdge& vertex) {
            return vertex.line_edge != line_edge;
        });
        for (; i < tin_.traces.size() && tin_.traces[i].a == a && tin_.traces[i].b == b; ++i) {
            VertexId from = a;
            for (auto vertex = on_edge; vertex != chain_end; ++vertex) {
                add(from, vertex->vertex, tin_.traces[i]);
                from = vertex->vertex;
            }
            add(from, b, tin_.traces[i]);
        }
        on_edge = chain_end;
    }
    std::sort(traces.begin(), traces.end());
    tin_.traces = std::move(traces);
}

}  // namespace tinwright
