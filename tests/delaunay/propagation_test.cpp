#include "tinwright/delaunay/propagation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/conforming_delaunay.hpp"
#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/constrained_oracle.hpp"
#include "support/line_sets.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
constexpr double kFine = 1048576;  // steps of the refined lattice in one of the data's

using KeyEdges = std::vector<std::pair<Key2, Key2>>;

/// Vertices and edges of lines that do not cross, on the data's lattice.
struct Graph {
    std::vector<Key2> keys;
    KeyEdges edges;

    void add(Key2 a, Key2 b) {
        keys.insert(keys.end(), {a, b});
        edges.emplace_back(a, b);
    }
};

Key2 fine(Key2 key) { return {kFine * key.x, kFine * key.y}; }

// The constrained Delaunay TIN of a graph on the refined lattice; z is 3 x + 5 y.
Tin tin_of(const Graph& graph) {
    std::vector<Key2> keys;
    for (const Key2 key : graph.keys) {
        keys.push_back(fine(key));
    }
    Tin tin = delaunay_tin(keys);
    std::map<std::pair<double, double>, std::uint32_t> ids;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        ids[{tin.keys[v].x, tin.keys[v].y}] = v;
        tin.z[v] = 3 * tin.keys[v].x + 5 * tin.keys[v].y;
    }
    std::vector<Segment> segments;
    for (const auto& [a, b] : graph.edges) {
        segments.push_back({{ids.at({fine(a).x, fine(a).y})}, {ids.at({fine(b).x, fine(b).y})}});
    }
    for (const SegmentEdge& edge : insert_segments(tin.mesh, tin.keys, segments)) {
        tin.traces.push_back({edge.a, edge.b, edge.segment, 1});
    }
    std::sort(tin.traces.begin(), tin.traces.end());
    return tin;
}

bool cross(const std::pair<Key2, Key2>& s, const std::pair<Key2, Key2>& t) {
    return oracle::orient2d(s.first, s.second, t.first) * oracle::orient2d(s.first, s.second, t.second) <=
               0 &&
           oracle::orient2d(t.first, t.second, s.first) * oracle::orient2d(t.first, t.second, s.second) <= 0;
}

// Points, and edges at random that meet nothing.
Graph scatter(Random& random) {
    Graph graph;
    for (int i = 0; i < 80; ++i) {
        graph.keys.push_back({random.key(1000), random.key(1000)});
    }
    for (int i = 0; i < 60; ++i) {
        const std::pair<Key2, Key2> edge{{random.key(1000), random.key(1000)},
                                         {random.key(1000), random.key(1000)}};
        if (std::none_of(graph.edges.begin(), graph.edges.end(),
                         [&](const auto& other) { return cross(edge, other); })) {
            graph.add(edge.first, edge.second);
        }
    }
    graph.keys = without_repetitions(graph.keys);
    return graph;
}

// The lower bound of [tan1993, Fig. 6.1].
Graph stack(Random& random) {
    Graph graph;
    const auto edges = static_cast<int>(random.integer(2, 12));
    const auto pairs = static_cast<int>(random.integer(1, 6));
    for (int i = 0; i < edges; ++i) {
        graph.add({0, 1000.0 + i}, {1000.0 * (pairs + 1), 1000.0 + i});
    }
    for (int i = 1; i <= pairs; ++i) {
        graph.keys.push_back({1000.0 * i, 1000 - 3});
        graph.keys.push_back({1000.0 * i + 2, 1000.0 + edges + 2});
    }
    return graph;
}

// Edges from one vertex with sharp angles between them, and points around.
Graph fan_graph(Random& random) {
    Graph graph;
    double angle = 6.28 * random.real();
    for (int i = 0; i < 6; ++i, angle += 0.02 + 0.14 * random.real()) {
        const double length = 800 + 600 * random.real();
        graph.add({2000, 2000},
                  {std::round(2000 + length * std::cos(angle)), std::round(2000 + length * std::sin(angle))});
    }
    for (int i = 0; i < 20; ++i) {
        graph.keys.push_back({random.key(4000), random.key(4000)});
    }
    return graph;
}

// Rings in rings, closer to each other than their edges are long.
Graph rings(Random& random) {
    Graph graph;
    const double turn = random.real();
    constexpr int kCorners = 24;
    for (int ring = 0; ring < 8; ++ring) {
        const auto corner = [&](int i) {
            const double angle = 6.283185307179586 * (i % kCorners) / kCorners + turn;
            const double radius = 1000 + 20 * ring;
            return Key2{std::round(2000 + radius * std::cos(angle)),
                        std::round(2000 + radius * std::sin(angle))};
        };
        for (int i = 0; i < kCorners; ++i) {
            graph.add(corner(i), corner(i + 1));
        }
    }
    return graph;
}

struct GraphFamily {
    const char* name;
    Graph (*make)(Random& random);
};
constexpr std::array kGraphFamilies{GraphFamily{"scatter", scatter}, GraphFamily{"stack", stack},
                                    GraphFamily{"fan", fan_graph}, GraphFamily{"rings", rings}};

template <class Check>
void for_each_graph(int seeds, const Check& check) {
    for (const GraphFamily& family : kGraphFamilies) {
        CAPTURE(std::string(family.name));
        for (int seed = 1; seed <= cases(seeds); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            check(random, family.make(random));
        }
    }
}

BlockingReport block(Tin& tin, std::size_t max_steiner = kUnlimited) {
    SteinerInserter inserter(tin);
    BlockingReport report = block_and_propagate(inserter, max_steiner, {});
    inserter.finish();
    return report;
}

// Positions, elevations and edges of lines, without the numbers that depend on the order of the lines.
auto essence_of(const Tin& tin) {
    std::vector<std::pair<VertexId, VertexId>> edges;
    for (const LineTrace& trace : tin.traces) {
        edges.emplace_back(trace.a, trace.b);
    }
    std::vector<std::array<double, 3>> vertices;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        vertices.push_back({tin.keys[v].x, tin.keys[v].y, tin.z[v]});
    }
    return std::tuple(vertices, edges, terrain_of(tin.mesh));
}

}  // namespace

TEST_SUITE("delaunay/propagation") {
    TEST_CASE("vertices stay within the bounds of Theorem 6.7, kind by kind") {
        std::size_t touching = 0;
        for_each_graph(20, [&](Random& /*random*/, const Graph& graph) {
            Tin tin = tin_of(graph);
            const std::size_t n = tin.vertex_count();
            const std::size_t m = graph.edges.size();
            const BlockingReport report = block(tin);
            touching += report.touching_vertices;
            CHECK(report.is_within_budget);
            CHECK(report.disks == n - 1);
            CHECK(report.circle_vertices <= (2 * m - 1) * (n - 1));
            CHECK(report.touching_vertices <= n - 2);
            CHECK(report.propagated_vertices <=
                  3 * m * (n + report.touching_vertices) + 2 * (m - 1) * report.circle_vertices);
            CHECK(tin.vertex_count() ==
                  n + report.circle_vertices + report.touching_vertices + report.propagated_vertices);
            CHECK(tin.vertex_count() < 4 * m * m * n + 10 * m * n + 4 * n);
        });
        CHECK(touching > 0);  // or the walls would not have been tried
    }

    TEST_CASE("no propagation sequence has two vertices on one edge of a line") {
        std::size_t longest = 0;
        for_each_graph(20, [&](Random& /*random*/, const Graph& graph) {
            Tin tin = tin_of(graph);
            SteinerInserter inserter(tin);
            const BlockingReport report = block_and_propagate(inserter, kUnlimited, {});
            std::map<VertexId, VertexId> source(report.projections.begin(), report.projections.end());
            CHECK(source.size() == report.propagated_vertices);
            std::size_t repeated = 0;
            for (const auto& [made, first_source] : report.projections) {
                std::set<std::uint32_t> met;
                VertexId v = made;
                for (std::size_t length = 1;; ++length) {
                    const bool is_steiner = v.value >= inserter.old_vertex_count();
                    const std::uint32_t edge =
                        is_steiner ? inserter.line_edge_of(v, v) : SteinerInserter::kFree;
                    repeated += edge != SteinerInserter::kFree && !met.insert(edge).second ? 1U : 0U;
                    const auto before = source.find(v);
                    if (before == source.end()) {
                        longest = std::max(longest, length - 1);
                        break;
                    }
                    v = before->second;
                }
            }
            CHECK(repeated == 0);
        });
        CHECK(longest >= 10);
    }

    TEST_CASE("the TIN stays constrained Delaunay, and rounding opens next to no edge") {
        std::size_t open = 0;
        std::size_t edges = 0;
        for_each_graph(10, [&](Random& /*random*/, const Graph& graph) {
            Tin tin = tin_of(graph);
            block(tin);
            CHECK(constrained_delaunay_defect(tin) == "");
            open += count_open_edges(tin);
            edges += tin.traces.size();
        });
        CAPTURE(open);
        CHECK(1000 * open <= edges);
    }

    TEST_CASE("edges that nothing disturbs are left whole") {
        for (int seed = 1; seed <= cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Graph graph;
            for (int i = 0; i < 200; ++i) {
                graph.keys.push_back({random.key(1000), random.key(1000)});
            }
            const Tin plain = delaunay_tin(graph.keys);
            for (const GraphEdge& edge : make_minimum_spanning_tree(plain.mesh, plain.keys)) {
                graph.edges.emplace_back(plain.key(edge.a), plain.key(edge.b));
            }
            Tin tin = tin_of(graph);
            const std::size_t before = tin.vertex_count();
            block(tin);
            CHECK(tin.vertex_count() == before);
        }
        // An edge of the hull, which is Delaunay however close to it a vertex is.
        Tin tin = tin_of({{{0, 0}, {1000, 0}, {500, 1}, {500, 900}}, {{{0, 0}, {1000, 0}}}});
        block(tin);
        CHECK(tin.vertex_count() == 4);
        CHECK(count_open_edges(tin) == 0);
    }

    TEST_CASE("a vertex beside an edge is projected onto it") {
        Graph graph{{{500, 10}, {500, 900}, {500, -900}}, {}};
        for (Key2& key : graph.keys) {
            key.y += 1000;
        }
        graph.add({0, 1000}, {1000, 1000});
        Tin tin = tin_of(graph);
        const BlockingReport report = block(tin);
        CHECK(report.circle_vertices + report.propagated_vertices >= 1);
        CHECK(count_open_edges(tin) == 0);
        CHECK(empty_disk_defect(tin) == "");
    }

    TEST_CASE("elevations of Steiner points are linear along lines and in faces") {
        for_each_graph(5, [](Random& /*random*/, const Graph& graph) {
            Tin tin = tin_of(graph);
            block(tin);
            double worst = 0;
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                worst = std::max(worst, std::abs(tin.z[v] - (3 * tin.keys[v].x + 5 * tin.keys[v].y)));
            }
            CHECK(worst <= 10);  // half a step beside the line in x or y, and rounding, in steps of 2^-20
        });
    }

    TEST_CASE("the order and the directions of lines do not matter") {
        for_each_graph(5, [](Random& random, Graph graph) {
            Tin first = tin_of(graph);
            block(first);
            graph.edges = shuffled(random, graph.edges);
            for (auto& [a, b] : graph.edges) {
                if (random.integer(0, 1) == 1) {
                    std::swap(a, b);
                }
            }
            Tin second = tin_of(graph);
            block(second);
            CHECK(essence_of(first) == essence_of(second));
        });
    }

    TEST_CASE("the budget is kept, and a TIN that is stopped by it is sound") {
        for_each_graph(3, [](Random& random, const Graph& graph) {
            Tin tin = tin_of(graph);
            Tin all = tin;
            const BlockingReport whole = block(all);
            const std::size_t needed = all.vertex_count() - tin.vertex_count();
            if (needed == 0) {
                return;
            }
            const std::size_t before = tin.vertex_count();
            const auto budget =
                static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(needed) - 1));
            const BlockingReport report = block(tin, budget);
            CHECK(tin.vertex_count() == before + budget);
            CHECK(!report.is_within_budget);
            CHECK(constrained_delaunay_defect(tin) == "");
            CHECK(whole.is_within_budget);
        });
    }

    TEST_CASE("stops when told to") {
        Random random(1);
        Tin tin = tin_of(stack(random));
        SteinerInserter inserter(tin);
        CHECK_THROWS_AS(block_and_propagate(inserter, kUnlimited, [](double) { return false; }), Cancelled);
    }

    TEST_CASE("lines of every family conform, but where they come within steps of the refined lattice") {
        const std::set<std::string> tight{"hub", "hair crossings", "parallel lines", "shifted by a unit"};
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 1; seed <= cases(2); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                LineSet set = family.make(random, 12);
                for (int i = 0; i < 12; ++i) {
                    set.samples.push_back(survey_point(random.integer(0, 20000), random.integer(0, 20000)));
                }
                ConstrainedTinOptions options;
                options.duplicates = {.policy = DuplicatePolicy::Mean, .tolerance = 0};
                options.noding.crossing_z = CrossingPolicy::Mean;
                options.wants_fine_lattice = true;
                Tin tin = make_constrained_tin(set.samples, set.lines, options).tin;
                const ConformingReport report =
                    make_conforming(tin, {.method = ConformingMethod::Blocking, .max_steiner = 3000});
                CHECK((report.is_conforming || tight.contains(family.name)));
                CHECK(report.open_edges == count_open_edges(tin));
                CHECK(constrained_delaunay_defect(tin) == "");
                CHECK((!report.is_conforming || empty_disk_defect(tin).empty()));
                CHECK(chain_defect(tin, set.lines, 1) == "");
            }
        }
    }
}
