#include "tinwright/delaunay/constrained_delaunay.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/constrained_oracle.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

bool cross(Key2 a, Key2 b, Key2 c, Key2 d) {
    return oracle::orient2d(a, b, c) * oracle::orient2d(a, b, d) < 0 &&
           oracle::orient2d(c, d, a) * oracle::orient2d(c, d, b) < 0;
}

// Segments between vertices, at random, that do not cross each other.
std::vector<Segment> random_segments(Random& random, const Tin& tin, int tries) {
    std::vector<Segment> segments;
    const auto most = static_cast<std::int64_t>(tin.vertex_count()) - 1;
    for (int i = 0; i < tries; ++i) {
        const VertexId a{static_cast<std::uint32_t>(random.integer(0, most))};
        const VertexId b{static_cast<std::uint32_t>(random.integer(0, most))};
        if (a != b && std::none_of(segments.begin(), segments.end(), [&](const Segment& s) {
                return cross(tin.key(a), tin.key(b), tin.key(s.a), tin.key(s.b));
            })) {
            segments.push_back({a, b});
        }
    }
    return segments;
}

// Segments as chains of their edges: each vertex on the way, exactly.
bool are_chains(const Tin& tin, const std::vector<Segment>& segments, std::vector<SegmentEdge> edges) {
    std::sort(edges.begin(), edges.end(),
              [](const SegmentEdge& x, const SegmentEdge& y) { return x.segment < y.segment; });
    auto edge = edges.begin();
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
        std::vector<VertexId> ends;
        for (; edge != edges.end() && edge->segment == i; ++edge) {
            for (const VertexId v : {edge->a, edge->b}) {
                if (oracle::orient2d(tin.key(segments[i].a), tin.key(segments[i].b), tin.key(v)) != 0) {
                    return false;
                }
                ends.push_back(v);
            }
        }
        ends.push_back(segments[i].a);
        ends.push_back(segments[i].b);
        std::sort(ends.begin(), ends.end());
        for (std::size_t k = 0; k < ends.size(); k += 2) {
            if (k + 1 == ends.size() || ends[k] != ends[k + 1] ||
                (k + 2 < ends.size() && ends[k + 2] == ends[k])) {
                return false;
            }
        }
    }
    return edge == edges.end();
}

}  // namespace

TEST_SUITE("delaunay/constrained_delaunay") {
    TEST_CASE("every segment becomes a chain of constrained edges in a constrained Delaunay triangulation") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 1; seed <= cases(60); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(random.integer(4, 120))));
                const std::vector<Segment> segments = random_segments(random, tin, 40);
                const std::vector<SegmentEdge> edges = insert_segments(tin.mesh, tin.keys, segments);
                REQUIRE(constrained_delaunay_defect(tin) == "");
                REQUIRE(are_chains(tin, segments, edges));
            }
        }
    }

    TEST_CASE("the order and direction of segments do not change the triangulation") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 1; seed <= cases(20); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = delaunay_tin(family.make(random, 80));
                Tin other = tin;
                std::vector<Segment> segments = random_segments(random, tin, 40);
                insert_segments(tin.mesh, tin.keys, segments);
                segments = shuffled(random, segments);
                for (Segment& segment : segments) {
                    if (random.integer(0, 1) == 1) {
                        std::swap(segment.a, segment.b);
                    }
                }
                insert_segments(other.mesh, other.keys, segments);
                REQUIRE(terrain_of(tin.mesh) == terrain_of(other.mesh));
            }
        }
    }

    TEST_CASE("a segment across a constrained edge is refused") {
        Tin tin = delaunay_tin({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
        const std::vector<Segment> diagonals = {{{0}, {3}}, {{1}, {2}}};
        CHECK_THROWS_AS(insert_segments(tin.mesh, tin.keys, diagonals), InputError);
    }
}
