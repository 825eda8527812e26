#include "tinwright/criteria/criterion.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <doctest/doctest.h>

#include "tinwright/criteria/visit_criterion.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using boost::multiprecision::cpp_rational;

/// What a measure may err by, relatively; the engine takes measures for equal that differ by twice that.
constexpr double kError = 0x1p-45;

struct Corner {
    Key2 key;
    double z = 0;
};
using Face = std::array<Corner, 3>;

/// Three vertices without a mesh, on a lattice of 10^-decimals.
Tin tin_of_face(const Face& face, int decimals = 0) {
    Tin tin = tin_of(std::vector<Key2>{face[0].key, face[1].key, face[2].key});
    tin.lattice = Lattice::decimal(decimals, {0, 0});
    for (std::size_t i = 0; i < 3; ++i) {
        tin.z[i] = face[i].z;
    }
    return tin;
}

double raw_measure(Criterion criterion, const Tin& tin, std::array<std::uint32_t, 3> order = {0, 1, 2}) {
    return visit_criterion(criterion, tin, [&](const FaceCriterion auto& code) {
        return code.measure({order[0]}, {order[1]}, {order[2]});
    });
}

double reported(Criterion criterion, const Face& face, int decimals = 0) {
    const Tin tin = tin_of_face(face, decimals);
    return visit_criterion(criterion, tin, [](const FaceCriterion auto& code) {
        return code.to_report(code.measure({0}, {1}, {2}));
    });
}

unsigned anchors_of(Criterion criterion, const Face& face) {
    const Tin tin = tin_of_face(face);
    return visit_criterion(criterion, tin,
                           [](const FaceCriterion auto& code) { return code.anchors({0}, {1}, {2}); });
}

/// Counter-clockwise, or nothing if the corners are collinear.
bool orient(Face& face) {
    const int side = oracle::orient2d(face[0].key, face[1].key, face[2].key);
    if (side < 0) {
        std::swap(face[1], face[2]);
    }
    return side != 0;
}

/// Faces of any width and shape: from the families of keys, needles, isosceles ones, right angles.
Face any_face(Random& random) {
    const auto families = key_families();
    const auto pick =
        static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(families.size()) + 3));
    const double limit = std::ldexp(1.0, static_cast<int>(random.integer(4, 43)));
    const auto any = [&] { return random.key(limit); };
    Face face{};
    const double u = any();
    const double v = any();
    if (pick < families.size()) {
        const std::vector<Key2> keys = without_repetitions(families[pick].make(random, 40));
        for (Corner& corner : face) {
            corner.key =
                keys[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(keys.size()) - 1))];
        }
    } else if (pick == families.size()) {  // isosceles, about an axis
        face = {{{{0, v}, 0}, {{2 * u, v}, 0}, {{u, any()}, 0}}};
    } else if (pick == families.size() + 1) {  // isosceles and right-angled
        face = {{{{limit, limit}, 0}, {{limit + u, limit + v}, 0}, {{limit - v, limit + u}, 0}}};
    } else {  // within some keys of a line, or of a right angle
        const double k = random.key(1024);
        const bool is_needle = pick == families.size() + 2;
        const double w = std::floor(limit / 1024);
        const Key2 step{std::floor(u / 1024), std::floor(v / 1024)};
        const Key2 turned = is_needle ? step : Key2{-step.y, step.x};
        const double base = 2 * limit + w;
        face = {{{{base, base}, 0},
                 {{base + 512 * step.x, base + 512 * step.y}, 0},
                 {{base + k * turned.x + random.key(3), base + k * turned.y + random.key(3)}, 0}}};
    }
    const int relief = static_cast<int>(random.integer(0, 2));
    for (Corner& corner : face) {
        corner.z = relief == 0   ? static_cast<double>(random.integer(0, 3))
                   : relief == 1 ? 1e4 * random.real()
                                 : 812.37 + 1e-9 * random.real();
    }
    return face;
}

struct Vector {
    cpp_rational x;
    cpp_rational y;
};
cpp_rational dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
cpp_rational cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// What rational numbers say of a face: the largest angle's corner has the longest edge opposite.
struct Exact {
    std::array<Vector, 3> position;
    std::array<cpp_rational, 3> z;
    std::size_t corner = 0;
    cpp_rational longest;
    cpp_rational inner;
    cpp_rational area;
    Vector gradient;

    explicit Exact(const Face& face) {
        for (std::size_t i = 0; i < 3; ++i) {
            position[i] = {cpp_rational(face[i].key.x), cpp_rational(face[i].key.y)};
            z[i] = cpp_rational(face[i].z);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector opposite = edge((i + 1) % 3, (i + 2) % 3);
            if (dot(opposite, opposite) > longest) {
                longest = dot(opposite, opposite);
                corner = i;
            }
        }
        inner = dot(edge(corner, (corner + 1) % 3), edge(corner, (corner + 2) % 3));
        area = cross(edge(0, 1), edge(0, 2));
        const cpp_rational du = z[1] - z[0];
        const cpp_rational dv = z[2] - z[0];
        gradient = {(du * edge(0, 2).y - dv * edge(0, 1).y) / area,
                    (dv * edge(0, 1).x - du * edge(0, 2).x) / area};
    }
    [[nodiscard]] Vector edge(std::size_t from, std::size_t to) const {
        return {position[to].x - position[from].x, position[to].y - position[from].y};
    }
    [[nodiscard]] cpp_rational measure(Criterion criterion) const {
        switch (criterion) {
            case Criterion::Angle:
                return -inner / area;
            case Criterion::Height:
                return longest / (area * area);
            case Criterion::Slope:
                return dot(gradient, gradient);
            case Criterion::Eccentricity:
                break;
        }
        return inner >= 0 ? cpp_rational(0) : cpp_rational(longest * inner * inner / (area * area));
    }
    /// The corners whose line of steepest descent runs through the face; all three if it is level.
    [[nodiscard]] unsigned descent_corners() const {
        std::array<cpp_rational, 3> along;  // along a level line
        for (std::size_t i = 0; i < 3; ++i) {
            along[i] = cross(gradient, position[i]);
        }
        unsigned corners = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const cpp_rational left = along[(i + 1) % 3] - along[i];
            const cpp_rational right = along[(i + 2) % 3] - along[i];
            corners |= left * right <= 0 ? 1U << i : 0U;
        }
        return corners;
    }
};

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
            const double slope = std::sqrt(raw_measure(Criterion::Slope, tin));
            const double expected = std::sqrt(number(exact.measure(Criterion::Slope)));
            REQUIRE(std::abs(slope - expected) <= kError * slope_bound(face, exact));
        }
        CHECK(obtuse > cases(6000) / 4);
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
            long double height = INFINITY;
            for (std::size_t i = 0; i < 3; ++i) {
                const long double p = length(i, i + 1);
                const long double q = length(i, i + 2);
                const long double r = length(i + 1, i + 2);
                largest = std::max(largest, std::acos((p * p + q * q - r * r) / (2 * p * q)));
                height = std::min(height, 2 * area / r);
            }
            if (largest > 3.1L || area < 1e-2L) {
                continue;  // an arc cosine tells little there
            }
            const double degrees = static_cast<double>(largest) * 180 / std::numbers::pi;
            REQUIRE(reported(Criterion::Angle, face, 2) == doctest::Approx(degrees).epsilon(1e-12));
            REQUIRE(reported(Criterion::Height, face, 2) ==
                    doctest::Approx(static_cast<double>(height)).epsilon(1e-12));

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
        // A base of 8 under an angle of 135 degrees: the centre is 4 below it.
        const double rise = 4 * (std::sqrt(2.0) - 1);
        const Face obtuse{{{{0, 0}, 0}, {{8e12, 0}, 0}, {{4e12, std::round(1e12 * rise)}, 0}}};
        CHECK(reported(Criterion::Angle, obtuse, 12) == doctest::Approx(135).epsilon(1e-11));
        CHECK(reported(Criterion::Eccentricity, obtuse, 12) == doctest::Approx(4).epsilon(1e-11));
    }

    TEST_CASE(
        "the obtuse corner is the anchor for angle, height and eccentricity; without one there is none") {
        int obtuse = 0;
        int right = 0;
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            unsigned expected = 0;
            for (unsigned i = 0; i < 3; ++i) {
                const int sign =
                    oracle::angle_sign(face[(i + 1) % 3].key, face[i].key, face[(i + 2) % 3].key);
                expected |= sign < 0 ? 1U << i : 0U;
                right += sign == 0 ? 1 : 0;
            }
            obtuse += expected != 0 ? 1 : 0;
            for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
                REQUIRE(anchors_of(criterion, face) == expected);
            }
        }
        CHECK(obtuse > cases(6000) / 4);
        CHECK(right > cases(6000) / 100);
    }

    TEST_CASE("slope: the anchor is the corner whose descent line runs through the face") {
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            const unsigned exact = Exact(face).descent_corners();
            const unsigned anchors = anchors_of(Criterion::Slope, face);
            if (std::has_single_bit(exact)) {
                REQUIRE((anchors & exact) == exact);  // perhaps another in doubt
            } else {
                REQUIRE((anchors == 0 || (anchors & exact) == exact));
            }
        }
    }

    TEST_CASE(
        "slope: small integers leave no doubt: one anchor, none for level faces and for two descent lines") {
        std::array<int, 4> counts{};
        for (int seed = 0; seed < cases(10000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face{};
            const double limit = seed % 2 == 0 ? 5 : 0x1p24;
            for (Corner& corner : face) {
                corner = {{random.key(limit), random.key(limit)},
                          static_cast<double>(random.integer(0, 4)) / 8};
            }
            if (!orient(face)) {
                continue;
            }
            const unsigned exact = Exact(face).descent_corners();
            ++counts[static_cast<std::size_t>(std::popcount(exact))];
            REQUIRE(anchors_of(Criterion::Slope, face) == (std::has_single_bit(exact) ? exact : 0U));
        }
        CHECK(counts[0] == 0);
        CHECK(counts[1] > 0);
        CHECK(counts[2] > 0);
        CHECK(counts[3] > 0);
        // The gradient along the edge from corner 0 to corner 1, in all turns of the corners.
        Face face{{{{0, 0}, 0}, {{2, 0}, 2}, {{1, 1}, 1}}};
        for (int turn = 0; turn < 3; ++turn) {
            CHECK(anchors_of(Criterion::Slope, face) == 0);
            std::rotate(face.begin(), face.begin() + 1, face.end());
        }
        face[0].z += 0.001;
        CHECK(std::popcount(anchors_of(Criterion::Slope, face)) == 1);
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

    TEST_CASE("criteria are found by name, and say what they are") {
        for (const Criterion criterion : kCriteria) {
            CHECK(find_criterion(criterion_traits(criterion).name) == criterion);
            CHECK(criterion_traits(criterion).is_greater_better == (criterion == Criterion::Height));
            const bool is_strong = criterion == Criterion::Angle || criterion == Criterion::Height;
            CHECK((criterion_traits(criterion).condition == InsertionCondition::Strong) == is_strong);
        }
        CHECK_FALSE(find_criterion("delaunay").has_value());
        CHECK_FALSE(find_criterion("").has_value());
    }
}
