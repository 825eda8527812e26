#ifndef TINWRIGHT_MESH_MESH_CHECK_HPP
#define TINWRIGHT_MESH_MESH_CHECK_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "tinwright/mesh/triangle_mesh.hpp"

/// Audit of a mesh's connectivity against the invariants listed with `TriangleMesh`.
namespace tinwright {

struct MeshViolation {
    int invariant = 0;        ///< n of the invariant M<n>
    HalfEdgeId half_edge{0};  ///< where: its face and corner
    std::string text;         ///< one line
};

struct MeshCheckOptions {
    /// Closed turns of faces that a vertex may have (M8); 0: any number.
    std::size_t turns = 1;
    /// Violations that are described; the rest is counted only.
    std::size_t limit = 100;
};

struct MeshCheckReport {
    std::vector<MeshViolation> violations;  ///< at most `limit`, by slot; M7 and M8 last
    std::size_t count = 0;                  ///< all of them
    [[nodiscard]] bool is_clean() const { return count == 0; }
};

/// Checks M1 to M8. M7 speaks of real vertices: the ghost vertex may be met twice in a turn, as it is when
/// all vertices are collinear. M7 and M8 need walks, so they are looked at only where M1 to M4 hold.
/// O(slots); half a byte a slot and 8 bytes a vertex of scratch.
MeshCheckReport check_mesh(const TriangleMesh& mesh, const MeshCheckOptions& options = {});

}  // namespace tinwright

#endif
