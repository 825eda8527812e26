#include "tinwright/geometry/predicates.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates_internal.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// Widths at which the tiers hand over to each other, and the limits of the contract.
constexpr std::array kLimits{0x1p8, 0x1p13, 0x1p26, 0x1p30, 0x1p45, 0x1p52};

using Triple = std::array<Key2, 3>;
using Four = std::array<Key2, 4>;

Key2 moved(Random& random, Key2 key, double limit) {
    const auto shift = [&](double v) {
        return std::fmin(std::fmax(v + static_cast<double>(random.integer(-1, 1)), -limit), limit);
    };
    return {shift(key.x), shift(key.y)};
}

/// Three keys within `limit` of zero: anywhere, on a line, or within a key of one.
Triple near_line(Random& random, double limit) {
    const auto any = [&] { return std::floor((2 * random.real() - 1) * limit); };
    const Key2 a{any(), any()};
    const Key2 b{any(), any()};
    switch (random.integer(0, 3)) {
        case 0:
            return {a, b, {any(), any()}};
        case 1:
            return {a, b, moved(random, a, limit)};
        default: {
            // Whole steps from a corner of the square, so that the third key is exactly on the line.
            const double parts = std::ldexp(1.0, static_cast<int>(random.integer(1, 6)));
            const Key2 step{std::floor(any() / parts), std::floor(any() / parts)};
            const auto on_line = [&](double k) { return Key2{k * step.x, k * step.y}; };
            const Triple line{on_line(random.key(parts)), on_line(-random.key(parts)),
                              on_line(random.key(parts))};
            return random.integer(0, 1) == 0 ? line : Triple{line[0], line[1], moved(random, line[2], limit)};
        }
    }
}

/// Four keys: anywhere, on a circle, or within a key of one.
Four near_circle(Random& random, double limit) {
    const auto any = [&] { return std::floor((2 * random.real() - 1) * limit); };
    switch (random.integer(0, 3)) {
        case 0:
            return {{{any(), any()}, {any(), any()}, {any(), any()}, {any(), any()}}};
        case 1: {  // a rectangle with its sides along (u, v)
            const double part = limit / 8;
            const double u = std::floor((2 * random.real() - 1) * part);
            const double v = std::floor((2 * random.real() - 1) * part);
            const double m = static_cast<double>(random.integer(1, 3));
            const double n = static_cast<double>(random.integer(1, 3));
            return {{{0, 0}, {m * u, m * v}, {m * u - n * v, m * v + n * u}, {-n * v, n * u}}};
        }
        case 2: {  // an isosceles trapezoid along the axes
            const double w = std::floor(random.real() * limit);
            const double s = std::floor(random.real() * w);
            const double h = any();
            return {{{-w, 0}, {w, 0}, {s, h}, {-s, h}}};
        }
        default: {
            Four four{};
            for (Key2& key : four) {
                const double angle = 6.283185307179586 * random.real();
                key = {std::round(limit * std::cos(angle)), std::round(limit * std::sin(angle))};
            }
            return four;
        }
    }
}

Four near_circle_moved(Random& random, double limit) {
    Four four = near_circle(random, limit);
    if (random.integer(0, 2) == 0) {
        Key2& key = four[static_cast<std::size_t>(random.integer(0, 3))];
        key = moved(random, key, limit);
    }
    for (std::size_t i = 3; i > 0; --i) {
        std::swap(four[i], four[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i)))]);
    }
    return four;
}

/// Two segments within `limit` of zero: any, as long as each other, or all but so.
Four near_equal_distances(Random& random, double limit) {
    const double part = limit / 2;
    const auto any = [&] { return std::floor((2 * random.real() - 1) * part); };
    const Key2 a{any(), any()};
    const Key2 c{any(), any()};
    const Key2 step{any(), any()};
    const Key2 turned = random.integer(0, 1) == 0 ? Key2{-step.y, step.x} : Key2{step.y, step.x};
    Four four{{a, {a.x + step.x, a.y + step.y}, c, {c.x + turned.x, c.y + turned.y}}};
    switch (random.integer(0, 3)) {
        case 0:
            four[3] = {any(), any()};
            break;
        case 1:
            four[3] = moved(random, four[3], limit);
            break;
        default:
            break;
    }
    return four;
}

/// a, apex, b within `limit` of zero: any angle, a right one, or all but so.
Triple near_right_angle(Random& random, double limit) {
    const double part = limit / 8;
    const auto any = [&] { return std::floor((2 * random.real() - 1) * part); };
    const Key2 apex{any(), any()};
    const Key2 step{any(), any()};
    const double k = static_cast<double>(random.integer(-4, 4));
    Triple triple{{{apex.x + step.x, apex.y + step.y}, apex, {apex.x - k * step.y, apex.y + k * step.x}}};
    switch (random.integer(0, 3)) {
        case 0:
            triple[2] = {any(), any()};
            break;
        case 1:
            triple[2] = moved(random, triple[2], limit);
            break;
        default:
            break;
    }
    return triple;
}

bool are_distinct(const Four& p) {
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (p[i] == p[j]) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

TEST_SUITE("geometry/predicates") {
    TEST_CASE("orient2d: every tier that answers agrees with integers of any length") {
        for (const double limit : kLimits) {
            CAPTURE(limit);
            int zeros = 0;
            for (int seed = 0; seed < cases(4000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto [a, b, c] = near_line(random, limit);
                const int expected = oracle::orient2d(a, b, c);
                zeros += expected == 0 ? 1 : 0;
                REQUIRE(orient2d(a, b, c) == expected);
                REQUIRE(internal::orient2d_int128(a, b, c) == expected);
                const int fast = internal::orient2d_double(a, b, c);
                REQUIRE((fast == expected || fast == internal::kUnsure));
            }
            CHECK(zeros > cases(4000) / 20);  // the families do reach collinear triples
        }
    }

    TEST_CASE("orient2d: rotating keeps the sign, swapping negates it") {
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto [a, b, c] = near_line(random, 0x1p52);
            const int turn = orient2d(a, b, c);
            REQUIRE(orient2d(b, c, a) == turn);
            REQUIRE(orient2d(c, a, b) == turn);
            REQUIRE(orient2d(b, a, c) == -turn);
            REQUIRE(orient2d(a, c, b) == -turn);
            REQUIRE(orient2d(c, b, a) == -turn);
        }
    }

    TEST_CASE("orient2d: plain doubles decide small keys and clear cases, not a key's width at 2^45") {
        CHECK(internal::orient2d_double({0, 0}, {0x1p25, 0x1p25}, {1, 1}) == 0);
        CHECK(internal::orient2d_double({0, 0}, {0x1p45, 0}, {0, 0x1p45}) == 1);
        const Key2 far{0x1p45 - 1, 0x1p45 - 3};
        const Key2 half{0x1p44 - 1, 0x1p44 - 2};
        CHECK(internal::orient2d_double({0, 0}, far, half) == internal::kUnsure);
        CHECK(internal::orient2d_int128({0, 0}, far, half) == oracle::orient2d({0, 0}, far, half));
        CHECK(orient2d({0, 0}, far, half) != 0);
    }

    TEST_CASE("incircle: every tier that answers agrees with integers of any length") {
        for (const double limit : kLimits) {
            CAPTURE(limit);
            int zeros = 0;
            for (int seed = 0; seed < cases(4000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto [a, b, c, d] = near_circle_moved(random, limit);
                const int expected = oracle::incircle(a, b, c, d);
                zeros += expected == 0 ? 1 : 0;
                REQUIRE(incircle(a, b, c, d) == expected);
                REQUIRE(internal::incircle_int256(a, b, c, d) == expected);
                const int fast = internal::incircle_double(a, b, c, d);
                REQUIRE((fast == expected || fast == internal::kUnsure));
                const int medium = internal::incircle_int128(a, b, c, d);
                REQUIRE((medium == expected || medium == internal::kUnsure));
            }
            CHECK(zeros > cases(4000) / 20);
        }
    }

    TEST_CASE("incircle: rotating keeps the sign, any swap negates it") {
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto [a, b, c, d] = near_circle_moved(random, 0x1p52);
            const int side = incircle(a, b, c, d);
            REQUIRE(incircle(b, c, a, d) == side);
            REQUIRE(incircle(c, a, b, d) == side);
            REQUIRE(incircle(b, a, c, d) == -side);
            REQUIRE(incircle(a, c, b, d) == -side);
            REQUIRE(incircle(c, b, a, d) == -side);
            REQUIRE(incircle(d, b, c, a) == -side);
            REQUIRE(incircle(a, d, c, b) == -side);
            REQUIRE(incircle(a, b, d, c) == -side);
        }
    }

    TEST_CASE("incircle: each tier has its own inputs") {
        const auto square = [](double side) { return Four{{{0, 0}, {side, 0}, {side, side}, {0, side}}}; };
        const auto small = square(0x1p12);
        CHECK(internal::incircle_double(small[0], small[1], small[2], small[3]) == 0);
        const auto medium = square(0x1p30);
        CHECK(internal::incircle_double(medium[0], medium[1], medium[2], medium[3]) == internal::kUnsure);
        CHECK(internal::incircle_int128(medium[0], medium[1], medium[2], medium[3]) == 0);
        const auto large = square(0x1p30 + 1);
        CHECK(internal::incircle_double(large[0], large[1], large[2], large[3]) == internal::kUnsure);
        CHECK(internal::incircle_int128(large[0], large[1], large[2], large[3]) == internal::kUnsure);
        CHECK(internal::incircle_int256(large[0], large[1], large[2], large[3]) == 0);
        const Four widest{{{-0x1p52, -0x1p52}, {0x1p52, -0x1p52}, {0x1p52, 0x1p52}, {-0x1p52, 0x1p52}}};
        CHECK(internal::incircle_int256(widest[0], widest[1], widest[2], widest[3]) == 0);
        CHECK(internal::incircle_int256(widest[0], widest[1], widest[2], {-0x1p52, 0x1p52 - 1}) == 1);
        CHECK(internal::incircle_int256(widest[0], widest[1], widest[2], {1 - 0x1p52, 0x1p52}) == 1);
        CHECK(internal::incircle_double({0, 0}, {0x1p45, 0}, {0, 0x1p45}, {1, 1}) == 1);
    }

    TEST_CASE("incircle_perturbed is the in-circle test of points truly lifted off the paraboloid") {
        for (const double limit : kLimits) {
            CAPTURE(limit);
            int ties = 0;
            for (int seed = 0; seed < cases(1500); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                auto [a, b, c, d] = near_circle_moved(random, limit);
                if (oracle::orient2d(a, b, c) < 0) {
                    std::swap(b, c);
                }
                if (!are_distinct({a, b, c, d}) || oracle::orient2d(a, b, c) == 0) {
                    continue;
                }
                const int side = incircle_perturbed(a, b, c, d);
                ties += oracle::incircle(a, b, c, d) == 0 ? 1 : 0;
                REQUIRE(side == oracle::incircle_perturbed(a, b, c, d));
                REQUIRE(side != 0);
                REQUIRE(incircle_perturbed(b, c, a, d) == side);
                REQUIRE(incircle_perturbed(b, a, c, d) == -side);
                REQUIRE(incircle_perturbed(a, b, d, c) == -side);
                REQUIRE(incircle_perturbed(d, b, c, a) == -side);
            }
            CHECK(ties > cases(1500) / 20);
        }
    }

    TEST_CASE("of a square's two diagonals the perturbation takes the one without the greatest key") {
        // The greatest key, (1, 1), is lifted most: it lies above the plane of the other three, so outside.
        CHECK(incircle_perturbed({0, 0}, {1, 0}, {0, 1}, {1, 1}) == -1);
        CHECK(incircle_perturbed({0, 0}, {1, 0}, {1, 1}, {0, 1}) == 1);
    }

    TEST_CASE("compare_distances: every tier that answers agrees with integers of any length") {
        for (const double limit : kLimits) {
            CAPTURE(limit);
            int zeros = 0;
            for (int seed = 0; seed < cases(4000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto [a, b, c, d] = near_equal_distances(random, limit);
                const int expected = oracle::compare_distances(a, b, c, d);
                zeros += expected == 0 ? 1 : 0;
                REQUIRE(compare_distances(a, b, c, d) == expected);
                REQUIRE(internal::compare_distances_int128(a, b, c, d) == expected);
                const int fast = internal::compare_squares(internal::localize(a, b).square,
                                                           internal::localize(c, d).square);
                REQUIRE((fast == expected || fast == internal::kUnsure));
                REQUIRE(compare_distances(b, a, c, d) == expected);
                REQUIRE(compare_distances(a, b, d, c) == expected);
                REQUIRE(compare_distances(c, d, a, b) == -expected);
            }
            CHECK(zeros > cases(4000) / 5);
        }
    }

    TEST_CASE(
        "compare_distances: plain doubles decide small keys and clear cases, not a key's width at 2^45") {
        const auto fast = [](Key2 a, Key2 b, Key2 c, Key2 d) {
            return internal::compare_squares(internal::localize(a, b).square,
                                             internal::localize(c, d).square);
        };
        CHECK(fast({0, 0}, {0x1p25, 1}, {5, 5}, {6, 5 + 0x1p25}) == 0);
        CHECK(fast({0, 0}, {0x1p45, 0}, {0, 0}, {0x1p44, 0x1p44}) == 1);
        CHECK(fast({0, 0}, {0x1p45, 1}, {0, 0}, {0x1p45, 0}) == internal::kUnsure);
        CHECK(compare_distances({0, 0}, {0x1p45, 1}, {0, 0}, {0x1p45, 0}) == 1);
        // The widest keys: the diagonals of the contract's square, one of them a key shorter.
        const double most = 0x1p52;
        CHECK(compare_distances({-most, -most}, {most, most}, {-most, most}, {most, -most}) == 0);
        CHECK(compare_distances({-most, -most}, {most, most}, {-most, most}, {most, 1 - most}) == 1);
    }

    TEST_CASE("angle_sign: every tier that answers agrees with integers of any length") {
        for (const double limit : kLimits) {
            CAPTURE(limit);
            int zeros = 0;
            for (int seed = 0; seed < cases(4000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto [a, apex, b] = near_right_angle(random, limit);
                const int expected = oracle::angle_sign(a, apex, b);
                zeros += expected == 0 ? 1 : 0;
                REQUIRE(angle_sign(a, apex, b) == expected);
                REQUIRE(angle_sign(b, apex, a) == expected);
                REQUIRE(internal::angle_sign_int128(a, apex, b) == expected);
                const int fast =
                    internal::inner_product_local(internal::localize(a, apex), internal::localize(b, apex));
                REQUIRE((fast == expected || fast == internal::kUnsure));
            }
            CHECK(zeros > cases(4000) / 5);
        }
    }

    TEST_CASE("angle_sign: the textbook's angles, and a key's width at 2^45") {
        CHECK(angle_sign({1, 0}, {0, 0}, {1, 1}) == 1);
        CHECK(angle_sign({1, 0}, {0, 0}, {0, 1}) == 0);
        CHECK(angle_sign({1, 0}, {0, 0}, {-1, 1}) == -1);
        const Key2 far{0x1p45, 0x1p45 - 1};
        const Key2 right{1 - 0x1p45, 0x1p45};
        const Key2 acute{2 - 0x1p45, 0x1p45};
        CHECK(internal::inner_product_local(internal::localize(far, {0, 0}),
                                            internal::localize(right, {0, 0})) == internal::kUnsure);
        CHECK(angle_sign(far, {0, 0}, right) == 0);
        CHECK(angle_sign(far, {0, 0}, acute) == 1);
        CHECK(angle_sign({0x1p52, 0x1p52}, {-0x1p52, -0x1p52}, {1 - 0x1p52, -0x1p52}) == 1);
    }

    TEST_CASE("keys are ordered by x, then y") {
        CHECK(precedes({0, 9}, {1, 0}));
        CHECK(precedes({1, 0}, {1, 1}));
        CHECK_FALSE(precedes({1, 1}, {1, 1}));
        CHECK_FALSE(precedes({2, 0}, {1, 1}));
    }
}
