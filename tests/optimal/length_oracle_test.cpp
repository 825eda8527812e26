#include "support/length_oracle.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"

#include "support/cases.hpp"
#include "support/length_tins.hpp"
#include "support/oracles.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// The oracles against each other, and with them the theorems that the engine rests on.

namespace {

/// Calls `check` with small TINs, in each norm.
template <class Check>
void for_small_tins(int count, std::size_t most, const Check& check) {
    for (const Norm norm : length_norms()) {
        CAPTURE(norm_name(norm));
        for (int seed = 0; seed < cases(count); ++seed) {
            CAPTURE(seed);
            const Tin tin = any_small_tin(static_cast<std::uint64_t>(seed), most);
            if (tin.mesh.count_terrain() > 0) {
                CAPTURE(describe(tin));
                check(tin, oracle::LengthRanks(norm, tin.keys));
            }
        }
    }
}

/// The longest edge when each region between relative neighbours is triangulated by itself.
std::uint32_t least_by_regions(Tin tin, const oracle::LengthRanks& ranks) {
    const std::set<oracle::Edge> graph = oracle::relative_neighbors(tin, ranks);
    std::vector<Segment> segments;
    segments.reserve(graph.size());
    for (const oracle::Edge& edge : graph) {
        segments.push_back({{edge[0]}, {edge[1]}});
    }
    insert_segments(tin.mesh, tin.keys, segments);
    std::uint32_t longest = 0;
    for (const oracle::Region& region : oracle::regions_of(tin, graph)) {
        REQUIRE(region.faces.size() + 2 == region.ring.size());
        const auto least = oracle::least_longest_edge(tin.keys, region.ring, ranks);
        REQUIRE(least.has_value());
        longest = std::max(longest, *least);
    }
    return longest;
}

}  // namespace

TEST_SUITE("optimal/length_oracle") {
    TEST_CASE("tabulated sweeps find what a list of all triangulations holds") {
        for_small_tins(600, 9, [](const Tin& tin, const oracle::LengthRanks& ranks) {
            const oracle::Terrain terrain = oracle::terrain_sites(tin);
            REQUIRE(oracle::least_longest_edge(terrain, ranks) ==
                    oracle::least_longest_edge_listed(terrain, ranks));
        });
    }

    TEST_CASE("an optimum holds all relative neighbours that see each other, constrained or not") {
        for_small_tins(1200, 12, [](const Tin& tin, const oracle::LengthRanks& ranks) {
            REQUIRE(least_by_regions(tin, ranks) ==
                    oracle::least_longest_edge(oracle::terrain_sites(tin), ranks));
        });
    }

    TEST_CASE("relative neighbours are Delaunay in the Euclidean norm, constrained or not") {
        for (int seed = 0; seed < cases(1200); ++seed) {
            CAPTURE(seed);
            const Tin tin = any_small_tin(static_cast<std::uint64_t>(seed), 14);
            if (tin.mesh.count_terrain() == 0) {
                continue;
            }
            std::set<oracle::Edge> edges;
            for (const oracle::Triple& face : terrain_of(tin.mesh)) {
                for (const auto& [a, b] : {std::array{face[0], face[1]}, std::array{face[1], face[2]},
                                           std::array{face[0], face[2]}}) {
                    edges.insert({std::min(a, b), std::max(a, b)});
                }
            }
            const auto graph = oracle::relative_neighbors(tin, oracle::LengthRanks({}, tin.keys));
            REQUIRE(std::includes(edges.begin(), edges.end(), graph.begin(), graph.end()));
        }
    }

    TEST_CASE("ranks order lengths as comparing two of them does") {
        for (const Norm norm : length_norms()) {
            CAPTURE(norm_name(norm));
            Random random(3);
            const Tin tin = length_families()[0].make(random, 12);
            const oracle::LengthRanks ranks(norm, tin.keys);
            const auto n = static_cast<std::uint32_t>(tin.vertex_count());
            for (std::uint32_t i = 0; i + 3 < n * n; ++i) {
                const std::uint32_t a = i % n;
                const std::uint32_t b = (i + 1) % n;
                const std::uint32_t c = i / n;
                const std::uint32_t d = 7 * i % n;
                const auto sign = [](auto x, auto y) { return x < y ? -1 : x > y ? 1 : 0; };
                CHECK(sign(ranks.rank(a, b), ranks.rank(c, d)) ==
                      oracle::compare_lengths(norm, tin.keys[a], tin.keys[b], tin.keys[c], tin.keys[d]));
                CHECK((ranks.place(a, b) == ranks.place(c, d)) ==
                      (std::minmax({a, b}) == std::minmax({c, d}) || (a == b && c == d)));
            }
        }
    }
}
