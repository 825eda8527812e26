#include "support/isotonic_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/push_relabel_max_flow.hpp>

namespace tinwright_tests::oracle {

using tinwright::Fall;
using tinwright::LevelFit;
using tinwright::LevelNode;
using tinwright::RiverFit;

namespace {

/// Weights differ by twelve powers of ten, and the lightest node counts.
__extension__ using Wide = __float128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_given(const LevelNode& node) { return node.lowest == node.highest; }

/// Calls `visit` with all ways to number nodes by the set that they are in.
void visit_partitions(std::size_t count, const std::function<void(const std::vector<std::size_t>&)>& visit) {
    std::vector<std::size_t> set_of(count, 0);
    const std::function<void(std::size_t, std::size_t)> choose = [&](std::size_t node, std::size_t sets) {
        if (node == count) {
            visit(set_of);
            return;
        }
        for (std::size_t set = 0; set <= sets; ++set) {
            set_of[node] = set;
            choose(node + 1, std::max(sets, set + 1));
        }
    };
    choose(0, 0);
}

/// The best levels with one for each set, or nothing where its nodes have no level in common.
std::optional<std::vector<double>> levels_of_sets(std::span<const LevelNode> nodes,
                                                  const std::vector<std::size_t>& set_of) {
    std::vector<double> levels(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        long double weight = 0;
        long double moment = 0;
        double lowest = -kInfinity;
        double highest = kInfinity;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            if (set_of[j] == set_of[i]) {
                weight += nodes[j].weight;
                moment += static_cast<long double>(nodes[j].weight) * nodes[j].target;
                lowest = std::max(lowest, nodes[j].lowest);
                highest = std::min(highest, nodes[j].highest);
            }
        }
        if (lowest > highest) {
            return std::nullopt;
        }
        levels[i] = std::clamp(static_cast<double>(moment / weight), lowest, highest);
    }
    return levels;
}

struct Network {
    using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
    using Graph = boost::adjacency_list<
        boost::vecS, boost::vecS, boost::directedS, boost::no_property,
        boost::property<boost::edge_capacity_t, long long,
                        boost::property<boost::edge_residual_capacity_t, long long,
                                        boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

    explicit Network(std::size_t count) : graph(count) {}

    void add(std::size_t from, std::size_t to, long long capacity) {
        const auto forth = boost::add_edge(from, to, graph).first;
        const auto back = boost::add_edge(to, from, graph).first;
        boost::put(boost::edge_capacity, graph, forth, capacity);
        boost::put(boost::edge_capacity, graph, back, 0);
        boost::put(boost::edge_reverse, graph, forth, back);
        boost::put(boost::edge_reverse, graph, back, forth);
    }

    Graph graph;
};

/// Undirected pairs of neighbours, each once.
using Pair = std::pair<std::uint32_t, std::uint32_t>;
Pair pair_of(std::uint32_t p, std::uint32_t q) { return {std::min(p, q), std::max(p, q)}; }

/// Sets of pairs that share a simple circle, directly or through others.
std::vector<std::set<Pair>> circle_parts(std::size_t node_count, const std::set<Pair>& pairs) {
    std::vector<std::set<Pair>> parts;
    const auto add = [&](std::set<Pair> circle) {
        for (std::size_t i = parts.size(); i-- > 0;) {
            const bool meets = std::any_of(circle.begin(), circle.end(),
                                           [&](const Pair& pair) { return parts[i].count(pair) > 0; });
            if (meets) {
                circle.insert(parts[i].begin(), parts[i].end());
                parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
        parts.push_back(std::move(circle));
    };
    std::vector<std::uint32_t> way;
    const std::function<void()> extend = [&] {
        for (std::uint32_t next = way.front(); next < node_count; ++next) {
            if (pairs.count(pair_of(way.back(), next)) == 0) {
                continue;
            }
            if (next == way.front() && way.size() > 2) {
                std::set<Pair> circle;
                for (std::size_t i = 0; i < way.size(); ++i) {
                    circle.insert(pair_of(way[i], way[(i + 1) % way.size()]));
                }
                add(circle);
            } else if (std::find(way.begin(), way.end(), next) == way.end()) {
                way.push_back(next);
                extend();
                way.pop_back();
            }
        }
    };
    for (std::uint32_t start = 0; start < node_count; ++start) {
        way = {start};
        extend();
    }
    return parts;
}

}  // namespace

std::vector<std::vector<bool>> find_reach(std::size_t node_count, std::span<const Fall> falls) {
    std::vector<std::vector<bool>> reach(node_count, std::vector<bool>(node_count, false));
    for (std::size_t node = 0; node < node_count; ++node) {
        reach[node][node] = true;
    }
    for (const Fall& fall : falls) {
        reach[fall.upper][fall.lower] = true;
    }
    for (std::size_t by = 0; by < node_count; ++by) {
        for (std::size_t from = 0; from < node_count; ++from) {
            for (std::size_t to = 0; to < node_count; ++to) {
                reach[from][to] = reach[from][to] || (reach[from][by] && reach[by][to]);
            }
        }
    }
    return reach;
}

std::vector<double> chain_levels(std::span<const LevelNode> nodes) {
    std::vector<double> levels(nodes.size(), kInfinity);
    for (std::size_t first = 0; first < nodes.size(); ++first) {
        std::vector<double> means;
        long double weight = 0;
        long double moment = 0;
        for (std::size_t last = first; last < nodes.size(); ++last) {
            weight += nodes[last].weight;
            moment += static_cast<long double>(nodes[last].weight) * nodes[last].target;
            means.push_back(static_cast<double>(moment / weight));
        }
        double greatest = -kInfinity;
        for (std::size_t last = nodes.size(); last-- > first;) {
            greatest = std::max(greatest, means[last - first]);
            levels[last] = std::min(levels[last], greatest);
        }
    }
    return levels;
}

std::optional<std::vector<double>> best_levels(std::span<const LevelNode> nodes,
                                               std::span<const Fall> falls) {
    std::optional<std::vector<double>> best;
    Wide least = 0;
    visit_partitions(nodes.size(), [&](const std::vector<std::size_t>& set_of) {
        const auto levels = levels_of_sets(nodes, set_of);
        if (!levels || std::any_of(falls.begin(), falls.end(), [&](const Fall& fall) {
                return (*levels)[fall.upper] < (*levels)[fall.lower];
            })) {
            return;
        }
        Wide sum = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const Wide distance = static_cast<Wide>((*levels)[i]) - static_cast<Wide>(nodes[i].target);
            sum += static_cast<Wide>(nodes[i].weight) * distance * distance;
        }
        if (!best || sum < least) {
            least = sum;
            best = levels;
        }
    });
    return best;
}

double unbalanced_part(std::span<const LevelNode> nodes, std::span<const Fall> falls,
                       std::span<const double> levels) {
    long double total = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        total += std::abs(static_cast<long double>(nodes[i].weight) *
                          (static_cast<long double>(nodes[i].target) - levels[i]));
    }
    if (total == 0) {
        return 0;
    }
    // Forces in units small enough, and such that sums stay below 2^62.
    const long double unit = total / 0x1p55L;
    constexpr long long kAny = 1LL << 60;
    const std::size_t source = nodes.size();
    const std::size_t sink = source + 1;
    const std::size_t ground = source + 2;  // holds what is at the end of its range
    Network network(nodes.size() + 3);
    long long up = 0;
    long long down = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const long double pull = nodes[i].weight * (static_cast<long double>(nodes[i].target) - levels[i]);
        const long long force = std::llround(std::abs(pull) / unit);
        if (pull > 0) {
            network.add(source, i, force);
            up += force;
        } else {
            network.add(i, sink, force);
            down += force;
        }
        // A level is rounded: twice what that makes of its node's pull is for nothing.
        const long double rounding =
            nodes[i].weight * std::abs(static_cast<long double>(levels[i])) * 0x1p-52L;
        const long long slack = std::llround(std::min<long double>(rounding / unit, kAny));
        network.add(ground, i, levels[i] == nodes[i].lowest ? kAny : slack);
        network.add(i, ground, levels[i] == nodes[i].highest ? kAny : slack);
    }
    network.add(source, ground, down);
    network.add(ground, sink, up);
    for (const Fall& fall : falls) {
        if (fall.upper != fall.lower && levels[fall.upper] == levels[fall.lower]) {
            network.add(fall.lower, fall.upper, kAny);
        }
    }
    const long long balanced = boost::push_relabel_max_flow(network.graph, source, sink);
    return static_cast<double>(up + down - balanced) / static_cast<double>(up + down);
}

LevelFit slow_fit(std::span<const LevelNode> nodes, std::span<const Fall> falls, RiverFit fit) {
    const std::size_t count = nodes.size();
    LevelFit result;
    std::map<std::uint32_t, double> beyond;
    auto reach = find_reach(count, falls);
    // Given levels that contradict each other.
    const auto highest_below = [&](std::uint32_t node) {
        double level = -kInfinity;
        for (std::size_t other = 0; other < count; ++other) {
            if (reach[node][other] && is_given(nodes[other])) {
                level = std::max(level, nodes[other].lowest);
            }
        }
        return level;
    };
    const auto lowest_above = [&](std::uint32_t node) {
        double level = kInfinity;
        for (std::size_t other = 0; other < count; ++other) {
            if (reach[other][node] && is_given(nodes[other])) {
                level = std::min(level, nodes[other].lowest);
            }
        }
        return level;
    };
    std::vector<Fall> kept;
    for (const Fall& fall : falls) {
        const LevelNode& upper = nodes[fall.upper];
        const LevelNode& lower = nodes[fall.lower];
        if (fall.upper != fall.lower && !(is_given(upper) && upper.lowest < highest_below(fall.lower)) &&
            !(is_given(lower) && lower.lowest > lowest_above(fall.upper))) {
            kept.push_back(fall);
        }
    }
    for (std::uint32_t node = 0; node < count; ++node) {
        if (is_given(nodes[node])) {
            const double too_low = highest_below(node) - nodes[node].lowest;
            const double too_high = nodes[node].lowest - lowest_above(node);
            if (too_low > 0 || too_high > 0) {
                beyond[node] = too_low >= too_high ? highest_below(node) : lowest_above(node);
            }
        }
    }
    reach = find_reach(count, kept);
    // Ranges that given levels contradict, then those that contradict each other.
    std::vector<LevelNode> free(nodes.begin(), nodes.end());
    for (const bool is_against_given : {true, false}) {
        const std::vector<LevelNode> before = free;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                const bool counts = !is_given(before[i]) && is_given(before[j]) == is_against_given;
                if (counts && ((reach[i][j] && before[i].highest < before[j].lowest) ||
                               (reach[j][i] && before[i].lowest > before[j].highest))) {
                    free[i].lowest = -kInfinity;
                    free[i].highest = kInfinity;
                }
            }
        }
    }
    if (fit == RiverFit::Isotonic) {
        result.levels = *best_levels(free, kept);
    } else {
        result.levels.assign(count, kInfinity);
        for (std::size_t round = 0; round <= count; ++round) {
            for (std::size_t i = 0; i < count; ++i) {
                double level = free[i].target;
                double least = -kInfinity;
                for (std::size_t j = 0; j < count; ++j) {
                    if (reach[j][i]) {
                        level = std::min({level, result.levels[j], free[j].highest});
                    }
                    if (reach[i][j]) {
                        least = std::max(least, free[j].lowest);
                    }
                }
                result.levels[i] = std::max(level, least);
            }
        }
    }
    for (std::uint32_t node = 0; node < count; ++node) {
        const double level = std::clamp(result.levels[node], nodes[node].lowest, nodes[node].highest);
        if (level != result.levels[node]) {
            beyond[node] = result.levels[node];
            result.levels[node] = level;
        }
    }
    for (const auto& [node, wanted] : beyond) {
        result.beyond.push_back(node);
        result.wanted.push_back(wanted);
    }
    return result;
}

std::vector<std::uint32_t> slow_braids(std::size_t node_count, std::span<const Fall> falls) {
    std::set<Fall> distinct;
    std::set<Pair> pairs;
    for (const Fall& fall : falls) {
        if (fall.upper != fall.lower) {
            distinct.insert(fall);
            pairs.insert(pair_of(fall.upper, fall.lower));
        }
    }
    std::set<std::uint32_t> braids;
    for (const std::set<Pair>& part : circle_parts(node_count, pairs)) {
        std::vector<Fall> inside;
        std::copy_if(distinct.begin(), distinct.end(), std::back_inserter(inside),
                     [&](const Fall& fall) { return part.count(pair_of(fall.upper, fall.lower)) > 0; });
        const auto reach = find_reach(node_count, inside);
        std::vector<int> lowers(node_count, 0);
        std::vector<int> uppers(node_count, 0);
        for (const Fall& fall : inside) {
            ++lowers[fall.upper];
            ++uppers[fall.lower];
        }
        bool is_cycle = true;
        std::optional<std::uint32_t> divide;
        for (std::uint32_t node = 0; node < node_count; ++node) {
            is_cycle = is_cycle && lowers[node] == uppers[node] && lowers[node] < 2;
            bool is_upmost = lowers[node] > 1;
            for (std::uint32_t other = 0; other < node_count; ++other) {
                is_upmost = is_upmost && (!reach[other][node] || reach[node][other]);
            }
            if (is_upmost && !divide) {
                divide = node;
            }
        }
        if (!is_cycle) {
            braids.insert(divide.value());
        }
    }
    return {braids.begin(), braids.end()};
}

}  // namespace tinwright_tests::oracle
