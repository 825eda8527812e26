#include "tinwright/mesh/tin_check.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/mesh/mesh_check.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

std::size_t count_of(const TinCheckReport& report, int invariant) {
    return static_cast<std::size_t>(
        std::count_if(report.violations.begin(), report.violations.end(),
                      [&](const TinViolation& v) { return v.invariant == invariant; }));
}

bool names(const TinCheckReport& report, int invariant, const std::string& text) {
    return std::any_of(report.violations.begin(), report.violations.end(),
                       [&](const TinViolation& v) { return v.invariant == invariant && v.text == text; });
}

Tin clean_tin() {
    Random random(4);
    Tin tin = delaunay_tin(key_families()[2].make(random, 100));
    REQUIRE(check_tin(tin).is_clean());
    REQUIRE(check_delaunay(tin).is_clean());
    return tin;
}

/// A TIN of the keys' given faces; corners are indices into `keys` as handed in.
Tin tin_with_faces(const std::vector<Key2>& keys, const std::vector<std::uint32_t>& corners) {
    Tin tin = tin_of(in_curve_order(keys));
    std::vector<std::uint32_t> renumbered;
    for (const std::uint32_t c : corners) {
        renumbered.push_back(static_cast<std::uint32_t>(std::find(tin.keys.begin(), tin.keys.end(), keys[c]) -
                                                        tin.keys.begin()));
    }
    tin.mesh = mesh_of(tin.keys.size(), renumbered);
    return tin;
}

}  // namespace

TEST_SUITE("mesh/tin_check") {
    TEST_CASE("G1: arrays of other lengths than the mesh are found") {
        Tin tin = clean_tin();
        tin.z.pop_back();
        const TinCheckReport report = check_tin(tin);
        CHECK(report.count == 1);
        CHECK(report.violations[0].invariant == 1);
    }

    TEST_CASE("G2: keys that are no integers within the limit are found") {
        for (const double bad : {0.5, -1.0, kKeyLimit, std::numeric_limits<double>::quiet_NaN()}) {
            CAPTURE(bad);
            Tin tin = tin_with_faces({{0, 0}, {8, 0}, {0, 8}}, {0, 1, 2});
            tin.keys.push_back({bad, 3});
            tin.z.push_back(0);
            tin.sample.push_back(0);
            tin.mesh = mesh_of(4, {0, 2, 1});
            CHECK(names(check_tin(tin), 2, "vertex 3: its key is no pair of integers within the limit"));
        }
    }

    TEST_CASE("G3: repeated keys and keys out of order are found") {
        Tin tin = clean_tin();
        std::swap(tin.keys[10], tin.keys[11]);
        CHECK(names(check_tin(tin), 3, "vertex 11 comes before its predecessor on the curve"));
        tin = clean_tin();
        tin.keys[11] = tin.keys[10];
        CHECK(names(check_tin(tin), 3, "vertex 11 is where the vertex before it is"));
    }

    TEST_CASE("G4: elevations that are not finite are found") {
        Tin tin = clean_tin();
        tin.z[7] = std::numeric_limits<double>::quiet_NaN();
        tin.z[9] = std::numeric_limits<double>::infinity();
        const TinCheckReport report = check_tin(tin);
        CHECK(report.count == 2);
        CHECK(names(report, 4, "vertex 7: its elevation is not finite"));
        CHECK(report.violations[1].index == 9);
        CHECK_FALSE(report.violations[1].is_face);
    }

    TEST_CASE("G5: clockwise and flat faces are found, also where they are no terrain") {
        Tin tin = tin_with_faces({{0, 0}, {8, 0}, {0, 8}}, {0, 2, 1});
        CHECK(names(check_tin(tin), 5, "face 0 is not counter-clockwise"));
        tin.mesh.set_terrain({0}, false);
        CHECK(count_of(check_tin(tin), 5) == 1);
        CHECK(count_of(check_tin(tin_with_faces({{0, 0}, {4, 4}, {8, 8}}, {0, 1, 2})), 5) == 1);
    }

    TEST_CASE("G6: faces that overlap are found, faces that touch are not") {
        const std::vector<Key2> keys{{0, 0}, {8, 0}, {0, 8}, {2, 2}, {9, 2}, {2, 9}, {8, 8}, {12, 12}};
        CHECK(count_of(check_tin(tin_with_faces(keys, {0, 1, 2, 3, 4, 5})), 6) == 1);
        CHECK(check_tin(tin_with_faces(keys, {0, 1, 2, 6, 7, 5})).is_clean());
        // A face within another, a common corner only.
        CHECK(
            count_of(check_tin(tin_with_faces({{0, 0}, {9, 0}, {0, 9}, {1, 2}, {2, 1}}, {0, 1, 2, 0, 4, 3})),
                     6) == 1);
    }

    TEST_CASE("G6: a ramp that winds over itself is found though every vertex looks right") {
        // Two and a half turns of a strip around the origin, inner and outer end of each step.
        const std::vector<Key2> ring{{60, 40}, {54, 54}, {40, 60}, {26, 54},
                                     {20, 40}, {26, 26}, {40, 20}, {54, 26}};
        std::vector<Key2> keys;
        std::vector<std::uint32_t> corners;
        const std::uint32_t steps = 12;
        for (std::uint32_t i = 0; i <= steps; ++i) {
            const Key2 inner = ring[i % 8];
            const double turn = i / 8;
            keys.push_back({100 + inner.x + turn, 100 + inner.y});
            keys.push_back({100 + 40 + 2 * (inner.x - 40) + turn, 100 + 40 + 2 * (inner.y - 40)});
            if (i > 0) {
                const std::uint32_t a = 2 * (i - 1);
                for (const std::uint32_t v : {a, a + 1, a + 3, a, a + 3, a + 2}) {
                    corners.push_back(v);
                }
            }
        }
        const Tin tin = tin_with_faces(keys, corners);
        CHECK(check_mesh(tin.mesh).is_clean());
        const TinCheckReport report = check_tin(tin);
        CHECK(count_of(report, 5) == 0);
        CHECK(count_of(report, 6) > 0);
    }

    TEST_CASE("G7: a border that is not the convex hull is found") {
        const std::vector<Key2> keys{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 2}, {20, 20}, {28, 20}, {24, 28}};
        // A dent at (4, 2).
        CHECK(names(check_delaunay(tin_with_faces(keys, {0, 4, 3, 4, 1, 2, 4, 2, 3})), 7,
                    "the border is not convex"));
        CHECK(check_tin(tin_with_faces(keys, {0, 4, 3, 4, 1, 2, 4, 2, 3})).is_clean());
        CHECK(names(check_delaunay(tin_with_faces(keys, {0, 1, 2, 5, 6, 7})), 7,
                    "the border is more than one loop"));
        Tin none = tin_of(in_curve_order(keys));
        none.mesh = mesh_of(keys.size(), {});
        CHECK(names(check_delaunay(none), 7, "there is no face"));
        const Tin collinear = delaunay_tin({{0, 0}, {1, 1}, {2, 2}});
        CHECK(names(check_delaunay(collinear), 7, "the border turns back"));
    }

    TEST_CASE("G7: a convex border that turns twice is found") {
        // A pentagram's border around a centre: every turn to the left, twice round.
        const std::vector<Key2> star{{50, 100}, {21, 10}, {97, 65}, {3, 65}, {79, 10}, {50, 55}};
        std::vector<std::uint32_t> corners;
        for (std::uint32_t i = 0; i < 5; ++i) {
            for (const std::uint32_t v : {5U, i, (i + 1) % 5}) {
                corners.push_back(v);
            }
        }
        const Tin tin = tin_with_faces(star, corners);
        CHECK(check_mesh(tin.mesh).is_clean());
        CHECK(names(check_delaunay(tin), 7, "the border turns more than once"));
        CHECK(count_of(check_tin(tin), 5) == 0);
        CHECK(count_of(check_tin(tin), 6) > 0);
    }

    TEST_CASE("G8: a vertex without a face is found") {
        const Tin tin = tin_with_faces({{0, 0}, {8, 0}, {0, 8}, {100, 100}}, {0, 1, 2});
        const TinCheckReport report = check_delaunay(tin);
        CHECK(count_of(report, 8) == 1);
        CHECK(report.count == 1);
        CHECK(report.violations[0].location == Point2{100, 100});
    }

    TEST_CASE("G9: the other diagonal is found, of a square as of any four vertices") {
        const std::vector<Key2> square{{0, 0}, {8, 0}, {8, 8}, {0, 8}};
        // The greatest key, (8, 8), is lifted most, so the diagonal that avoids it stays.
        CHECK(check_delaunay(tin_with_faces(square, {0, 1, 3, 1, 2, 3})).is_clean());
        const TinCheckReport report = check_delaunay(tin_with_faces(square, {0, 1, 2, 0, 2, 3}));
        CHECK(report.count == 1);
        CHECK(count_of(report, 9) == 1);
    }

    TEST_CASE("G9: any single flip of a Delaunay TIN is found, and nothing else is wrong with it") {
        for (int seed = 0; seed < cases(100); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto& family = key_families()[static_cast<std::size_t>(random.integer(0, 9))];
            CAPTURE(family.name);
            Tin tin = delaunay_tin(family.make(random, 40));
            const TriangleMesh& mesh = tin.mesh;
            const auto f = static_cast<std::uint32_t>(
                random.integer(0, static_cast<std::int64_t>(mesh.slot_count()) - 1));
            const HalfEdgeId h = half_edge({f}, 0);
            if (mesh.is_ghost({f}) || mesh.is_ghost(face_of(mesh.twin(h)))) {
                continue;
            }
            const VertexId a = mesh.origin(h);
            const VertexId b = mesh.destination(h);
            const VertexId c = mesh.origin(previous(h));
            const VertexId d = mesh.origin(previous(mesh.twin(h)));
            if (oracle::orient2d(tin.key(c), tin.key(d), tin.key(b)) <= 0 ||
                oracle::orient2d(tin.key(d), tin.key(c), tin.key(a)) <= 0) {
                continue;
            }
            std::vector<std::uint32_t> corners{c.value, d.value, b.value, d.value, c.value, a.value};
            for (std::uint32_t g = 0; g < mesh.slot_count(); ++g) {
                if (!mesh.is_ghost({g}) && g != f && g != face_of(mesh.twin(h)).value) {
                    for (const VertexId v : mesh.face({g}).vertex) {
                        corners.push_back(v.value);
                    }
                }
            }
            tin.mesh = mesh_of(tin.vertex_count(), corners);
            REQUIRE(check_tin(tin).is_clean());
            const TinCheckReport report = check_delaunay(tin);
            REQUIRE(report.count > 0);
            REQUIRE(count_of(report, 9) == report.count);
        }
    }

    TEST_CASE("locations are in CRS units, and the limit limits descriptions only") {
        Tin tin = clean_tin();
        tin.lattice = Lattice::decimal(2, {100, 200});
        std::fill(tin.z.begin(), tin.z.end(), std::numeric_limits<double>::quiet_NaN());
        const TinCheckReport report = check_tin(tin, {.limit = 3});
        CHECK(report.count == tin.vertex_count());
        CHECK(report.violations.size() == 3);
        CHECK(report.violations[0].location == tin.lattice.position(tin.keys[0]));
    }

    TEST_CASE("bounds are those of the terrain, in CRS units") {
        Tin tin =
            tin_with_faces({{0, 0}, {8, 0}, {0, 8}, {100, 100}, {107, 100}, {100, 109}}, {0, 1, 2, 3, 4, 5});
        tin.lattice = Lattice::decimal(1, {5, 0});
        CHECK(tin.bounds() == Box{0.5, 0, 11.2, 10.9});
        tin.mesh.set_terrain({1}, false);
        CHECK(tin.bounds() == Box{0.5, 0, 1.3, 0.8});
        tin.mesh.set_terrain({0}, false);
        CHECK(tin.bounds().is_empty());
    }
}
