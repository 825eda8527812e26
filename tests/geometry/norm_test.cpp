#include "tinwright/geometry/norm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr double kWidest = 0x1p53;

using Segment = std::array<Key2, 2>;

/// A segment with these coordinate differences (or swapped ones), somewhere within 2^52 of zero, in either
/// direction along each axis.
Segment any_segment(Random& random, double x, double y) {
    if (random.integer(0, 1) == 0) {
        std::swap(x, y);
    }
    const auto ends = [&random](double difference) {
        const double low = std::floor((kWidest - difference) * random.real()) - kWidest / 2;
        return random.integer(0, 1) == 0 ? std::pair(low, low + difference)
                                         : std::pair(low + difference, low);
    };
    const auto [ax, bx] = ends(x);
    const auto [ay, by] = ends(y);
    return {{{ax, ay}, {bx, by}}};
}

int compare(Norm norm, const Segment& s, const Segment& t) {
    return compare_lengths(norm, s[0], s[1], t[0], t[1]);
}

/// What integers of any length say, once it is checked that the library says so too, whichever segment and
/// end comes first.
int checked_sign(Norm norm, const Segment& s, const Segment& t) {
    const int expected = oracle::compare_lengths(norm, s[0], s[1], t[0], t[1]);
    REQUIRE(compare(norm, s, t) == expected);
    REQUIRE(compare(norm, t, s) == -expected);
    REQUIRE(compare(norm, {s[1], s[0]}, t) == expected);
    REQUIRE(compare(norm, s, {t[1], t[0]}) == expected);
    return expected;
}

std::vector<Norm> all_norms() {
    std::vector<Norm> norms{Norm::maximum()};
    for (int p = 1; p <= Norm::kLargestPower; ++p) {
        norms.push_back(Norm::lp(p));
    }
    return norms;
}

Norm any_norm(Random& random) {
    const std::vector<Norm> norms = all_norms();
    const auto last = static_cast<std::int64_t>(norms.size()) - 1;
    // Half of them with a small p, which people use.
    return norms[static_cast<std::size_t>(random.integer(0, random.integer(0, 1) == 0 ? 5 : last))];
}

/// A whole number from 0 to `limit`.
double any_difference(Random& random, double limit) { return std::floor((limit + 1) * random.real()); }

}  // namespace

TEST_SUITE("geometry/norm") {
    TEST_CASE("lengths compare as integers of any length say, at all widths and in all norms") {
        std::array<int, 3> signs{};
        for (int seed = 0; seed < cases(4000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Norm norm = any_norm(random);
            CAPTURE(norm_name(norm));
            const double limit = std::ldexp(1.0, static_cast<int>(random.integer(1, 53)));
            const auto any = [&] {
                return any_segment(random, any_difference(random, limit), any_difference(random, limit));
            };
            const Segment s = any();
            ++signs[static_cast<std::size_t>(checked_sign(norm, s, any()) + 1)];
        }
        CHECK(*std::min_element(signs.begin(), signs.end()) > 0);
    }

    TEST_CASE("swapped and mirrored differences tie, one step more or less decides") {
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Norm norm = any_norm(random);
            const double limit = std::ldexp(1.0, static_cast<int>(random.integer(1, 53)));
            const double x = any_difference(random, limit);
            const double y = any_difference(random, limit);
            const Segment s = any_segment(random, x, y);
            REQUIRE(checked_sign(norm, s, any_segment(random, x, y)) == 0);
            const auto step = [&random](double value) {
                return std::clamp(value + static_cast<double>(random.integer(-1, 1)), 0.0, kWidest);
            };
            checked_sign(norm, s, any_segment(random, step(x), step(y)));
        }
    }

    TEST_CASE("lengths that differ by less than one step in one coordinate are told apart") {
        int near_ties = 0;
        for (int seed = 0; seed < cases(3000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Norm norm = any_norm(random);
            if (norm.is_maximum()) {
                continue;
            }
            CAPTURE(norm_name(norm));
            const double limit = std::ldexp(1.0, static_cast<int>(random.integer(3, 53)));
            // From (x, y) to (u, v) of nearly the same length; u near x makes v near y.
            const double x = any_difference(random, limit);
            const double y = any_difference(random, x);
            const double loss = std::floor(x * std::pow(random.real(), 12));
            const double u = random.integer(0, 1) == 0 ? x - std::min(x, loss) : any_difference(random, x);
            const Segment s = any_segment(random, x, y);
            const Segment flat = any_segment(random, u, 0);
            if (oracle::compare_lengths(norm, flat[0], flat[1], {0, 0}, {x, x}) > 0) {
                continue;
            }
            double low = 0;
            double high = kWidest;  // the longest v that makes u v no longer than x y, by halving
            while (low < high) {
                const double middle = low + std::ceil((high - low) / 2);
                const bool fits = oracle::compare_lengths(norm, {0, 0}, {u, middle}, s[0], s[1]) <= 0;
                (fits ? low : high) = fits ? middle : middle - 1;
            }
            if (low + 1 > kWidest) {
                continue;
            }
            const int below = checked_sign(norm, any_segment(random, u, low), s);
            const int above = checked_sign(norm, any_segment(random, u, low + 1), s);
            REQUIRE(below <= 0);
            REQUIRE(above > 0);
            near_ties += below < 0 ? 1 : 0;
        }
        CHECK(near_ties > cases(3000) / 2);
    }

    TEST_CASE("sums of equal powers tie, and near misses of Fermat's equation do not") {
        struct Example {
            int p;
            std::array<double, 2> one;
            std::array<double, 2> other;
            int sign;
        };
        const std::vector<Example> examples{
            {2, {3, 4}, {5, 0}, 0},
            {2, {7, 4}, {8, 1}, 0},
            {2, {20, 21}, {29, 0}, 0},
            {3, {1, 12}, {9, 10}, 0},
            {3, {3, 5}, {6, 0}, -1},
            {3, {167, 436}, {228, 423}, 0},
            {4, {59, 158}, {133, 134}, 0},
            {4, {7, 239}, {157, 227}, 0},
            // Ramanujan's: a^3 + b^3 = c^3 + 1 and - 1 in turn.
            {3, {9, 10}, {12, 0}, 1},
            {3, {135, 138}, {172, 0}, -1},
            {3, {11161, 11468}, {14258, 0}, 1},
            {3, {926271, 951690}, {1183258, 0}, -1},
            {3, {76869289, 78978818}, {98196140, 0}, 1},
            {3, {6379224759, 6554290188}, {8149096378, 0}, -1},
            {3, {529398785665, 543927106802}, {676276803218, 0}, 1},
            {3, {43933719985479, 45139395574362}, {56122825570732, 0}, -1},
            {3, {3645969360009049, 3746025905565260}, {4657518245567522, 0}, 1},
            {12, {1782, 1841}, {1922, 0}, -1},
            {12, {3987, 4365}, {4472, 0}, 1},
        };
        Random random(1);
        for (const Example& example : examples) {
            const auto& [p, one, other, sign] = example;
            CAPTURE(example.p);
            CAPTURE(example.one[0]);
            const double largest = std::max({one[0], one[1], other[0]});
            for (double scale = 1; scale * largest <= kWidest; scale = std::floor(3.7 * scale)) {
                const Segment s = any_segment(random, scale * one[0], scale * one[1]);
                const Segment t = any_segment(random, scale * other[0], scale * other[1]);
                CHECK(checked_sign(Norm::lp(p), s, t) == sign);
            }
        }
    }

    TEST_CASE("the widest keys, and widths that differ as much as can be") {
        Random random(1);
        const std::vector<double> values{0,           1,           2,           0x1p26,      0x1p52,
                                         0x1p52 + 1,  0x1p53 - 64, 0x1p53 - 2,  0x1p53 - 1,  0x1p53,
                                         0x1p51 + 55, 0x1p50,      0x1p49 + 99, 0x1p48 - 17, 1e9 + 7};
        for (const Norm norm : all_norms()) {
            CAPTURE(norm_name(norm));
            for (int i = 0; i < cases(200); ++i) {
                const auto any = [&] {
                    const auto last = static_cast<std::int64_t>(values.size()) - 1;
                    return values[static_cast<std::size_t>(random.integer(0, last))];
                };
                const std::array<double, 4> v{any(), any(), any(), any()};
                checked_sign(norm, any_segment(random, v[0], v[1]), any_segment(random, v[2], v[3]));
            }
            checked_sign(norm, {{{-0x1p52, -0x1p52}, {0x1p52, 0x1p52}}},
                         {{{-0x1p52, 0x1p52}, {0x1p52, -0x1p52 + 1}}});
            CHECK(compare_lengths(norm, {1, 1}, {1, 1}, {7, -9}, {7, -9}) == 0);
        }
    }

    TEST_CASE("a length is within 2^-44 of the true one, and overflows nowhere") {
        for (int seed = 0; seed < cases(1500); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Norm norm = any_norm(random);
            CAPTURE(norm_name(norm));
            const auto any = [&] {
                const double limit = std::ldexp(1.0, static_cast<int>(random.integer(0, 53)));
                return random.integer(0, 9) == 0 ? limit : any_difference(random, limit);
            };
            const double x = any();
            const double y = random.integer(0, 9) == 0 ? x : any();
            const auto [a, b] = any_segment(random, x, y);
            const double value = length(norm, a, b);
            REQUIRE(oracle::is_length(value, 0x1p-44, norm, a, b));
            REQUIRE(length(norm, b, a) == value);
            const auto [c, d] = any_segment(random, x, y);
            REQUIRE(length(norm, c, d) == value);
        }
        for (const Norm norm : all_norms()) {
            CHECK(length(norm, {3, 4}, {3, 4}) == 0);
            CHECK(length(norm, {-0x1p52, 0}, {0x1p52, 0}) == 0x1p53);
            CHECK(oracle::is_length(length(norm, {-0x1p52, -0x1p52}, {0x1p52, 0x1p52}), 0x1p-44, norm,
                                    {-0x1p52, -0x1p52}, {0x1p52, 0x1p52}));
        }
        CHECK(length(Norm(), {1, 1}, {4, 5}) == 5);
        CHECK(length(Norm::lp(1), {1, 1}, {4, 5}) == 7);
        CHECK(length(Norm::maximum(), {1, 1}, {4, 5}) == 4);
        CHECK(length(Norm::lp(3), {0, 0}, {3, 4}) == doctest::Approx(std::cbrt(91.0)).epsilon(1e-15));
    }

    TEST_CASE("the triangle inequality holds, and lengths shrink as p grows") {
        const std::vector<Norm> norms = all_norms();
        for (int seed = 0; seed < cases(500); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto any = [&] { return Key2{random.key(0x1p52), -random.key(0x1p52)}; };
            const Key2 a = any();
            const Key2 b = any();
            const Key2 c = any();
            double longest = length(Norm::lp(1), a, b);
            for (const Norm norm : norms) {
                REQUIRE(length(norm, a, c) <= (length(norm, a, b) + length(norm, b, c)) * (1 + 0x1p-43));
                if (!norm.is_maximum()) {
                    REQUIRE(length(norm, a, b) <= longest * (1 + 0x1p-43));
                    longest = length(norm, a, b);
                }
            }
            REQUIRE(length(Norm::maximum(), a, b) <= longest);
        }
    }

    TEST_CASE("norms go by the names of --norm") {
        CHECK(norm_name(Norm()) == "l2");
        CHECK(norm_name(Norm::lp(1)) == "l1");
        CHECK(norm_name(Norm::maximum()) == "linf");
        CHECK(norm_name(Norm::lp(3)) == "lp:3");
        CHECK(norm_name(Norm::lp(64)) == "lp:64");
        for (const Norm norm : all_norms()) {
            CHECK(find_norm(norm_name(norm)) == norm);
            if (!norm.is_maximum()) {
                CHECK(find_norm("lp:" + std::to_string(norm.power())) == norm);
            }
        }
        CHECK(Norm::lp(2).is_euclidean());
        CHECK_FALSE(Norm::maximum().is_euclidean());
        for (const char* name :
             {"", "l", "l3", "L2", "lp", "lp:", "lp:0", "lp:65", "lp:-1", "lp:+3", "lp:1.5", "lp:3 ", " lp:3",
              "lp: 3", "lp:99999999999", "lp:inf", "l2x", "linfinity"}) {
            CAPTURE(name);
            CHECK_FALSE(find_norm(name).has_value());
        }
    }

    TEST_CASE("there is no norm without a whole p from 1 to 64") {
        for (const int p : {0, -1, 65, 1 << 30}) {
            CHECK_THROWS_WITH_AS(static_cast<void>(Norm::lp(p)),
                                 ("there is no norm lp:" + std::to_string(p) +
                                  "; p is a whole number from 1 to 64, or use linf")
                                     .c_str(),
                                 UsageError);
        }
    }
}
