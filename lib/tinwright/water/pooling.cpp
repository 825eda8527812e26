#include "tinwright/water/pooling.hpp"

#include <limits>
#include <utility>

namespace tinwright {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Heaps of pools with the lowest level on top, that two can be made one of (leftist heaps).
class PoolHeaps {
  public:
    explicit PoolHeaps(std::size_t count) : items_(count) {}

    void set_level(std::uint32_t pool, double level) { items_[pool].level = level; }
    double level(std::uint32_t pool) const { return items_[pool].level; }

    /// The top of a heap of what is in two.
    std::uint32_t meld(std::uint32_t a, std::uint32_t b) {
        if (a == kNone || b == kNone) {
            return a == kNone ? b : a;
        }
        if (std::pair(level(b), b) < std::pair(level(a), a)) {
            std::swap(a, b);
        }
        Item& top = items_[a];
        top.right = meld(top.right, b);  // as deep as the logarithm of what is in both
        if (rank(top.left) < rank(top.right)) {
            std::swap(top.left, top.right);
        }
        top.rank = rank(top.right) + 1;
        return a;
    }

    std::uint32_t without_top(std::uint32_t top) {
        const std::uint32_t rest = meld(items_[top].left, items_[top].right);
        items_[top].left = items_[top].right = kNone;
        items_[top].rank = 1;
        return rest;
    }

  private:
    struct Item {
        double level = 0;
        std::uint32_t left = kNone;
        std::uint32_t right = kNone;
        std::uint32_t rank = 1;
    };

    std::uint32_t rank(std::uint32_t pool) const { return pool == kNone ? 0 : items_[pool].rank; }

    std::vector<Item> items_;
};

}  // namespace

PooledChains pool_chains(const PooledFalls& falls) {
    const auto count = static_cast<std::uint32_t>(falls.pools.size());
    const FallGraph& graph = falls.graph;
    const auto is_inner = [&](std::uint32_t pool) {
        return graph.uppers(pool).size() == 1 && graph.lowers(graph.uppers(pool)[0]).size() == 1;
    };
    std::vector<std::uint32_t> head(count);  // of each pool one further up that it is joined with, or itself
    std::vector<LevelPool> joined(count);
    std::vector<std::pair<std::uint32_t, LevelPool>> chain;
    for (std::uint32_t first = 0; first < count; ++first) {
        if (is_inner(first)) {
            continue;
        }
        chain.clear();
        std::uint32_t pool = first;
        while (true) {
            chain.emplace_back(pool, falls.pools[pool]);
            head[pool] = pool;
            while (chain.size() > 1 && chain[chain.size() - 2].second.level() < chain.back().second.level()) {
                const auto [last, sums] = chain.back();
                chain.pop_back();
                chain.back().second.join(sums);
                head[last] = chain.back().first;
            }
            if (graph.lowers(pool).size() != 1 || graph.uppers(graph.lowers(pool)[0]).size() != 1) {
                break;
            }
            pool = graph.lowers(pool)[0];
        }
        for (const auto& [kept, sums] : chain) {
            joined[kept] = sums;
        }
    }
    PooledChains result{{{}, FallGraph(0, {})}, std::vector<std::uint32_t>(count)};
    for (std::uint32_t pool = 0; pool < count; ++pool) {
        if (head[pool] == pool) {
            result.pool_of[pool] = static_cast<std::uint32_t>(result.left.pools.size());
            result.left.pools.push_back(joined[pool]);
        } else {
            result.pool_of[pool] = result.pool_of[head[pool]];
        }
    }
    std::vector<Fall> left;
    for (std::uint32_t pool = 0; pool < count; ++pool) {
        for (const std::uint32_t lower : graph.lowers(pool)) {
            left.push_back({result.pool_of[pool], result.pool_of[lower]});
        }
    }
    result.left.graph = FallGraph(result.left.pools.size(), make_distinct(left));
    return result;
}

std::vector<std::uint32_t> pool_tree(std::vector<LevelPool> pools, std::span<const std::uint32_t> lower) {
    const auto count = static_cast<std::uint32_t>(pools.size());
    PoolHeaps heaps(count);
    std::vector<std::uint32_t> above(count, kNone);  // heap of the pools next above each pool
    std::vector<std::uint32_t> joined_with(count);
    for (std::uint32_t pool = 0; pool < count; ++pool) {
        joined_with[pool] = pool;
        double level = pools[pool].level();
        while (above[pool] != kNone && heaps.level(above[pool]) < level) {
            const std::uint32_t upper = above[pool];
            above[pool] = heaps.meld(heaps.without_top(upper), above[upper]);
            joined_with[upper] = pool;
            pools[pool].join(pools[upper]);
            level = pools[pool].level();
        }
        heaps.set_level(pool, level);
        if (lower[pool] != pool) {
            above[lower[pool]] = heaps.meld(above[lower[pool]], pool);
        }
    }
    for (std::uint32_t pool = count; pool-- > 0;) {
        joined_with[pool] = joined_with[joined_with[pool]];
    }
    return joined_with;
}

}  // namespace tinwright
