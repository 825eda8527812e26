#include "tinwright/water/area_findings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tinwright {

namespace {

using Kind = WaterFinding::Kind;

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
            chainage += i > 0 ? network.distance(chain[i - 1], v) : 0;
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
    std::vector<Fall> falls;
    const auto lower_than = [](const Fall& fall, std::uint32_t node) { return fall.upper < node; };
    for (std::uint32_t lake = 0; lake < network.first_section && network.first_section > 1; ++lake) {
        std::vector<std::uint32_t> stack = {flow.first_of[lake]};
        std::set<std::uint32_t> seen(stack.begin(), stack.end());
        while (!stack.empty()) {
            const std::uint32_t node = stack.back();
            stack.pop_back();
            for (auto fall = std::lower_bound(flow.falls.begin(), flow.falls.end(), node, lower_than);
                 fall != flow.falls.end() && fall->upper == node; ++fall) {
                if (!seen.insert(fall->lower).second) {
                    continue;
                }
                if (fall->lower >= network.first_section) {
                    stack.push_back(fall->lower);
                } else {
                    falls.push_back({lake, fall->lower});
                }
            }
        }
    }
    return falls;
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

std::vector<WaterFinding> find_bank_faults(const WaterNetwork& network, double tolerance) {
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
                finding.length = section.width * network.lattice.quantum();
                finding.is_repaired = true;
                findings.push_back(finding);
            }
        }
        const auto overlaps = [&](const std::vector<std::uint32_t>& vertices, const auto& is_inside) {
            return std::find_if(vertices.begin(), vertices.end(), is_inside);
        };
        for (const std::vector<std::uint32_t>& vertices : bank.rings) {
            const auto found = overlaps(vertices, [&](std::uint32_t v) {
                return network.is_between_banks[v] ||
                       (network.node_of[v] != kNoNode && network.is_in_lake[v]);
            });
            if (found != vertices.end()) {
                findings.push_back(make_finding(Kind::WaterOverlaps, network, ring, *found));
                break;
            }
        }
    }
    for (const WaterPolygon& lake : network.lakes) {
        for (const std::uint32_t ring : lake.rings) {
            const auto chain = network.chain(ring);
            const auto found = std::find_if(chain.begin(), chain.end(),
                                            [&](std::uint32_t v) { return network.is_between_banks[v]; });
            if (found != chain.end()) {
                findings.push_back(make_finding(Kind::WaterOverlaps, network, ring, *found));
                break;
            }
        }
    }
    return findings;
}

}  // namespace tinwright
