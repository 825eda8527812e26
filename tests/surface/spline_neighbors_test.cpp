#include "tinwright/surface/spline_neighbors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/ring_prediction.hpp"
#include "tinwright/surface/stretch_direction.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

Tin uniform_tin(Random& random, int count) {
    std::vector<Key2> keys;
    for (int i = 0; i < count; ++i) {
        keys.push_back({random.key(1e6), random.key(1e6)});
    }
    return delaunay_tin(keys);
}

VertexFan fan_of(const Tin& tin, const std::vector<HalfEdgeId>& starts, VertexId v) {
    HalfEdgeId corner = starts[v.value];
    while (!tin.mesh.is_terrain(face_of(corner))) {
        corner = next_around(tin.mesh, corner);
    }
    return find_fan(tin.mesh, {}, corner);
}

}  // namespace

TEST_SUITE("surface/spline_neighbors") {
    TEST_CASE("on a Delaunay TIN they are the nearest of each octant, the nearest others, and the joined") {
        for (int seed = 1; seed <= cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = uniform_tin(random, 300);
            const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
            const SharpEdges sharp;
            SplineNeighbors neighbors(tin, sharp, 24);
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                const auto found = neighbors.find(fan_of(tin, starts, {v}));
                const std::set<VertexId> set(found.begin(), found.end());
                REQUIRE(set.size() == found.size());
                REQUIRE(set.count({v}) == 0);
                REQUIRE(set.size() >= 24);
                for (std::size_t i = 1; i < found.size(); ++i) {
                    REQUIRE(squared_distance(tin.keys[v], tin.key(found[i - 1])) <=
                            squared_distance(tin.keys[v], tin.key(found[i])));
                }
                // Among all vertices the nearest three of each octant are there, unless a search of a hundred
                // vertices did not come so far.
                std::array<std::vector<std::pair<double, std::uint32_t>>, 8> octants;
                std::vector<std::pair<double, std::uint32_t>> all;
                for (std::uint32_t u = 0; u < tin.vertex_count(); ++u) {
                    const double dx = tin.keys[u].x - tin.keys[v].x;
                    const double dy = tin.keys[u].y - tin.keys[v].y;
                    if (u != v) {
                        const double turn = std::atan2(dy, dx) / (2 * std::acos(-1.0)) * 8;
                        const auto octant = static_cast<std::size_t>(std::floor(turn + 8)) % 8;
                        octants[octant].emplace_back(dx * dx + dy * dy, u);
                        all.emplace_back(dx * dx + dy * dy, u);
                    }
                }
                std::sort(all.begin(), all.end());
                for (auto& octant : octants) {
                    std::sort(octant.begin(), octant.end());
                    for (std::size_t i = 0; i < std::min<std::size_t>(3, octant.size()); ++i) {
                        if (octant[i] <= all[60]) {
                            REQUIRE(set.count({octant[i].second}) == 1);
                        }
                    }
                }
                visit_fan(tin.mesh, fan_of(tin, starts, {v}),
                          [&](HalfEdgeId h) { REQUIRE(set.count(tin.mesh.destination(h)) == 1); });
            }
        }
    }

    TEST_CASE("the hub of a wheel has neighbours all around, not all of its spokes") {
        std::vector<Key2> keys{{100000, 100000}};
        for (int i = 0; i < 2000; ++i) {
            const double angle = i * std::acos(-1.0) / 1000;
            keys.push_back(
                {std::round(100000 + 90000 * std::cos(angle)), std::round(100000 + 90000 * std::sin(angle))});
        }
        const Tin tin = delaunay_tin(keys);
        const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
        const SharpEdges sharp;
        SplineNeighbors neighbors(tin, sharp, 24);
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
            const auto found = neighbors.find(fan_of(tin, starts, {v}));
            REQUIRE(found.size() >= 8);
            REQUIRE(found.size() <= 24 + 40);
            if (tin.keys[v] == keys[0]) {
                std::set<int> octants;
                for (const VertexId u : found) {
                    const double turn = std::atan2(tin.key(u).y - keys[0].y, tin.key(u).x - keys[0].x);
                    octants.insert(static_cast<int>(std::floor(turn * 4 / std::acos(-1.0) + 8)) % 8);
                }
                REQUIRE(octants.size() == 8);
            }
        }
    }
}

TEST_SUITE("surface/ring_prediction") {
    TEST_CASE("the error is that of the Delaunay TIN without the vertex") {
        for (int seed = 1; seed <= cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = uniform_tin(random, 12);
            for (double& z : tin.z) {
                z = random.real();
            }
            const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                const auto error = ring_prediction_error(tin, fan_of(tin, starts, {v}));
                if (!error) {
                    continue;
                }
                std::vector<Key2> others;
                std::vector<double> z;
                for (std::uint32_t u = 0; u < tin.vertex_count(); ++u) {
                    if (u != v) {
                        others.push_back(tin.keys[u]);
                        z.push_back(tin.z[u]);
                    }
                }
                const Tin without = delaunay_tin(others);  // in curve order, as they were
                for (std::uint32_t f = 0; f < without.mesh.slot_count(); ++f) {
                    if (!without.mesh.is_terrain({f})) {
                        continue;
                    }
                    const auto& c = without.mesh.face({f}).vertex;
                    const Key2 at = tin.keys[v];
                    const Key2 p = without.key(c[0]);
                    const Key2 q = without.key(c[1]);
                    const Key2 r = without.key(c[2]);
                    const double of_p = doubled_area(at, q, r);
                    const double of_q = doubled_area(p, at, r);
                    const double of_r = doubled_area(p, q, at);
                    if (of_p >= 0 && of_q >= 0 && of_r >= 0) {
                        const double there =
                            (of_p * z[c[0].value] + of_q * z[c[1].value] + of_r * z[c[2].value]) /
                            doubled_area(p, q, r);
                        REQUIRE(std::abs(tin.z[v] - there - *error) < 1e-9);
                    }
                }
            }
        }
    }
}

TEST_SUITE("surface/stretch_direction") {
    TEST_CASE("the slope of a ridge varies across it") {
        Random random(3);
        Tin tin = uniform_tin(random, 400);
        const Point2 across{0.6, 0.8};
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
            tin.z[v] = std::cos((across.x * tin.keys[v].x + across.y * tin.keys[v].y) * 4e-6);
        }
        const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
        double sum = 0;
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
            const Point2 found = find_direction_of_change(tin, {}, fan_of(tin, starts, {v}));
            CHECK(std::abs(std::hypot(found.x, found.y) - 1) < 1e-12);
            sum += std::abs(found.x * across.x + found.y * across.y);
        }
        CHECK(sum > 0.9 * static_cast<double>(tin.vertex_count()));
    }

    TEST_CASE("a plane has no direction of change but along x") {
        Tin tin = delaunay_tin(grid_keys(5, 5));
        const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
        const Point2 found = find_direction_of_change(tin, {}, fan_of(tin, starts, {12}));
        CHECK(found.x == 1);
        CHECK(found.y == 0);
    }
}
