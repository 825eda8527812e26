#include "tinwright/delaunay/delaunay_edges.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A circle through a and b leaves all vertices out if and only if none is between them, and no vertex on one
/// side is inside the circle through them and one on the other side.
bool has_disk(const std::vector<Key2>& keys, Edge edge) {
    const Key2 a = keys[edge.first];
    const Key2 b = keys[edge.second];
    std::vector<Key2> left;
    std::vector<Key2> right;
    for (const Key2 key : keys) {
        const int side = orient2d(a, b, key);
        if (side == 0 && angle_sign(a, key, b) < 0) {
            return false;
        }
        if (side != 0) {
            (side > 0 ? left : right).push_back(key);
        }
    }
    for (const Key2 c : left) {
        for (const Key2 d : right) {
            if (incircle(a, b, c, d) > 0) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

TEST_SUITE("delaunay/delaunay_edges") {
    TEST_CASE("edges without an empty disk are those that a slow search finds") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(4); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Key2> keys = without_repetitions(family.make(random, 24));
                bool is_flat = true;
                for (std::size_t i = 2; i < keys.size(); ++i) {
                    is_flat = is_flat && orient2d(keys[0], keys[1], keys[i]) == 0;
                }
                if (keys.size() < 3 || is_flat) {
                    continue;
                }
                for (std::uint32_t a = 0; a < keys.size(); ++a) {
                    for (std::uint32_t b = a + 1; b < keys.size(); ++b) {
                        const std::array<Edge, 1> edge{Edge(a, b)};
                        CHECK((count_edges_without_disk(keys, edge) == 0) == has_disk(keys, edge[0]));
                    }
                }
            }
        }
    }

    TEST_CASE("both diagonals of a square have one, the long edge over two has none") {
        const std::vector<Key2> keys = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {20, 0}};
        const std::vector<Edge> edges = {{0, 2}, {1, 3}, {0, 4}, {4, 3}};
        CHECK(count_edges_without_disk(keys, std::span(edges).first(2)) == 0);
        CHECK(count_edges_without_disk(keys, edges) == 2);
    }

    TEST_CASE("locations may be repeated") {
        const std::vector<Key2> keys = {{0, 0}, {10, 0}, {0, 10}, {10, 0}, {0, 0}};
        const std::vector<Edge> edges = {{3, 4}, {1, 2}};
        CHECK(count_edges_without_disk(keys, edges) == 0);
    }
}
