#include "tinwright/optimal/polygon_optimizer.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"

#include "optimal/length_checks.hpp"
#include "support/cases.hpp"
#include "support/ring_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;
using internal::PolygonOptimizer;
using internal::PolygonTask;
using internal::Walls;

namespace {

/// A TIN in which the edges of its relative neighbourhood graph are constrained, as walls.
Tin with_walls(const Tin& start, const std::set<oracle::Edge>& graph) {
    Tin tin = start;
    std::vector<Segment> segments;
    for (const oracle::Edge& edge : graph) {
        segments.push_back({{edge[0]}, {edge[1]}});
    }
    insert_segments(tin.mesh, tin.keys, segments);
    return tin;
}

/// The half-edges of terrain faces by their ends.
std::map<oracle::Edge, HalfEdgeId> half_edges_of(const Tin& tin) {
    std::map<oracle::Edge, HalfEdgeId> result;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            result[{tin.mesh.origin(h).value, tin.mesh.destination(h).value}] = h;
        }
    }
    return result;
}

std::set<oracle::Edge> sides_of(const oracle::Region& region) {
    std::set<oracle::Edge> sides;
    for (std::size_t i = 0; i < region.ring.size(); ++i) {
        sides.insert(ascending(region.ring[i], region.ring[(i + 1) % region.ring.size()]));
    }
    return sides;
}

/// The diagonal of the region's faces that has the last place.
std::optional<oracle::Edge> longest_diagonal(const oracle::Region& region, const oracle::LengthRanks& ranks) {
    const std::set<oracle::Edge> sides = sides_of(region);
    std::optional<oracle::Edge> longest;
    for (const oracle::Triple& face : region.faces) {
        for (const oracle::Edge& edge :
             {oracle::Edge{face[0], face[1]}, {face[1], face[2]}, {face[0], face[2]}}) {
            if (!sides.contains(edge) &&
                (!longest || ranks.place(edge[0], edge[1]) > ranks.place((*longest)[0], (*longest)[1]))) {
                longest = edge;
            }
        }
    }
    return longest;
}

/// Polygons that were triangulated anew.
struct ChangedPolygons {
    std::size_t complete = 0;
    std::size_t incomplete = 0;  ///< with a side that is longer than need be
    ChangedPolygons& operator+=(ChangedPolygons other) {
        complete += other.complete;
        incomplete += other.incomplete;
        return *this;
    }
};

/// All diagonals of the region come before the shortest of its long sides.
void check_diagonals(const oracle::Region& region, const std::vector<oracle::Edge>& long_sides,
                     const oracle::LengthRanks& ranks) {
    std::uint32_t shortest = UINT32_MAX;
    for (const oracle::Edge& side : long_sides) {
        shortest = std::min(shortest, ranks.place(side[0], side[1]));
    }
    const std::set<oracle::Edge> sides = sides_of(region);
    for (const oracle::Triple& face : region.faces) {
        for (const oracle::Edge& edge :
             {oracle::Edge{face[0], face[1]}, {face[1], face[2]}, {face[0], face[2]}}) {
            REQUIRE((sides.contains(edge) || ranks.place(edge[0], edge[1]) < shortest));
        }
    }
}

/// Runs the optimiser on every polygon between walls and checks each by itself.
ChangedPolygons check_each_polygon(const Tin& start, Norm norm) {
    const oracle::LengthRanks ranks(norm, start.keys);
    const std::set<oracle::Edge> graph = oracle::relative_neighbors(start, ranks);
    Tin tin = with_walls(start, graph);
    const std::map<oracle::Edge, HalfEdgeId> half_edges = half_edges_of(tin);
    Walls walls;
    walls.is_wall.assign(4 * tin.mesh.slot_count(), 0);
    walls.position.assign(walls.is_wall.size(), 0);
    std::vector<std::uint8_t> in_graph(walls.is_wall.size(), 0);
    for (const auto& [ends, h] : half_edges) {
        walls.is_wall[h.value] = tin.mesh.is_constrained(h) || tin.mesh.is_border(h) ? 1 : 0;
        in_graph[h.value] = graph.contains(ascending(ends[0], ends[1])) ? 1 : 0;
    }
    const LengthOrder order(tin.keys, norm);
    const std::vector<oracle::Region> before = oracle::regions_of(tin, graph);
    std::vector<PolygonTask> tasks;
    const TriangleMesh mesh = tin.mesh;
    PolygonOptimizer optimizer(mesh, order, walls, in_graph);
    for (const oracle::Region& region : before) {
        CAPTURE(region.ring);
        REQUIRE(region.faces.size() + 2 == region.ring.size());  // simply connected
        if (region.faces.size() > 1) {
            const oracle::Edge longest = *longest_diagonal(region, ranks);
            PolygonTask task;
            task.wall = half_edges.at({region.ring[0], region.ring[1]});
            task.longest = half_edges.at(longest);
            task.size = static_cast<std::uint32_t>(region.ring.size());
            optimizer.run(task, [] { return true; });
            REQUIRE(task.is_done);
            tasks.push_back(task);
        } else {
            tasks.emplace_back();
        }
    }
    for (const PolygonTask& task : tasks) {
        if (!task.faces.empty()) {
            refill_cavity(tin.mesh, task.slots, task.faces);
        }
    }
    REQUIRE(is_sound(tin));
    const std::vector<oracle::Region> after = oracle::regions_of(tin, graph);
    REQUIRE(after.size() == before.size());
    ChangedPolygons changed;
    for (std::size_t r = 0; r < after.size(); ++r) {
        const oracle::Region& region = after[r];
        CAPTURE(region.ring);
        REQUIRE(region.ring == before[r].ring);
        if (region.faces.size() == 1) {
            continue;
        }
        const PolygonTask& task = tasks[r];
        const std::uint32_t longest = oracle::longest_edge(region, ranks);
        REQUIRE(oracle::least_longest_edge(start.keys, region.ring, ranks) == longest);
        const std::vector<oracle::Edge> long_sides = oracle::long_sides(region, start.keys, ranks);
        REQUIRE(task.is_incomplete == !long_sides.empty());
        if (task.is_incomplete) {
            ++changed.incomplete;
            check_diagonals(region, long_sides, ranks);
        } else {
            const bool is_kept = task.faces.empty();
            REQUIRE(ranks.rank(task.optimum.first.value, task.optimum.second.value) == longest);
            REQUIRE(is_kept == (oracle::longest_edge(before[r], ranks) == longest));
            changed.complete += is_kept ? 0U : 1U;
        }
    }
    return changed;
}

}  // namespace

TEST_SUITE("optimal/polygon_optimizer") {
    TEST_CASE("the inside of a ring is as good as dynamic programming makes it") {
        ChangedPolygons changed;
        for (const RingFamily& family : ring_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(100); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Key2> ring =
                    family.make(random, static_cast<std::size_t>(random.integer(4, seed % 8 == 7 ? 90 : 24)));
                const Tin start = tin_of_ring(ring);
                REQUIRE(start.mesh.count_terrain() + 2 == ring.size());
                for (const Norm norm : length_norms()) {
                    CAPTURE(norm_name(norm));
                    changed += check_each_polygon(start, norm);
                }
            }
        }
        CHECK(changed.complete > 0);
        CHECK(changed.incomplete > 0);
    }

    TEST_CASE("every polygon between relative neighbours is optimal by itself") {
        const std::vector<TinFamily> families = all_tin_families();
        ChangedPolygons changed;
        for (const TinFamily& family : families) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin start = family.make(random, seed % 3 == 0 ? 80 : 30);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                if (seed % 2 == 1) {
                    add_segments_at_random(random, start, 10);
                    make_voids_at_random(random, start, static_cast<int>(random.integer(0, 6)));
                }
                for (const Norm norm : length_norms()) {
                    CAPTURE(norm_name(norm));
                    changed += check_each_polygon(start, norm);
                }
            }
        }
        CHECK(changed.complete > 0);
        CHECK(changed.incomplete > 0);
    }
}
