#ifndef TINWRIGHT_MESH_TIN_HPP
#define TINWRIGHT_MESH_TIN_HPP

#include <cstdint>
#include <vector>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// That an edge is part of a line: the line's number is an index into whatever lines the TIN was made with.
struct LineTrace {
    VertexId a{};  ///< a < b
    VertexId b{};
    std::uint32_t line = 0;
    std::uint32_t runs = 1;  ///< how often the line runs along the edge: a ring with a spike runs there twice
    friend auto operator<=>(const LineTrace&, const LineTrace&) = default;
};

/// A triangulated irregular network: connectivity, and one position and elevation a vertex.
/// The value that every later step takes and gives.
struct Tin {
    /// `sample` of a Steiner point.
    static constexpr std::uint32_t kNoSample = 0xFFFFFFFFU;
    /// `sample` of a vertex made where lines cross, or where a draped border crosses an edge of the TIN.
    static constexpr std::uint32_t kCrossing = 0xFFFFFFFEU;
    /// `sample` of a vertex put into a face to give it relief.
    static constexpr std::uint32_t kInserted = 0xFFFFFFFDU;

    Lattice lattice;
    LargeVector<Key2> keys;  ///< one a vertex, distinct, in the order of `curve.hpp`
    LargeVector<double> z;   ///< one a vertex, in the samples' unit
    /// What each vertex came from: the index of a sample, or the number of samples plus that of a line's
    /// point (counted through all lines), or one of the three values above.
    LargeVector<std::uint32_t> sample;
    TriangleMesh mesh;
    /// Which constrained edges are parts of which lines; ascending, distinct. Constrained edges of the border
    /// need not be part of any.
    std::vector<LineTrace> traces;

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
