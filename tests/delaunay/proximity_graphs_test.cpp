#include "tinwright/delaunay/proximity_graphs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/delaunay.hpp"

#include "support/cases.hpp"
#include "support/graph_oracle.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

__extension__ using Int128 = __int128;

// Squared length, then the ends: no two edges are equal.
using Weight = std::tuple<Int128, std::uint32_t, std::uint32_t>;

Weight weight(std::span<const Key2> keys, std::uint32_t a, std::uint32_t b) {
    const Int128 x = static_cast<std::int64_t>(keys[b].x) - static_cast<std::int64_t>(keys[a].x);
    const Int128 y = static_cast<std::int64_t>(keys[b].y) - static_cast<std::int64_t>(keys[a].y);
    return {x * x + y * y, std::min(a, b), std::max(a, b)};
}

// Prim's method on the complete graph, O(n^2), in integers.
std::vector<GraphEdge> prim(std::span<const Key2> keys) {
    std::vector<std::uint32_t> outside(keys.size() - 1);
    std::vector<Weight> best(keys.size());
    for (std::uint32_t v = 1; v < keys.size(); ++v) {
        outside[v - 1] = v;
        best[v] = weight(keys, 0, v);
    }
    std::vector<GraphEdge> tree;
    while (!outside.empty()) {
        const auto next = std::min_element(outside.begin(), outside.end(),
                                           [&](auto u, auto v) { return best[u] < best[v]; });
        const std::uint32_t added = *next;
        outside.erase(next);
        tree.push_back({{std::get<1>(best[added])}, {std::get<2>(best[added])}});
        for (const std::uint32_t v : outside) {
            best[v] = std::min(best[v], weight(keys, added, v));
        }
    }
    std::sort(tree.begin(), tree.end(), [&](const GraphEdge& x, const GraphEdge& y) {
        return weight(keys, x.a.value, x.b.value) < weight(keys, y.a.value, y.b.value);
    });
    return tree;
}

std::vector<oracle::Edge> as_sorted_pairs(const std::vector<GraphEdge>& edges) {
    std::vector<oracle::Edge> pairs;
    for (const GraphEdge& edge : edges) {
        pairs.push_back({edge.a.value, edge.b.value});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<oracle::Edge> edges_of(const TriangleMesh& mesh) {
    std::vector<oracle::Edge> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < (mesh.is_ghost({f}) ? 1U : 3U); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (mesh.origin(h) < mesh.destination(h)) {
                edges.push_back({mesh.origin(h).value, mesh.destination(h).value});
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

TEST_SUITE("delaunay/minimum_spanning_tree") {
    TEST_CASE("the tree is the one that Prim's method finds on all pairs of vertices") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const Tin tin = delaunay_tin(family.make(random, seed % 2 == 0 ? 20 : 300));
                CHECK(make_minimum_spanning_tree(tin.mesh, tin.keys) == prim(tin.keys));
            }
        }
    }

    TEST_CASE("the closed disk on an edge of the tree holds no third vertex") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(3); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed) + 100);
                const Tin tin = delaunay_tin(family.make(random, 40));
                std::size_t inside = 0;
                for (const GraphEdge& edge : make_minimum_spanning_tree(tin.mesh, tin.keys)) {
                    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                        const bool is_third = v != edge.a.value && v != edge.b.value;
                        if (is_third &&
                            oracle::angle_sign(tin.key(edge.a), tin.keys[v], tin.key(edge.b)) <= 0) {
                            ++inside;
                        }
                    }
                }
                CHECK(inside == 0);
            }
        }
    }

    TEST_CASE("in every norm the tree is the one that Prim's method finds on all pairs of vertices") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (const Norm norm : {Norm(), Norm::lp(1), Norm::maximum(), Norm::lp(3), Norm::lp(7)}) {
                CAPTURE(norm_name(norm));
                Random random(21);
                const Tin tin = delaunay_tin(family.make(random, 60));
                const auto tree = make_minimum_spanning_tree(tin.mesh, tin.keys, norm);
                const oracle::PairTable rank = oracle::ranks(tin.keys, norm, oracle::Ties::Ordered);
                CHECK(std::is_sorted(tree.begin(), tree.end(), [&](const GraphEdge& x, const GraphEdge& y) {
                    return rank(x.a.value, x.b.value) < rank(y.a.value, y.b.value);
                }));
                CHECK(as_sorted_pairs(tree) == oracle::minimum_spanning_tree(tin.keys, norm));
            }
        }
    }

    TEST_CASE("collinear vertices are joined in a row, two by their edge") {
        const Tin row = delaunay_tin({{9, 9}, {0, 0}, {3, 3}, {4, 4}});
        std::vector<std::pair<double, double>> joined;
        for (const GraphEdge& edge : make_minimum_spanning_tree(row.mesh, row.keys)) {
            const double a = row.key(edge.a).x;
            const double b = row.key(edge.b).x;
            joined.emplace_back(std::min(a, b), std::max(a, b));
        }
        CHECK(joined == std::vector<std::pair<double, double>>{{3, 4}, {0, 3}, {4, 9}});
        const Tin pair = delaunay_tin({{5, 1}, {2, 7}});
        CHECK(make_minimum_spanning_tree(pair.mesh, pair.keys) == std::vector<GraphEdge>{{{0}, {1}}});
    }

    TEST_CASE("on a square grid, where all lengths tie, the ends decide") {
        const Tin tin = delaunay_tin(grid_keys(12, 9));
        CHECK(make_minimum_spanning_tree(tin.mesh, tin.keys) == prim(tin.keys));
    }
}

TEST_SUITE("delaunay/gabriel_graph") {
    TEST_CASE("the edges are those whose closed diametral disk holds no third vertex") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed) + 60);
                const Tin tin = delaunay_tin(family.make(random, seed % 2 == 0 ? 12 : 60));
                const auto graph = make_gabriel_graph(tin.mesh, tin.keys);
                CHECK(std::is_sorted(graph.begin(), graph.end()));
                CHECK(as_sorted_pairs(graph) == oracle::gabriel_neighbors(tin.keys));
            }
        }
    }

    TEST_CASE("tree, relative neighbours, Gabriel graph and Delaunay triangulation hold each other in turn") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(77);
            const Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(cases(2000))));
            const auto holds = [](const std::vector<oracle::Edge>& all,
                                  const std::vector<oracle::Edge>& some) {
                return std::includes(all.begin(), all.end(), some.begin(), some.end());
            };
            const auto tree = as_sorted_pairs(make_minimum_spanning_tree(tin.mesh, tin.keys));
            const auto ordered = as_sorted_pairs(
                make_relative_neighborhood_graph(tin.mesh, tin.keys, Norm(), LuneRim::Ordered));
            const auto relative = as_sorted_pairs(make_relative_neighborhood_graph(tin.mesh, tin.keys));
            const auto gabriel = as_sorted_pairs(make_gabriel_graph(tin.mesh, tin.keys));
            CHECK(holds(ordered, tree));
            CHECK(holds(relative, ordered));
            CHECK(holds(gabriel, relative));
            CHECK(holds(edges_of(tin.mesh), gabriel));
        }
    }
}
