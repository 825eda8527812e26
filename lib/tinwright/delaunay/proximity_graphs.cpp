#include "tinwright/delaunay/proximity_graphs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <tbb/parallel_sort.h>

#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

struct Candidate {
    double squared_length;  // rounded once, so it orders as the exact one does, but for ties
    GraphEdge edge;
};

// The sets of vertices that are connected so far.
class Components {
  public:
    explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    // Whether the two were apart; they no longer are.
    bool unite(VertexId a, VertexId b) {
        const std::uint32_t of_a = root(a.value);
        const std::uint32_t of_b = root(b.value);
        // Neighbours have close numbers: the lesser one as the root does no harm.
        parent_[std::max(of_a, of_b)] = std::min(of_a, of_b);
        return of_a != of_b;
    }

  private:
    std::uint32_t root(std::uint32_t v) {
        while (parent_[v] != v) {
            parent_[v] = parent_[parent_[v]];
            v = parent_[v];
        }
        return v;
    }

    std::vector<std::uint32_t> parent_;
};

// Calls visit(h) with one half-edge of every edge, that which runs to the greater vertex.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        const unsigned sides = mesh.is_ghost({f}) ? 1 : 3;
        for (unsigned i = 0; i < sides; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (mesh.origin(h) < mesh.destination(h)) {  // once an edge, since the twin runs the other way
                visit(h);
            }
        }
    }
}

std::vector<Candidate> delaunay_edges(const TriangleMesh& mesh, std::span<const Key2> keys) {
    std::vector<Candidate> edges;
    edges.reserve(3 * keys.size());
    for_each_edge(mesh, [&](HalfEdgeId h) {
        const GraphEdge edge{mesh.origin(h), mesh.destination(h)};
        const Key2 q = keys[edge.b.value];
        edges.push_back({inner_product(q, keys[edge.a.value], q), edge});
    });
    return edges;
}

const GraphEdge& edge_of(const Candidate& candidate) { return candidate.edge; }
const GraphEdge& edge_of(const GraphEdge& edge) { return edge; }

// Kruskal's method on edges that come shortest first.
template <class Edge>
std::vector<GraphEdge> find_tree(const std::vector<Edge>& edges, std::size_t vertex_count) {
    std::vector<GraphEdge> tree;
    tree.reserve(vertex_count);
    Components components(vertex_count);
    for (const Edge& candidate : edges) {
        const GraphEdge edge = edge_of(candidate);
        if (components.unite(edge.a, edge.b)) {
            tree.push_back(edge);
            if (tree.size() + 1 == vertex_count) {
                break;
            }
        }
    }
    return tree;
}

// The third corner of a half-edge's face is outside the closed disk on its edge, or there is none.
bool is_apex_outside(const TriangleMesh& mesh, std::span<const Key2> keys, HalfEdgeId h) {
    if (mesh.is_ghost(face_of(h))) {
        return true;
    }
    const auto key = [&](HalfEdgeId side) { return keys[mesh.origin(side).value]; };
    return angle_sign(key(h), key(previous(h)), key(next(h))) > 0;
}

}  // namespace

std::vector<GraphEdge> make_minimum_spanning_tree(const TriangleMesh& delaunay, std::span<const Key2> keys) {
    std::vector<Candidate> candidates = delaunay_edges(delaunay, keys);
    const auto key = [&](VertexId v) { return keys[v.value]; };
    tbb::parallel_sort(candidates.begin(), candidates.end(), [&](const Candidate& x, const Candidate& y) {
        if (x.squared_length != y.squared_length) {
            return x.squared_length < y.squared_length;
        }
        const int order = compare_distances(key(x.edge.a), key(x.edge.b), key(y.edge.a), key(y.edge.b));
        return order != 0 ? order < 0 : x.edge < y.edge;
    });

    return find_tree(candidates, keys.size());
}

std::vector<GraphEdge> make_minimum_spanning_tree(const TriangleMesh& delaunay, std::span<const Key2> keys,
                                                  Norm norm, const Progress& progress) {
    if (norm.is_euclidean()) {
        return make_minimum_spanning_tree(delaunay, keys);
    }
    std::vector<GraphEdge> edges =
        make_relative_neighborhood_graph(delaunay, keys, norm, LuneRim::Ordered, progress);
    const LengthOrder lengths(keys, norm);
    tbb::parallel_sort(edges.begin(), edges.end(), [&](const GraphEdge& x, const GraphEdge& y) {
        return lengths.is_shorter(x.a, x.b, y.a, y.b);
    });
    return find_tree(edges, keys.size());
}

// The angle over an edge is greatest, on either side, at the apex of the face there: its circle is empty.
std::vector<GraphEdge> make_gabriel_graph(const TriangleMesh& delaunay, std::span<const Key2> keys) {
    std::vector<GraphEdge> edges;
    for_each_edge(delaunay, [&](HalfEdgeId h) {
        if (is_apex_outside(delaunay, keys, h) && is_apex_outside(delaunay, keys, delaunay.twin(h))) {
            edges.push_back({delaunay.origin(h), delaunay.destination(h)});
        }
    });
    tbb::parallel_sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace tinwright
