#include "tinwright/surface/neighbor_mesh.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

constexpr int kWalkLimit = 64;  // faces after which a walk is given up

bool is_closed(const TriangleMesh& mesh, const SharpEdges& sharp, HalfEdgeId h) {
    return !mesh.is_terrain(face_of(mesh.twin(h))) || sharp.is_sharp(h);
}

/// The vertex of h's face that is not on h.
VertexId apex(const TriangleMesh& mesh, HalfEdgeId h) { return mesh.origin(previous(h)); }

bool is_delaunay(const Tin& tin, const SharpEdges& sharp, const FaceCircles& circles,
                 const QueryLattice& lattice) {
    const TriangleMesh& mesh = tin.mesh;
    const auto is_right = [&](HalfEdgeId h) {
        const HalfEdgeId other = mesh.twin(h);
        return other < h || is_closed(mesh, sharp, h) ||
               !circles.is_inside(face_of(h), lattice.scaled(tin.key(apex(mesh, other))));
    };
    using Slots = tbb::blocked_range<std::uint32_t>;
    return tbb::parallel_reduce(
        Slots(0, static_cast<std::uint32_t>(mesh.slot_count()), 4096), true,
        [&](const Slots& slots, bool right) {
            for (std::uint32_t f = slots.begin(); f < slots.end() && right; ++f) {
                right = !mesh.is_terrain({f}) || (is_right(half_edge({f}, 0)) &&
                                                  is_right(half_edge({f}, 1)) && is_right(half_edge({f}, 2)));
            }
            return right;
        },
        [](bool a, bool b) { return a && b; });
}

/// Leaves the sharp edges constrained, and of the rest only those of the border; lists the half-edges between
/// terrain faces that are not sharp.
std::vector<HalfEdgeId> free_edges(TriangleMesh& mesh, const SharpEdges& sharp) {
    std::vector<HalfEdgeId> free;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (h < mesh.twin(h) && !is_closed(mesh, sharp, h)) {
                mesh.set_constrained(h, false);
                free.push_back(h);
            }
        }
    }
    return free;
}

/// Flips until every edge between terrain faces is constrained or locally Delaunay, ties broken the canonical
/// way: the result does not depend on the faces that there were.
void make_delaunay_inside(Tin& tin, std::vector<HalfEdgeId> suspects) {
    TriangleMesh& mesh = tin.mesh;
    while (!suspects.empty()) {
        const HalfEdgeId h = suspects.back();
        suspects.pop_back();
        if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(mesh.twin(h))) ||
            incircle_perturbed(tin.key(mesh.origin(h)), tin.key(mesh.destination(h)), tin.key(apex(mesh, h)),
                               tin.key(apex(mesh, mesh.twin(h)))) < 0) {
            continue;
        }
        flip_edge(mesh, h);
        // The flip moved edges from one half-edge of the two faces to another: all four are looked at, so
        // that none that waited is lost.
        const HalfEdgeId other = mesh.twin(h);
        for (const HalfEdgeId side : {next(h), previous(h), next(other), previous(other)}) {
            suspects.push_back(side);
        }
    }
}

std::array<int, 3> sides(const Tin& tin, const QueryLattice& lattice, FaceId f, Key2 at) {
    std::array<Key2, 3> key{};
    for (unsigned i = 0; i < 3; ++i) {
        key[i] = lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
    }
    return {orient2d(key[0], key[1], at), orient2d(key[1], key[2], at), orient2d(key[2], key[0], at)};
}

/// What a place is at that lies in the closure of a face, given its sides of the face's edges.
NeighborPlace settle(const TriangleMesh& mesh, const SharpEdges& sharp, FaceId f,
                     const std::array<int, 3>& side) {
    for (unsigned i = 0; i < 3; ++i) {
        if (side[i] == 0 && side[previous_corner(i)] == 0) {
            return {NeighborPlace::Kind::Vertex, half_edge(f, i)};
        }
    }
    for (unsigned i = 0; i < 3; ++i) {
        if (side[i] == 0 && is_closed(mesh, sharp, half_edge(f, i))) {
            return {NeighborPlace::Kind::Edge, half_edge(f, i)};
        }
    }
    return {NeighborPlace::Kind::Face, half_edge(f, smallest_corner(mesh, f))};
}

/// From a face to the one whose closure holds the place, through no border; one whose edges bar the way gives
/// that edge. A place off its face by a rounding is some needles away at most.
NeighborPlace walk(const Tin& tin, const SharpEdges& sharp, const QueryLattice& lattice,
                   const SurfacePlace& place) {
    FaceId f = place.face;
    for (int steps = 0;; ++steps) {
        const std::array<int, 3> side = sides(tin, lattice, f, place.at);
        std::optional<HalfEdgeId> barrier;
        std::optional<HalfEdgeId> way;
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge(f, i);
            if (side[i] < 0) {
                (tin.mesh.is_border(h) || steps == kWalkLimit ? barrier : way) = h;
            }
        }
        if (way) {
            f = face_of(tin.mesh.twin(*way));
        } else {
            return barrier ? NeighborPlace{NeighborPlace::Kind::Edge, *barrier}
                           : settle(tin.mesh, sharp, f, side);
        }
    }
}

/// Around the origin of h, clockwise, to the closed edge that ends the faces h's is one of; empty if there is
/// none.
std::optional<HalfEdgeId> find_right_end(const TriangleMesh& mesh, const SharpEdges& sharp, HalfEdgeId h) {
    HalfEdgeId around = h;
    while (!is_closed(mesh, sharp, around)) {
        around = next(mesh.twin(around));
        if (around == h) {
            return std::nullopt;
        }
    }
    return around;
}

/// The first terrain face for which `take` gives something, breadth first from `start` through edges that are
/// not closed. Such faces exist within the same closed edges.
template <class Take>
std::optional<NeighborPlace> search(const NeighborMesh& mesh, FaceId start, const Take& take) {
    std::vector<FaceId> queue{start};
    std::unordered_set<std::uint32_t> seen{start.value};
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const FaceId f = queue[i];
        if (const std::optional<NeighborPlace> taken = take(f)) {
            return taken;
        }
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(f, corner);
            const FaceId across = face_of(mesh.tin().mesh.twin(h));
            if (!mesh.is_closed(h) && seen.insert(across.value).second) {
                queue.push_back(across);
            }
        }
    }
    return std::nullopt;
}

std::optional<NeighborPlace> find_face(const NeighborMesh& mesh, FaceId start, Key2 at,
                                       const QueryLattice& lattice) {
    const Tin& tin = mesh.tin();
    const auto take = [&](FaceId f, const std::array<int, 3>& side) {
        return settle(tin.mesh, mesh.sharp(), f, side);
    };
    // Straight there as a rule; where a closed edge bars the way or the walk is long, by looking everywhere.
    FaceId f = start;
    for (int steps = 0; steps < kWalkLimit; ++steps) {
        const std::array<int, 3> side = sides(tin, lattice, f, at);
        unsigned behind = 0;
        while (behind < 3 && side[behind] >= 0) {
            ++behind;
        }
        if (behind == 3) {
            return take(f, side);
        }
        const HalfEdgeId way = half_edge(f, behind);
        if (mesh.is_closed(way)) {
            break;
        }
        f = face_of(tin.mesh.twin(way));
    }
    return search(mesh, start, [&](FaceId face) -> std::optional<NeighborPlace> {
        const std::array<int, 3> side = sides(tin, lattice, face, at);
        return *std::min_element(side.begin(), side.end()) < 0 ? std::nullopt
                                                               : std::optional(take(face, side));
    });
}

std::optional<NeighborPlace> find_edge(const NeighborMesh& mesh, FaceId start, NeighborPlace::Kind kind,
                                       VertexId from, std::optional<VertexId> to) {
    return search(mesh, start, [&](FaceId f) -> std::optional<NeighborPlace> {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(f, corner);
            if (mesh.tin().mesh.origin(h) == from && (!to || mesh.tin().mesh.destination(h) == *to)) {
                return NeighborPlace{kind, h};
            }
        }
        return std::nullopt;
    });
}

}  // namespace

NeighborMesh::NeighborMesh(const Tin& tin, const SharpEdges& sharp, const QueryLattice& lattice)
    : tin_(tin),
      lattice_(lattice),
      sharp_(sharp),
      circles_(std::make_unique<const FaceCircles>(tin, lattice)) {
    if (is_delaunay(tin, sharp, *circles_, lattice)) {
        return;
    }
    auto copy = std::make_unique<Tin>(tin);
    copy->traces.clear();
    make_delaunay_inside(*copy, free_edges(copy->mesh, sharp));
    copy_sharp_ = SharpEdges(*copy, {});  // constrained, and no line says why
    copy_ = std::move(copy);
    circles_ = std::make_unique<const FaceCircles>(*copy_, lattice);
}

NeighborPlace NeighborMesh::find_exactly(const SurfacePlace& place) const {
    const NeighborPlace here = walk(tin_, sharp_, lattice_, place);
    return copy_ ? in_copy(here, place.at) : here;
}

NeighborPlace NeighborMesh::in_copy(const NeighborPlace& place, Key2 at) const {
    const FaceId start = face_of(place.edge);
    const TriangleMesh& mesh = tin_.mesh;
    std::optional<NeighborPlace> found;
    switch (place.kind) {
        case NeighborPlace::Kind::Face:
            found = find_face(*this, start, at, lattice_);
            break;
        case NeighborPlace::Kind::Edge:
            found =
                find_edge(*this, start, place.kind, mesh.origin(place.edge), mesh.destination(place.edge));
            break;
        case NeighborPlace::Kind::Vertex: {
            const std::optional<HalfEdgeId> end = find_right_end(mesh, sharp_, place.edge);
            const VertexId at_vertex = mesh.origin(place.edge);
            found = find_edge(*this, start, place.kind, at_vertex,
                              end ? std::optional(mesh.destination(*end)) : std::nullopt);
            break;
        }
    }
    return found.value_or(place);
}

}  // namespace tinwright
