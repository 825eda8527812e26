#include "tinwright/water/isotonic_regression.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/isotonic_oracle.hpp"
#include "support/point_sets.hpp"

using tinwright::Fall;
using tinwright::fit_levels;
using tinwright::LevelFit;
using tinwright::LevelNode;
using tinwright::RiverFit;
using tinwright_tests::cases;
using tinwright_tests::Random;
namespace oracle = tinwright_tests::oracle;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct River {
    std::vector<LevelNode> nodes;
    std::vector<Fall> falls;
};

std::uint32_t below(Random& random, std::size_t limit) {
    return static_cast<std::uint32_t>(random.integer(0, static_cast<std::int64_t>(limit) - 1));
}

/// A target: one of few, so that many are equal, or any.
double random_target(Random& random, bool is_coarse) {
    return is_coarse ? static_cast<double>(random.integer(0, 5)) : 100 * random.real();
}

/// Weights that differ little, not at all, or by twelve powers of ten.
double random_weight(Random& random, std::int64_t kind) {
    if (kind == 0) {
        return 1;
    }
    return kind == 1 ? 0.5 + random.real() : std::pow(10.0, static_cast<double>(random.integer(-6, 6)));
}

std::vector<LevelNode> random_nodes(Random& random, std::size_t count) {
    const bool is_coarse = random.integer(0, 1) == 0;
    const std::int64_t kind = random.integer(0, 2);
    std::vector<LevelNode> nodes(count);
    for (LevelNode& node : nodes) {
        node.target = random_target(random, is_coarse);
        node.weight = random_weight(random, kind);
    }
    return nodes;
}

std::vector<Fall> chain(std::size_t count) {
    std::vector<Fall> falls;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        falls.push_back({i, i + 1});
    }
    return falls;
}

/// Falls between any nodes, as many as `falls`, from one to itself and in circles perhaps.
std::vector<Fall> any_falls(Random& random, std::size_t count, std::size_t falls) {
    std::vector<Fall> result;
    for (std::size_t i = 0; i < falls; ++i) {
        result.push_back({below(random, count), below(random, count)});
    }
    return result;
}

/// Falls from smaller to greater numbers, then with numbers shuffled.
std::vector<Fall> acyclic_falls(Random& random, std::size_t count, std::size_t falls) {
    std::vector<std::uint32_t> name(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        name[i] = i;
        std::swap(name[i], name[below(random, i + 1)]);
    }
    std::vector<Fall> result;
    for (std::size_t i = 0; i < falls; ++i) {
        const std::uint32_t p = below(random, count);
        const std::uint32_t q = below(random, count);
        if (p != q) {
            result.push_back({name[std::min(p, q)], name[std::max(p, q)]});
        }
    }
    return result;
}

/// Each node but the last runs to one, not far off.
std::vector<Fall> tree_falls(Random& random, std::size_t count) {
    std::vector<Fall> falls;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        falls.push_back({i, i + 1 + below(random, std::min<std::size_t>(count - i - 1, 20))});
    }
    return falls;
}

/// Some nodes get ranges about their targets, some are given.
void bound_at_random(Random& random, std::vector<LevelNode>& nodes, double width) {
    const bool is_coarse = random.integer(0, 1) == 0;
    const auto distance = [&] {
        return is_coarse ? std::floor((width + 1) * random.real()) : width * random.real();
    };
    for (LevelNode& node : nodes) {
        const std::int64_t kind = random.integer(0, 5);
        if (kind == 0) {
            node.lowest = node.highest = node.target;
        }
        if (kind == 1 || kind == 3) {
            node.lowest = node.target - distance();
        }
        if (kind == 2 || kind == 3) {
            node.highest = node.target + distance();
        }
    }
}

/// Moves ranges to where a random fit of the falls is, so that they can be kept.
void bound_feasibly(Random& random, River& river) {
    std::vector<LevelNode> other = river.nodes;
    const bool is_coarse = random.integer(0, 1) == 0;
    for (LevelNode& node : other) {
        node.target = random_target(random, is_coarse);
    }
    const std::vector<double> levels = fit_levels(other, river.falls, RiverFit::Isotonic).levels;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::int64_t kind = random.integer(0, 5);
        if (kind == 0) {
            river.nodes[i].lowest = river.nodes[i].highest = levels[i];
        }
        if (kind == 1 || kind == 3) {
            river.nodes[i].lowest = levels[i] - (is_coarse ? 0 : 10 * random.real());
        }
        if (kind == 2 || kind == 3) {
            river.nodes[i].highest = levels[i] + (is_coarse ? 0 : 10 * random.real());
        }
    }
}

bool falls_hold(const River& river, std::span<const double> levels) {
    return std::all_of(river.falls.begin(), river.falls.end(),
                       [&](const Fall& fall) { return levels[fall.upper] >= levels[fall.lower]; });
}

bool ranges_hold(const River& river, std::span<const double> levels) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (levels[i] < river.nodes[i].lowest || levels[i] > river.nodes[i].highest) {
            return false;
        }
    }
    return true;
}

/// The largest difference, as a part of 100, the span of targets.
double difference(std::span<const double> a, std::span<const double> b) {
    REQUIRE(a.size() == b.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] - b[i]) / 100);
    }
    return largest;
}

/// Levels as they would be if no range had to give way.
std::vector<double> wanted_levels(const LevelFit& fit) {
    std::vector<double> levels = fit.levels;
    for (std::size_t i = 0; i < fit.beyond.size(); ++i) {
        levels[fit.beyond[i]] = fit.wanted[i];
    }
    return levels;
}

/// A braided river: two channels of so many nodes side by side, with a link to the other one at each node,
/// after `acyclic_falls`' fashion the water runs to the greater numbers.
std::vector<Fall> ladder(std::size_t length) {
    std::vector<Fall> falls;
    for (std::uint32_t i = 0; i + 1 < length; ++i) {
        for (const std::uint32_t side : {0U, 1U}) {
            falls.push_back({2 * i + side, 2 * i + 2 + side});
            falls.push_back({2 * i + side, 2 * i + 3 - side});
        }
    }
    return falls;
}

}  // namespace

TEST_SUITE("water/isotonic_regression") {
    TEST_CASE("small networks get what trial of all partitions finds") {
        for (int seed = 1; seed <= cases(1000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 1 + below(random, 7);
            River river{random_nodes(random, count), {}};
            river.falls = seed % 2 == 0 ? any_falls(random, count, below(random, 12))
                                        : acyclic_falls(random, count, below(random, 16));
            if (seed % 3 != 0) {
                bound_at_random(random, river.nodes, seed % 5 == 0 ? 100 : 2);
            }
            for (const RiverFit fit : {RiverFit::Isotonic, RiverFit::Min}) {
                const LevelFit found = fit_levels(river.nodes, river.falls, fit);
                const LevelFit expected = oracle::slow_fit(river.nodes, river.falls, fit);
                CHECK(difference(found.levels, expected.levels) < 1e-8);
                CHECK(difference(wanted_levels(found), wanted_levels(expected)) < 1e-8);
            }
        }
    }

    TEST_CASE("chains get what the textbook formula says, whichever way their nodes are numbered") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 1 + below(random, 300);
            std::vector<LevelNode> nodes = random_nodes(random, count);
            if (seed % 3 == 0) {  // mostly downhill
                for (std::size_t i = 0; i < count; ++i) {
                    nodes[i].target += 50.0 - static_cast<double>(i);
                }
            }
            const std::vector<double> expected = oracle::chain_levels(nodes);
            std::vector<Fall> falls = chain(count);
            CHECK(difference(fit_levels(nodes, falls, RiverFit::Isotonic).levels, expected) < 1e-13);
            std::reverse(nodes.begin(), nodes.end());
            for (Fall& fall : falls) {
                std::swap(fall.upper, fall.lower);
            }
            std::vector<double> turned = fit_levels(nodes, falls, RiverFit::Isotonic).levels;
            std::reverse(turned.begin(), turned.end());
            CHECK(difference(turned, expected) < 1e-13);
        }
    }

    TEST_CASE("levels of any network are in balance with the pull of the targets") {
        for (int seed = 1; seed <= cases(120); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 400);
            River river{random_nodes(random, count), {}};
            const int kind = seed % 4;
            if (kind == 0) {
                river.falls = acyclic_falls(random, count, count + below(random, 2 * count));
            } else if (kind == 1) {
                river.falls = any_falls(random, count, count / 2 + below(random, count / 2 + 1));
            } else {
                river.falls = tree_falls(random, count);
                if (kind == 3) {  // dividing
                    for (Fall& fall : river.falls) {
                        fall = {static_cast<std::uint32_t>(count) - 1 - fall.lower,
                                static_cast<std::uint32_t>(count) - 1 - fall.upper};
                    }
                }
                if (seed % 8 < 4) {  // a few braids
                    for (const Fall& fall : acyclic_falls(random, count, 5)) {
                        river.falls.push_back(
                            {std::min(fall.upper, fall.lower), std::max(fall.upper, fall.lower)});
                    }
                }
                for (std::size_t i = 0; i < count; ++i) {
                    river.nodes[i].target -=
                        40 * random.real() * static_cast<double>(i) / static_cast<double>(count);
                }
            }
            if (seed % 3 == 0) {
                bound_feasibly(random, river);
            }
            const LevelFit fit = fit_levels(river.nodes, river.falls, RiverFit::Isotonic);
            CHECK(fit.beyond.empty());
            CHECK(falls_hold(river, fit.levels));
            CHECK(ranges_hold(river, fit.levels));
            CHECK(oracle::unbalanced_part(river.nodes, river.falls, fit.levels) < 1e-12);

            const LevelFit lowest = fit_levels(river.nodes, river.falls, RiverFit::Min);
            CHECK(falls_hold(river, lowest.levels));
            CHECK(ranges_hold(river, lowest.levels));
        }
    }

    TEST_CASE("levels out of balance are found out") {
        const std::vector<LevelNode> nodes{{1}, {2}, {0}};
        const std::vector<Fall> falls = chain(3);
        CHECK(oracle::unbalanced_part(nodes, falls, std::vector<double>{1.5, 1.5, 0}) == 0);
        CHECK(oracle::unbalanced_part(nodes, falls, std::vector<double>{1.6, 1.6, 0}) > 0.1);
        CHECK(oracle::unbalanced_part(nodes, falls, std::vector<double>{2, 2, 0}) > 0.4);
        CHECK(oracle::unbalanced_part(nodes, falls, std::vector<double>{1, 1, 1}) > 0.4);
    }

    TEST_CASE("where ranges cannot be kept only falls of nodes that are named rise") {
        int named = 0;
        for (int seed = 1; seed <= cases(150); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 100);
            River river{random_nodes(random, count), {}};
            river.falls = seed % 2 == 0 ? any_falls(random, count, count) : tree_falls(random, count);
            bound_at_random(random, river.nodes, 10);
            for (const RiverFit fit : {RiverFit::Isotonic, RiverFit::Min}) {
                const LevelFit found = fit_levels(river.nodes, river.falls, fit);
                CHECK(ranges_hold(river, found.levels));
                CHECK(std::is_sorted(found.beyond.begin(), found.beyond.end()));
                CHECK(found.beyond.size() == found.wanted.size());
                for (std::size_t i = 0; i < found.beyond.size(); ++i) {
                    CHECK(found.wanted[i] != found.levels[found.beyond[i]]);
                }
                std::erase_if(river.falls, [&](const Fall& fall) {
                    return std::binary_search(found.beyond.begin(), found.beyond.end(), fall.upper) ||
                           std::binary_search(found.beyond.begin(), found.beyond.end(), fall.lower);
                });
                CHECK(falls_hold(river, found.levels));
                named += static_cast<int>(found.beyond.size());
            }
        }
        CHECK(named > 0);
    }

    TEST_CASE("neither the order of falls nor their repetition nor falls to oneself change a bit") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 60);
            std::vector<LevelNode> nodes = random_nodes(random, count);
            bound_at_random(random, nodes, 20);
            std::vector<Fall> falls = any_falls(random, count, count + 5);
            for (const RiverFit fit : {RiverFit::Isotonic, RiverFit::Min}) {
                const LevelFit first = fit_levels(nodes, falls, fit);
                for (std::uint32_t i = 0; i < falls.size(); ++i) {
                    std::swap(falls[i], falls[below(random, i + 1)]);
                }
                falls.push_back(falls[below(random, falls.size())]);
                falls.push_back({0, 0});
                const LevelFit second = fit_levels(nodes, falls, fit);
                CHECK(first.levels == second.levels);
                CHECK(first.beyond == second.beyond);
                CHECK(first.wanted == second.wanted);
            }
        }
    }

    TEST_CASE("other numbers of the nodes do not change a bit") {
        for (int seed = 1; seed <= cases(100); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 200);
            River river{random_nodes(random, count), {}};
            river.falls = seed % 2 == 0 ? tree_falls(random, count) : any_falls(random, count, count);
            if (seed % 3 == 0) {
                bound_at_random(random, river.nodes, 20);
            }
            std::vector<std::uint32_t> name(count);
            for (std::uint32_t i = 0; i < count; ++i) {
                name[i] = i;
                std::swap(name[i], name[below(random, i + 1)]);
            }
            River renamed = river;
            for (std::size_t i = 0; i < count; ++i) {
                renamed.nodes[name[i]] = river.nodes[i];
            }
            for (Fall& fall : renamed.falls) {
                fall = {name[fall.upper], name[fall.lower]};
            }
            for (const RiverFit rule : {RiverFit::Isotonic, RiverFit::Min}) {
                const LevelFit fit = fit_levels(river.nodes, river.falls, rule);
                const LevelFit other = fit_levels(renamed.nodes, renamed.falls, rule);
                CHECK(fit.beyond.size() == other.beyond.size());
                for (std::size_t i = 0; i < count; ++i) {
                    CHECK(fit.levels[i] == other.levels[name[i]]);
                }
            }
        }
    }

    TEST_CASE("other units of levels and weights give the same levels in these units") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 60);
            std::vector<LevelNode> nodes = random_nodes(random, count);
            bound_at_random(random, nodes, 20);
            const std::vector<Fall> falls = acyclic_falls(random, count, 2 * count);
            const LevelFit fit = fit_levels(nodes, falls, RiverFit::Isotonic);
            const double scale = std::ldexp(1.0, static_cast<int>(random.integer(-60, 60)));
            const double heavier = std::ldexp(1.0, static_cast<int>(random.integer(-60, 60)));
            for (LevelNode& node : nodes) {
                node = {node.target * scale, node.weight * heavier, node.lowest * scale,
                        node.highest * scale};
            }
            const LevelFit scaled = fit_levels(nodes, falls, RiverFit::Isotonic);
            CHECK(scaled.beyond == fit.beyond);
            for (std::size_t i = 0; i < count; ++i) {
                CHECK(scaled.levels[i] == fit.levels[i] * scale);
            }
        }
    }

    TEST_CASE("a river that runs downhill stays as it is, also what was fitted before") {
        for (int seed = 1; seed <= cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 2 + below(random, 200);
            std::vector<LevelNode> nodes = random_nodes(random, count);
            const std::vector<Fall> falls = any_falls(random, count, count);
            for (const RiverFit fit : {RiverFit::Isotonic, RiverFit::Min}) {
                const std::vector<double> levels = fit_levels(nodes, falls, fit).levels;
                for (std::size_t i = 0; i < count; ++i) {
                    nodes[i].target = levels[i];
                }
                CHECK(fit_levels(nodes, falls, RiverFit::Isotonic).levels == levels);
                CHECK(fit_levels(nodes, falls, RiverFit::Min).levels == levels);
            }
        }
    }

    TEST_CASE("a bump is shared by length") {
        const std::vector<LevelNode> nodes{{10, 1}, {8, 1}, {9, 3}, {5, 1}};
        const LevelFit fit = fit_levels(nodes, chain(4), RiverFit::Isotonic);
        CHECK(fit.levels == std::vector<double>{10, 8.75, 8.75, 5});
        CHECK(fit_levels(nodes, chain(4), RiverFit::Min).levels == std::vector<double>{10, 8, 8, 5});
    }

    TEST_CASE("tributaries end at or above the trunk") {
        // 0 -> 1 -> 2 is the trunk, 3 -> 4 -> 1 a tributary that is too low.
        const std::vector<LevelNode> nodes{{9}, {7}, {5}, {8}, {4}};
        const std::vector<Fall> falls{{0, 1}, {1, 2}, {3, 4}, {4, 1}};
        CHECK(fit_levels(nodes, falls, RiverFit::Isotonic).levels == std::vector<double>{9, 5.5, 5, 8, 5.5});
        CHECK(fit_levels(nodes, falls, RiverFit::Min).levels == std::vector<double>{9, 4, 4, 8, 4});
    }

    TEST_CASE("both arms of a braid end at the level that they have in common") {
        const std::vector<LevelNode> nodes{{10}, {6}, {9}, {8}};
        const std::vector<Fall> falls{{0, 1}, {0, 2}, {1, 3}, {2, 3}};
        CHECK(fit_levels(nodes, falls, RiverFit::Isotonic).levels == std::vector<double>{10, 7, 9, 7});
    }

    TEST_CASE("a cycle of falls gets one level") {
        const std::vector<LevelNode> nodes{{6, 1}, {1, 2}, {4, 1}, {5, 1}};
        const std::vector<Fall> falls{{0, 1}, {1, 2}, {2, 1}, {2, 3}};
        CHECK(fit_levels(nodes, falls, RiverFit::Isotonic).levels ==
              std::vector<double>{6, 2.75, 2.75, 2.75});
        CHECK(fit_levels(nodes, falls, RiverFit::Min).levels == std::vector<double>{6, 1, 1, 1});
    }

    TEST_CASE("a given level stays, and the river fits in") {
        std::vector<LevelNode> nodes{{10}, {6}, {8, 1, 8, 8}, {9}, {3}};
        const LevelFit fit = fit_levels(nodes, chain(5), RiverFit::Isotonic);
        CHECK(fit.levels == std::vector<double>{10, 8, 8, 8, 3});
        CHECK(fit.beyond.empty());
        CHECK(fit_levels(nodes, chain(5), RiverFit::Min).levels == std::vector<double>{10, 8, 8, 8, 3});
    }

    TEST_CASE("of lakes in the wrong order both keep their level, and so does the river around them") {
        // A river, a lake at 5, a river, a lake at 8, a river.
        const std::vector<LevelNode> nodes{{9}, {6}, {5, 1, 5, 5}, {7}, {6}, {8, 1, 8, 8}, {7.5}, {4}};
        for (const RiverFit rule : {RiverFit::Isotonic, RiverFit::Min}) {
            const LevelFit fit = fit_levels(nodes, chain(8), rule);
            CHECK(fit.levels == std::vector<double>{9, 6, 5, 7, 6, 8, 7.5, 4});
            CHECK(fit.beyond == std::vector<std::uint32_t>{2, 5});
            CHECK(fit.wanted == std::vector<double>{8, 5});
        }
    }

    TEST_CASE("what a range forbids is done elsewhere") {
        // The second node must not be lifted by more than 1: the third is dug the deeper.
        const std::vector<LevelNode> nodes{{20}, {10, 1, -kInfinity, 11}, {14}, {2}};
        const LevelFit fit = fit_levels(nodes, chain(4), RiverFit::Isotonic);
        CHECK(fit.levels == std::vector<double>{20, 11, 11, 2});
        CHECK(fit.beyond.empty());
        const std::vector<LevelNode> undug{{20}, {10}, {14, 1, 13, kInfinity}, {2}};
        CHECK(fit_levels(undug, chain(4), RiverFit::Isotonic).levels == std::vector<double>{20, 13, 13, 2});
        CHECK(fit_levels(undug, chain(4), RiverFit::Min).levels == std::vector<double>{20, 13, 13, 2});
    }

    TEST_CASE("ranges that leave no way downhill are named with what it would take") {
        const std::vector<LevelNode> nodes{{20, 1, 19, 21}, {10, 1, 9, 11}, {14, 1, 13, 15}, {2, 1, 1, 3}};
        const LevelFit fit = fit_levels(nodes, chain(4), RiverFit::Isotonic);
        CHECK(fit.levels == std::vector<double>{20, 11, 13, 2});
        CHECK(fit.beyond == std::vector<std::uint32_t>{1, 2});
        CHECK(fit.wanted == std::vector<double>{12, 12});
        const LevelFit lowest = fit_levels(nodes, chain(4), RiverFit::Min);
        CHECK(lowest.levels == std::vector<double>{20, 10, 13, 2});
        CHECK(lowest.beyond == std::vector<std::uint32_t>{2});
        CHECK(lowest.wanted == std::vector<double>{10});
    }

    TEST_CASE("a range that a given level forbids gives way, not the level") {
        const std::vector<LevelNode> nodes{{8, 1, 8, 8}, {7, 1, 6, 8}, {12, 1, 11, 13}, {5}};
        const LevelFit fit = fit_levels(nodes, chain(4), RiverFit::Isotonic);
        CHECK(fit.levels == std::vector<double>{8, 8, 11, 5});
        CHECK(fit.beyond == std::vector<std::uint32_t>{2});
        CHECK(fit.wanted == std::vector<double>{8});
    }

    TEST_CASE("the lightest nodes beside the heaviest have levels of their own") {
        // A braid of nodes that rise downstream, so heavy that the light ones before and after it weigh less
        // than the rounding of its level.
        for (int seed = 1; seed <= cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<LevelNode> nodes{{3, 1e-9},
                                         {1 + random.real(), 1e12},
                                         {2.1 + random.real(), 1e12},
                                         {2.1 + random.real(), 2e12},
                                         {3.2 + random.real(), 1e12},
                                         {1.9, 1e-9}};
            const std::vector<Fall> falls{{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 5}};
            const std::vector<double> levels = fit_levels(nodes, falls, RiverFit::Isotonic).levels;
            const long double moment =
                1e12L * (static_cast<long double>(nodes[1].target) + nodes[2].target +
                         2 * static_cast<long double>(nodes[3].target) + nodes[4].target);
            const auto mean = static_cast<double>(moment / 5e12L);
            CHECK(levels[1] == doctest::Approx(mean).epsilon(1e-15));
            CHECK(std::count(levels.begin(), levels.end(), levels[1]) >= 4);
            CHECK(levels[0] == std::max(3.0, levels[1]));
            CHECK(levels[5] == std::min(1.9, levels[4]));
        }
    }

    TEST_CASE("a river drawn the wrong way is level, with one channel or two") {
        constexpr std::size_t kLength = 5000;
        std::vector<LevelNode> nodes(2 * kLength);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            nodes[i].target = static_cast<double>(i);
        }
        const double mean = static_cast<double>(nodes.size() - 1) / 2;
        for (const std::vector<Fall>& falls : {chain(2 * kLength), ladder(kLength)}) {
            const std::vector<double> levels = fit_levels(nodes, falls, RiverFit::Isotonic).levels;
            CHECK(std::all_of(levels.begin(), levels.end(), [&](double level) { return level == mean; }));
            const std::vector<double> lowest = fit_levels(nodes, falls, RiverFit::Min).levels;
            CHECK(lowest.front() == 0);
            CHECK(*std::max_element(lowest.begin() + 2, lowest.end()) == 0);
        }
    }

    TEST_CASE("nothing is fitted to nothing") {
        const LevelFit fit = fit_levels({}, {}, RiverFit::Isotonic);
        CHECK(fit.levels.empty());
        CHECK(fit_levels(std::vector<LevelNode>{{3}}, {}, RiverFit::Min).levels == std::vector<double>{3});
    }
}
