#include "tinwright/optimal/polygon_dp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

namespace {

using namespace tinwright;
using namespace tinwright_tests;

using Ring = std::vector<Key2>;
using RingFaces = std::vector<std::array<std::uint32_t, 3>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// All ways to divide the part i..j of a ring, whatever its shape, into triples.
std::vector<RingFaces> all_divisions(std::uint32_t i, std::uint32_t j) {
    if (j - i < 2) {
        return {{}};
    }
    std::vector<RingFaces> all;
    for (std::uint32_t k = i + 1; k < j; ++k) {
        for (const RingFaces& first : all_divisions(i, k)) {
            for (const RingFaces& second : all_divisions(k, j)) {
                RingFaces faces{{i, k, j}};
                faces.insert(faces.end(), first.begin(), first.end());
                faces.insert(faces.end(), second.begin(), second.end());
                all.push_back(std::move(faces));
            }
        }
    }
    return all;
}

/// Whether faces tile a ring by definition: each has area, no two overlap, and their areas make up the
/// ring's.
bool is_tiling(const Ring& ring, const RingFaces& faces) {
    std::vector<std::array<Key2, 3>> triangles;
    for (const auto& [i, k, j] : faces) {
        if (oracle::orient2d(ring[i], ring[k], ring[j]) <= 0) {
            return false;
        }
        triangles.push_back({ring[i], ring[k], ring[j]});
    }
    for (std::size_t a = 0; a < triangles.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (oracle::do_interiors_meet(triangles[a], triangles[b])) {
                return false;
            }
        }
    }
    return oracle::twice_area_of_faces(triangles) == oracle::twice_area(ring);
}

std::vector<RingFaces> all_triangulations(const Ring& ring) {
    std::vector<RingFaces> all = all_divisions(0, static_cast<std::uint32_t>(ring.size() - 1));
    std::erase_if(all, [&](const RingFaces& faces) { return !is_tiling(ring, faces); });
    return all;
}

double cost_of(const RingFaces& faces, const RingMeasure& measure, PolygonCost cost) {
    double total = cost == PolygonCost::Sum ? 0.0 : -kInfinity;
    for (const auto& [i, k, j] : faces) {
        const double value = measure(i, k, j);
        if (!(value < kInfinity)) {
            return kInfinity;
        }
        total = cost == PolygonCost::Sum ? total + value : std::max(total, value);
    }
    return total;
}

/// A measure without any sense in it: a whole number for each triple, some of them forbidden.
RingMeasure random_measure(std::uint64_t seed, int forbidden_percent) {
    return [seed, forbidden_percent](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
        Random random(seed + i * 10007 + k * 101 + j);
        if (random.integer(0, 99) < forbidden_percent) {
            return random.integer(0, 1) == 0 ? kInfinity : std::nan("");
        }
        return static_cast<double>(random.integer(-20, 20));
    };
}

/// The least cost over all triangulations, infinity if there is none.
double least_cost(const std::vector<RingFaces>& all, const RingMeasure& measure, PolygonCost cost) {
    double least = kInfinity;
    for (const RingFaces& faces : all) {
        const double total = cost_of(faces, measure, cost);
        least = total < least ? total : least;
    }
    return least;
}

void check_against_all(const Ring& ring, std::uint64_t seed) {
    const std::vector<RingFaces> all = all_triangulations(ring);
    for (const PolygonCost cost : {PolygonCost::Maximum, PolygonCost::Sum}) {
        for (const int forbidden : {0, 20, 60}) {
            CAPTURE(forbidden);
            const RingMeasure measure = random_measure(seed, forbidden);
            const auto result = triangulate_polygon(ring, measure, cost);
            const double least = least_cost(all, measure, cost);
            REQUIRE(result.has_value() == (least < kInfinity));
            if (result) {
                CHECK(result->cost == least);
                CHECK(result->faces.size() == ring.size() - 2);
                CHECK(is_tiling(ring, result->faces));
                CHECK(cost_of(result->faces, measure, cost) == least);
            }
        }
    }
}

/// The rim of `count` faces of a Delaunay TIN that hang together along a tree of shared edges, and of those
/// edges alone: every other edge between two of them is a crack.
Ring random_ring(Random& random, const Tin& tin, std::size_t count) {
    const TriangleMesh& mesh = tin.mesh;
    FaceId first{};
    do {
        first.value =
            static_cast<std::uint32_t>(random.integer(0, static_cast<std::int64_t>(mesh.slot_count()) - 1));
    } while (!mesh.is_terrain(first));
    std::set<std::uint32_t> faces{first.value};
    std::vector<HalfEdgeId> rim{half_edge(first, 0), half_edge(first, 1), half_edge(first, 2)};
    for (int tries = 0; faces.size() < count && tries < 100; ++tries) {
        const auto place =
            static_cast<std::ptrdiff_t>(random.integer(0, static_cast<std::int64_t>(rim.size()) - 1));
        const HalfEdgeId behind = mesh.twin(rim[static_cast<std::size_t>(place)]);
        if (mesh.is_terrain(face_of(behind)) && faces.insert(face_of(behind).value).second) {
            rim[static_cast<std::size_t>(place)] = next(behind);
            rim.insert(rim.begin() + place + 1, previous(behind));
        }
    }
    Ring ring;
    for (const HalfEdgeId h : rim) {
        ring.push_back(tin.key(mesh.origin(h)));
    }
    return ring;
}

double length(Key2 a, Key2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

TEST_SUITE("optimal/polygon_dp") {
    TEST_CASE("a convex polygon has as many triangulations to choose from as Catalan counts") {
        const std::array<std::size_t, 6> catalan{1, 2, 5, 14, 42, 132};
        for (std::size_t n = 3; n < 9; ++n) {
            Ring ring;
            for (std::size_t i = 0; i < n; ++i) {
                const auto x = static_cast<double>(i);
                ring.push_back({x, x * x});
            }
            const std::vector<RingFaces> all = all_triangulations(ring);
            CHECK(all.size() == catalan[n - 3]);
            // Whichever of them is the only one allowed is found.
            for (const RingFaces& wanted : all) {
                const RingMeasure measure = [&](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
                    const std::array<std::uint32_t, 3> face{i, k, j};
                    return std::find(wanted.begin(), wanted.end(), face) == wanted.end() ? kInfinity : 1.0;
                };
                const auto result = triangulate_polygon(ring, measure);
                REQUIRE(result.has_value());
                CHECK(result->faces == wanted);
            }
        }
    }

    TEST_CASE("star-shaped polygons get the least of all triangulations") {
        for (int seed = 0; seed < cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<double> angles;
            for (int i = 0; i < 7; ++i) {
                angles.push_back(i + 0.9 * random.real());
            }
            Ring ring;
            for (const double angle : angles) {
                const double radius = 100 + 900 * random.real();
                ring.push_back({std::round(radius * std::cos(angle * 0.897)),
                                std::round(radius * std::sin(angle * 0.897))});
            }
            check_against_all(ring, random.next());
        }
    }

    TEST_CASE("polygons with cracks and collinear vertices get the least of all triangulations") {
        int cracks = 0;
        int straight = 0;
        for (int seed = 0; seed < cases(150); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Ring keys = grid_keys(4, 4);
            if (seed % 2 == 0) {
                for (Key2& key : keys) {
                    key = {random.key(9), random.key(9)};
                }
            }
            const Tin tin = delaunay_tin(without_repetitions(std::move(keys)));
            const Ring ring = random_ring(random, tin, static_cast<std::size_t>(random.integer(3, 6)));
            cracks += without_repetitions(ring).size() < ring.size() ? 1 : 0;
            for (std::size_t i = 2; i < ring.size(); ++i) {
                straight += oracle::orient2d(ring[i - 2], ring[i - 1], ring[i]) == 0 ? 1 : 0;
            }
            CHECK(triangulate_polygon(ring, random_measure(0, 0)).has_value());
            check_against_all(ring, random.next());
        }
        CHECK(cracks > cases(10));
        CHECK(straight > 10);
    }

    TEST_CASE("a crack that ends inside is gone round") {
        // A square, and an edge from a corner to its middle, which is no corner of the ring's outside.
        const Ring ring{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {2, 2}};
        const auto result = triangulate_polygon(
            ring, [](auto, auto, auto) { return 1.0; }, PolygonCost::Sum);
        REQUIRE(result.has_value());
        CHECK(result->cost == 4);
        CHECK(is_tiling(ring, result->faces));
        CHECK(all_triangulations(ring).size() == 1);
    }

    TEST_CASE("half the perimeter as measure gives the minimum weight") {
        for (int seed = 0; seed < cases(30); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Ring keys;
            for (int i = 0; i < 14; ++i) {
                keys.push_back({random.key(1000), random.key(1000)});
            }
            const Ring ring = random_ring(random, delaunay_tin(keys), 6);
            const auto result = triangulate_polygon(
                ring,
                [&ring](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
                    return (length(ring[i], ring[k]) + length(ring[k], ring[j]) + length(ring[j], ring[i])) /
                           2;
                },
                PolygonCost::Sum);
            double least = kInfinity;
            for (const RingFaces& faces : all_triangulations(ring)) {
                std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
                for (const auto& [i, k, j] : faces) {
                    edges.insert({{i, k}, {k, j}, {i, j}});
                }
                double weight = 0;
                for (const auto& [i, j] : edges) {
                    const bool is_of_ring = j == i + 1 || (i == 0 && j + 1 == ring.size());
                    weight += length(ring[i], ring[j]) / (is_of_ring ? 2 : 1);
                }
                least = std::min(least, weight);
            }
            REQUIRE(result.has_value());
            CHECK(result->cost == doctest::Approx(least).epsilon(1e-12));
        }
    }

    TEST_CASE("a hundred vertices on a line of a convex ring are all reached") {
        Ring ring{{0, 1}};
        for (int i = 0; i < 100; ++i) {
            ring.push_back({static_cast<double>(i), 0});
        }
        const auto result = triangulate_polygon(
            ring, [](std::uint32_t i, auto, auto) { return static_cast<double>(i); }, PolygonCost::Maximum);
        REQUIRE(result.has_value());
        CHECK(result->cost == 0);
        CHECK(result->faces.size() == 99);
    }

    TEST_CASE("of equal triangulations the one with the first middle corners is taken") {
        const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const auto result = triangulate_polygon(square, [](auto, auto, auto) { return 7.0; });
        REQUIRE(result.has_value());
        CHECK(result->faces == RingFaces{{0, 1, 3}, {1, 2, 3}});
        CHECK(result->cost == 7);
    }

    TEST_CASE("what cannot be triangulated gives nothing") {
        const auto fine = [](auto, auto, auto) { return 1.0; };
        CHECK_FALSE(triangulate_polygon({}, fine).has_value());
        CHECK_FALSE(triangulate_polygon(Ring{{0, 0}, {1, 0}}, fine).has_value());
        CHECK_FALSE(triangulate_polygon(Ring{{0, 0}, {1, 0}, {2, 0}}, fine).has_value());
        CHECK_FALSE(triangulate_polygon(Ring{{0, 0}, {0, 1}, {1, 1}, {1, 0}}, fine).has_value());
        const auto never = [](auto, auto, auto) { return kInfinity; };
        CHECK_FALSE(triangulate_polygon(Ring{{0, 0}, {1, 0}, {0, 1}}, never).has_value());
    }

    TEST_CASE("a table that grew and shrank knows the same as a new one") {
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Ring keys;
            for (int i = 0; i < 12; ++i) {
                keys.push_back({random.key(50), random.key(50)});
            }
            const Ring ring = random_ring(random, delaunay_tin(keys), 7);
            const auto last = static_cast<std::uint32_t>(ring.size() - 1);
            for (const PolygonCost cost : {PolygonCost::Maximum, PolygonCost::Sum}) {
                const RingMeasure measure = random_measure(static_cast<std::uint64_t>(seed), 30);
                PolygonTable table(measure, cost);
                for (int turn = 0; turn < 12; ++turn) {
                    table.truncate(
                        static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(table.size()))));
                    // What was learnt of other vertices must not stay.
                    table.push_back({random.key(50), random.key(50)});
                    if (table.size() > 2) {
                        static_cast<void>(table.cost(0, static_cast<std::uint32_t>(table.size() - 1)));
                    }
                    table.truncate(table.size() - 1);
                    while (table.size() < ring.size()) {
                        table.push_back(ring[table.size()]);
                    }
                    const auto fresh = triangulate_polygon(ring, measure, cost);
                    REQUIRE(table.cost(0, last) == (fresh ? fresh->cost : kInfinity));
                    if (fresh) {
                        REQUIRE(table.faces(0, last) == fresh->faces);
                    }
                }
            }
        }
    }

    TEST_CASE("a measure of two infinities asks whether there is a triangulation") {
        for (int seed = 0; seed < cases(200); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Ring ring = random_ring(random, delaunay_tin(grid_keys(4, 4)), 6);
            const RingMeasure numbers = random_measure(static_cast<std::uint64_t>(seed), 40);
            const RingMeasure infinities = [&numbers](auto i, auto k, auto j) {
                return numbers(i, k, j) < kInfinity ? -kInfinity : kInfinity;
            };
            const auto result = triangulate_polygon(ring, infinities);
            CHECK(result.has_value() == triangulate_polygon(ring, numbers).has_value());
            if (result) {
                CHECK(result->cost == -kInfinity);
                CHECK(is_tiling(ring, result->faces));
                CHECK(cost_of(result->faces, numbers, PolygonCost::Maximum) < kInfinity);
            }
        }
    }

    TEST_CASE("it can be stopped") {
        const Ring ring{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        CHECK_THROWS_AS(triangulate_polygon(
                            ring, [](auto, auto, auto) { return 1.0; }, PolygonCost::Maximum,
                            [](double) { return false; }),
                        Cancelled);
    }
}
