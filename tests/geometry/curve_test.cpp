#include "tinwright/geometry/curve.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

std::vector<std::uint32_t> sorted_slowly(const std::vector<Key2>& keys) {
    std::vector<std::pair<std::string, std::uint32_t>> codes;
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        codes.emplace_back(oracle::curve_code(keys[i]), i);
    }
    std::sort(codes.begin(), codes.end());
    std::vector<std::uint32_t> order;
    for (const auto& [code, index] : codes) {
        order.push_back(index);
    }
    return order;
}

std::vector<Key2> picked(const std::vector<Key2>& keys, const std::vector<std::uint32_t>& order) {
    std::vector<Key2> result;
    for (const std::uint32_t i : order) {
        result.push_back(keys[i]);
    }
    return result;
}

}  // namespace

TEST_SUITE("geometry/curve") {
    TEST_CASE("the order of two keys is that of their interleaved bits") {
        for (const double limit : {2.0, 16.0, 0x1p32, 0x1p33, 0x1p45}) {
            CAPTURE(limit);
            for (int seed = 0; seed < cases(2000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const Key2 a{random.key(limit), random.key(limit)};
                const Key2 b = random.integer(0, 3) == 0 ? Key2{a.x, random.key(limit)}
                                                         : Key2{random.key(limit), random.key(limit)};
                REQUIRE(precedes_on_curve(a, b) == (oracle::curve_code(a) < oracle::curve_code(b)));
                REQUIRE_FALSE(precedes_on_curve(a, a));
            }
        }
    }

    TEST_CASE("sorting gives the slow order, equal keys by ascending index") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                std::vector<Key2> keys = family.make(
                    random, static_cast<std::size_t>(random.integer(1, seed % 3 == 0 ? 4000 : 60)));
                // Repeat a third of them.
                for (std::size_t i = keys.size() / 3; i > 0; --i) {
                    keys.push_back(keys[i]);
                }
                REQUIRE(sort_along_curve(keys) == sorted_slowly(keys));
            }
        }
    }

    TEST_CASE("large sets are sorted, whatever part of the keys fits beside the index in a word") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(31);
            std::vector<Key2> keys = family.make(random, 150000);
            keys.insert(keys.end(), keys.begin(),
                        keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 4));
            const std::vector<std::uint32_t> order = sort_along_curve(keys);
            REQUIRE(order.size() == keys.size());
            std::vector<bool> is_met(keys.size(), false);
            std::size_t misplaced = 0;
            for (std::size_t i = 0; i < order.size(); ++i) {
                is_met[order[i]] = true;
                if (i > 0) {
                    const Key2 a = keys[order[i - 1]];
                    const Key2 b = keys[order[i]];
                    misplaced += precedes_on_curve(a, b) || (a == b && order[i - 1] < order[i]) ? 0 : 1;
                }
            }
            CHECK(misplaced == 0);
            CHECK(std::count(is_met.begin(), is_met.end(), false) == 0);
        }
    }

    TEST_CASE("no key, one key and many equal keys are sorted") {
        CHECK(sort_along_curve({}).empty());
        const std::vector<Key2> one{{5, 7}};
        CHECK(sort_along_curve(one) == std::vector<std::uint32_t>{0});
        for (const Key2 key : {Key2{0, 0}, Key2{0x1p45 - 1, 0x1p45 - 1}}) {
            const std::vector<Key2> equal(100000, key);
            std::vector<std::uint32_t> ascending(equal.size());
            std::iota(ascending.begin(), ascending.end(), 0U);
            CHECK(sort_along_curve(equal) == ascending);
        }
    }

    TEST_CASE("the order is the same for any number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(11);
            const std::vector<Key2> keys = family.make(random, 100000);
            std::vector<std::uint32_t> expected;
            tbb::task_arena(1).execute([&] { expected = sort_along_curve(keys); });
            for (const int threads : {2, 4}) {
                CAPTURE(threads);
                tbb::task_arena(threads).execute([&] { CHECK(sort_along_curve(keys) == expected); });
            }
        }
    }

    TEST_CASE("a split separates a range by one axis where the codes first differ") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(20); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Key2> distinct = without_repetitions(family.make(random, 50));
                const std::vector<Key2> keys = picked(distinct, sort_along_curve(distinct));
                if (keys.size() < 2) {
                    continue;
                }
                const CurveSplit split = find_curve_split(keys);
                REQUIRE(split.middle > 0);
                REQUIRE(split.middle < keys.size());
                const std::string low = oracle::curve_code(keys.front());
                const std::string high = oracle::curve_code(keys.back());
                const auto bit = static_cast<std::size_t>(
                    std::mismatch(low.begin(), low.end(), high.begin()).first - low.begin());
                REQUIRE(split.axis == static_cast<int>(bit % 2));
                for (std::size_t i = 0; i < keys.size(); ++i) {
                    REQUIRE(oracle::curve_code(keys[i])[bit] == (i < split.middle ? '0' : '1'));
                }
            }
        }
    }
}
