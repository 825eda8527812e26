#ifndef TINWRIGHT_MESH_MESH_WALK_HPP
#define TINWRIGHT_MESH_MESH_WALK_HPP

#include <cstdint>
#include <optional>
#include <vector>

#include "tinwright/mesh/triangle_mesh.hpp"

/// Ways through a mesh from one half-edge to the next.
namespace tinwright {

/// The corner of a face whose vertex has the smallest id: where to begin so that nothing depends on where the
/// face starts.
inline unsigned smallest_corner(const TriangleMesh& mesh, FaceId f) {
    const auto& v = mesh.face(f).vertex;
    const unsigned first = v[1] < v[0] ? 1 : 0;
    return v[2] < v[first] ? 2 : first;
}

/// The next half-edge from the same origin, counter-clockwise.
inline HalfEdgeId next_around(const TriangleMesh& mesh, HalfEdgeId h) { return mesh.twin(previous(h)); }

/// For each vertex a half-edge that starts there, of a face that is no ghost where the vertex has one.
/// Vertices without faces get half-edge 3, which is none. O(slots).
std::vector<HalfEdgeId> find_starts(const TriangleMesh& mesh);
inline constexpr HalfEdgeId kNoHalfEdge{3};

/// The number of each terrain face among all of them, by slots, as TIN files number them; kNoNumber for other
/// slots. O(slots).
std::vector<std::uint32_t> number_terrain(const TriangleMesh& mesh);
inline constexpr std::uint32_t kNoNumber = 0xFFFFFFFFU;

/// The half-edge from the origin of `start` to `to`. O(degree of the origin).
std::optional<HalfEdgeId> find_half_edge(const TriangleMesh& mesh, HalfEdgeId start, VertexId to);

}  // namespace tinwright

#endif
