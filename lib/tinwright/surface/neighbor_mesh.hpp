#ifndef TINWRIGHT_SURFACE_NEIGHBOR_MESH_HPP
#define TINWRIGHT_SURFACE_NEIGHBOR_MESH_HPP

#include <cstdint>
#include <memory>

#include "tinwright/geometry/predicates_internal.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/face_circles.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// A place as natural neighbours need it, in terms of the `NeighborMesh`.
struct NeighborPlace {
    enum class Kind : std::uint8_t {
        Face,   ///< in the closure of the face of `edge`, not at a vertex, nor on a closed edge
        Edge,   ///< on the closed half-edge `edge`, as its face sees it; or outside the terrain by a rounding
        Vertex  ///< at the origin of `edge`, between the same closed edges as `edge`'s face
    };
    Kind kind = Kind::Face;
    HalfEdgeId edge{};
};

/// The Delaunay triangulation of a terrain constrained at its *closed* edges only: those of the border and
/// the sharp ones. It is unique up to vertices on one circle, and natural neighbours are the same for all of
/// these.
///
/// A TIN that is such a triangulation is used as it is. Another (optimised, or with smooth constrained edges)
/// is copied, and the copy's edges flipped until it is one [lawson1972]. Flips leave every terrain face slot
/// within the same closed edges, so a face of the TIN is where the search in the copy begins.
class NeighborMesh {
  public:
    /// `tin` and its lattice must outlive it. O(n), and O(1) a flip, in practice a few a vertex; parallel
    /// inside the caller's task arena but for flips. Memory: 64 bytes a vertex, 1 byte a face with sharp
    /// edges; where a copy is needed, that of a TIN.
    NeighborMesh(const Tin& tin, const SharpEdges& sharp, const QueryLattice& lattice);

    /// The TIN or the copy, with all closed interior edges constrained; same vertices.
    [[nodiscard]] const Tin& tin() const { return copy_ ? *copy_ : tin_; }
    [[nodiscard]] bool is_copy() const { return copy_ != nullptr; }
    /// The sharp edges of `tin()`.
    [[nodiscard]] const SharpEdges& sharp() const { return copy_ ? copy_sharp_ : sharp_; }
    /// The circles of its faces.
    [[nodiscard]] const FaceCircles& circles() const { return *circles_; }
    /// Whether no cavity goes on through a terrain face's half-edge.
    [[nodiscard]] bool is_closed(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin().mesh;
        return !mesh.is_terrain(face_of(mesh.twin(h))) || sharp().is_sharp(h);
    }

    /// `place`: of the TIN given. O(1) for a TIN used as it is.
    [[nodiscard]] NeighborPlace find(const SurfacePlace& place) const {
        if (copy_ || !is_clearly_inside(place)) {
            return find_exactly(place);
        }
        return {NeighborPlace::Kind::Face, half_edge(place.face, smallest_corner(tin_.mesh, place.face))};
    }

  private:
    [[nodiscard]] bool is_clearly_inside(const SurfacePlace& place) const {
        const auto corner = [&](unsigned i) {
            return internal::localize(lattice_.scaled(tin_.key(tin_.mesh.vertex(place.face, i))), place.at);
        };
        const internal::LocalKey a = corner(0);
        const internal::LocalKey b = corner(1);
        const internal::LocalKey c = corner(2);
        return internal::orient2d_local(a, b) == 1 && internal::orient2d_local(b, c) == 1 &&
               internal::orient2d_local(c, a) == 1;
    }
    [[nodiscard]] NeighborPlace find_exactly(const SurfacePlace& place) const;
    [[nodiscard]] NeighborPlace in_copy(const NeighborPlace& place, Key2 at) const;

    const Tin& tin_;
    const QueryLattice& lattice_;
    SharpEdges sharp_;  // of tin_
    std::unique_ptr<const Tin> copy_;
    SharpEdges copy_sharp_;
    std::unique_ptr<const FaceCircles> circles_;  // of tin()
};

}  // namespace tinwright

#endif
