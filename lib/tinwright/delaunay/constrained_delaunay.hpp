#ifndef TINWRIGHT_DELAUNAY_CONSTRAINED_DELAUNAY_HPP
#define TINWRIGHT_DELAUNAY_CONSTRAINED_DELAUNAY_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// A straight segment between two vertices that is to become part of a triangulation.
struct Segment {
    VertexId a;
    VertexId b;
};

/// An edge that a segment became, or a part of one where the segment passes through vertices.
struct SegmentEdge {
    VertexId a;  ///< a < b
    VertexId b;
    std::uint32_t segment;  ///< index
    friend auto operator<=>(const SegmentEdge&, const SegmentEdge&) = default;
};

/// Makes every segment a chain of constrained edges and leaves the mesh a constrained Delaunay triangulation:
/// no vertex that can be seen from a face's inside across no constrained edge lies in the face's circle, ties
/// broken as `incircle_perturbed` does. It is unique: the order of the segments changes face slots only.
///
/// `mesh`: Delaunay, or constrained Delaunay, on `keys`, convex border. Segments must not cross each other or
/// constrained edges between vertices; they may overlap. No vertex is added. Returns the edges, ascending.
/// Cavities are refilled as [anglada1997] does. O(k^2) worst for a segment that crosses k edges, O(k log k)
/// as a rule, and O(n) once.
/// Throws InputError when a segment crosses a constrained edge.
std::vector<SegmentEdge> insert_segments(TriangleMesh& mesh, std::span<const Key2> keys,
                                         std::span<const Segment> segments);

}  // namespace tinwright

#endif
