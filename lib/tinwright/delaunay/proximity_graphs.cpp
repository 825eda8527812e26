#include "tinwright/delaunay/proximity_graphs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <tbb/parallel_sort.h>

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

std::vector<Candidate> delaunay_edges(const TriangleMesh& mesh, std::span<const Key2> keys) {
    std::vector<Candidate> edges;
    edges.reserve(3 * keys.size());
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        const unsigned sides = mesh.is_ghost({f}) ? 1 : 3;
        for (unsigned i = 0; i < sides; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const VertexId a = mesh.origin(h);
            const VertexId b = mesh.destination(h);
            if (a < b) {  // once an edge, since the twin runs the other way
                const Key2 p = keys[a.value];
                const Key2 q = keys[b.value];
                edges.push_back({inner_product(q, p, q), {a, b}});
            }
        }
    }
    return edges;
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

    std::vector<GraphEdge> tree;
    tree.reserve(keys.size());
    Components components(keys.size());
    for (const Candidate& candidate : candidates) {
        if (components.unite(candidate.edge.a, candidate.edge.b)) {
            tree.push_back(candidate.edge);
            if (tree.size() + 1 == keys.size()) {
                break;
            }
        }
    }
    return tree;
}

}  // namespace tinwright
