#include "tinwright/water/area_findings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "tinwright/water/fall_graph.hpp"

namespace tinwright {

namespace {

using Kind = WaterFinding::Kind;

/// The lakes that water comes to next from each place. Most places have those of the place below, so sets of
/// lakes are kept once.
class LakesBelow {
  public:
    LakesBelow(const WaterNetwork& network, const WaterFlow& flow) : network_(network), flow_(flow) {
        const FallGraph graph(network.node_count, falls_of_rest());
        steps_ = find_flow_steps(graph);
        sets_.emplace_back();  // none
        set_of_.assign(steps_.count, 0);
        std::vector<std::vector<std::uint32_t>> members(steps_.count);
        for (std::uint32_t node = 0; node < network.node_count; ++node) {
            members[steps_.step[node]].push_back(node);
        }
        for (std::size_t step = steps_.count; step-- > 0;) {
            for (const std::uint32_t node : members[step]) {
                set_of_[step] = node < network.first_section ? add_set({node}) : unite(set_of_[step], node);
            }
        }
    }

    std::vector<Fall> find_falls() {
        std::vector<Fall> falls;
        for (std::uint32_t lake = 0; lake < network_.first_section; ++lake) {
            const std::uint32_t first = flow_.first_of[lake];
            for (const std::uint32_t below : sets_[unite(0, first)]) {
                if (below != first) {
                    falls.push_back({lake, below});
                }
            }
        }
        return falls;
    }

  private:
    /// Those that do not leave lakes.
    [[nodiscard]] std::vector<Fall> falls_of_rest() const {
        return {std::lower_bound(flow_.falls.begin(), flow_.falls.end(), Fall{network_.first_section, 0}),
                flow_.falls.end()};
    }

    std::size_t add_set(std::vector<std::uint32_t> lakes) {
        sets_.push_back(std::move(lakes));
        return sets_.size() - 1;
    }

    /// A set and all that is below a node.
    std::size_t unite(std::size_t set, std::uint32_t node) {
        const auto lower_than = [](const Fall& fall, std::uint32_t sought) { return fall.upper < sought; };
        for (auto fall = std::lower_bound(flow_.falls.begin(), flow_.falls.end(), node, lower_than);
             fall != flow_.falls.end() && fall->upper == node; ++fall) {
            set = unite_sets(set, set_of_[steps_.step[fall->lower]]);
        }
        return set;
    }

    std::size_t unite_sets(std::size_t a, std::size_t b) {
        if (a == b || sets_[b].empty()) {
            return a;
        }
        std::vector<std::uint32_t> both;
        std::set_union(sets_[a].begin(), sets_[a].end(), sets_[b].begin(), sets_[b].end(),
                       std::back_inserter(both));
        return both == sets_[a] ? a : both == sets_[b] ? b : add_set(std::move(both));
    }

    const WaterNetwork& network_;
    const WaterFlow& flow_;
    FlowSteps steps_;
    std::vector<std::vector<std::uint32_t>> sets_;  // of lakes, ascending
    std::vector<std::size_t> set_of_;               // of each step
};

}  // namespace

std::vector<WaterFinding> find_passages(const WaterNetwork& network, std::span<const double> levels,
                                        double tolerance) {
    std::vector<WaterFinding> findings;
    for (std::uint32_t line = 0; line < network.prepared.size(); ++line) {
        if (network.prepared[line].role != LineRole::River) {
            continue;
        }
        std::map<std::uint32_t, WaterFinding> of_lake;
        double chainage = 0;
        const auto chain = network.chain(line);
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const std::uint32_t v = chain[i];
            chainage += i > 0 ? network.told_distance(chain[i - 1], v) : 0;
            const std::uint32_t node = network.node_of[v];
            if (node == kNoNode || node >= network.first_section) {
                continue;
            }
            const double own = network.noded.z[v];  // lakes said nothing
            const double off = std::isfinite(own) ? std::abs(own - levels[node]) : 0;
            const auto [place, is_new] = of_lake.try_emplace(node);
            WaterFinding& finding = place->second;
            if (is_new || off > finding.amount) {
                finding = make_finding(Kind::RiverThroughLake, network, line, v);
                finding.z = own;
                finding.other_z = levels[node];
                finding.amount = off > tolerance ? off : 0;
                finding.chainage = chainage;
                finding.is_repaired = true;
            }
        }
        for (const auto& [node, finding] : of_lake) {
            findings.push_back(finding);
        }
    }
    return findings;
}

std::vector<Fall> find_lake_falls(const WaterNetwork& network, const WaterFlow& flow) {
    if (network.first_section < 2) {
        return {};
    }
    return LakesBelow(network, flow).find_falls();
}

std::vector<WaterFinding> find_disorder(const WaterNetwork& network, const WaterFlow& flow,
                                        std::span<const double> levels, double tolerance) {
    std::vector<WaterFinding> findings;
    const std::vector<Fall> falls = find_lake_falls(network, flow);
    if (falls.empty()) {
        return findings;
    }
    const std::vector<std::uint32_t> vertex = find_node_vertices(network);
    const std::vector<std::uint32_t> line = find_node_lines(network);
    for (const Fall& fall : falls) {
        if (levels[fall.lower] - levels[fall.upper] > tolerance) {
            WaterFinding finding =
                make_finding(Kind::LakesOutOfOrder, network, line[fall.upper], vertex[fall.lower]);
            finding.other_line = network.lines[line[fall.lower]];
            finding.z = levels[fall.upper];
            finding.other_z = levels[fall.lower];
            finding.amount = levels[fall.lower] - levels[fall.upper];
            findings.push_back(finding);
        }
    }
    return findings;
}

std::vector<WaterFinding> find_unlevel_sections(const WaterNetwork& network, double tolerance) {
    std::vector<WaterFinding> findings;
    for (const BankWater& bank : network.banks) {
        const std::uint32_t ring = bank.polygon.rings.front();
        for (const BankSection& section : bank.network.sections) {
            if (!section.is_straight) {
                continue;
            }
            const std::uint32_t a = bank.rings[section.vertices[0][0]][section.vertices[0][1]];
            const std::uint32_t b = bank.rings[section.vertices[1][0]][section.vertices[1][1]];
            const auto [low, high] = std::minmax(network.noded.z[a], network.noded.z[b]);
            if (high - low > tolerance) {
                WaterFinding finding =
                    make_finding(Kind::BanksNotLevel, network, ring, network.noded.z[a] == high ? a : b);
                finding.z = high;
                finding.other_z = low;
                finding.amount = high - low;
                finding.length = network.ground.is_geodesic() ? network.told_distance(a, b)
                                                              : section.width * network.lattice.quantum();
                finding.is_repaired = true;
                findings.push_back(finding);
            }
        }
    }
    return findings;
}

std::vector<WaterFinding> find_overlaps(const WaterNetwork& network) {
    std::vector<WaterFinding> findings;
    const auto add_first = [&](const WaterPolygon& polygon, const auto& is_inside) {
        for (const std::uint32_t ring : polygon.rings) {
            const auto chain = network.chain(ring);
            const auto found = std::find_if(chain.begin(), chain.end(), is_inside);
            if (found != chain.end()) {
                findings.push_back(make_finding(Kind::WaterOverlaps, network, ring, *found));
                return;
            }
        }
    };
    for (const BankWater& bank : network.banks) {
        add_first(bank.polygon,
                  [&](std::uint32_t v) { return network.is_between_banks[v] || network.is_in_lake[v]; });
    }
    for (const WaterPolygon& lake : network.lakes) {
        add_first(lake, [&](std::uint32_t v) { return network.is_between_banks[v]; });
    }
    return findings;
}

}  // namespace tinwright
