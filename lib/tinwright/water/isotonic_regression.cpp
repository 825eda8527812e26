#include "tinwright/water/isotonic_regression.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "tinwright/water/level_division.hpp"

namespace tinwright {

namespace {

/// Without a range.
LevelPool pool_of(const LevelNode& node) {
    const auto weight = static_cast<long double>(node.weight);
    return {weight, weight * static_cast<long double>(node.target), {}};
}

/// Of each step the first of those that have one level with it.
std::vector<std::uint32_t> find_groups(std::span<const LevelNode> nodes, const LevelBounds& bounds) {
    PooledFalls falls{std::vector<LevelPool>(bounds.steps.count), bounds.graph};
    for (std::uint32_t step = 0; step < bounds.steps.count; ++step) {
        falls.pools[step].range = bounds.ranges[step];
    }
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        falls.pools[bounds.steps.step[node]].join(pool_of(nodes[node]));
    }
    return find_level_groups(std::move(falls));
}

std::vector<double> fit_squares(std::span<const LevelNode> nodes, const LevelBounds& bounds) {
    const std::vector<std::uint32_t> group_of = find_groups(nodes, bounds);
    std::vector<LevelPool> groups(bounds.steps.count);
    for (std::uint32_t step = 0; step < bounds.steps.count; ++step) {
        groups[group_of[step]].join({0, 0, bounds.ranges[step]});
    }
    // In an order of their own, so that the sums are the same however nodes are numbered.
    std::vector<std::tuple<std::uint32_t, double, double>> members;
    members.reserve(nodes.size());
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        members.emplace_back(group_of[bounds.steps.step[node]], nodes[node].target, nodes[node].weight);
    }
    std::sort(members.begin(), members.end());
    for (const auto& [group, target, weight] : members) {
        groups[group].join(pool_of(LevelNode{target, weight}));
    }
    std::vector<double> levels(bounds.steps.count);
    for (std::uint32_t step = 0; step < levels.size(); ++step) {
        levels[step] = groups[group_of[step]].level();
    }
    return levels;
}

std::vector<double> fit_lowest(std::span<const LevelNode> nodes, const LevelBounds& bounds) {
    std::vector<double> levels(bounds.steps.count, std::numeric_limits<double>::infinity());
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        double& level = levels[bounds.steps.step[node]];
        level = std::min(level, nodes[node].target);
    }
    for (std::uint32_t step = 0; step < levels.size(); ++step) {
        for (const std::uint32_t upper : bounds.graph.uppers(step)) {
            levels[step] = std::min(levels[step], levels[upper]);
        }
        levels[step] = std::clamp(levels[step], bounds.ranges[step].lowest, bounds.ranges[step].highest);
    }
    return levels;
}

}  // namespace

LevelFit fit_levels(std::span<const LevelNode> nodes, std::span<const Fall> falls, RiverFit fit) {
    assert(std::all_of(nodes.begin(), nodes.end(), [](const LevelNode& node) {
        return std::isfinite(node.target) && std::isfinite(node.weight) && node.weight > 0 &&
               node.lowest <= node.highest;
    }));
    const LevelBounds bounds = find_level_bounds(nodes, make_distinct(falls));
    std::vector<double> levels =
        fit == RiverFit::Min ? fit_lowest(nodes, bounds) : fit_squares(nodes, bounds);
    // Ranges do not rise downstream, so that what keeps to them and is lowered to what is above still does.
    for (std::uint32_t step = 0; step < levels.size(); ++step) {
        levels[step] = std::clamp(levels[step], bounds.ranges[step].lowest, bounds.ranges[step].highest);
        for (const std::uint32_t upper : bounds.graph.uppers(step)) {
            levels[step] = std::min(levels[step], levels[upper]);
        }
    }
    LevelFit result;
    result.levels.resize(nodes.size());
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        result.levels[node] = levels[bounds.steps.step[node]];
    }
    std::vector<std::pair<std::uint32_t, double>> beyond = bounds.contradicted;
    for (const std::uint32_t node : bounds.dropped) {
        const double wanted = result.levels[node];
        result.levels[node] = std::clamp(wanted, nodes[node].lowest, nodes[node].highest);
        if (result.levels[node] != wanted) {
            beyond.emplace_back(node, wanted);
        }
    }
    std::sort(beyond.begin(), beyond.end());
    for (const auto& [node, wanted] : beyond) {
        result.beyond.push_back(node);
        result.wanted.push_back(wanted);
    }
    return result;
}

}  // namespace tinwright
