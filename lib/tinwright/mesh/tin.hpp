#ifndef TINWRIGHT_MESH_TIN_HPP
#define TINWRIGHT_MESH_TIN_HPP

#include <cstdint>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// A triangulated irregular network: connectivity, and one position and elevation a vertex.
/// The value that every later step takes and gives.
struct Tin {
    /// `sample` of a vertex that no sample gave.
    static constexpr std::uint32_t kNoSample = 0xFFFFFFFFU;

    Lattice lattice;
    LargeVector<Key2> keys;             ///< one a vertex, distinct, in the order of `curve.hpp`
    LargeVector<double> z;              ///< one a vertex, in the samples' unit
    LargeVector<std::uint32_t> sample;  ///< index of the sample each vertex came from, or kNoSample
    TriangleMesh mesh;

    [[nodiscard]] std::size_t vertex_count() const { return keys.size(); }
    [[nodiscard]] Key2 key(VertexId v) const { return keys[v.value]; }
    /// Position in CRS units.
    [[nodiscard]] Point3 position(VertexId v) const {
        const Point2 p = lattice.position(keys[v.value]);
        return {p.x, p.y, z[v.value]};
    }
    /// Bounds in CRS units of the terrain faces' vertices; empty without faces. O(slots).
    [[nodiscard]] Box bounds() const;
};

}  // namespace tinwright

#endif
