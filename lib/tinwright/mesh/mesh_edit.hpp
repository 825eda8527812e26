#ifndef TINWRIGHT_MESH_MESH_EDIT_HPP
#define TINWRIGHT_MESH_MESH_EDIT_HPP

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/mesh/triangle_mesh.hpp"

/// The changes a mesh can undergo.
namespace tinwright {

/// Replaces the edge of `h` by the other diagonal of its two faces' quadrilateral, which must be strictly
/// convex; the edge must not be constrained, and both faces must be terrain. Afterwards `h` is the new edge,
/// in the same face. O(1).
void flip_edge(TriangleMesh& mesh, HalfEdgeId h);

/// Splits the edge of `h`, between real vertices, by a new vertex, which becomes the last; its two faces,
/// ghosts or not, become four. Both parts are constrained if the edge was, the two new edges are not; new
/// faces are terrain if the halved one was. Afterwards `h` runs from its origin to the new vertex. Amortised
/// O(1).
VertexId split_edge(TriangleMesh& mesh, HalfEdgeId h);

/// Splits a face that is no ghost into three by a new vertex, which becomes the last. Amortised O(1).
VertexId split_face(TriangleMesh& mesh, FaceId f);

/// Gives every vertex another number: v becomes new_ids[v]. O(slots), parallel inside the caller's task
/// arena.
void renumber_vertices(TriangleMesh& mesh, std::span<const VertexId> new_ids);

/// A face that is to come into a cavity, with what lies across each of its edges.
struct CavityFace {
    /// Either a half-edge of the cavity's rim as it was, or a half-edge of another new face.
    class Across {
      public:
        static constexpr Across rim(HalfEdgeId old) { return Across(kRim | old.value); }
        static constexpr Across inner(std::uint32_t face, unsigned edge) {
            return Across(4ULL * face + edge);
        }
        constexpr Across() = default;  ///< not known yet
        [[nodiscard]] constexpr bool is_known() const { return code_ != kUnknown; }
        [[nodiscard]] constexpr bool is_rim() const { return (code_ & kRim) != 0; }
        /// The half-edge, within the cavity, that the new half-edge takes the place of.
        [[nodiscard]] constexpr HalfEdgeId old() const { return {static_cast<std::uint32_t>(code_)}; }
        [[nodiscard]] constexpr std::uint32_t face() const { return static_cast<std::uint32_t>(code_ >> 2U); }
        [[nodiscard]] constexpr unsigned edge() const { return static_cast<unsigned>(code_ & 3U); }

      private:
        static constexpr std::uint64_t kRim = 1ULL << 63U;
        static constexpr std::uint64_t kUnknown = 1ULL << 62U;
        constexpr explicit Across(std::uint64_t code) : code_(code) {}
        std::uint64_t code_ = kUnknown;
    };

    std::array<VertexId, 3> vertex{};  ///< counter-clockwise
    std::array<Across, 3> across;      ///< of the edge from corner i to corner i + 1
};

/// Replaces the faces of a cavity, a simply connected set of terrain faces, by as many others within the same
/// rim. An edge that the cavity touches from both sides without crossing it (a crack, [tan1993, Fig. 3.1])
/// is twice in the rim. `slots[i]` takes `faces[i]`. Constrained rim edges stay so. If memory runs out,
/// nothing has changed. O(slots), once more for each crack.
void refill_cavity(TriangleMesh& mesh, std::span<const FaceId> slots, std::span<const CavityFace> faces);

}  // namespace tinwright

#endif
