#include "tinwright/optimal/ring_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"
#include "support/triangulation_oracle.hpp"

// Of polygons with few corners, all triangulations are looked at: those of the corners as points, the ring's
// edges constrained, and of each the faces inside.

namespace {

using namespace tinwright;
using namespace tinwright_tests;

using Ring = std::vector<Key2>;
using RingFaces = std::vector<oracle::Triple>;

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
const std::array kNorms{Norm(), Norm::lp(1), Norm::maximum(), Norm::lp(3), Norm::lp(17)};

/// A ring around the middle of a square, star-shaped, so that it meets itself nowhere; empty if rounding to
/// the lattice spoilt that.
Ring star_shaped_ring(Random& random, std::size_t count, double size) {
    Ring ring;
    const bool is_convex = random.integer(0, 3) == 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn = (static_cast<double>(i) + 0.9 * random.real()) / static_cast<double>(count);
        const double radius = size * (is_convex ? 1 : 0.1 + 0.9 * random.real());
        ring.push_back({std::round(radius * std::cos(2 * std::numbers::pi * turn)),
                        std::round(radius * std::sin(2 * std::numbers::pi * turn))});
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Key2 next = ring[(i + 1) % count];
        if (oracle::turn({0, 0}, ring[i], next) <= 0) {
            return {};
        }
    }
    return ring;
}

oracle::Sites sites_of_ring(Random& random, const Ring& ring) {
    oracle::Sites sites{ring, {}, {}};
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
        sites.z.push_back(static_cast<double>(random.integer(0, 999)));
        sites.constraints.push_back({i, static_cast<std::uint32_t>((i + 1) % ring.size())});
    }
    return sites;
}

/// Calls `visit` with the faces of each triangulation of the polygon, positions ascending. A face inside has
/// its corners counter-clockwise along the ring; one in a bay has them clockwise.
void for_each_filling(const oracle::Sites& sites, const std::function<void(const RingFaces&)>& visit) {
    std::set<RingFaces> seen;  // bays can be filled in several ways
    oracle::for_each_triangulation(sites, [&](const std::vector<oracle::Triple>& faces) {
        RingFaces inside;
        for (oracle::Triple face : faces) {
            std::sort(face.begin(), face.end());
            if (oracle::turn(sites.keys[face[0]], sites.keys[face[1]], sites.keys[face[2]]) > 0) {
                inside.push_back(face);
            }
        }
        std::sort(inside.begin(), inside.end());
        if (seen.insert(inside).second) {
            visit(inside);
        }
    });
}

/// By the p-th root of the sum of the p-th powers, in long doubles.
long double plain_length(Norm norm, Key2 a, Key2 b) {
    const long double x = std::fabs(static_cast<long double>(a.x) - static_cast<long double>(b.x));
    const long double y = std::fabs(static_cast<long double>(a.y) - static_cast<long double>(b.y));
    if (norm.is_maximum()) {
        return std::max(x, y);
    }
    const long double p = norm.power();
    return std::pow(std::pow(x, p) + std::pow(y, p), 1 / p);
}

/// Each edge once; those of the ring half.
long double weight_of(const Ring& ring, const RingFaces& faces, Norm norm) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& [i, k, j] : faces) {
        edges.insert({{i, k}, {k, j}, {i, j}});
    }
    long double weight = 0;
    for (const auto& [i, j] : edges) {
        const bool is_of_ring = j == i + 1 || (i == 0 && j + 1 == ring.size());
        weight += plain_length(norm, ring[i], ring[j]) / (is_of_ring ? 2 : 1);
    }
    return weight;
}

long double longest_of(const Ring& ring, const RingFaces& faces, Norm norm) {
    long double longest = 0;
    for (const auto& [i, k, j] : faces) {
        longest = std::max({longest, plain_length(norm, ring[i], ring[k]),
                            plain_length(norm, ring[k], ring[j]), plain_length(norm, ring[i], ring[j])});
    }
    return longest;
}

bool is_near(double value, long double expected, long double scale) {
    return std::fabs(value - expected) <= 1e-9L * scale;
}

/// Calls `check` with rings of 3 to 9 corners, many of them with equal sides or collinear corners.
void for_each_ring(int count, const std::function<void(const oracle::Sites& sites)>& check) {
    int rings = 0;
    for (int seed = 0; seed < count; ++seed) {
        CAPTURE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const auto corners = static_cast<std::size_t>(random.integer(3, 9));
        const std::array<double, 4> sizes{4, 12, 1000, 0x1p40};
        const Ring ring = star_shaped_ring(random, corners, sizes[static_cast<std::size_t>(seed) % 4]);
        if (!ring.empty()) {
            ++rings;
            check(sites_of_ring(random, ring));
        }
    }
    CHECK(rings > count / 3);
}

}  // namespace

TEST_SUITE("optimal/ring_measures") {
    TEST_CASE("the least maximum of the longest sides is the min-max length of all triangulations") {
        for_each_ring(cases(240), [](const oracle::Sites& sites) {
            for (const Norm norm : kNorms) {
                CAPTURE(norm_name(norm));
                long double least = kInfinity;
                for_each_filling(sites, [&](const RingFaces& faces) {
                    least = std::min(least, longest_of(sites.keys, faces, norm));
                });
                const auto result = triangulate_polygon(sites.keys, longest_side(sites.keys, norm));
                REQUIRE(result.has_value());
                REQUIRE(is_near(result->cost, least, least));
                REQUIRE(is_near(result->cost, longest_of(sites.keys, result->faces, norm), least));
            }
        });
    }

    TEST_CASE("the least sum of half the perimeters is the minimum weight of all triangulations") {
        for_each_ring(cases(240), [](const oracle::Sites& sites) {
            for (const Norm norm : kNorms) {
                CAPTURE(norm_name(norm));
                long double least = kInfinity;
                for_each_filling(sites, [&](const RingFaces& faces) {
                    least = std::min(least, weight_of(sites.keys, faces, norm));
                });
                const auto result =
                    triangulate_polygon(sites.keys, half_perimeter(sites.keys, norm), PolygonCost::Sum);
                REQUIRE(result.has_value());
                REQUIRE(is_near(result->cost, least, least));
                REQUIRE(is_near(result->cost, weight_of(sites.keys, result->faces, norm), least));
            }
        });
    }

    TEST_CASE("every criterion's least maximum and least sum are those of all triangulations") {
        for_each_ring(cases(160), [](const oracle::Sites& sites) {
            Tin tin = tin_of(sites.keys);
            tin.lattice = Lattice::decimal(0, {0, 0});
            tin.z.assign(sites.z.begin(), sites.z.end());
            std::vector<VertexId> ring;
            for (std::uint32_t v = 0; v < sites.keys.size(); ++v) {
                ring.push_back({v});
            }
            for (const Criterion criterion : kCriteria) {
                CAPTURE(name_of(criterion));
                for (const Norm norm : {Norm(), Norm::lp(4)}) {
                    long double least_worst = kInfinity;
                    long double least_sum = kInfinity;
                    long double scale = 0;
                    for_each_filling(sites, [&](const RingFaces& faces) {
                        long double worst = -kInfinity;
                        long double sum = 0;
                        for (const auto& face : faces) {
                            const auto site = [&](std::size_t corner) {
                                return oracle::Site{sites.keys[face[corner]], sites.z[face[corner]]};
                            };
                            const long double badness =
                                oracle::badness(criterion, site(0), site(1), site(2), norm);
                            worst = std::max(worst, badness);
                            sum += badness;
                            scale = std::max(scale, std::fabs(badness));
                        }
                        least_worst = std::min(least_worst, worst);
                        least_sum = std::min(least_sum, sum);
                    });
                    const RingMeasure measure = criterion_measure(tin, ring, criterion, norm);
                    const auto of_maximum = triangulate_polygon(sites.keys, measure);
                    const auto of_sum = triangulate_polygon(sites.keys, measure, PolygonCost::Sum);
                    REQUIRE((of_maximum.has_value() && of_sum.has_value()));
                    REQUIRE(is_near(of_maximum->cost, least_worst, scale));
                    REQUIRE(is_near(of_sum->cost, least_sum, scale));
                }
            }
        });
    }

    TEST_CASE("a criterion's measure is in the unit of its reports, less is better") {
        Tin tin = tin_of(Ring{{0, 0}, {400, 0}, {0, 300}});
        tin.lattice = Lattice::decimal(2, {0, 0});
        const std::array<VertexId, 3> ring{{{0}, {1}, {2}}};
        const auto of = [&](Criterion criterion, Norm norm = {}) {
            return criterion_measure(tin, ring, criterion, norm)(0, 1, 2);
        };
        CHECK(of(Criterion::Angle) == doctest::Approx(90));
        CHECK(of(Criterion::Height) == doctest::Approx(-2.4));
        CHECK(of(Criterion::Length) == doctest::Approx(5));
        CHECK(of(Criterion::Length, Norm::lp(1)) == doctest::Approx(7));
        CHECK(longest_side(tin.keys)(0, 1, 2) == doctest::Approx(500));
        CHECK(half_perimeter(tin.keys)(0, 1, 2) == doctest::Approx(600));
    }
}
