#include "support/triangulation_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

std::size_t count_triangulations(const oracle::Sites& sites) {
    std::size_t count = 0;
    oracle::for_each_triangulation(sites, [&](const auto&) { ++count; });
    return count;
}

oracle::Sites level(std::vector<Key2> keys) {
    const std::size_t n = keys.size();
    return {std::move(keys), std::vector<double>(n, 0.0), {}};
}

/// Keys in convex position, on a parabola.
std::vector<Key2> convex_keys(int count) {
    std::vector<Key2> keys;
    for (int i = 0; i < count; ++i) {
        keys.push_back({static_cast<double>(i), static_cast<double>(i * i)});
    }
    return keys;
}

oracle::Sites random_sites(Random& random, std::size_t count, double limit) {
    std::vector<Key2> keys;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back({random.key(limit), random.key(limit)});
    }
    oracle::Sites sites = level(without_repetitions(std::move(keys)));
    for (double& z : sites.z) {
        z = static_cast<double>(random.integer(0, 50));
    }
    return sites;
}

std::vector<long double> badnesses_of(const oracle::Sites& sites, const std::vector<oracle::Triple>& faces,
                                      Criterion criterion, Norm norm) {
    const auto site = [&](std::uint32_t i) { return oracle::Site{sites.keys[i], sites.z[i]}; };
    std::vector<long double> vector;
    for (const oracle::Triple& face : faces) {
        vector.push_back(oracle::badness(criterion, site(face[0]), site(face[1]), site(face[2]), norm));
    }
    std::sort(vector.begin(), vector.end(), std::greater<>());
    return vector;
}

/// Lets a random edge of a random triangulation be a constraint.
void constrain_one(Random& random, oracle::Sites& sites) {
    std::vector<oracle::Triple> faces;
    std::int64_t seen = 0;
    oracle::for_each_triangulation(sites, [&](const std::vector<oracle::Triple>& all) {
        if (random.integer(0, seen++) == 0) {
            faces = all;
        }
    });
    if (!faces.empty()) {
        const auto& face =
            faces[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(faces.size()) - 1))];
        sites.constraints.push_back({face[0], face[1]});
    }
}

}  // namespace

TEST_SUITE("optimal/triangulation_oracle") {
    TEST_CASE("a convex polygon has a Catalan number of triangulations") {
        CHECK(count_triangulations(level(convex_keys(3))) == 1);
        CHECK(count_triangulations(level(convex_keys(4))) == 2);
        CHECK(count_triangulations(level(convex_keys(5))) == 5);
        CHECK(count_triangulations(level(convex_keys(6))) == 14);
        CHECK(count_triangulations(level(convex_keys(9))) == 429);
    }

    TEST_CASE("grids have the numbers of triangulations that are known") {
        CHECK(count_triangulations(level(grid_keys(2, 4))) == 20);  // 6 choose 3
        CHECK(count_triangulations(level(grid_keys(3, 3))) == 64);
    }

    TEST_CASE("a constraint leaves the triangulations that contain it") {
        oracle::Sites hexagon = level(convex_keys(6));
        hexagon.constraints.push_back({0, 3});
        CHECK(count_triangulations(hexagon) == 4);
        hexagon.constraints.push_back({0, 2});
        CHECK(count_triangulations(hexagon) == 2);
    }

    TEST_CASE("the swept optimum is the best of all triangulations, one by one") {
        for (int seed = 0; seed < cases(400); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto count = static_cast<std::size_t>(random.integer(3, 7));
            oracle::Sites sites = random_sites(random, count,
                                               seed % 3 == 0   ? 4
                                               : seed % 3 == 1 ? 30
                                                               : 0x1p44);
            if (oracle::convex_hull(sites.keys).size() < 3) {
                continue;
            }
            for (std::int64_t i = random.integer(0, 2); i > 0; --i) {
                constrain_one(random, sites);
            }
            std::vector<std::pair<Criterion, Norm>> measures{{Criterion::Length, Norm::lp(1)},
                                                             {Criterion::Length, Norm::lp(5)},
                                                             {Criterion::Length, Norm::maximum()}};
            for (const Criterion criterion : kCriteria) {
                measures.emplace_back(criterion, Norm());
            }
            for (const auto& measure : measures) {
                const Criterion criterion = measure.first;
                const Norm norm = measure.second;
                CAPTURE(criterion_traits(criterion).name);
                CAPTURE(norm_name(norm));
                std::vector<long double> best;
                bool is_first = true;
                oracle::for_each_triangulation(sites, [&](const std::vector<oracle::Triple>& faces) {
                    const auto vector = badnesses_of(sites, faces, criterion, norm);
                    best = is_first ? vector : std::min(best, vector);
                    is_first = false;
                });
                REQUIRE_FALSE(is_first);
                REQUIRE(oracle::best_badnesses(sites, criterion, norm) == best);
            }
        }
    }

    TEST_CASE("the measures are those of the textbook") {
        const auto of = [](Criterion criterion, oracle::Site a, oracle::Site b, oracle::Site c,
                           Norm norm = {}) {
            return static_cast<double>(oracle::badness(criterion, a, b, c, norm));
        };
        // Legs of 3 and 4 at a right angle; a plane that rises by 1 for 2 along x.
        const oracle::Site a{{0, 0}, 0};
        const oracle::Site b{{4, 0}, 2};
        const oracle::Site c{{0, 3}, 0};
        CHECK(of(Criterion::Angle, a, b, c) == doctest::Approx(90));
        CHECK(of(Criterion::Height, a, b, c) == doctest::Approx(-2.4));
        CHECK(of(Criterion::Slope, a, b, c) == doctest::Approx(0.5));
        CHECK(of(Criterion::Eccentricity, a, b, c) == 0);
        CHECK(of(Criterion::Length, a, b, c) == doctest::Approx(5));
        CHECK(of(Criterion::Length, a, b, c, Norm::lp(1)) == doctest::Approx(7));
        CHECK(of(Criterion::Length, a, b, c, Norm::lp(3)) == doctest::Approx(std::cbrt(91.0)));
        CHECK(of(Criterion::Length, a, b, c, Norm::maximum()) == 4);
        // An angle of 120 degrees: the centre is the apex's mirror image beyond the base.
        const oracle::Site apex{{1000000, 577350}, 0};
        const oracle::Site right{{2000000, 0}, 0};
        CHECK(of(Criterion::Angle, a, right, apex) == doctest::Approx(120).epsilon(1e-6));
        CHECK(of(Criterion::Eccentricity, a, right, apex) == doctest::Approx(577350).epsilon(1e-5));
    }
}
