#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/geometry/predicates_internal.hpp"

#include "support/cases.hpp"
#include "support/noding_oracle.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr std::array kBits{1, 2, 3, 5, 10, 20, 30, 40, 45};

Key2 random_key(Random& random, int bits) {
    const double limit = std::ldexp(1.0, bits);
    return {random.key(limit), random.key(limit)};
}

/// Near the line through two keys, at a random place between them.
Key2 key_near(Random& random, Key2 a, Key2 b) {
    const double part = random.real();
    return {std::max(0.0, std::round(a.x + part * (b.x - a.x)) + static_cast<double>(random.integer(-1, 1))),
            std::max(0.0, std::round(a.y + part * (b.y - a.y)) + static_cast<double>(random.integer(-1, 1)))};
}

/// Segments that cross at all angles, or at an angle as small as keys allow.
std::array<Key2, 4> random_pair(Random& random, int bits) {
    const Key2 a = random_key(random, bits);
    const Key2 b = random_key(random, bits);
    if (random.integer(0, 1) == 0) {
        return {a, b, random_key(random, bits), random_key(random, bits)};
    }
    return {a, b, key_near(random, a, b), key_near(random, a, b)};
}

oracle::KeySegment segment(Key2 a, Key2 b) { return {a, b}; }

SquarePass pass_by_oracle(Key2 a, Key2 b, Key2 c) {
    if (oracle::is_on(c, {a, b})) {
        return SquarePass::Center;
    }
    if (oracle::passes_square({a, b}, c)) {
        return SquarePass::Through;
    }
    return oracle::is_within_half_step(c, {a, b}) ? SquarePass::Corner : SquarePass::Apart;
}

bool is_as_expected(const std::optional<oracle::Crossing>& expected, Key2 a, Key2 b, Key2 c, Key2 d) {
    if (do_cross(a, b, c, d) != expected.has_value()) {
        return false;
    }
    if (!expected) {
        return true;
    }
    const RoundedCrossing crossing = round_crossing(a, b, c, d);
    return crossing.key == expected->key && crossing.is_exact == expected->is_exact;
}

void check_crossing(Key2 a, Key2 b, Key2 c, Key2 d) {
    std::optional<oracle::Crossing> expected;
    if (a != b && c != d) {
        expected = oracle::crossing(segment(a, b), segment(c, d));
    }
    CHECK(is_as_expected(expected, a, b, c, d));
    CHECK(is_as_expected(expected, b, a, c, d));
    CHECK(is_as_expected(expected, c, d, a, b));
    CHECK(is_as_expected(expected, d, c, b, a));
}

void check_pass(Key2 a, Key2 b, Key2 c) {
    if (a == b) {
        return;
    }
    const SquarePass expected = pass_by_oracle(a, b, c);
    CHECK(pass_square(a, b, c) == expected);
    CHECK(pass_square(b, a, c) == expected);
    if (internal::is_apart_double(a, internal::direction(b, a), c)) {
        CHECK(expected == SquarePass::Apart);
    }
}

/// `check(random, bits)` for keys of all sizes.
template <class Check>
void for_each_size(int usual, const Check& check) {
    for (const int bits : kBits) {
        CAPTURE(bits);
        for (int seed = 0; seed < cases(usual); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            check(random, bits);
        }
    }
}

}  // namespace

TEST_SUITE("geometry/predicates: crossings") {
    TEST_CASE("segments cross exactly where rational arithmetic says, whatever their order and direction") {
        for_each_size(300, [](Random& random, int bits) {
            const auto [a, b, c, d] = random_pair(random, bits);
            check_crossing(a, b, c, d);
        });
    }

    TEST_CASE("a crossing halfway between lattice points goes to the greater one") {
        const RoundedCrossing half = round_crossing({0, 0}, {1, 1}, {0, 1}, {1, 0});
        CHECK(half.key == Key2{1, 1});
        CHECK_FALSE(half.is_exact);
        const RoundedCrossing exact = round_crossing({0, 0}, {2, 2}, {0, 2}, {2, 0});
        CHECK(exact.key == Key2{1, 1});
        CHECK(exact.is_exact);
    }

    TEST_CASE("a crossing near the ends of the key range is rounded exactly") {
        const double end = kKeyLimit - 1;
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto small = [&] { return static_cast<double>(random.integer(0, 3)); };
            check_crossing({small(), small()}, {end - small(), end - small()}, {small(), small()},
                           {end - small(), end - small()});
        }
    }

    TEST_CASE("two edges across a line come in the order that their crossings have") {
        // Edges between points at whole distances to the left and right of a line along an axis meet it at
        // places that are fractions with small denominators, which are compared as such.
        for (int seed = 0; seed < cases(3000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::int64_t width = random.integer(0, 1) == 0 ? 4 : 1000000000;
            const auto edge = [&] {
                return std::array{random.integer(-width, width), random.integer(1, 1000),
                                  random.integer(-width, width), random.integer(1, 1000)};
            };
            const auto e = edge();
            const auto f = edge();
            // x0 y1 + x1 y0 over y0 + y1
            const std::int64_t left = (e[0] * e[3] + e[2] * e[1]) * (f[1] + f[3]);
            const std::int64_t right = (f[0] * f[3] + f[2] * f[1]) * (e[1] + e[3]);
            const int expected = (left > right) - (left < right);
            const auto key = [](std::int64_t x, std::int64_t y) {
                return Key2{static_cast<double>(x), static_cast<double>(y)};
            };
            const Key2 c = key(e[0], e[1]);
            const Key2 d = key(e[2], -e[3]);
            const Key2 g = key(f[0], f[1]);
            const Key2 h = key(f[2], -f[3]);
            CHECK(compare_crossings({-5, 0}, {7, 0}, c, d, g, h) == expected);
            CHECK(compare_crossings({-5, 0}, {7, 0}, d, c, h, g) == expected);
            CHECK(compare_crossings({-5, 0}, {7, 0}, g, h, c, d) == -expected);
            CHECK(compare_crossings({0x1p51, 0}, {-0x1p51, 0}, c, d, g, h) == -expected);
        }
    }

    TEST_CASE("crossings that differ by less than doubles tell are still in order") {
        const double far = 0x1p50;
        // Both edges come down from far away; their feet are one step apart on either side of the line.
        CHECK(compare_crossings({0, 0}, {10, 0}, {0, far}, {1, -1}, {0, far - 1}, {1, -1}) == 1);
        CHECK(compare_crossings({0, 0}, {10, 0}, {0, far}, {1, -1}, {0, far}, {1, -1}) == 0);
        CHECK(compare_crossings({0, 0}, {10, 0}, {-far, far}, {2, -2}, {-far, far}, {3, -3}) == 0);
    }

    TEST_CASE("a segment passes lattice squares as rational arithmetic says, in either direction") {
        for_each_size(300, [](Random& random, int bits) {
            const Key2 a = random_key(random, bits);
            const Key2 b = random_key(random, bits);
            const bool is_anywhere = random.integer(0, 4) == 0;
            check_pass(a, b, is_anywhere ? random_key(random, bits) : key_near(random, a, b));
        });
    }

    TEST_CASE("every segment of a small lattice passes every square as it should, corners included") {
        const std::vector<Key2> keys = grid_keys(4, 4);
        for (const Key2 a : keys) {
            for (const Key2 b : keys) {
                std::for_each(keys.begin(), keys.end(), [&](Key2 c) { check_pass(a, b, c); });
            }
        }
    }
}
