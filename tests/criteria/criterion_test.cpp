#include "tinwright/criteria/criterion.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/criteria/visit_criterion.hpp"

#include "faces.hpp"
#include "support/cases.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// What a measure may err by, relatively; the engine takes measures for equal that differ by twice that.
constexpr double kError = 0x1p-45;

double raw_measure(Criterion criterion, const Tin& tin, std::array<std::uint32_t, 3> order = {0, 1, 2},
                   Norm norm = {}) {
    return visit_criterion(
        criterion, tin,
        [&](const FaceCriterion auto& code) { return code.measure({order[0]}, {order[1]}, {order[2]}); },
        norm);
}

/// Corners of an edge that no other is longer than, by integers of any length.
std::array<Key2, 2> longest_edge(const Face& face, Norm norm) {
    std::array<Key2, 2> longest{face[0].key, face[1].key};
    for (const std::size_t i : {1U, 2U}) {
        const std::array<Key2, 2> edge{face[i].key, face[(i + 1) % 3].key};
        if (oracle::compare_lengths(norm, edge[0], edge[1], longest[0], longest[1]) > 0) {
            longest = edge;
        }
    }
    return longest;
}

double reported(Criterion criterion, const Face& face, int decimals = 0) {
    const Tin tin = tin_of_face(face, decimals);
    return visit_criterion(criterion, tin, [](const FaceCriterion auto& code) {
        return code.to_report(code.measure({0}, {1}, {2}));
    });
}

double number(const cpp_rational& value) { return value.convert_to<double>(); }

/// The gradient's error in units of rounding: relative to the rises over the face, not to itself.
double slope_bound(const Face& face, const Exact& exact) {
    const auto length = [&](std::size_t i) {
        return std::hypot(face[i].key.x - face[0].key.x, face[i].key.y - face[0].key.y);
    };
    return (std::abs(face[1].z - face[0].z) * length(2) + std::abs(face[2].z - face[0].z) * length(1)) /
           number(exact.area);
}

}  // namespace

TEST_SUITE("criteria/criterion") {
    TEST_CASE("measures agree with rational numbers, for needles and for keys up to 2^45") {
        int obtuse = 0;
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            const Tin tin = tin_of_face(face);
            const Exact exact(face);
            obtuse += exact.inner < 0 ? 1 : 0;
            for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
                CAPTURE(std::string(criterion_traits(criterion).name));
                const double expected = number(exact.measure(criterion));
                REQUIRE(std::abs(raw_measure(criterion, tin) - expected) <= kError * std::abs(expected));
            }
            const double longest = std::sqrt(number(exact.measure(Criterion::Length)));
            REQUIRE(std::abs(raw_measure(Criterion::Length, tin) - longest) <= kError * longest);
            const double slope = std::sqrt(raw_measure(Criterion::Slope, tin));
            const double expected = std::sqrt(number(exact.measure(Criterion::Slope)));
            REQUIRE(std::abs(slope - expected) <= kError * slope_bound(face, exact));
        }
        CHECK(obtuse > cases(6000) / 4);
    }

    TEST_CASE("the length of a face is that of its longest edge, in every norm") {
        for (int seed = 0; seed < cases(600); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            const Tin tin = tin_of_face(face, 3);
            for (const Norm norm : {Norm(), Norm::lp(1), Norm::maximum(), Norm::lp(3), Norm::lp(64)}) {
                CAPTURE(norm_name(norm));
                const auto [a, b] = longest_edge(face, norm);
                const double measure = raw_measure(Criterion::Length, tin, {0, 1, 2}, norm);
                REQUIRE(oracle::is_length(measure, 0x1p-44, norm, a, b));
                std::array<std::uint32_t, 3> order{0, 1, 2};
                while (std::next_permutation(order.begin(), order.end())) {
                    REQUIRE(raw_measure(Criterion::Length, tin, order, norm) == measure);
                }
            }
        }
    }

    TEST_CASE("a measure has the same bits in all six orders of the corners") {
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            const Tin tin = tin_of_face(face);
            for (const Criterion criterion : kCriteria) {
                CAPTURE(std::string(criterion_traits(criterion).name));
                const auto bits = std::bit_cast<std::uint64_t>(raw_measure(criterion, tin));
                std::array<std::uint32_t, 3> order{0, 1, 2};
                while (std::next_permutation(order.begin(), order.end())) {
                    REQUIRE(std::bit_cast<std::uint64_t>(raw_measure(criterion, tin, order)) == bits);
                }
            }
        }
    }

    TEST_CASE("reports agree with angles by arc cosine, circumcentres and planes, in CRS units") {
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face{};
            for (Corner& corner : face) {
                corner = {{random.key(10000), random.key(10000)}, 100 * random.real()};
            }
            if (!orient(face)) {
                continue;
            }
            // In units of the lattice, 10^-2.
            const auto x = [&](std::size_t i) { return static_cast<long double>(face[i % 3].key.x) / 100; };
            const auto y = [&](std::size_t i) { return static_cast<long double>(face[i % 3].key.y) / 100; };
            const auto length = [&](std::size_t i, std::size_t j) {
                return std::hypot(x(j) - x(i), y(j) - y(i));
            };
            const long double area = ((x(1) - x(0)) * (y(2) - y(0)) - (y(1) - y(0)) * (x(2) - x(0))) / 2;
            long double largest = 0;
            long double longest = 0;
            long double height = INFINITY;
            for (std::size_t i = 0; i < 3; ++i) {
                const long double p = length(i, i + 1);
                const long double q = length(i, i + 2);
                const long double r = length(i + 1, i + 2);
                largest = std::max(largest, std::acos((p * p + q * q - r * r) / (2 * p * q)));
                height = std::min(height, 2 * area / r);
                longest = std::max(longest, r);
            }
            if (largest > 3.1L || area < 1e-2L) {
                continue;  // an arc cosine tells little there
            }
            const double degrees = static_cast<double>(largest) * 180 / std::numbers::pi;
            REQUIRE(reported(Criterion::Angle, face, 2) == doctest::Approx(degrees).epsilon(1e-12));
            REQUIRE(reported(Criterion::Height, face, 2) ==
                    doctest::Approx(static_cast<double>(height)).epsilon(1e-12));
            REQUIRE(reported(Criterion::Length, face, 2) ==
                    doctest::Approx(static_cast<double>(longest)).epsilon(1e-14));

            // The plane through the three points by Cramer's rule.
            const long double nx = (static_cast<long double>(face[1].z) - face[0].z) * (y(2) - y(0)) -
                                   (static_cast<long double>(face[2].z) - face[0].z) * (y(1) - y(0));
            const long double ny = (static_cast<long double>(face[2].z) - face[0].z) * (x(1) - x(0)) -
                                   (static_cast<long double>(face[1].z) - face[0].z) * (x(2) - x(0));
            REQUIRE(reported(Criterion::Slope, face, 2) ==
                    doctest::Approx(static_cast<double>(std::hypot(nx, ny) / (2 * area))).epsilon(1e-9));

            // The distance of the circumcentre from the face: the greatest signed one from its sides.
            const auto square = [&](std::size_t i) { return x(i) * x(i) + y(i) * y(i); };
            long double cx = 0;
            long double cy = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                cx += square(i) * (y(i + 1) - y(i + 2)) / (4 * area);
                cy += square(i) * (x(i + 2) - x(i + 1)) / (4 * area);
            }
            long double outside = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const long double turn = (x(i + 1) - x(i)) * (cy - y(i)) - (y(i + 1) - y(i)) * (cx - x(i));
                outside = std::max(outside, -turn / length(i, i + 1));
            }
            REQUIRE(std::abs(reported(Criterion::Eccentricity, face, 2) - static_cast<double>(outside)) <=
                    1e-9 * (static_cast<double>(outside) + 1));
        }
    }

    TEST_CASE("textbook faces") {
        const Face right{{{{0, 0}, 0}, {{400, 0}, 8}, {{0, 300}, 0}}};
        CHECK(reported(Criterion::Angle, right, 2) == doctest::Approx(90).epsilon(1e-15));
        CHECK(reported(Criterion::Height, right, 2) == doctest::Approx(2.4).epsilon(1e-15));
        CHECK(reported(Criterion::Slope, right, 2) == doctest::Approx(2).epsilon(1e-15));
        CHECK(reported(Criterion::Eccentricity, right, 2) == 0);
        CHECK(reported(Criterion::Length, right, 2) == doctest::Approx(5).epsilon(1e-15));
        // A base of 8 under an angle of 135 degrees: the centre is 4 below it.
        const double rise = 4 * (std::sqrt(2.0) - 1);
        const Face obtuse{{{{0, 0}, 0}, {{8e12, 0}, 0}, {{4e12, std::round(1e12 * rise)}, 0}}};
        CHECK(reported(Criterion::Angle, obtuse, 12) == doctest::Approx(135).epsilon(1e-11));
        CHECK(reported(Criterion::Eccentricity, obtuse, 12) == doctest::Approx(4).epsilon(1e-11));
    }

    TEST_CASE("reports can be turned back into measures, and keep their order") {
        for (const int decimals : {0, 3}) {
            const Tin tin = tin_of_face({{{{0, 0}, 0}, {{1, 0}, 0}, {{0, 1}, 0}}}, decimals);
            for (const Criterion criterion : kCriteria) {
                CAPTURE(std::string(criterion_traits(criterion).name));
                visit_criterion(criterion, tin, [&](const FaceCriterion auto& code) {
                    const bool is_greater_better = criterion_traits(criterion).is_greater_better;
                    for (int seed = 0; seed < cases(1000); ++seed) {
                        Random random(static_cast<std::uint64_t>(seed));
                        const double size =
                            std::ldexp(1 + random.real(), static_cast<int>(random.integer(-60, 40)));
                        const bool is_negative = criterion == Criterion::Angle && random.integer(0, 3) == 0;
                        // No face has its largest angle below 60 degrees, where the measure is -0.577.
                        const double measure = is_negative ? -0.577 * random.real() : size;
                        const double report = code.to_report(measure);
                        REQUIRE(std::isfinite(report));
                        // Near 180 degrees the degrees are what is rounded.
                        const double loss =
                            criterion == Criterion::Angle ? 1e-13 * (1 + measure * measure) : 0;
                        REQUIRE(std::abs(code.from_report(report) - measure) <=
                                1e-13 * std::abs(measure) + loss);
                        const double worse = code.to_report(measure + 0.5 * std::abs(measure));
                        REQUIRE((is_greater_better ? worse <= report : worse >= report));
                    }
                });
            }
        }
    }

    TEST_CASE("a right angle is not above 90 degrees") {
        CHECK(AngleCriterion::from_report(90) == 0);
        CHECK(AngleCriterion::to_report(0) == 90);
    }

    TEST_CASE("worst measures are over terrain faces, and interior ones have no edge on the border") {
        // A hexagon around a triangle: faces 0 to 5 have an edge on the border, 6 has none.
        Tin tin = tin_of(std::vector<Key2>{
            {20, 0}, {80, 0}, {100, 50}, {80, 100}, {20, 100}, {0, 50}, {50, 30}, {65, 60}, {35, 60}});
        tin.lattice = Lattice::decimal(1, {0, 0});
        tin.mesh = mesh_of(
            9, {0, 1, 6, 1, 2, 7, 2, 3, 7, 3, 4, 8, 4, 5, 8, 5, 0, 8, 6, 1, 7, 7, 3, 8, 0, 6, 8, 6, 7, 8});
        tin.z = {0, 0, 0, 0, 0, 0, 4, 5, 9};
        for (const Criterion criterion : kCriteria) {
            CAPTURE(std::string(criterion_traits(criterion).name));
            const bool is_greater_better = criterion_traits(criterion).is_greater_better;
            const auto worse = [&](double a, double b) {
                return is_greater_better ? std::min(a, b) : std::max(a, b);
            };
            double all = measure_face(tin, {0}, criterion);
            for (std::uint32_t f = 0; f < 10; ++f) {
                all = worse(all, measure_face(tin, {f}, criterion));
            }
            double interior = measure_face(tin, {6}, criterion);
            for (std::uint32_t f = 6; f < 10; ++f) {
                interior = worse(interior, measure_face(tin, {f}, criterion));
            }
            const WorstMeasures worst = find_worst(tin, criterion);
            CHECK(worst.all == all);
            REQUIRE(worst.interior.has_value());
            CHECK(*worst.interior == interior);

            // A void makes the faces next to it border faces, and counts for nothing itself.
            Tin holed = tin;
            holed.mesh.set_terrain({9}, false);
            const WorstMeasures around = find_worst(holed, criterion);
            CHECK_FALSE(around.interior.has_value());
            for (const std::uint32_t f : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 8U}) {
                holed.mesh.set_terrain({f}, false);
            }
            CHECK(find_worst(holed, criterion).all == measure_face(tin, {6}, criterion));
            CHECK_FALSE(find_worst(holed, criterion).interior.has_value());
        }
    }

    TEST_CASE("the worst length is told in the norm asked for; the other criteria know none") {
        const Face right{{{{0, 0}, 0}, {{400, 0}, 8}, {{0, 300}, 0}}};
        Tin tin = tin_of_face(right, 2);
        tin.mesh = mesh_of(3, {0, 1, 2});
        CHECK(find_worst(tin, Criterion::Length).all == doctest::Approx(5));
        CHECK(find_worst(tin, Criterion::Length, Norm::lp(1)).all == doctest::Approx(7));
        CHECK(find_worst(tin, Criterion::Length, Norm::maximum()).all == doctest::Approx(4));
        CHECK(measure_face(tin, {0}, Criterion::Length, Norm::lp(3)) == doctest::Approx(std::cbrt(91.0)));
        for (const Criterion criterion : kInsertionCriteria) {
            CHECK(find_worst(tin, criterion, Norm::lp(1)).all == find_worst(tin, criterion).all);
            CHECK(measure_face(tin, {0}, criterion, Norm::maximum()) == measure_face(tin, {0}, criterion));
        }
    }

    TEST_CASE("criteria are found by name, and say what they are") {
        for (const Criterion criterion : kCriteria) {
            CHECK(find_criterion(criterion_traits(criterion).name) == criterion);
            CHECK(criterion_traits(criterion).is_greater_better == (criterion == Criterion::Height));
            const bool is_strong = criterion == Criterion::Angle || criterion == Criterion::Height;
            CHECK((criterion_traits(criterion).condition == InsertionCondition::Strong) == is_strong);
            const bool is_inserted = std::find(kInsertionCriteria.begin(), kInsertionCriteria.end(),
                                               criterion) != kInsertionCriteria.end();
            CHECK((criterion_traits(criterion).condition != InsertionCondition::None) == is_inserted);
        }
        CHECK(find_criterion("length") == Criterion::Length);
        CHECK(criterion_traits(Criterion::Length).unit == MeasureUnit::Length);
        CHECK_FALSE(find_criterion("delaunay").has_value());
        CHECK_FALSE(find_criterion("").has_value());
    }
}
