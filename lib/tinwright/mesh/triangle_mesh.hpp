#ifndef TINWRIGHT_MESH_TRIANGLE_MESH_HPP
#define TINWRIGHT_MESH_TRIANGLE_MESH_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/handles.hpp"

namespace tinwright {

/// Connectivity of triangles; knows no position.
///
/// Faces are records of three corners in counter-clockwise order and the opposite half-edge of each of
/// their half-edges. Every border edge has a ghost face behind it, whose corner 2 is the ghost vertex,
/// so that a half-edge always has a twin and no walk needs a special case. A face inside the hull that is
/// not terrain (a void, a trimmed needle) stays in the mesh and is marked outside.
///
/// Invariants (audited by `check_mesh`):
///   M1  twin(twin(h)) == h, and twin(h) belongs to another face
///   M2  origin(twin(h)) == destination(h), destination(twin(h)) == origin(h)
///   M3  the three corners of a face are distinct and below vertex_count(), or the ghost vertex
///   M4  the ghost vertex stands at corner 2 only
///   M5  an edge is constrained in both of its faces or in neither
///   M6  marks have no bit beyond the four known ones, and scratch is zero
///   M7  no vertex has two edges to the same vertex in one turn around it
///   M8  every vertex that is a corner of a face has all its faces in as many closed turns as `check_mesh`
///       is told to allow (one for a triangulation of samples)
class TriangleMesh {
  public:
    /// 32 bytes: half a cache line. Cleared only when made with braces.
    struct Face {
        std::array<VertexId, 3> vertex;
        std::uint32_t marks;
        std::array<HalfEdgeId, 3> twin;
        std::uint32_t scratch;  ///< zero but while `mesh_edit.hpp` is at work
    };

    using Faces = LargeVector<Face>;

    TriangleMesh() = default;
    TriangleMesh(std::size_t vertex_count, Faces faces)
        : faces_(std::move(faces)), vertex_count_(vertex_count) {}

    [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
    /// Number of face slots, ghosts included; FaceId runs from 0 to this.
    [[nodiscard]] std::size_t slot_count() const { return faces_.size(); }

    [[nodiscard]] const Face& face(FaceId f) const { return faces_[f.value]; }
    [[nodiscard]] VertexId vertex(FaceId f, unsigned corner) const { return faces_[f.value].vertex[corner]; }
    [[nodiscard]] bool is_ghost(FaceId f) const { return faces_[f.value].vertex[2] == kGhostVertex; }
    /// Whether the face is part of the surface: neither ghost nor marked outside.
    [[nodiscard]] bool is_terrain(FaceId f) const {
        return !is_ghost(f) && (faces_[f.value].marks & kOutsideMark) == 0;
    }

    [[nodiscard]] HalfEdgeId twin(HalfEdgeId h) const { return faces_[h.value >> 2U].twin[h.value & 3U]; }
    [[nodiscard]] VertexId origin(HalfEdgeId h) const { return faces_[h.value >> 2U].vertex[h.value & 3U]; }
    [[nodiscard]] VertexId destination(HalfEdgeId h) const { return origin(next(h)); }
    [[nodiscard]] bool is_constrained(HalfEdgeId h) const {
        return (faces_[h.value >> 2U].marks >> (h.value & 3U) & 1U) != 0;
    }
    /// Whether `h` belongs to a terrain face and its twin does not.
    [[nodiscard]] bool is_border(HalfEdgeId h) const {
        return is_terrain(face_of(h)) && !is_terrain(face_of(twin(h)));
    }

    /// Marks both half-edges of an edge.
    void set_constrained(HalfEdgeId h, bool constrained);
    /// Marks a face as terrain or not; a ghost face never is.
    void set_terrain(FaceId f, bool terrain);

    /// Number of terrain faces. O(slots).
    [[nodiscard]] std::size_t count_terrain() const;

    friend class MeshEditor;  // behind mesh_edit.hpp

  private:
    static constexpr std::uint32_t kOutsideMark = 8;  // bits 0..2: half-edge i is constrained

    Faces faces_;
    std::size_t vertex_count_ = 0;
};

/// Builds a mesh from corner triples in counter-clockwise order, `corners.size() == 3 * faces`; border
/// edges get ghost faces. Faces that touch only at a vertex make that vertex turn more than once (M8).
/// Throws InputError, with the face's number in its text, when an edge is used twice in one direction or a
/// corner is out of range or repeated. O(f log f).
TriangleMesh make_mesh(std::size_t vertex_count, std::span<const VertexId> corners);

}  // namespace tinwright

#endif
