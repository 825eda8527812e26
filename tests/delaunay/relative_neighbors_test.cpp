#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/graph_oracle.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

const std::array<Norm, 6> kNorms = {Norm(),      Norm::lp(1), Norm::maximum(),
                                    Norm::lp(3), Norm::lp(7), Norm::lp(64)};

std::vector<oracle::Edge> as_pairs(const std::vector<GraphEdge>& edges) {
    std::vector<oracle::Edge> pairs;
    for (const GraphEdge& edge : edges) {
        pairs.push_back({edge.a.value, edge.b.value});
    }
    return pairs;
}

std::string as_text(const std::vector<oracle::Edge>& edges) {
    std::string text;
    for (const oracle::Edge& edge : edges) {
        text += std::to_string(edge[0]) + "-" + std::to_string(edge[1]) + " ";
    }
    return text;
}

oracle::Ties ties_of(LuneRim rim) {
    return rim == LuneRim::Outside ? oracle::Ties::Equal : oracle::Ties::Ordered;
}

std::vector<oracle::Edge> graph_of(const Tin& tin, Norm norm, LuneRim rim) {
    return as_pairs(make_relative_neighborhood_graph(tin.mesh, tin.keys, norm, rim));
}

// The edges that are marked, ascending; each by both half-edges or none.
std::vector<oracle::Edge> marked_of(const Tin& tin) {
    const std::vector<std::uint8_t> marks = mark_relative_neighbors(tin.mesh, tin.keys);
    REQUIRE(marks.size() == 4 * tin.mesh.slot_count());
    std::vector<oracle::Edge> edges;
    for (std::uint32_t i = 0; i < marks.size(); ++i) {
        if (marks[i] != 0) {
            const HalfEdgeId h{i};
            REQUIRE(marks[tin.mesh.twin(h).value] == 1);
            const oracle::Edge edge{tin.mesh.origin(h).value, tin.mesh.destination(h).value};
            if (edge[0] < edge[1]) {
                edges.push_back(edge);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

void constrain_segments(Random& random, Tin& tin, int tries) {
    std::vector<Segment> segments;
    const auto most = static_cast<std::int64_t>(tin.vertex_count()) - 1;
    for (int i = 0; i < tries; ++i) {
        const VertexId a{static_cast<std::uint32_t>(random.integer(0, most))};
        const VertexId b{static_cast<std::uint32_t>(random.integer(0, most))};
        if (a != b && std::none_of(segments.begin(), segments.end(), [&](const Segment& s) {
                return oracle::do_cross(tin.key(a), tin.key(b), tin.key(s.a), tin.key(s.b));
            })) {
            segments.push_back({a, b});
        }
    }
    insert_segments(tin.mesh, tin.keys, segments);
}

// Two or three places far from each other around which vertices are the denser the nearer: those on the rims
// see many of another place, or a ring of them, further apart than their own neighbours.
std::vector<Key2> distant_clusters(Random& random) {
    std::vector<Key2> keys;
    const std::int64_t places = random.integer(2, 3);
    const bool is_ring = random.integer(0, 2) == 0;
    for (std::int64_t place = 0; place < places; ++place) {
        const Key2 center{2000 + random.key(6000), 2000 + random.key(6000)};
        for (int i = 0; i < 70; ++i) {
            const double angle = 6.28 * random.real();
            const double reach = is_ring ? 1000 : 1500 * random.real() * random.real();
            keys.push_back({std::round(center.x + reach * std::cos(angle)),
                            std::round(center.y + reach * std::sin(angle))});
        }
    }
    return keys;
}

void check_against_definition(const Tin& tin, const oracle::Scene& scene) {
    CAPTURE(describe(tin));
    for (const Norm norm : kNorms) {
        CAPTURE(norm_name(norm));
        for (const LuneRim rim : {LuneRim::Outside, LuneRim::Ordered}) {
            CAPTURE(static_cast<int>(rim));
            REQUIRE(as_text(graph_of(tin, norm, rim)) ==
                    as_text(oracle::relative_neighbors(scene, norm, ties_of(rim))));
        }
    }
    REQUIRE(marked_of(tin) == graph_of(tin, Norm(), LuneRim::Ordered));
}

}  // namespace

TEST_SUITE("delaunay/relative_neighbors") {
    TEST_CASE("the graphs are those of the definition, in every norm, with rims outside or ordered") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(8); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto count = static_cast<std::size_t>(random.integer(2, 40));
                const std::vector<Key2> keys = in_curve_order(family.make(random, count));
                if (keys.size() >= 2) {
                    const Tin tin = delaunay_tin(keys);
                    check_against_definition(tin, oracle::open_scene(tin));
                }
            }
        }
    }

    TEST_CASE("between constrained edges only what is seen from both ends counts") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(8); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed) + 50);
                Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(random.integer(6, 40))));
                if (tin.mesh.count_terrain() > 0) {
                    constrain_segments(random, tin, static_cast<int>(random.integer(1, 20)));
                    check_against_definition(tin, oracle::scene_of(tin));
                }
            }
        }
    }

    TEST_CASE("voids and borders that are not convex are in the way like constrained edges") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(8); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed) + 90);
                Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(random.integer(6, 40))));
                if (tin.mesh.count_terrain() > 0) {
                    constrain_segments(random, tin, static_cast<int>(random.integer(0, 4)));
                    make_voids_at_random(random, tin, static_cast<int>(random.integer(1, 20)));
                    check_against_definition(tin, oracle::scene_of(tin));
                }
            }
        }
    }

    TEST_CASE(
        "among clusters far apart, with constrained edges or not, the graphs are those of the definition") {
        for (int seed = 0; seed < cases(12); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed) + 130);
            Tin tin = delaunay_tin(distant_clusters(random));
            check_against_definition(tin, oracle::open_scene(tin));
            if (seed % 4 == 0) {
                constrain_segments(random, tin, 2);
                check_against_definition(tin, oracle::scene_of(tin));
            }
        }
    }

    TEST_CASE("with ordered rims the graph is plane and connected and holds the minimum spanning tree") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (const Norm norm : kNorms) {
                CAPTURE(norm_name(norm));
                Random random(7);
                const Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(cases(150))));
                const auto graph = graph_of(tin, norm, LuneRim::Ordered);
                const auto outside = graph_of(tin, norm, LuneRim::Outside);
                REQUIRE(oracle::is_plane(tin.keys, graph));
                REQUIRE(oracle::count_components(tin.vertex_count(), graph) == 1);
                REQUIRE(std::includes(outside.begin(), outside.end(), graph.begin(), graph.end()));
                auto tree = as_pairs(make_minimum_spanning_tree(tin.mesh, tin.keys, norm));
                std::sort(tree.begin(), tree.end());
                REQUIRE(std::includes(graph.begin(), graph.end(), tree.begin(), tree.end()));
            }
        }
    }

    TEST_CASE("on a square grid the steps of one are neighbours, ordered or not") {
        const Tin tin = delaunay_tin(grid_keys(20, 10));
        const std::size_t steps = 19 * 10 + 20 * 9;
        for (const Norm norm : {Norm(), Norm::lp(1), Norm::lp(3)}) {
            CAPTURE(norm_name(norm));
            CHECK(graph_of(tin, norm, LuneRim::Ordered).size() == steps);
            CHECK(graph_of(tin, norm, LuneRim::Outside).size() == steps);
        }
        // A step across is no longer than the two beside it, in the maximum norm; the little Euclidean part
        // of the order makes it so.
        CHECK(graph_of(tin, Norm::maximum(), LuneRim::Ordered).size() == steps);
        CHECK(graph_of(tin, Norm::maximum(), LuneRim::Outside).size() == steps + 2 * std::size_t{19} * 9);
    }

    TEST_CASE("the graphs do not depend on the number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        Random random(3);
        std::vector<Key2> keys;
        for (int i = 0; i < 30000; ++i) {
            keys.push_back({random.key(500), random.key(500)});
        }
        Tin tin = delaunay_tin(keys);
        constrain_segments(random, tin, 60);
        for (const Norm norm : {Norm(), Norm::lp(1), Norm::lp(3)}) {
            CAPTURE(norm_name(norm));
            std::vector<oracle::Edge> expected;
            std::vector<oracle::Edge> expected_marks;
            tbb::task_arena(1).execute([&] {
                expected = graph_of(tin, norm, LuneRim::Outside);
                expected_marks = marked_of(tin);
            });
            for (const int threads : {2, 4}) {
                tbb::task_arena(threads).execute([&] {
                    CHECK(graph_of(tin, norm, LuneRim::Outside) == expected);
                    CHECK(marked_of(tin) == expected_marks);
                });
            }
        }
    }

    TEST_CASE("turned by quarters and mirrored, the sites have the same neighbours") {
        using Location = std::pair<double, double>;
        using Locations = std::set<std::pair<Location, Location>>;
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Key2> keys;
            for (int i = 0; i < 200; ++i) {
                keys.push_back({random.key(64), random.key(64)});
            }
            const auto locations = [&](Norm norm, const auto& turned, const auto& turned_back) {
                std::vector<Key2> moved;
                for (const Key2 key : keys) {
                    moved.push_back(turned(key));
                }
                const Tin tin = delaunay_tin(moved);
                Locations result;
                for (const oracle::Edge& edge : graph_of(tin, norm, LuneRim::Outside)) {
                    const Key2 a = turned_back(tin.keys[edge[0]]);
                    const Key2 b = turned_back(tin.keys[edge[1]]);
                    result.insert(std::minmax(Location{a.x, a.y}, Location{b.x, b.y}));
                }
                return result;
            };
            for (const Norm norm : kNorms) {
                CAPTURE(norm_name(norm));
                const auto same = [](Key2 key) { return key; };
                const auto left = [](Key2 key) { return Key2{63 - key.y, key.x}; };
                const auto right = [](Key2 key) { return Key2{key.y, 63 - key.x}; };
                const auto mirrored = [](Key2 key) { return Key2{key.y, key.x}; };
                const Locations expected = locations(norm, same, same);
                CHECK(locations(norm, left, right) == expected);
                CHECK(locations(norm, mirrored, mirrored) == expected);
            }
        }
    }

    TEST_CASE("a callback that says stop cancels the work") {
        Random random(5);
        const Tin tin = delaunay_tin(key_families()[2].make(random, 100));
        const Progress stop = [](double) { return false; };
        CHECK_THROWS_AS(mark_relative_neighbors(tin.mesh, tin.keys, stop), Cancelled);
        for (const Norm norm : {Norm(), Norm::lp(1)}) {
            CHECK_THROWS_AS(
                make_relative_neighborhood_graph(tin.mesh, tin.keys, norm, LuneRim::Ordered, stop),
                Cancelled);
            CHECK_THROWS_AS(make_minimum_spanning_tree(tin.mesh, tin.keys, Norm::lp(3), stop), Cancelled);
        }
    }
}
