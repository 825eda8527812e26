#include "tinwright/delaunay/delaunay.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

bool are_collinear(std::span<const Key2> keys) {
    return std::all_of(keys.begin(), keys.end(),
                       [&](Key2 key) { return oracle::orient2d(keys.front(), keys.back(), key) == 0; });
}

std::vector<std::array<Key2, 3>> faces_of(const Tin& tin) {
    std::vector<std::array<Key2, 3>> faces;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            const auto& v = tin.mesh.face({f}).vertex;
            faces.push_back({tin.key(v[0]), tin.key(v[1]), tin.key(v[2])});
        }
    }
    return faces;
}

std::string named(char kind, int invariant, const std::string& text) {
    return kind + std::to_string(invariant).append(": ").append(text);
}

std::string first_violation(const Tin& tin) {
    const MeshCheckReport mesh = check_mesh(tin.mesh);
    if (!mesh.is_clean()) {
        return named('M', mesh.violations[0].invariant, mesh.violations[0].text);
    }
    if (are_collinear(tin.keys)) {
        return tin.mesh.count_terrain() == 0 ? "" : "collinear vertices have faces";
    }
    const TinCheckReport geometry = check_delaunay(tin);
    return geometry.is_clean() ? ""
                               : named('G', geometry.violations[0].invariant, geometry.violations[0].text);
}

/// Bytes of all face slots.
std::vector<std::uint32_t> words_of(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> words;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        const TriangleMesh::Face& face = mesh.face({f});
        for (unsigned i = 0; i < 3; ++i) {
            words.push_back(face.vertex[i].value);
            words.push_back(face.twin[i].value);
        }
        words.push_back(face.marks);
        words.push_back(face.scratch);
    }
    return words;
}

}  // namespace

TEST_SUITE("delaunay/delaunay") {
    TEST_CASE("every family gives a clean, canonical Delaunay mesh of 2n - 2 slots") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(40); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto count = static_cast<std::size_t>(random.integer(2, seed % 8 == 0 ? 2000 : 200));
                const std::vector<Key2> keys = in_curve_order(family.make(random, count));
                if (keys.size() < 2) {
                    continue;
                }
                const Tin tin = delaunay_tin(keys);
                REQUIRE(tin.mesh.slot_count() == 2 * keys.size() - 2);
                REQUIRE(first_violation(tin) == "");
            }
        }
    }

    TEST_CASE("small sets give the faces of the definition") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(25); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto count = static_cast<std::size_t>(random.integer(3, 11));
                const std::vector<Key2> keys = in_curve_order(family.make(random, count));
                if (keys.size() < 2) {
                    continue;
                }
                REQUIRE(terrain_of(make_delaunay(keys)) == oracle::delaunay(keys));
            }
        }
    }

    TEST_CASE("every subset of a 3 x 3 grid gives the faces of the definition") {
        const std::vector<Key2> grid = in_curve_order(grid_keys(3, 3));
        for (unsigned subset = 0; subset < 512; ++subset) {
            CAPTURE(subset);
            std::vector<Key2> keys;
            for (unsigned i = 0; i < grid.size(); ++i) {
                if ((subset >> i & 1U) != 0) {
                    keys.push_back(grid[i]);
                }
            }
            if (keys.size() < 2) {
                continue;
            }
            const Tin tin = delaunay_tin(keys);
            REQUIRE(terrain_of(tin.mesh) == oracle::delaunay(keys));
            REQUIRE(first_violation(tin) == "");
        }
    }

    TEST_CASE("subsets of a 4 x 4 grid give the faces of the definition") {
        const std::vector<Key2> grid = in_curve_order(grid_keys(4, 4));
        // A stride prime to 2^16 walks through subsets of all sizes.
        for (unsigned i = 0, subset = 1; i < static_cast<unsigned>(std::min(65536, cases(600))); ++i) {
            subset = (subset + 40503U) & 0xFFFFU;
            CAPTURE(subset);
            std::vector<Key2> keys;
            for (unsigned k = 0; k < grid.size(); ++k) {
                if ((subset >> k & 1U) != 0) {
                    keys.push_back(grid[k]);
                }
            }
            if (keys.size() < 2) {
                continue;
            }
            const Tin tin = delaunay_tin(keys);
            REQUIRE(terrain_of(tin.mesh) == oracle::delaunay(keys));
            REQUIRE(first_violation(tin) == "");
        }
    }

    TEST_CASE("a grid's diagonals are all parallel") {
        const Tin tin = delaunay_tin(grid_keys(13, 9));
        std::size_t rising = 0;
        std::size_t falling = 0;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                const Key2 a = tin.key(tin.mesh.vertex({f}, i));
                const Key2 b = tin.key(tin.mesh.vertex({f}, next_corner(i)));
                if (a.x != b.x && a.y != b.y) {
                    ((a.x < b.x) == (a.y < b.y) ? rising : falling) += 1;
                }
            }
        }
        CHECK(std::min(rising, falling) == 0);
        CHECK(rising + falling == 2 * 12 * 8);  // each diagonal seen from both its faces
    }

    TEST_CASE("collinear vertices give ghosts only") {
        for (const int count : {2, 3, 4, 5, 8, 100}) {
            CAPTURE(count);
            std::vector<Key2> keys;
            for (int i = 0; i < count; ++i) {
                keys.push_back({7.0 * i, 3.0 * i});
            }
            const Tin tin = delaunay_tin(keys);
            CHECK(tin.mesh.slot_count() == 2 * tin.keys.size() - 2);
            CHECK(tin.mesh.count_terrain() == 0);
            CHECK(check_mesh(tin.mesh).is_clean());
        }
    }

    TEST_CASE("the faces of large sets fill the convex hull exactly") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(99);
            const std::vector<Key2> keys = in_curve_order(family.make(random, 20000));
            if (are_collinear(keys)) {
                continue;
            }
            const Tin tin = delaunay_tin(keys);
            REQUIRE(first_violation(tin) == "");
            REQUIRE(check_tin(tin).is_clean());
            const std::vector<Key2> hull = oracle::convex_hull(keys);
            REQUIRE(oracle::twice_area_of_faces(faces_of(tin)) == oracle::twice_area(hull));
        }
    }

    TEST_CASE("the slots are the same for any number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(5);
            const std::vector<Key2> keys = in_curve_order(family.make(random, 40000));
            std::vector<std::uint32_t> expected;
            tbb::task_arena(1).execute([&] { expected = words_of(make_delaunay(keys)); });
            for (const int threads : {2, 4}) {
                CAPTURE(threads);
                tbb::task_arena(threads).execute([&] { CHECK(words_of(make_delaunay(keys)) == expected); });
            }
        }
    }
}
