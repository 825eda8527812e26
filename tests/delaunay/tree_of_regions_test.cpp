#include "tinwright/delaunay/tree_of_regions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

struct Example {
    Tin tin;
    BlockingDisks disks;
    LinesInDisks lines;
};

// `edges`: between keys, which have to be among the vertices.
Example make_example(const std::vector<Key2>& keys, const std::vector<std::pair<Key2, Key2>>& edges) {
    Tin tin = delaunay_tin(keys);
    BlockingDisks disks(tin.keys, make_minimum_spanning_tree(tin.mesh, tin.keys));
    const auto vertex = [&](Key2 key) {
        return VertexId{
            static_cast<std::uint32_t>(std::find(tin.keys.begin(), tin.keys.end(), key) - tin.keys.begin())};
    };
    std::vector<std::pair<VertexId, VertexId>> line_edges;
    for (const auto& [p, q] : edges) {
        line_edges.emplace_back(vertex(p), vertex(q));
    }
    LinesInDisks lines =
        find_lines_in_disks(disks, tin.keys, line_edges, std::vector<bool>(line_edges.size()));
    return {std::move(tin), std::move(disks), std::move(lines)};
}

std::size_t place_in(const std::vector<Export>& order, std::uint32_t edge, bool is_from_left) {
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), Export{edge, is_from_left}) -
                                    order.begin());
}

}  // namespace

TEST_SUITE("delaunay/tree_of_regions") {
    TEST_CASE("both sides of every unprotected edge occur once") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Key2> keys;
            std::vector<std::pair<Key2, Key2>> edges;
            for (int row = 0; row < 12; ++row) {  // edges that run from left to right and do not cross
                const Key2 left{random.key(2e5), row * 1e5 + random.key(9e4)};
                const Key2 right{1e6 + random.key(2e5), row * 1e5 + random.key(9e4)};
                keys.insert(keys.end(), {left, right});
                edges.emplace_back(left, right);
            }
            for (int i = 0; i < 60; ++i) {
                keys.push_back({3e5 + random.key(6e5), random.key(12e5)});
            }
            const Example example = make_example(keys, edges);
            const std::vector<Export> order = order_exports(example.disks, example.tin.keys, example.lines);
            REQUIRE(example.lines.unprotected.size() > edges.size());
            CHECK(order.size() == 2 * example.lines.unprotected.size());
            for (std::uint32_t edge = 0; edge < example.lines.unprotected.size(); ++edge) {
                CHECK(place_in(order, edge, true) < order.size());
                CHECK(place_in(order, edge, false) < order.size());
            }
        }
    }

    TEST_CASE("through a stack of edges, vertices are handed on from each edge to the next in one go") {
        // Figure 6.1 of the thesis with three pairs: between neighbouring pairs, all edges pass from one disk
        // to the next in one face of the walls, whose regions are a path.
        constexpr std::uint32_t kEdges = 7;
        std::vector<Key2> keys;
        std::vector<std::pair<Key2, Key2>> edges;
        for (std::uint32_t i = 0; i < kEdges; ++i) {
            const Key2 left{0, 1e6 + 1e3 * i};
            const Key2 right{4e5, 1e6 + 1e3 * i};
            keys.insert(keys.end(), {left, right});
            edges.emplace_back(left, right);
        }
        for (const double x : {1e5, 2e5, 3e5}) {
            keys.insert(keys.end(), {{x, 1e6 - 2e4}, {x + 10, 1e6 + 2.6e4}});
        }
        const Example example = make_example(keys, edges);
        const std::vector<Export> order = order_exports(example.disks, example.tin.keys, example.lines);
        std::size_t stacks = 0;
        for (std::uint32_t gap = 0; gap < 6; ++gap) {
            std::vector<std::uint32_t> stack;
            for (const LineInDisks& edge : example.lines.edges) {
                for (std::uint32_t u = edge.first; u < edge.last; ++u) {
                    const UnprotectedEdge& part = example.lines.unprotected[u];
                    if (part.gap == gap && part.from > 0 && part.to < 1) {
                        stack.push_back(u);
                    }
                }
            }
            if (stack.size() == kEdges) {
                ++stacks;
                for (std::uint32_t i = 1; i < kEdges; ++i) {
                    // Upwards from below, downwards from above; edges run to the right or all to the left.
                    const bool is_up = place_in(order, stack[i - 1], true) < place_in(order, stack[i], true);
                    const bool is_down =
                        place_in(order, stack[i - 1], false) < place_in(order, stack[i], false);
                    const bool starts_up = place_in(order, stack[0], true) < place_in(order, stack[1], true);
                    CHECK(is_up != is_down);
                    CHECK(is_up == starts_up);
                }
                const Key2 p = example.tin.key(example.lines.edges[0].p);
                const Key2 q = example.tin.key(example.lines.edges[0].q);
                const bool above_is_left = q.x > p.x;
                CHECK(
                    (place_in(order, stack[0], !above_is_left) < place_in(order, stack[1], !above_is_left)));
            }
        }
        CHECK(stacks >= 2);
    }
}
