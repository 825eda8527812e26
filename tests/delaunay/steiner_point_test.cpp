#include "tinwright/delaunay/steiner_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/border_points.hpp"
#include "tinwright/delaunay/constrained_delaunay.hpp"

#include "support/cases.hpp"
#include "support/constrained_oracle.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

// A TIN of random keys, far apart, with one traced line from its first to its last vertex.
Tin tin_with_line(Random& random, std::size_t count) {
    std::vector<Key2> keys;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back({random.key(1e9), random.key(1e9)});
    }
    Tin tin = delaunay_tin(keys);
    for (std::size_t v = 0; v < tin.vertex_count(); ++v) {
        tin.z[v] = 100 * random.real();
    }
    const std::vector<Segment> line = {{{0}, {static_cast<std::uint32_t>(tin.vertex_count() - 1)}}};
    for (const SegmentEdge& edge : insert_segments(tin.mesh, tin.keys, line)) {
        tin.traces.push_back({edge.a, edge.b, 0});
    }
    return tin;
}

}  // namespace

TEST_SUITE("delaunay/steiner_point") {
    TEST_CASE("splits and free vertices leave a constrained Delaunay TIN in the order of the curve") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = tin_with_line(random, 40);
            const std::size_t old_traces = tin.traces.size();
            const Key2 a = tin.keys.front();
            const Key2 b = tin.keys.back();
            SteinerInserter inserter(tin);
            std::size_t splits = 0;
            std::size_t free_vertices = 0;
            std::vector<VertexId> ends = {tin.traces[0].a, tin.traces[0].b};
            for (int i = 0; i < 20; ++i) {
                const std::optional<HalfEdgeId> h = inserter.find_half_edge(ends[0], ends[1]);
                REQUIRE(h.has_value());
                if (const auto made = inserter.split(*h, 0.1 + 0.8 * random.real())) {
                    ++splits;
                    ends[static_cast<std::size_t>(random.integer(0, 1))] = *made;
                }
                if (inserter.insert({random.key(1e9), random.key(1e9)}, 5, ends[0])) {
                    ++free_vertices;
                }
            }
            inserter.finish();
            REQUIRE(splits + free_vertices > 10);
            REQUIRE(tin.traces.size() == old_traces + splits);
            REQUIRE(constrained_delaunay_defect(tin) == "");
            for (const LineTrace& trace : tin.traces) {
                for (const VertexId v : {trace.a, trace.b}) {
                    const double length = std::hypot(b.x - a.x, b.y - a.y);
                    REQUIRE(std::abs((b.x - a.x) * (tin.key(v).y - a.y) -
                                     (b.y - a.y) * (tin.key(v).x - a.x)) <= length);
                }
            }
        }
    }

    TEST_CASE("a Steiner point's elevation is linear along its edge") {
        Tin tin = delaunay_tin({{0, 0}, {1000, 1000}, {0, 2000}, {3000, 0}, {4000, 4000}});
        const auto at = [&](double x) {
            return static_cast<std::uint32_t>(std::find(tin.keys.begin(), tin.keys.end(), Key2{x, x}) -
                                              tin.keys.begin());
        };
        const std::uint32_t first = at(1000);
        const std::uint32_t last = at(4000);
        tin.z[first] = 10;
        tin.z[last] = 40;
        const std::vector<Segment> line = {{{first}, {last}}};
        insert_segments(tin.mesh, tin.keys, line);
        tin.traces = {{{std::min(first, last)}, {std::max(first, last)}, 7}};
        SteinerInserter inserter(tin);
        const std::optional<HalfEdgeId> h = inserter.find_half_edge({first}, {last});
        REQUIRE(h.has_value());
        REQUIRE(inserter.split(*h, 0.5).has_value());
        CHECK(inserter.tin().keys.back() == Key2{2500, 2500});
        CHECK(inserter.tin().z.back() == doctest::Approx(25));
        inserter.finish();
        REQUIRE(tin.traces.size() == 2);
        CHECK(tin.traces[0].line == 7);
    }

    TEST_CASE("there is no room to split an edge of one step, and none for a vertex that is there") {
        Tin tin = delaunay_tin({{1, 1}, {2, 2}, {0, 4}, {4, 0}, {9, 9}});
        const std::vector<Segment> line = {{{0}, {1}}};
        for (std::uint32_t v = 1; v < 5; ++v) {
            REQUIRE_FALSE(tin.keys[0] == tin.keys[v]);
        }
        insert_segments(tin.mesh, tin.keys, line);
        tin.traces = {{{0}, {1}, 0}};
        SteinerInserter inserter(tin);
        const std::optional<HalfEdgeId> h = inserter.find_half_edge({0}, {1});
        REQUIRE(h.has_value());
        CHECK_FALSE(inserter.split(*h, 0.5).has_value());
        CHECK_FALSE(inserter.insert({2, 2}, 0, {0}).has_value());
        CHECK_FALSE(inserter.insert({0, 0}, 0, {0}).has_value());
        CHECK_FALSE(inserter.insert({100, 3}, 0, {0}).has_value());
        inserter.finish();
        CHECK(tin.vertex_count() == 5);
    }
}

TEST_SUITE("delaunay/border_points") {
    TEST_CASE("border points lie exactly on their segment, one an edge crossed") {
        for (int seed = 1; seed <= cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Key2> keys;
            for (int i = 0; i < 60; ++i) {
                keys.push_back({1048576.0 * random.key(1000), 1048576.0 * random.key(1000)});
            }
            Tin tin = delaunay_tin(keys);
            const std::vector<Segment> segment = {
                {{0}, {static_cast<std::uint32_t>(tin.vertex_count() - 1)}}};
            const std::vector<Key2> points = find_border_points(tin.mesh, tin.keys, segment);
            for (const Key2 point : points) {
                REQUIRE(oracle::orient2d(tin.keys.front(), tin.keys.back(), point) == 0);
            }
            // With a vertex at every crossing the segment is a chain that crosses nothing.
            std::vector<Key2> all(tin.keys.begin(), tin.keys.end());
            all.insert(all.end(), points.begin(), points.end());
            REQUIRE(in_curve_order(all).size() == all.size());
        }
    }
}
