#include "tinwright/water/water_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
        NodeSets same(network_.node_count);
        for (const auto& [a, b] : network_.equal) {
            same.join(a, b);
        }
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
    /// Gives the chosen runs a direction. Where `outlets` has none for a connected part, elevations decide.
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
        std::vector<bool> is_settled(network_.node_count);
        for (const std::uint32_t outlet : outlets) {
            is_settled[parts.find(outlet)] = true;
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

    [[nodiscard]] bool is_section(std::uint32_t node) const {
        return node >= network_.first_section && node < network_.first_vertex;
    }

    /// Where rivers, as they were drawn, leave banks, or end between them.
    [[nodiscard]] std::vector<std::uint32_t> bank_outlets() const {
        std::vector<std::uint32_t> outlets;
        for (const WaterRun& run : network_.runs) {
            if (!run.is_between_banks && is_section(run.from)) {
                outlets.push_back(flow_.first_of[run.from]);
            }
        }
        for (std::uint32_t line = 0; line < network_.prepared.size(); ++line) {
            if (network_.prepared[line].role != LineRole::River || network_.chain(line).empty()) {
                continue;
            }
            const std::uint32_t end = network_.chain(line).back();
            if (network_.is_between_banks[end]) {
                outlets.push_back(nearest_bank_end(network_.key(end)));
            }
        }
        return outlets;
    }

    [[nodiscard]] std::uint32_t nearest_bank_end(Key2 key) const {
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t nearest = network_.first_section;
        for (const BankWater& bank : network_.banks) {
            for (const std::uint32_t end : bank.network.ends) {
                const Point2 middle = bank.network.sections[end].middle;
                const double distance = std::hypot(middle.x - key.x, middle.y - key.y);
                if (distance < least) {
                    least = distance;
                    nearest = bank.first_node + end;
                }
            }
        }
        return flow_.first_of[nearest];
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
