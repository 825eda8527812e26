#ifndef TINWRIGHT_DELAUNAY_PROXIMITY_GRAPHS_HPP
#define TINWRIGHT_DELAUNAY_PROXIMITY_GRAPHS_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

/// Graphs that join vertices which are near each other, each in the next: the minimum spanning tree, the
/// relative neighbourhood graph and the Gabriel graph, all in the Delaunay triangulation [tan1993, Sec. 2.4].
///
/// Lengths are compared exactly, on keys. Work is shared out inside the caller's task arena; the result does
/// not depend on it. Edges come with a < b and in ascending order, but those of the tree, which come shortest
/// first.
namespace tinwright {

/// A pair of vertices.
struct GraphEdge {
    VertexId a;  ///< a < b
    VertexId b;
    friend auto operator<=>(const GraphEdge&, const GraphEdge&) = default;
};

/// The Euclidean minimum spanning tree of the vertices: n - 1 edges, shortest first, equal ones by (a, b), so
/// the tree is unique.
///
/// `delaunay`: the Delaunay mesh of `keys` (`make_delaunay`), which has every edge of every such tree: the
/// closed disk with the edge as diameter holds no third vertex. Kruskal's method [kruskal1956]. O(n log n).
std::vector<GraphEdge> make_minimum_spanning_tree(const TriangleMesh& delaunay, std::span<const Key2> keys);
/// The same in any norm: taken from that norm's relative neighbourhood graph, which holds it. Equal lengths
/// come in the order of `LengthOrder`.
std::vector<GraphEdge> make_minimum_spanning_tree(const TriangleMesh& delaunay, std::span<const Key2> keys,
                                                  Norm norm, const Progress& progress = {});

/// The edges whose closed diametral disk holds no third vertex [gabriel1969]. `delaunay` as above. O(n).
std::vector<GraphEdge> make_gabriel_graph(const TriangleMesh& delaunay, std::span<const Key2> keys);

/// What becomes of vertices on the rim of a lune.
enum class LuneRim : std::uint8_t {
    Outside,  ///< as the graph is defined: only vertices nearer to both ends than these to each other count
    Ordered   ///< lengths are told apart by `LengthOrder`: fewer edges, never two that cross, still connected
};

/// The pairs p q without a vertex x for which both p x and q x are shorter than p q [toussaint1980;
/// tan1993, Sec. 2.4, 5.8]. In a norm other than the Euclidean, edges may cross if `rim` is `Outside`.
///
/// `mesh`: Delaunay, or constrained Delaunay with a convex border or not; then pairs that a constrained edge,
/// the border or a vertex separates are none, only an x seen from both p and q counts, not one across a void
/// from an edge of its border, and constrained edges are not listed unless they are in the graph. `progress`
/// may throw Cancelled.
/// Euclidean: the mesh's edges are tried, about O(n); O(n^2) at worst, as between two rows of vertices that
/// face each other, when many lunes are crossed by many edges. Others: at each vertex what it sees is looked
/// at, and those tried that are nearest within an octant, which all edges of the graph are: of two vertices
/// in one half-open octant around p that are not farther than q, one is nearer to q than p is. O(n k) for k
/// vertices seen within the reach of the octants' nearest, but for most that mesh neighbours rule out; k is
/// about 20 for even samples, n at worst.
std::vector<GraphEdge> make_relative_neighborhood_graph(const TriangleMesh& mesh, std::span<const Key2> keys,
                                                        Norm norm = {}, LuneRim rim = LuneRim::Outside,
                                                        const Progress& progress = {});

/// The Euclidean graph with ordered rims as marks: for each half-edge (`HalfEdgeId::value`, four a face slot)
/// 1 if its edge is in it, else 0. Same conditions.
std::vector<std::uint8_t> mark_relative_neighbors(const TriangleMesh& mesh, std::span<const Key2> keys,
                                                  const Progress& progress = {});

}  // namespace tinwright

#endif
