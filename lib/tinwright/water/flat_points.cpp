#include "tinwright/water/flat_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright::internal {

namespace {

/// Middles of edges need one bit more than their ends, middles of faces any number: these are a quarter of a
/// thousandth of a step off at most.
constexpr int kBits = 10;

void refine(Tin& tin) {
    double largest = 0;
    for (const Key2 key : tin.keys) {
        largest = std::max({largest, key.x, key.y});
    }
    const int bits = std::min(kBits, tin.lattice.refinement_room(largest));
    tin.lattice = tin.lattice.refined(bits);
    for (Key2& key : tin.keys) {
        key = {std::ldexp(key.x, bits), std::ldexp(key.y, bits)};
    }
}

template <class Value>
void arrange(LargeVector<Value>& values, std::span<const std::uint32_t> order) {
    LargeVector<Value> arranged;
    arranged.reserve(values.size());
    for (const std::uint32_t i : order) {
        arranged.push_back(values[i]);
    }
    values = std::move(arranged);
}

/// Returns everybody's new number. Old vertices keep their order among themselves, so traces stay sorted.
std::vector<VertexId> sort_vertices(Tin& tin) {
    const std::vector<std::uint32_t> order = sort_along_curve(tin.keys);
    std::vector<VertexId> new_ids(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        new_ids[order[i]] = {i};
    }
    arrange(tin.keys, order);
    arrange(tin.z, order);
    arrange(tin.sample, order);
    renumber_vertices(tin.mesh, new_ids);
    for (LineTrace& trace : tin.traces) {
        trace.a = new_ids[trace.a.value];
        trace.b = new_ids[trace.b.value];
    }
    return new_ids;
}

class PointInserter {
  public:
    explicit PointInserter(Tin& tin) : tin_(tin), start_(find_starts(tin.mesh)) {}

    /// Whether it was inserted. Middles of faces come before those of the same faces' edges.
    bool insert(const AxisNode& node, double z) {
        return node.is_on_edge() ? insert_on_edge(node, z) : insert_in_face(node, z);
    }

  private:
    [[nodiscard]] bool turns_left(VertexId a, VertexId b, Key2 c) const {
        return orient2d(tin_.key(a), tin_.key(b), c) > 0;
    }

    bool insert_in_face(const AxisNode& node, double z) {
        const auto middle = [](double a, double b, double c) {
            return Lattice::nearest_integer((a + b + c) / 3);
        };
        const auto [a, b, c] = std::array{node.a, node.b, node.c};
        const Key2 key = {middle(tin_.key(a).x, tin_.key(b).x, tin_.key(c).x),
                          middle(tin_.key(a).y, tin_.key(b).y, tin_.key(c).y)};
        if (!turns_left(a, b, key) || !turns_left(b, c, key) || !turns_left(c, a, key)) {
            return false;
        }
        add(key, z);
        split_face(tin_.mesh, node.face);
        take_starts(node.face);
        take_last_starts();
        return true;
    }

    bool insert_on_edge(const AxisNode& node, double z) {
        const std::optional<HalfEdgeId> h = find_half_edge(tin_.mesh, start_[node.a.value], node.b);
        const Key2 a = tin_.key(node.a);
        const Key2 b = tin_.key(node.b);
        const Key2 key = {Lattice::nearest_integer((a.x + b.x) / 2),
                          Lattice::nearest_integer((a.y + b.y) / 2)};
        if (!h || !keeps_faces(*h, key)) {
            return false;
        }
        const FaceId across = face_of(tin_.mesh.twin(*h));
        add(key, z);
        split_edge(tin_.mesh, *h);
        take_starts(face_of(*h));
        take_starts(across);
        take_last_starts();
        return true;
    }

    [[nodiscard]] bool keeps_faces(HalfEdgeId h, Key2 key) const {
        const TriangleMesh& mesh = tin_.mesh;
        const std::array sides{h, mesh.twin(h)};
        return std::all_of(sides.begin(), sides.end(), [&](HalfEdgeId side) {
            const VertexId apex = mesh.origin(previous(side));
            return turns_left(apex, mesh.origin(side), key) && turns_left(mesh.destination(side), apex, key);
        });
    }

    void add(Key2 key, double z) {
        tin_.keys.push_back(key);
        tin_.z.push_back(z);
        tin_.sample.push_back(Tin::kInserted);
        start_.push_back(kNoHalfEdge);
    }

    void take_starts(FaceId f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            start_[tin_.mesh.vertex(f, corner).value] = half_edge(f, corner);
        }
    }

    void take_last_starts() {
        const auto slots = static_cast<std::uint32_t>(tin_.mesh.slot_count());
        take_starts({slots - 2});
        take_starts({slots - 1});
    }

    Tin& tin_;
    std::vector<HalfEdgeId> start_;
};

}  // namespace

InsertedPoints insert_axis_points(Tin& tin, const FlatAxes& axes, std::span<const double> z) {
    const auto has_point = [&](std::size_t n) {
        return std::isfinite(z[n]) && z[n] != tin.z[axes.nodes[n].a.value];
    };
    std::vector<std::size_t> wanted;
    for (const bool is_on_edge : {false, true}) {
        for (std::size_t n = 0; n < z.size(); ++n) {
            if (axes.nodes[n].is_on_edge() == is_on_edge && has_point(n)) {
                wanted.push_back(n);
            }
        }
    }
    if (wanted.empty()) {
        return {};
    }
    refine(tin);
    PointInserter inserter(tin);
    InsertedPoints result;
    std::vector<VertexId> vertex(z.size(), kGhostVertex);  // of each node
    for (const std::size_t n : wanted) {
        if (inserter.insert(axes.nodes[n], z[n])) {
            vertex[n] = {static_cast<std::uint32_t>(tin.vertex_count() - 1)};
            ++result.count;
        }
    }
    const std::vector<VertexId> new_ids = sort_vertices(tin);
    const auto keep = [&](VertexId a, VertexId b) {
        if (a != kGhostVertex && b != kGhostVertex) {
            result.edges.emplace_back(std::minmax(new_ids[a.value], new_ids[b.value]));
        }
    };
    for (const AxisLink& link : axes.links) {
        keep(vertex[link.from], vertex[link.to]);
    }
    for (std::size_t n = 0; n < vertex.size(); ++n) {
        keep(vertex[n], axes.nodes[n].outlet);
    }
    std::sort(result.edges.begin(), result.edges.end());
    return result;
}

namespace {

/// Flips edges of terrain that are not Delaunay, as long as `may_flip(h)`.
template <class MayFlip>
void flip_to_delaunay(Tin& tin, const MayFlip& may_flip) {
    TriangleMesh& mesh = tin.mesh;
    std::vector<HalfEdgeId> pending;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            pending.push_back(half_edge({f}, corner));
        }
        while (!pending.empty()) {
            const HalfEdgeId h = pending.back();
            const HalfEdgeId t = mesh.twin(h);
            pending.pop_back();
            if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(h)) || !mesh.is_terrain(face_of(t)) ||
                incircle_perturbed(tin.key(mesh.origin(h)), tin.key(mesh.destination(h)),
                                   tin.key(mesh.origin(previous(h))),
                                   tin.key(mesh.origin(previous(t)))) <= 0 ||
                !may_flip(h)) {
                continue;
            }
            flip_edge(mesh, h);
            for (const HalfEdgeId side : {h, mesh.twin(h)}) {
                pending.push_back(next(side));
                pending.push_back(previous(side));
            }
        }
    }
}

}  // namespace

void restore_delaunay(Tin& tin) {
    flip_to_delaunay(tin, [](HalfEdgeId) { return true; });
}

void restore_delaunay_around(Tin& tin, std::span<const AxisEdge> kept) {
    flip_to_delaunay(tin, [&tin, kept](HalfEdgeId h) {
        const TriangleMesh& mesh = tin.mesh;
        const VertexId a = mesh.origin(h);
        const VertexId b = mesh.destination(h);
        const double c = tin.z[mesh.origin(previous(h)).value];
        const double d = tin.z[mesh.origin(previous(mesh.twin(h))).value];
        const bool makes_flat = c == d && (tin.z[a.value] == c || tin.z[b.value] == c);
        return !makes_flat && !std::binary_search(kept.begin(), kept.end(), AxisEdge(std::minmax(a, b)));
    });
}

}  // namespace tinwright::internal
