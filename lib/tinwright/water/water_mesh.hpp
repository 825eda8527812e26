#ifndef TINWRIGHT_WATER_WATER_MESH_HPP
#define TINWRIGHT_WATER_WATER_MESH_HPP

#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// The constrained Delaunay triangulation of a polygon. Terrain faces are those inside; constrained edges are
/// the rings'. Numbers of vertices and faces follow from the set of ring edges alone.
struct WaterMesh {
    std::vector<Key2> keys;  ///< in curve order
    TriangleMesh mesh;
    std::vector<std::vector<VertexId>> rings;  ///< as they came in

    [[nodiscard]] Key2 key(VertexId v) const { return keys[v.value]; }
    /// Middle of an edge, in keys.
    [[nodiscard]] Point2 middle(HalfEdgeId h) const;
    [[nodiscard]] double length(HalfEdgeId h) const;
};

/// `rings`: closed without the first vertex repeated, three vertices or more, vertices distinct; they meet
/// neither themselves nor each other. Inside is what an odd number of them goes around. O(n log n).
WaterMesh make_water_mesh(std::span<const std::vector<Key2>> rings);

}  // namespace tinwright

#endif
