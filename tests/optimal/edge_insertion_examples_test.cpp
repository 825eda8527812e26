#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "tinwright/optimal/edge_flip.hpp"

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// The examples of [tan1993, Ch. 4].

namespace {

using Sites = std::vector<oracle::Site>;
using Corners = std::vector<std::uint32_t>;

/// Faces named by the numbers of their corners in `sites`, each least first, sorted.
std::vector<std::array<std::uint32_t, 3>> faces_by_site(const Tin& tin, const Sites& sites) {
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (const auto& face : terrain_of(tin.mesh)) {
        std::array<std::uint32_t, 3> named{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto place = std::find_if(sites.begin(), sites.end(), [&](const oracle::Site& site) {
                return site.key == tin.keys[face[i]];
            });
            named[i] = static_cast<std::uint32_t>(place - sites.begin());
        }
        std::sort(named.begin(), named.end());
        faces.push_back(named);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

double measure(Criterion criterion, const Sites& sites, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return static_cast<double>(oracle::badness(criterion, sites[a], sites[b], sites[c]));
}

/// The pentagon a b c d e of Figure 4.1 with the diagonals b e and b d.
constexpr std::uint32_t a = 0;
constexpr std::uint32_t b = 1;
constexpr std::uint32_t c = 2;
constexpr std::uint32_t d = 3;
constexpr std::uint32_t e = 4;
const Corners kStuck{a, b, e, b, d, e, b, c, d};
using FaceList = std::vector<std::array<std::uint32_t, 3>>;
const FaceList kStuckFaces{{a, b, e}, {b, c, d}, {b, d, e}};
const FaceList kBestFaces{{a, b, c}, {a, c, d}, {a, d, e}};

void check_pentagon(const Sites& pentagon, Criterion criterion) {
    CAPTURE(name_of(criterion));
    Tin tin = tin_of_faces(pentagon, kStuck);
    CHECK(flip_edges(tin, criterion) == 0);
    CHECK(faces_by_site(tin, pentagon) == kStuckFaces);
    for (const Scope scope : {kMaxScope, Scope{}, kVectorScope}) {
        Tin inserted = tin;
        const OptimizeReport report = optimize_to(scope, criterion, inserted);
        CHECK(report.insertions == 1);
        // Scope top ends above the first face that cannot be improved.
        CHECK(report.proof == (scope.kind == Scope::Kind::Top ? Proof::None : Proof::Theorem));
        CHECK(faces_by_site(inserted, pentagon) == kBestFaces);
        CHECK(are_close(badnesses_of(inserted, criterion, Faces::All),
                        oracle::best_badnesses(sites_of(tin), criterion)));
    }
}

/// The hexagon x u y v z w of Figures 4.4 and 4.5: triangulation A has the diagonals x y, y z, z x, and T has
/// u v, v w, w u.
constexpr std::uint32_t x = 0;
constexpr std::uint32_t u = 1;
constexpr std::uint32_t y = 2;
constexpr std::uint32_t v = 3;
constexpr std::uint32_t z = 4;
constexpr std::uint32_t w = 5;

void check_hexagon(const Sites& hexagon, Criterion criterion) {
    const auto of = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return measure(criterion, hexagon, i, j, k);
    };
    const double center = of(x, y, z);
    const double worst_of_a = std::max({center, of(x, u, y), of(y, v, z), of(z, w, x)});
    const double worst_of_t = std::max({of(u, v, w), of(x, u, w), of(u, y, v), of(v, z, w)});
    // T improves A and is better than x y z. No edge of T leaves x, y or z into x y z, which it would have
    // to under condition (II).
    CHECK(worst_of_t < worst_of_a);
    CHECK(worst_of_t < center);
    for (const auto& [apex, before, after] :
         {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
        for (const auto& [from, to] : {std::array{u, v}, std::array{v, w}, std::array{w, u}}) {
            CHECK_FALSE((from == apex || to == apex));
        }
        for (const std::uint32_t other : {u, v, w}) {  // not even one that T lacks
            const bool is_hull_edge = other == apex - 1 || other == apex + 1 || (apex == x && other == w);
            CHECK((is_hull_edge || oracle::do_cross(hexagon[apex].key, hexagon[other].key,
                                                    hexagon[before].key, hexagon[after].key)));
        }
    }
    for (const Corners& faces :
         {Corners{x, y, z, x, u, y, y, v, z, z, w, x}, Corners{u, v, w, x, u, w, u, y, v, v, z, w}}) {
        for (const Scope scope : {kMaxScope, kVectorScope}) {
            Tin tin = tin_of_faces(hexagon, faces);
            const auto best = oracle::best_badnesses(sites_of(tin), criterion);
            const OptimizeReport report = optimize_to(scope, criterion, tin);
            CHECK(report.proof == Proof::Theorem);
            CHECK(are_close(badnesses_of(tin, criterion, Faces::All).front(), best.front()));
            if (scope.kind == Scope::Kind::Vector) {
                CHECK(are_close(badnesses_of(tin, criterion, Faces::All), best));
            }
        }
    }
}

/// A parallelogram of nearly equilateral triangles with straight sides; vertices inside moved a little.
Tin acute_tin(std::uint64_t seed, int columns, int rows) {
    Random random(seed);
    std::vector<Key2> keys;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const bool is_inside = row > 0 && column > 0 && row + 1 < rows && column + 1 < columns;
            const auto shift = [&] { return is_inside ? static_cast<double>(random.integer(-90, 90)) : 0.0; };
            keys.push_back({2000.0 * column + 1000.0 * row + 100 + shift(), 1732.0 * row + 100 + shift()});
        }
    }
    return delaunay_tin(keys);
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_examples") {
    TEST_CASE("the pentagon that flips cannot improve, edge insertion does: angle, height, eccentricity") {
        // Near a regular pentagon, bent as the text of [tan1993, Ch. 4] below Figure 4.1 asks.
        const Sites pentagon{
            {{1038, 2038}, 0}, {{28, 1253}, 0}, {{398, 229}, 0}, {{1544, 220}, 0}, {{2010, 1249}, 0}};
        for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
            check_pentagon(pentagon, criterion);
        }
    }

    TEST_CASE("the regular pentagon with elevations 5, 0, 10, 0, 11, which flips cannot solve") {
        constexpr std::array kElevations{5.0, 0.0, 10.0, 0.0, 11.0};
        Sites pentagon;
        for (std::size_t i = 0; i < 5; ++i) {
            const double angle = std::numbers::pi * (0.5 + 0.4 * static_cast<double>(i));
            pentagon.push_back({{1000000 + std::round(1000000 * std::cos(angle)),
                                 1000000 + std::round(1000000 * std::sin(angle))},
                                kElevations[i]});
        }
        check_pentagon(pentagon, Criterion::Slope);
    }

    TEST_CASE("slope violates condition (II) as in Figure 4.4, and is optimised all the same") {
        check_hexagon({{{129, 108}, 18},
                       {{130, 129}, 20},
                       {{86, 183}, 8},
                       {{55, 116}, 13},
                       {{74, 40}, 1},
                       {{107, 68}, 10}},
                      Criterion::Slope);
    }

    TEST_CASE("eccentricity violates condition (II) as in Figure 4.5, and is optimised all the same") {
        check_hexagon(
            {{{190, 88}, 0}, {{146, 136}, 0}, {{33, 132}, 0}, {{63, 100}, 0}, {{88, 81}, 0}, {{114, 81}, 0}},
            Criterion::Eccentricity);
    }

    TEST_CASE("triangulations without obtuse faces are optimal for angle, height and eccentricity") {
        for (int seed = 0; seed < cases(50); ++seed) {
            CAPTURE(seed);
            const bool is_small = seed % 2 == 0;
            const Tin start =
                acute_tin(static_cast<std::uint64_t>(seed), is_small ? 4 : 12, is_small ? 3 : 9);
            REQUIRE(badnesses_of(start, Criterion::Angle, Faces::All).front() < 90);
            for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
                CAPTURE(name_of(criterion));
                for (const Scope scope : {kMaxScope, Scope{}, kVectorScope}) {
                    Tin tin = start;
                    const OptimizeReport report = optimize_to(scope, criterion, tin);
                    REQUIRE(report.insertions == 0);
                    REQUIRE(report.candidates == 0);
                    REQUIRE(report.proof == Proof::Theorem);
                    REQUIRE(terrain_of(tin.mesh) == terrain_of(start.mesh));
                }
                if (is_small) {
                    REQUIRE(are_close(badnesses_of(start, criterion, Faces::All).front(),
                                      oracle::best_badnesses(sites_of(start), criterion).front()));
                }
            }
        }
    }

    TEST_CASE("regular polygons: the worst face is the best possible from any triangulation") {
        for (int corners = 4; corners <= 12; ++corners) {
            CAPTURE(corners);
            Sites polygon;
            for (int i = 0; i < corners; ++i) {
                const double angle = 2 * std::numbers::pi * i / corners;
                polygon.push_back({{1000000 + std::round(1000000 * std::cos(angle)),
                                    1000000 + std::round(1000000 * std::sin(angle))},
                                   static_cast<double>(i * i % 7)});
            }
            for (int seed = 0; seed < cases(10); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin start = tin_of_sites(polygon);
                flip_at_random(random, start, 10 * seed);
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    Tin tin = start;
                    optimize_to(kVectorScope, criterion, tin);
                    REQUIRE(is_sound(tin));
                    REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All).front(),
                                      oracle::best_badnesses(sites_of(start), criterion).front()));
                }
            }
        }
    }
}
