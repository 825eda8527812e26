#ifndef TINWRIGHT_MESH_BORDER_HPP
#define TINWRIGHT_MESH_BORDER_HPP

#include <vector>

#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// The border half-edges (of terrain faces, with a twin that is not terrain), in the order of the slots
/// behind them. They are found from there: faces that are not terrain are few, and terrain faces need no look
/// at their neighbours. O(slots), parallel inside the caller's task arena.
std::vector<HalfEdgeId> find_border(const TriangleMesh& mesh);

/// Whether an edge of the terrain face `f` is on the border.
inline bool is_on_border(const TriangleMesh& mesh, FaceId f) {
    return mesh.is_border(half_edge(f, 0)) || mesh.is_border(half_edge(f, 1)) ||
           mesh.is_border(half_edge(f, 2));
}

}  // namespace tinwright

#endif
