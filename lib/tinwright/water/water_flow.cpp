#include "tinwright/water/water_flow.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tinwright/water/bank_outlets.hpp"

namespace tinwright {

namespace {

/// Sets of nodes, each known by its first.
class NodeSets {
  public:
    explicit NodeSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::uint32_t find(std::uint32_t node) {
        while (parent_[node] != node) {
            node = parent_[node] = parent_[parent_[node]];
        }
        return node;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t first = find(a);
        const std::uint32_t second = find(b);
        parent_[std::max(first, second)] = std::min(first, second);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

class FlowFinder {
  public:
    FlowFinder(const WaterNetwork& network, std::span<const double> elevations)
        : network_(network), elevations_(elevations) {}

    WaterFlow find(FlowRule rule) {
        NodeSets same = join_equal();
        flow_.first_of.resize(network_.node_count);
        for (std::uint32_t node = 0; node < network_.node_count; ++node) {
            flow_.first_of[node] = same.find(node);
        }
        flow_.is_reversed.assign(network_.runs.size(), false);
        if (rule == FlowRule::Auto) {
            orient([](const WaterRun&) { return true; }, {});
        } else {
            orient([](const WaterRun& run) { return run.is_between_banks; }, bank_outlets());
        }
        make_falls();
        return std::move(flow_);
    }

  private:
    /// Sections that are tied to several lakes have the level of the highest: lakes keep their own.
    [[nodiscard]] NodeSets join_equal() const {
        std::vector<std::vector<std::uint32_t>> tied(network_.equal.empty() ? 0 : network_.node_count);
        std::vector<std::uint32_t> lakes;
        for (const auto& [a, b] : network_.equal) {
            tied[a].push_back(b);
            tied[b].push_back(a);
            if (a < network_.first_section) {
                lakes.push_back(a);
            }
        }
        std::sort(lakes.begin(), lakes.end(), [this](std::uint32_t a, std::uint32_t b) {
            return std::pair(elevations_[b], a) < std::pair(elevations_[a], b);
        });
        NodeSets same(network_.node_count);
        std::vector<bool> is_taken(network_.node_count);
        std::vector<std::uint32_t> todo;
        for (const std::uint32_t lake : lakes) {
            todo.assign(is_taken[lake] ? 0 : 1, lake);
            while (!todo.empty()) {
                const std::uint32_t node = todo.back();
                todo.pop_back();
                is_taken[node] = true;
                for (const std::uint32_t next : tied[node]) {
                    if (next >= network_.first_section && !is_taken[next]) {
                        same.join(lake, next);
                        todo.push_back(next);
                    }
                }
            }
        }
        for (const auto& [a, b] : network_.equal) {
            if (!is_taken[a] && !is_taken[b]) {
                same.join(a, b);
            }
        }
        return same;
    }

    /// Gives the chosen runs a direction. Where `outlets` has no end of a connected part, elevations tell
    /// more.
    template <class IsChosen>
    void orient(const IsChosen& is_chosen, const std::vector<std::uint32_t>& outlets) {
        std::vector<std::uint32_t> runs;
        std::vector<FlowLink> links;
        NodeSets parts(network_.node_count);
        for (std::uint32_t r = 0; r < network_.runs.size(); ++r) {
            const WaterRun& run = network_.runs[r];
            if (is_chosen(run)) {
                runs.push_back(r);
                links.push_back({flow_.first_of[run.from], flow_.first_of[run.to]});
                parts.join(links.back().a, links.back().b);
            }
        }
        std::vector<std::uint32_t> ways(network_.node_count);
        for (const FlowLink& link : links) {
            ++ways[link.a];
            ++ways[link.b];
        }
        // A canal that leaves in the middle does not say where the rest of the water goes.
        std::vector<bool> is_settled(network_.node_count);
        for (const std::uint32_t outlet : outlets) {
            if (ways[outlet] < 2) {
                is_settled[parts.find(outlet)] = true;
            }
        }
        std::vector<std::uint32_t> all(outlets);
        for (const std::uint32_t outlet : find_outlets(elevations_, links)) {
            if (!is_settled[parts.find(outlet)]) {
                all.push_back(outlet);
            }
        }
        const std::vector<bool> reversed = orient_links(elevations_, links, all);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            flow_.is_reversed[runs[i]] = reversed[i];
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> bank_outlets() const {
        std::vector<std::uint32_t> outlets = find_bank_outlets(network_);
        for (std::uint32_t& outlet : outlets) {
            outlet = flow_.first_of[outlet];
        }
        return outlets;
    }

    void make_falls() {
        for (std::uint32_t r = 0; r < network_.runs.size(); ++r) {
            if (network_.runs[r].is_between_banks) {
                const std::vector<std::uint32_t> stops = flow_.stops(network_, r);
                for (std::size_t i = 1; i < stops.size(); ++i) {
                    flow_.bank_falls.push_back({stops[i - 1], stops[i]});
                }
            }
        }
        std::sort(flow_.bank_falls.begin(), flow_.bank_falls.end());
        flow_.falls = flow_.bank_falls;
        for (std::uint32_t r = 0; r < network_.runs.size(); ++r) {
            if (!network_.runs[r].is_between_banks) {
                const std::vector<std::uint32_t> stops = flow_.stops(network_, r);
                for (std::size_t i = 1; i < stops.size(); ++i) {
                    flow_.falls.push_back(
                        {flow_.around(network_, stops[i - 1]).lower, flow_.around(network_, stops[i]).upper});
                }
            }
        }
        for (Fall& fall : flow_.falls) {
            fall = {flow_.first_of[fall.upper], flow_.first_of[fall.lower]};
        }
        std::erase_if(flow_.falls, [](const Fall& fall) { return fall.upper == fall.lower; });
        std::sort(flow_.falls.begin(), flow_.falls.end());
        flow_.falls.erase(std::unique(flow_.falls.begin(), flow_.falls.end()), flow_.falls.end());
    }

    const WaterNetwork& network_;
    std::span<const double> elevations_;
    WaterFlow flow_;
};

}  // namespace

std::vector<std::uint32_t> WaterFlow::stops(const WaterNetwork& network, std::uint32_t run) const {
    std::vector<std::uint32_t> stops = network.runs[run].stops;
    if (is_reversed[run]) {
        std::reverse(stops.begin(), stops.end());
    }
    return stops;
}

Fall WaterFlow::around(const WaterNetwork& network, std::uint32_t vertex) const {
    if (network.node_of[vertex] != kNoNode) {
        return {network.node_of[vertex], network.node_of[vertex]};
    }
    const BankStand& stand = network.stand_of[vertex];
    const bool is_down = std::binary_search(bank_falls.begin(), bank_falls.end(), Fall{stand.a, stand.b});
    return is_down ? Fall{stand.a, stand.b} : Fall{stand.b, stand.a};
}

WaterFlow find_flow(const WaterNetwork& network, std::span<const double> elevations, FlowRule rule) {
    return FlowFinder(network, elevations).find(rule);
}

}  // namespace tinwright
