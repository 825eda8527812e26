#include "tinwright/water/lake_levels.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

using Kind = WaterFinding::Kind;

WaterFinding finding_at(Kind kind, const LakeLevel& lake) {
    WaterFinding finding;
    finding.kind = kind;
    finding.line = lake.line;
    finding.location = lake.location;
    finding.is_repaired = true;
    return finding;
}

LakeShape shape_of(const WaterNetwork& network, const WaterPolygon& polygon) {
    LakeShape shape;
    for (const std::uint32_t ring : polygon.rings) {
        CleanLine line;
        for (const std::uint32_t v : network.chain(ring)) {
            line.keys.push_back(network.key(v));
            line.z.push_back(0);
        }
        shape.lines.push_back(network.lines[ring]);
        shape.rings.push_back(std::move(line));
    }
    return shape;
}

}  // namespace

void LakeLevels::measure() {
    std::vector<MeasuredLake> measured;
    for (const WaterPolygon& polygon : network_.lakes) {
        measured.push_back(measure_lake(shape_of(network_, polygon), lines_, samples_, network_.lattice,
                                        options_.lake_level, report_.shore_width));
        const MeasuredLake& lake = measured.back();
        if (lake.lake.is_own && lake.z_high - lake.z_low > options_.tolerance) {
            WaterFinding finding = finding_at(Kind::LakeNotLevel, lake.lake);
            finding.z = lake.z_high;
            finding.other_z = lake.z_low;
            finding.amount = lake.z_high - lake.z_low;
            report_.findings.push_back(finding);
        }
    }
    agree(measured);
    for (std::size_t i = 0; i < measured.size(); ++i) {
        LakeLevel& lake = measured[i].lake;
        lake.level = levels_[network_.lake_node[i]];
        report_.lakes.push_back(lake);
        beside_.push_back(std::move(measured[i].beside));
    }
}

/// Lakes of one node get one level.
void LakeLevels::agree(const std::vector<MeasuredLake>& measured) {
    levels_.assign(network_.first_section, 0);
    std::map<std::uint32_t, std::vector<std::size_t>> lakes_of;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        lakes_of[network_.lake_node[i]].push_back(i);
    }
    for (auto& [node, lakes] : lakes_of) {
        std::sort(lakes.begin(), lakes.end(), [&](std::size_t a, std::size_t b) {
            return measured[a].lake.line < measured[b].lake.line;
        });
        std::vector<double> levels;
        for (const std::size_t lake : lakes) {
            levels.push_back(measured[lake].lake.level);
            if (levels.size() > 1) {
                report_meeting(measured[lakes.front()].lake, measured[lake].lake);
            }
        }
        const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
        const bool do_differ = *high - *low > options_.tolerance;
        if (do_differ && options_.meeting_levels == CrossingPolicy::Error && !options_.keeps_faults) {
            const LakeLevel& lowest = measured[lakes[static_cast<std::size_t>(low - levels.begin())]].lake;
            const LakeLevel& highest = measured[lakes[static_cast<std::size_t>(high - levels.begin())]].lake;
            throw BreaklineError("lakes that touch or overlap have different levels, " + decimal_text(*low) +
                                     " and " + decimal_text(*high) + ", near " +
                                     location_text(highest.location) +
                                     "; give them one, or say which to take with --crossing-z "
                                     "mean|first|min|max",
                                 {lowest.line, highest.line});
        }
        levels_[node] = choose_common(levels, do_differ);
    }
}

void LakeLevels::report_meeting(const LakeLevel& first, const LakeLevel& other) {
    WaterFinding finding = finding_at(Kind::LakesMeet, other);
    finding.line = first.line;
    finding.other_line = other.line;
    finding.z = first.level;
    finding.other_z = other.level;
    const double off = std::abs(other.level - first.level);
    finding.amount = off > options_.tolerance ? off : 0;
    report_.findings.push_back(finding);
}

double LakeLevels::choose_common(const std::vector<double>& levels, bool do_differ) const {
    if (do_differ && options_.meeting_levels == CrossingPolicy::Mean) {
        return choose_level({LevelRule::Kind::Mean, 0}, levels);
    }
    if (do_differ && options_.meeting_levels == CrossingPolicy::First) {
        return levels.front();
    }
    if (do_differ && options_.meeting_levels == CrossingPolicy::Max) {
        return *std::max_element(levels.begin(), levels.end());
    }
    return *std::min_element(levels.begin(), levels.end());
}

void LakeLevels::order(std::span<const Fall> falls) {
    const bool are_in_order = std::all_of(falls.begin(), falls.end(), [this](const Fall& fall) {
        return levels_[fall.upper] >= levels_[fall.lower];
    });
    if (are_in_order) {
        return;
    }
    std::vector<LevelNode> nodes(levels_.size());
    for (std::uint32_t node = 0; node < nodes.size(); ++node) {
        nodes[node] = {levels_[node], 0};
    }
    for (std::size_t i = 0; i < report_.lakes.size(); ++i) {
        LevelNode& node = nodes[network_.lake_node[i]];
        node.weight += report_.lakes[i].shore_length;
        if (report_.lakes[i].is_own) {
            node.lowest = node.highest = node.target;
        }
    }
    levels_ = fit_levels(nodes, falls, RiverFit::Isotonic).levels;
    for (std::size_t i = 0; i < report_.lakes.size(); ++i) {
        report_.lakes[i].level = levels_[network_.lake_node[i]];
    }
}

std::vector<std::pair<std::uint32_t, double>> LakeLevels::look_at_shores() {
    std::map<std::uint32_t, double> lifted;
    for (std::size_t i = 0; i < beside_.size(); ++i) {
        LakeLevel& lake = report_.lakes[i];
        for (const std::uint32_t sample : beside_[i]) {
            const double z = samples_.z(sample);
            if (!(z < lake.level)) {
                continue;
            }
            ++lake.samples_under;
            WaterFinding finding = finding_at(Kind::ShoreUnderWater, lake);
            finding.sample = sample;
            finding.location = network_.lattice.position(samples_.key(sample));
            finding.z = z;
            finding.other_z = lake.level;
            finding.amount = lake.level - z;
            finding.is_repaired = options_.shore_clearance.has_value();
            if (finding.amount > options_.tolerance) {
                report_.findings.push_back(finding);
            }
            if (options_.shore_clearance) {
                // Beside two lakes the higher one counts.
                const double wanted = lake.level + *options_.shore_clearance;
                const auto [place, is_new] = lifted.try_emplace(sample, wanted);
                place->second = std::max(place->second, wanted);
            }
        }
    }
    return {lifted.begin(), lifted.end()};
}

}  // namespace tinwright
