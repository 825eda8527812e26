#include "tinwright/water/level_division.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "tinwright/water/closure.hpp"

namespace tinwright {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Pools that are fitted apart from all others.
struct Part {
    PooledFalls falls;
    std::vector<std::uint32_t> members;  ///< of the pools that were there in the beginning
    std::vector<std::uint32_t> pool_of;  ///< one a member
    bool is_new = true;                  ///< falls that do not matter have not been left out yet
};

/// Numbers what is connected. `kNone`: not with any other.
std::vector<std::uint32_t> number_connected(const FallGraph& graph, std::uint32_t& count) {
    std::vector<std::uint32_t> number(graph.size(), kNone);
    std::vector<std::uint32_t> queue;
    for (std::uint32_t start = 0; start < graph.size(); ++start) {
        if (number[start] != kNone || (graph.lowers(start).empty() && graph.uppers(start).empty())) {
            continue;
        }
        number[start] = count;
        queue.assign(1, start);
        for (std::size_t i = 0; i < queue.size(); ++i) {
            for (const auto next : {graph.lowers(queue[i]), graph.uppers(queue[i])}) {
                for (const std::uint32_t neighbor : next) {
                    if (number[neighbor] == kNone) {
                        number[neighbor] = count;
                        queue.push_back(neighbor);
                    }
                }
            }
        }
        ++count;
    }
    return number;
}

/// The connected parts of two pools or more; what is single is left to `settle`, called with a member and
/// the number of its pool.
template <class Settle>
std::vector<Part> part_connected(const Part& whole, const Settle& settle) {
    const auto& [pools, graph] = whole.falls;
    std::uint32_t count = 0;
    const std::vector<std::uint32_t> number = number_connected(graph, count);
    std::vector<Part> parts(count, Part{{{}, FallGraph(0, {})}, {}, {}});
    std::vector<std::uint32_t> new_pool(graph.size());
    for (std::uint32_t pool = 0; pool < graph.size(); ++pool) {
        if (number[pool] != kNone) {
            auto& new_pools = parts[number[pool]].falls.pools;
            new_pool[pool] = static_cast<std::uint32_t>(new_pools.size());
            new_pools.push_back(pools[pool]);
        }
    }
    std::vector<std::vector<Fall>> falls(count);
    for (std::uint32_t pool = 0; pool < graph.size(); ++pool) {
        for (const std::uint32_t lower : graph.lowers(pool)) {
            falls[number[pool]].push_back({new_pool[pool], new_pool[lower]});
        }
    }
    for (std::size_t i = 0; i < whole.members.size(); ++i) {
        const std::uint32_t pool = whole.pool_of[i];
        if (number[pool] == kNone) {
            settle(whole.members[i], pool);
        } else {
            parts[number[pool]].members.push_back(whole.members[i]);
            parts[number[pool]].pool_of.push_back(new_pool[pool]);
        }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        parts[i].falls.graph = FallGraph(parts[i].falls.pools.size(), falls[i]);
    }
    return parts;
}

/// Leaves out falls, all but those that `keeps` wants.
template <class Keeps>
void keep_falls(FallGraph& graph, const Keeps& keeps) {
    std::vector<Fall> kept;
    for (std::uint32_t upper = 0; upper < graph.size(); ++upper) {
        for (const std::uint32_t lower : graph.lowers(upper)) {
            if (keeps(upper, lower)) {
                kept.push_back({upper, lower});
            }
        }
    }
    graph = FallGraph(graph.size(), kept);
}

/// Leaves out falls that hold by themselves. The best level of a pool is not below the lowest that any pool
/// upstream of it would have alone: were it, it could be raised to that, all such pools at a time, and be
/// nearer to its targets. Likewise it is not above the highest of those downstream. Without a fall
/// these limits are no wider, so that all falls whose ends are kept apart by them can go at once.
void drop_idle_falls(PooledFalls& falls) {
    const std::size_t count = falls.pools.size();
    std::vector<double> lowest_above(count);
    std::vector<double> highest_below(count);
    for (std::uint32_t pool = 0; pool < count; ++pool) {
        lowest_above[pool] = highest_below[pool] = falls.pools[pool].level();
        for (const std::uint32_t upper : falls.graph.uppers(pool)) {
            lowest_above[pool] = std::min(lowest_above[pool], lowest_above[upper]);
        }
    }
    for (auto pool = static_cast<std::uint32_t>(count); pool-- > 0;) {
        for (const std::uint32_t lower : falls.graph.lowers(pool)) {
            highest_below[pool] = std::max(highest_below[pool], highest_below[lower]);
        }
    }
    keep_falls(falls.graph, [&](std::uint32_t upper, std::uint32_t lower) {
        return lowest_above[upper] < highest_below[lower];
    });
}

/// Falls the other way, with levels of the other sign, numbered from the other end.
PooledFalls turn_over(const PooledFalls& falls) {
    const auto count = static_cast<std::uint32_t>(falls.pools.size());
    PooledFalls turned{{falls.pools.rbegin(), falls.pools.rend()}, FallGraph(0, {})};
    for (LevelPool& pool : turned.pools) {
        pool.moment = -pool.moment;
        pool.range = {-pool.range.highest, -pool.range.lowest};
    }
    std::vector<Fall> turned_falls;
    for (std::uint32_t pool = count; pool-- > 0;) {
        const auto uppers = falls.graph.uppers(pool);
        std::transform(uppers.rbegin(), uppers.rend(), std::back_inserter(turned_falls),
                       [&](std::uint32_t upper) {
                           return Fall{count - 1 - pool, count - 1 - upper};
                       });
    }
    turned.graph = FallGraph(count, turned_falls);
    return turned;
}

/// The level that a part has if it has one level, or one that divides it.
struct Threshold {
    double level = 0;
    bool is_mean = true;  ///< and no range ends there
};

Threshold find_threshold(const std::vector<LevelPool>& pools) {
    LevelPool all;
    for (const LevelPool& pool : pools) {
        all.join(pool);
    }
    const auto mean = static_cast<double>(all.moment / all.weight);
    if (all.range.lowest < mean && mean < all.range.highest) {
        return {mean, true};
    }
    return {all.range.lowest > all.range.highest ? all.range.lowest : all.level(), false};
}

/// The mean of the levels that pools would have alone.
Threshold middle(const std::vector<LevelPool>& pools) {
    LevelPool all;
    for (const LevelPool& pool : pools) {
        all.weight += pool.weight;
        all.moment += pool.weight * static_cast<long double>(pool.level());
    }
    return {all.level(), false};
}

/// What each pool gains when its level rises from the threshold, by so little that only the first order
/// counts. In integers, so that sums are exact.
std::vector<Gain> find_gains(const std::vector<LevelPool>& pools, const Threshold& threshold) {
    constexpr int kBits = 120;
    std::vector<long double> rough(pools.size());
    long double greatest = 0;
    long double weight = 0;
    for (std::size_t i = 0; i < pools.size(); ++i) {
        rough[i] = pools[i].moment - pools[i].weight * static_cast<long double>(threshold.level);
        greatest = std::max(greatest, std::abs(rough[i]));
        weight += pools[i].weight;
    }
    std::vector<Gain> gains(pools.size(), 0);
    if (greatest == 0) {
        return gains;
    }
    const int scale = kBits - std::ilogb(greatest) - std::ilogb(static_cast<double>(pools.size())) - 2;
    Gain sum = 0;
    for (std::size_t i = 0; i < pools.size(); ++i) {
        gains[i] = static_cast<Gain>(std::ldexp(rough[i], scale));
        sum += gains[i];
    }
    if (threshold.is_mean) {
        // A mean is rounded. What that makes of heavy pools may be more than light ones weigh, and these
        // would get a wrong level: the sum is made the zero that it is, but for a few units.
        const long double share = static_cast<long double>(sum) / weight;
        for (std::size_t i = 0; i < pools.size(); ++i) {
            gains[i] -= static_cast<Gain>(share * pools[i].weight);
        }
    }
    return gains;
}

/// Which pools have a level not below the threshold in the best levels. Those that have to be, or cannot be,
/// by their ranges make no part of the cut.
std::vector<bool> find_not_below(const PooledFalls& falls, const Threshold& threshold) {
    std::vector<bool> is_inside(falls.pools.size());
    std::vector<std::uint32_t> free;
    std::vector<std::uint32_t> number(falls.pools.size(), kNone);
    for (std::uint32_t pool = 0; pool < falls.pools.size(); ++pool) {
        const LevelRange& range = falls.pools[pool].range;
        is_inside[pool] = range.lowest >= threshold.level;
        if (!is_inside[pool] && range.highest >= threshold.level) {
            number[pool] = static_cast<std::uint32_t>(free.size());
            free.push_back(pool);
        }
    }
    const std::vector<Gain> all_gains = find_gains(falls.pools, threshold);
    std::vector<Gain> gains;
    std::vector<Fall> free_falls;
    for (const std::uint32_t pool : free) {
        gains.push_back(all_gains[pool]);
        for (const std::uint32_t lower : falls.graph.lowers(pool)) {
            if (number[lower] != kNone) {
                free_falls.push_back({number[pool], number[lower]});
            }
        }
    }
    const std::vector<bool> closure =
        find_largest_closure(FallGraph(free.size(), free_falls), std::move(gains));
    for (std::size_t i = 0; i < free.size(); ++i) {
        is_inside[free[i]] = closure[i];
    }
    return is_inside;
}

class LevelDivision {
  public:
    explicit LevelDivision(std::size_t count) : group_(count) {}

    std::vector<std::uint32_t> run(PooledFalls falls) {
        std::vector<std::uint32_t> numbers(falls.pools.size());
        std::iota(numbers.begin(), numbers.end(), 0U);
        parts_.push_back({std::move(falls), numbers, numbers});
        while (!parts_.empty()) {
            Part part = std::move(parts_.back());
            parts_.pop_back();
            join_chains(part);
            if (part.is_new) {
                drop_idle_falls(part.falls);
                push_connected(part, false);
            } else if (!is_tree(part)) {
                cut(part);
            }
        }
        return std::move(group_);
    }

  private:
    static void join_chains(Part& part) {
        PooledChains chains = pool_chains(part.falls);
        part.falls = std::move(chains.left);
        for (std::uint32_t& pool : part.pool_of) {
            pool = chains.pool_of[pool];
        }
    }

    void push_connected(const Part& whole, bool are_new) {
        std::vector<std::uint32_t> first(whole.falls.pools.size(), kNone);
        auto parts = part_connected(whole, [&](std::uint32_t member, std::uint32_t pool) {
            first[pool] = std::min(first[pool], member);
            group_[member] = first[pool];
        });
        for (Part& part : parts) {
            part.is_new = are_new;
            parts_.push_back(std::move(part));
        }
    }

    /// `root`: of each pool one of those that it has one level with, the same for all of them.
    void settle(const Part& part, const std::vector<std::uint32_t>& root) {
        std::vector<std::uint32_t> first(root.size(), kNone);
        for (std::size_t i = 0; i < part.members.size(); ++i) {
            std::uint32_t& group = first[root[part.pool_of[i]]];
            group = std::min(group, part.members[i]);
            group_[part.members[i]] = group;
        }
    }

    /// Settles a part in which water never divides, or never comes together.
    bool is_tree(const Part& part) {
        const FallGraph& graph = part.falls.graph;
        bool joins = false;
        bool divides = false;
        for (std::uint32_t pool = 0; pool < graph.size(); ++pool) {
            joins = joins || graph.uppers(pool).size() > 1;
            divides = divides || graph.lowers(pool).size() > 1;
        }
        if (!divides) {
            settle(part, pool_branches(part.falls));
        } else if (!joins) {
            std::vector<std::uint32_t> root = pool_branches(turn_over(part.falls));
            std::reverse(root.begin(), root.end());
            settle(part, root);
        }
        return !divides || !joins;
    }

    static std::vector<std::uint32_t> pool_branches(const PooledFalls& falls) {
        std::vector<std::uint32_t> lower(falls.pools.size());
        for (std::uint32_t pool = 0; pool < lower.size(); ++pool) {
            const auto lowers = falls.graph.lowers(pool);
            lower[pool] = lowers.empty() ? pool : lowers[0];
        }
        return pool_tree(falls.pools, lower);
    }

    void cut(Part& part) {
        const Threshold threshold = find_threshold(part.falls.pools);
        // Where ranges hold the level away from the mean, dividing there may part little from much.
        if (!threshold.is_mean && divide(part, find_not_below(part.falls, middle(part.falls.pools)))) {
            return;
        }
        if (divide(part, find_not_below(part.falls, threshold))) {
            return;
        }
        if (!threshold.is_mean) {
            // Where ranges end at the threshold, nothing below it does not mean nothing above it.
            std::vector<bool> is_inside = find_not_below(turn_over(part.falls), {-threshold.level, false});
            std::reverse(is_inside.begin(), is_inside.end());
            if (divide(part, is_inside)) {
                return;
            }
        }
        settle(part, std::vector<std::uint32_t>(part.falls.pools.size(), 0));
    }

    /// Whether some are inside and some are not: these are parted then.
    bool divide(Part& part, const std::vector<bool>& is_inside) {
        // That none are is brought about by a threshold above all levels, and by rounding.
        if (std::find(is_inside.begin(), is_inside.end(), !is_inside.front()) == is_inside.end()) {
            return false;
        }
        keep_falls(part.falls.graph, [&](std::uint32_t upper, std::uint32_t lower) {
            return is_inside[upper] == is_inside[lower];
        });
        push_connected(part, true);
        return true;
    }

    std::vector<std::uint32_t> group_;
    std::vector<Part> parts_;
};

}  // namespace

std::vector<std::uint32_t> find_level_groups(PooledFalls falls) {
    const std::size_t count = falls.pools.size();
    return LevelDivision(count).run(std::move(falls));
}

}  // namespace tinwright
