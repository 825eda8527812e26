#include "tinwright/water/flow.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/isotonic_oracle.hpp"
#include "support/point_sets.hpp"

using tinwright::Fall;
using tinwright::find_braids;
using tinwright::find_cycles;
using tinwright::find_outlets;
using tinwright::FlowLink;
using tinwright::kNoCycle;
using tinwright::orient_links;
using tinwright_tests::cases;
using tinwright_tests::Random;
namespace oracle = tinwright_tests::oracle;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint32_t below(Random& random, std::size_t limit) {
    return static_cast<std::uint32_t>(random.integer(0, static_cast<std::int64_t>(limit) - 1));
}

struct Network {
    std::vector<double> elevations;
    std::vector<FlowLink> links;
};

/// Links between any nodes, parallel ones and some of a node with itself among them; elevations at random, of
/// few perhaps.
Network random_network(Random& random, std::size_t count) {
    Network network;
    const bool is_coarse = random.integer(0, 1) == 0;
    for (std::size_t i = 0; i < count; ++i) {
        network.elevations.push_back(is_coarse ? static_cast<double>(random.integer(0, 3)) : random.real());
    }
    const std::size_t links = below(random, 2 * count + 1);
    for (std::size_t i = 0; i < links; ++i) {
        network.links.push_back({below(random, count), below(random, count)});
    }
    return network;
}

std::vector<Fall> falls_of(const Network& network, const std::vector<bool>& runs_back) {
    std::vector<Fall> falls;
    for (std::size_t i = 0; i < network.links.size(); ++i) {
        const auto [a, b] = network.links[i];
        falls.push_back(runs_back[i] ? Fall{b, a} : Fall{a, b});
    }
    return falls;
}

std::vector<Fall> both_ways(std::span<const FlowLink> links) {
    std::vector<Fall> falls;
    for (const FlowLink& link : links) {
        falls.push_back({link.a, link.b});
        falls.push_back({link.b, link.a});
    }
    return falls;
}

/// The least that the highest node is on a way from each node to each other one along falls.
std::vector<std::vector<double>> find_passes(std::span<const double> elevations,
                                             std::span<const Fall> falls) {
    const std::size_t count = elevations.size();
    std::vector<std::vector<double>> pass(count, std::vector<double>(count, kInfinity));
    for (std::size_t node = 0; node < count; ++node) {
        pass[node][node] = elevations[node];
    }
    for (const Fall& fall : falls) {
        pass[fall.upper][fall.lower] = std::max(elevations[fall.upper], elevations[fall.lower]);
    }
    for (std::size_t by = 0; by < count; ++by) {
        for (std::size_t from = 0; from < count; ++from) {
            for (std::size_t to = 0; to < count; ++to) {
                pass[from][to] = std::min(pass[from][to], std::max(pass[from][by], pass[by][to]));
            }
        }
    }
    return pass;
}

/// Of a row of passes the lowest to a node of these.
double lowest_pass(const std::vector<double>& passes, std::span<const std::uint32_t> nodes) {
    double lowest = kInfinity;
    for (const std::uint32_t node : nodes) {
        lowest = std::min(lowest, passes[node]);
    }
    return lowest;
}

/// What `find_outlets` promises, node by node.
std::vector<std::uint32_t> slow_outlets(const Network& network) {
    const auto count = static_cast<std::uint32_t>(network.elevations.size());
    std::vector<std::vector<std::uint32_t>> neighbors(count);
    for (const auto& [a, b] : network.links) {
        if (a != b) {
            neighbors[a].push_back(b);
            neighbors[b].push_back(a);
        }
    }
    const auto reach = oracle::find_reach(count, both_ways(network.links));
    const auto is_low_end = [&](std::uint32_t node) {
        return neighbors[node].size() == 1 &&
               network.elevations[node] < network.elevations[neighbors[node].front()];
    };
    const auto rank = [&](std::uint32_t node) {
        return std::pair(network.elevations[node], (neighbors[node].size() == 1 ? 0U : count) + node);
    };
    std::vector<std::uint32_t> outlets;
    for (std::uint32_t node = 0; node < count; ++node) {
        bool has_low_end = false;
        bool is_lowest = true;
        for (std::uint32_t other = 0; other < count; ++other) {
            if (reach[node][other]) {
                has_low_end = has_low_end || is_low_end(other);
                is_lowest = is_lowest && rank(node) <= rank(other);
            }
        }
        if (!neighbors[node].empty() && (has_low_end ? is_low_end(node) : is_lowest)) {
            outlets.push_back(node);
        }
    }
    return outlets;
}

}  // namespace

TEST_SUITE("water/flow") {
    TEST_CASE("outlets are the low ends, or the lowest node") {
        for (int seed = 1; seed <= cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Network network = random_network(random, 1 + below(random, 15));
            CHECK(find_outlets(network.elevations, network.links) == slow_outlets(network));
        }
    }

    TEST_CASE("the only end that is lower than its neighbour is the outlet, above a pit too") {
        const std::vector<double> elevations{9, 1, 8, 3, 5};
        const std::vector<FlowLink> links{{0, 1}, {1, 2}, {2, 3}};
        CHECK(find_outlets(elevations, links) == std::vector<std::uint32_t>{3});
        // Without it the pit is the lowest node.
        CHECK(find_outlets(elevations, std::span(links).first(2)) == std::vector<std::uint32_t>{1});
        CHECK(find_outlets(elevations, {}).empty());
        // Of a level river an end.
        CHECK(find_outlets(std::vector<double>{4, 4, 4}, std::vector<FlowLink>{{1, 0}, {0, 2}}) ==
              std::vector<std::uint32_t>{1});
    }

    TEST_CASE("from everywhere water gets to an outlet over as low a way as there is, never in a circle") {
        for (int seed = 1; seed <= cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 1 + below(random, 15);
            const Network network = random_network(random, count);
            std::vector<std::uint32_t> outlets = find_outlets(network.elevations, network.links);
            if (seed % 2 == 0) {  // anywhere
                outlets.assign(1 + below(random, 2), below(random, count));
            }
            const std::vector<bool> runs_back = orient_links(network.elevations, network.links, outlets);
            const std::vector<Fall> falls = falls_of(network, runs_back);
            const auto reach = oracle::find_reach(count, falls);
            for (std::size_t i = 0; i < network.links.size(); ++i) {
                const auto [a, b] = network.links[i];
                CHECK((a == b || reach[a][b] != reach[b][a]));
                CHECK((a != b || !runs_back[i]));
            }
            const auto part = oracle::find_reach(count, both_ways(network.links));
            const auto any_pass = find_passes(network.elevations, both_ways(network.links));
            const auto pass = find_passes(network.elevations, falls);
            for (std::uint32_t node = 0; node < count; ++node) {
                std::vector<std::uint32_t> ends;
                std::copy_if(outlets.begin(), outlets.end(), std::back_inserter(ends),
                             [&](std::uint32_t outlet) { return part[node][outlet]; });
                if (ends.empty()) {
                    std::uint32_t lowest = node;
                    for (std::uint32_t other = 0; other < count; ++other) {
                        if (part[node][other] && std::pair(network.elevations[other], other) <
                                                     std::pair(network.elevations[lowest], lowest)) {
                            lowest = other;
                        }
                    }
                    ends.push_back(lowest);
                }
                CHECK(lowest_pass(pass[node], ends) == lowest_pass(any_pass[node], ends));
            }
        }
    }

    TEST_CASE("a river over a hump and a pit runs to its outlet") {
        const std::vector<double> elevations{9, 2, 7, 5, 1};
        const std::vector<FlowLink> links{{0, 1}, {2, 1}, {2, 3}, {4, 3}};
        CHECK(find_outlets(elevations, links) == std::vector<std::uint32_t>{4});
        CHECK(orient_links(elevations, links, std::vector<std::uint32_t>{4}) ==
              std::vector<bool>{false, true, false, true});
    }

    TEST_CASE("of a braid every arm runs down") {
        // 0 - 1 - {2, 3} - 4 - 5
        const std::vector<double> elevations{9, 8, 6, 7, 5, 4};
        const std::vector<FlowLink> links{{1, 0}, {1, 2}, {3, 1}, {2, 4}, {4, 3}, {4, 5}};
        const std::vector<bool> runs_back = orient_links(elevations, links, std::vector<std::uint32_t>{5});
        CHECK(runs_back == std::vector<bool>{true, false, true, false, true, false});
        CHECK(find_braids(6, falls_of({elevations, links}, runs_back)) == std::vector<std::uint32_t>{1});
    }

    TEST_CASE("nodes are on one cycle when water gets from each to the other") {
        for (int seed = 1; seed <= cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 1 + below(random, 15);
            std::vector<Fall> falls;
            const std::size_t wanted = below(random, 2 * count);
            for (std::size_t i = 0; i < wanted; ++i) {
                falls.push_back({below(random, count), below(random, count)});
            }
            const auto reach = oracle::find_reach(count, falls);
            std::vector<std::uint32_t> expected(count, kNoCycle);
            std::uint32_t cycles = 0;
            for (std::size_t node = 0; node < count; ++node) {
                for (std::size_t other = 0; other < count; ++other) {
                    if (other != node && expected[node] == kNoCycle && reach[node][other] &&
                        reach[other][node]) {
                        expected[node] = other < node ? expected[other] : cycles++;
                    }
                }
            }
            CHECK(find_cycles(count, falls) == expected);
        }
    }

    TEST_CASE("braids are what circles of neighbours make them") {
        int found = 0;
        for (int seed = 1; seed <= cases(600); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::size_t count = 1 + below(random, 8);
            std::vector<Fall> falls;
            const std::size_t wanted = below(random, count + 4);
            for (std::size_t i = 0; i < wanted; ++i) {
                const std::uint32_t p = below(random, count);
                const std::uint32_t q = below(random, count);
                // Without cycles, mostly.
                falls.push_back(seed % 3 == 0 ? Fall{p, q} : Fall{std::max(p, q), std::min(p, q)});
            }
            const std::vector<std::uint32_t> braids = find_braids(count, falls);
            CHECK(braids == oracle::slow_braids(count, falls));
            found += static_cast<int>(braids.size());
        }
        CHECK(found > 0);
    }

    TEST_CASE("a confluence is no braid, nor is a cycle, a fall drawn twice or to itself") {
        CHECK(find_braids(4, std::vector<Fall>{{0, 2}, {1, 2}, {2, 3}}).empty());
        CHECK(find_braids(4, std::vector<Fall>{{0, 1}, {1, 2}, {2, 0}, {2, 3}}).empty());
        CHECK(find_braids(2, std::vector<Fall>{{0, 1}, {0, 1}, {1, 1}, {1, 0}}).empty());
        CHECK(find_cycles(3, std::vector<Fall>{{0, 1}, {1, 1}, {2, 1}, {1, 2}}) ==
              std::vector<std::uint32_t>{kNoCycle, 0, 0});
    }

    TEST_CASE("braids one after the other are two, a braid inside a braid is one") {
        const std::vector<Fall> row{{0, 1}, {0, 2}, {1, 3}, {2, 3}, {3, 4}, {4, 5}, {4, 6}, {5, 7}, {6, 7}};
        CHECK(find_braids(8, row) == std::vector<std::uint32_t>{0, 4});
        const std::vector<Fall> nested{{5, 1}, {5, 2}, {1, 3}, {1, 4}, {3, 0}, {4, 0}, {2, 0}};
        CHECK(find_braids(6, nested) == std::vector<std::uint32_t>{5});
    }

    TEST_CASE("long rivers do not exhaust the stack") {
        constexpr std::uint32_t kLength = 200000;
        std::vector<double> elevations(kLength);
        std::vector<FlowLink> links;
        std::vector<Fall> falls;
        for (std::uint32_t i = 0; i + 1 < kLength; ++i) {
            elevations[i] = i % 10;
            links.push_back({i, i + 1});
            falls.push_back({i, i + 1});
        }
        elevations[kLength - 1] = -1;
        CHECK(find_outlets(elevations, links) == std::vector<std::uint32_t>{0, kLength - 1});
        const std::vector<bool> runs_back =
            orient_links(elevations, links, std::vector<std::uint32_t>{kLength - 1});
        CHECK(std::find(runs_back.begin(), runs_back.end(), true) == runs_back.end());
        falls.push_back({kLength - 1, 0});
        CHECK(find_braids(kLength, falls).empty());
        const std::vector<std::uint32_t> cycles = find_cycles(kLength, falls);
        CHECK(std::all_of(cycles.begin(), cycles.end(), [](std::uint32_t cycle) { return cycle == 0; }));
        falls.push_back({7, 3});
        CHECK(find_braids(kLength, falls) == std::vector<std::uint32_t>{7});
    }
}
