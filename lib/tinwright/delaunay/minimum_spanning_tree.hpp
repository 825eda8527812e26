#ifndef TINWRIGHT_DELAUNAY_MINIMUM_SPANNING_TREE_HPP
#define TINWRIGHT_DELAUNAY_MINIMUM_SPANNING_TREE_HPP

#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// An edge of a tree of vertices.
struct TreeEdge {
    VertexId a;  ///< a < b
    VertexId b;
    friend auto operator<=>(const TreeEdge&, const TreeEdge&) = default;
};

/// The Euclidean minimum spanning tree of the vertices: n - 1 edges, shortest first. Lengths are compared
/// exactly, equal ones by (a, b), so the tree is unique.
///
/// `delaunay`: the Delaunay mesh of `keys` (`make_delaunay`), which has every edge of every such tree: the
/// closed disk with the edge as diameter holds no third vertex. Kruskal's method [kruskal1956].
/// O(n log n), the sort parallel inside the caller's task arena.
std::vector<TreeEdge> make_minimum_spanning_tree(const TriangleMesh& delaunay, std::span<const Key2> keys);

}  // namespace tinwright

#endif
