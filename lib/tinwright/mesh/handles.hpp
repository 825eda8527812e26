#ifndef TINWRIGHT_MESH_HANDLES_HPP
#define TINWRIGHT_MESH_HANDLES_HPP

#include <compare>
#include <cstdint>

namespace tinwright {

/// An index that knows what it counts. 32 bits: meshes hold up to 2^29 vertices. Zero when made with braces,
/// like an integer; arrays of them need not be cleared before they are filled.
template <class Tag>
struct Handle {
    std::uint32_t value;
    friend auto operator<=>(const Handle&, const Handle&) = default;
};

using VertexId = Handle<struct VertexTag>;
using FaceId = Handle<struct FaceTag>;
/// Half-edge 4f + i runs from corner i to corner i + 1 (mod 3) of face f; i = 3 is never used.
using HalfEdgeId = Handle<struct HalfEdgeTag>;

/// The vertex at infinity: corner 2 of every ghost face.
inline constexpr VertexId kGhostVertex{0xFFFFFFFFU};

constexpr HalfEdgeId half_edge(FaceId face, unsigned corner) { return {4 * face.value + corner}; }
constexpr FaceId face_of(HalfEdgeId h) { return {h.value >> 2U}; }
constexpr unsigned corner_of(HalfEdgeId h) { return h.value & 3U; }
constexpr unsigned next_corner(unsigned corner) { return (0x9U >> (2 * corner)) & 3U; }  // 0 1 2 -> 1 2 0
constexpr unsigned previous_corner(unsigned corner) {
    return (0x12U >> (2 * corner)) & 3U;
}  // 0 1 2 -> 2 0 1
constexpr HalfEdgeId next(HalfEdgeId h) { return {(h.value & ~3U) | next_corner(corner_of(h))}; }
constexpr HalfEdgeId previous(HalfEdgeId h) { return {(h.value & ~3U) | previous_corner(corner_of(h))}; }

}  // namespace tinwright

#endif
