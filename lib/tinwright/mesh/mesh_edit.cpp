#include "tinwright/mesh/mesh_edit.hpp"

#include <cassert>

#include <tbb/parallel_for.h>

namespace tinwright {

/// The one who may write into face records.
class MeshEditor {
  public:
    explicit MeshEditor(TriangleMesh& mesh) : mesh_(mesh) {}

    void flip(HalfEdgeId h);
    void refill(std::span<const FaceId> slots, std::span<const CavityFace> faces);
    VertexId split_edge(HalfEdgeId h);
    VertexId split_face(FaceId f);
    void renumber(std::span<const VertexId> new_ids);

  private:
    using Face = TriangleMesh::Face;

    /// A half-edge outside the place under repair, and whether its edge is constrained.
    struct Outer {
        HalfEdgeId twin;
        bool is_constrained;
    };

    [[nodiscard]] Face& record(FaceId f) { return mesh_.faces_[f.value]; }
    [[nodiscard]] Outer outer(HalfEdgeId h) const { return {mesh_.twin(h), mesh_.is_constrained(h)}; }
    void link(HalfEdgeId a, HalfEdgeId b) {
        record(face_of(a)).twin[corner_of(a)] = b;
        record(face_of(b)).twin[corner_of(b)] = a;
    }
    void attach(HalfEdgeId h, Outer outer) {
        link(h, outer.twin);
        record(face_of(h)).marks |= static_cast<std::uint32_t>(outer.is_constrained) << corner_of(h);
    }
    /// A new slot, terrain or not as `like` is.
    FaceId add_face(VertexId a, VertexId b, VertexId c, FaceId like) {
        const FaceId made{static_cast<std::uint32_t>(mesh_.faces_.size())};
        Face face{};
        face.vertex = {a, b, c};
        face.marks = record(like).marks & TriangleMesh::kOutsideMark;
        mesh_.faces_.push_back(face);
        return made;
    }
    /// What is outside `h` goes outside `to`; `h` is left without a mark.
    void move_outer(HalfEdgeId h, HalfEdgeId to) {
        const Outer was = outer(h);
        record(face_of(h)).marks &= ~(1U << corner_of(h));
        attach(to, was);
    }
    static HalfEdgeId resolve(CavityFace::Across across, std::span<const FaceId> slots) {
        return half_edge(slots[across.face()], across.edge());
    }

    TriangleMesh& mesh_;
};

void MeshEditor::flip(HalfEdgeId h) {
    const HalfEdgeId t = mesh_.twin(h);
    assert(!mesh_.is_constrained(h) && mesh_.is_terrain(face_of(h)) && mesh_.is_terrain(face_of(t)));
    // The quadrilateral is a d b c, counter-clockwise.
    const VertexId a = mesh_.origin(h);
    const VertexId b = mesh_.origin(t);
    const VertexId c = mesh_.origin(previous(h));
    const VertexId d = mesh_.origin(previous(t));
    const Outer bc = outer(next(h));
    const Outer ca = outer(previous(h));
    const Outer ad = outer(next(t));
    const Outer db = outer(previous(t));

    const auto set_corners = [this](HalfEdgeId first, VertexId u, VertexId v, VertexId w) {
        Face& face = record(face_of(first));
        face.vertex[corner_of(first)] = u;
        face.vertex[corner_of(next(first))] = v;
        face.vertex[corner_of(previous(first))] = w;
        face.marks = 0;
    };
    set_corners(h, d, c, a);
    set_corners(t, c, d, b);
    attach(next(h), ca);
    attach(previous(h), ad);
    attach(next(t), db);
    attach(previous(t), bc);
}

void MeshEditor::refill(std::span<const FaceId> slots, std::span<const CavityFace> faces) {
    assert(slots.size() == faces.size());
    struct RimEdge {
        HalfEdgeId old;
        HalfEdgeId now;
        Outer outer;
    };
    thread_local std::vector<RimEdge> rim;  // kept for its memory; empty between calls
    rim.clear();
    rim.reserve(3 * slots.size());  // what may throw comes before any change
    for (const FaceId slot : slots) {
        record(slot).scratch = 1;
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (unsigned edge = 0; edge < 3; ++edge) {
            const CavityFace::Across across = faces[i].across[edge];
            if (across.is_rim()) {
                rim.push_back({across.old(), half_edge(slots[i], edge), outer(across.old())});
            }
        }
    }
    // Behind a crack lies the cavity itself: the half-edge that takes the place of the one once there.
    for (RimEdge& edge : rim) {
        if (record(face_of(edge.outer.twin)).scratch != 0) {
            for (const RimEdge& other : rim) {
                if (other.old == mesh_.twin(edge.old)) {
                    edge.outer.twin = other.now;
                    break;
                }
            }
        }
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        Face& face = record(slots[i]);
        face.vertex = faces[i].vertex;
        face.marks = 0;
        face.scratch = 0;
        for (unsigned edge = 0; edge < 3; ++edge) {
            const CavityFace::Across across = faces[i].across[edge];
            if (!across.is_rim()) {
                face.twin[edge] = resolve(across, slots);
            }
        }
    }
    for (const RimEdge& edge : rim) {
        attach(edge.now, edge.outer);
    }
    rim.clear();
}

VertexId MeshEditor::split_edge(HalfEdgeId h) {
    const HalfEdgeId t = mesh_.twin(h);
    const VertexId a = mesh_.origin(h);
    const VertexId b = mesh_.origin(t);
    const bool is_constrained = mesh_.is_constrained(h);
    const VertexId m{static_cast<std::uint32_t>(mesh_.vertex_count_++)};
    // The halves at b of the face of h, and at a of the face of t. A ghost stays at corner 2.
    const FaceId at_b = add_face(m, b, mesh_.origin(previous(h)), face_of(h));
    const FaceId at_a = add_face(m, a, mesh_.origin(previous(t)), face_of(t));
    move_outer(next(h), half_edge(at_b, 1));
    move_outer(next(t), half_edge(at_a, 1));
    record(face_of(h)).vertex[corner_of(next(h))] = m;
    record(face_of(t)).vertex[corner_of(next(t))] = m;
    link(next(h), half_edge(at_b, 2));
    link(next(t), half_edge(at_a, 2));
    attach(half_edge(at_a, 0), {h, is_constrained});
    attach(half_edge(at_b, 0), {t, is_constrained});
    return m;
}

VertexId MeshEditor::split_face(FaceId f) {
    const std::array<VertexId, 3> corner = record(f).vertex;
    assert(!mesh_.is_ghost(f));
    const VertexId m{static_cast<std::uint32_t>(mesh_.vertex_count_++)};
    const FaceId second = add_face(corner[1], corner[2], m, f);
    const FaceId third = add_face(corner[2], corner[0], m, f);
    move_outer(half_edge(f, 1), half_edge(second, 0));
    move_outer(half_edge(f, 2), half_edge(third, 0));
    record(f).vertex[2] = m;
    link(half_edge(f, 1), half_edge(second, 2));
    link(half_edge(second, 1), half_edge(third, 2));
    link(half_edge(third, 1), half_edge(f, 2));
    return m;
}

void MeshEditor::renumber(std::span<const VertexId> new_ids) {
    tbb::parallel_for(std::size_t{0}, mesh_.faces_.size(), [&](std::size_t f) {
        for (VertexId& v : mesh_.faces_[f].vertex) {
            v = v == kGhostVertex ? v : new_ids[v.value];
        }
    });
}

void flip_edge(TriangleMesh& mesh, HalfEdgeId h) { MeshEditor(mesh).flip(h); }

VertexId split_edge(TriangleMesh& mesh, HalfEdgeId h) { return MeshEditor(mesh).split_edge(h); }

VertexId split_face(TriangleMesh& mesh, FaceId f) { return MeshEditor(mesh).split_face(f); }

void renumber_vertices(TriangleMesh& mesh, std::span<const VertexId> new_ids) {
    MeshEditor(mesh).renumber(new_ids);
}

void refill_cavity(TriangleMesh& mesh, std::span<const FaceId> slots, std::span<const CavityFace> faces) {
    MeshEditor(mesh).refill(slots, faces);
}

}  // namespace tinwright
