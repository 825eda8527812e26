#include "water_report.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "tinwright/geometry/decimal.hpp"

#include "part_names.hpp"
#include "water_finding_text.hpp"

namespace tinwright::tools {

namespace {

constexpr const char* kLakesKey = "TINWRIGHT_LAKES";
constexpr const char* kReachesKey = "TINWRIGHT_REACHES";
constexpr const char* kSectionsKey = "TINWRIGHT_SECTIONS";
constexpr const char* kBurnKey = "TINWRIGHT_BURN";

std::string counted(std::size_t count, const std::string& singular, const std::string& plural) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string number_text(double value) { return decimal_text(rounded(value)); }

FeatureName name_of(std::uint32_t line, const io::Lines& lines) {
    const io::LineSlice& slice = lines.slice_of(line);
    return {slice.file, slice.layer, lines.parts[line].feature};
}

/// Sums over the reaches: of rivers drawn and of the middles between banks.
struct ReachTotals {
    std::size_t rivers = 0;
    std::size_t between_banks = 0;
    double length = 0;
    double most_dug = 0;
    double most_lifted = 0;
};

ReachTotals total(const WaterReport& report) {
    ReachTotals totals;
    for (const Reach& reach : report.reaches) {
        ++(reach.is_between_banks ? totals.between_banks : totals.rivers);
        totals.length += reach.is_between_banks ? 0 : reach.length;
        totals.most_dug = std::max(totals.most_dug, reach.most_dug);
        totals.most_lifted = std::max(totals.most_lifted, reach.most_lifted);
    }
    return totals;
}

std::size_t total_sections(const WaterReport& report) {
    std::size_t sections = 0;
    for (const BanksReport& banks : report.banks) {
        sections += banks.sections;
    }
    return sections;
}

/// Findings of faults that are put right, or that are not; shores are told of apart.
WaterFindingCounts count_faults(const WaterReport& report, bool are_repaired) {
    std::vector<WaterFinding> faults;
    std::copy_if(report.findings.begin(), report.findings.end(), std::back_inserter(faults),
                 [&](const WaterFinding& finding) {
                     return is_fault(finding) && finding.is_repaired == are_repaired &&
                            finding.kind != WaterFinding::Kind::ShoreUnderWater &&
                            finding.kind != WaterFinding::Kind::BeyondLimit;
                 });
    return count_findings(faults);
}

std::string lakes_text(const WaterSummary& summary) {
    const std::vector<LakeLevel>& lakes = summary.report.lakes;
    const auto [low, high] = std::minmax_element(
        lakes.begin(), lakes.end(), [](const LakeLevel& a, const LakeLevel& b) { return a.level < b.level; });
    std::size_t inside = 0;
    for (const LakeLevel& lake : lakes) {
        inside += lake.samples_inside;
    }
    std::string text = std::to_string(lakes.size()) + ", level ";
    text += number_text(low->level);
    text += low->level < high->level ? " to " + number_text(high->level) : std::string();
    if (inside > 0) {
        text += "; " + counted(inside, "sample inside", "samples inside") + " left out";
    }
    if (summary.lifted > 0) {
        text += "; " + counted(summary.lifted, "sample", "samples") + " on shores lifted";
    }
    return text;
}

std::string rivers_text(const WaterSummary& summary, const ReachTotals& totals) {
    std::string text = counted(summary.rivers, "line", "lines") + " in " +
                       counted(totals.rivers, "reach", "reaches") + ", " + number_text(totals.length) +
                       " long";
    if (summary.report.rivers_turned > 0) {
        text += "; " + std::to_string(summary.report.rivers_turned) + " drawn against the flow";
    }
    return text;
}

std::string fitted_text(const WaterSummary& summary, const ReachTotals& totals) {
    std::string text = "dug in by up to " + number_text(totals.most_dug) + ", lifted by up to " +
                       number_text(totals.most_lifted);
    return summary.burn ? text + ", burnt in by " + number_text(*summary.burn) : text;
}

std::string banks_text(const WaterReport& report) {
    double z_up = -std::numeric_limits<double>::infinity();
    double z_down = std::numeric_limits<double>::infinity();
    for (const BanksReport& banks : report.banks) {
        z_up = std::max(z_up, banks.z_up);
        z_down = std::min(z_down, banks.z_down);
    }
    return std::to_string(report.banks.size()) + ", " +
           counted(total_sections(report), "level section", "level sections") + " from " + number_text(z_up) +
           " down to " + number_text(z_down);
}

void set_name(JsonValue& json, const FeatureName& name) {
    json.set("source", name.file).set("layer", name.layer).set("feature", name.feature);
}

JsonValue lake_json(const LakeLevel& lake, const FeatureName& name) {
    JsonValue json = JsonValue::object();
    set_name(json, name);
    return json.set("level", lake.level)
        .set("own", lake.is_own)
        .set("shore_length", lake.shore_length)
        .set("samples_inside", lake.samples_inside)
        .set("samples_on_shore", lake.samples_on_shore)
        .set("samples_under", lake.samples_under);
}

JsonValue rivers_json(const WaterSummary& summary) {
    const ReachTotals totals = total(summary.report);
    JsonValue json = JsonValue::object();
    json.set("lines", summary.rivers).set("reaches", totals.rivers).set("length", totals.length);
    json.set("turned", summary.report.rivers_turned);
    json.set("most_dug", totals.most_dug).set("most_lifted", totals.most_lifted);
    if (summary.burn) {
        json.set("burn", *summary.burn);
    }
    if (summary.river_cells) {
        json.set("cells", *summary.river_cells);
    }
    return json;
}

JsonValue banks_json(const BanksReport& banks, const FeatureName& name) {
    JsonValue json = JsonValue::object();
    set_name(json, name);
    return json.set("sections", banks.sections)
        .set("z_up", banks.z_up)
        .set("z_down", banks.z_down)
        .set("mean_width", banks.mean_width);
}

}  // namespace

WaterSummary summarize_water(const Water& water, const io::Lines& lines, const WaterOptions& options) {
    WaterSummary summary;
    summary.report = water.report;
    for (Reach& reach : summary.report.reaches) {
        reach.points = {};
    }
    for (const LakeLevel& lake : water.report.lakes) {
        summary.lake_names.push_back(name_of(lake.line, lines));
    }
    for (const BanksReport& banks : water.report.banks) {
        summary.banks_names.push_back(name_of(banks.line, lines));
    }
    summary.lifted = water.lifted.size();
    summary.rivers = static_cast<std::size_t>(
        std::count_if(lines.lines.begin(), lines.lines.end(),
                      [](const Breakline& line) { return line.role == LineRole::River; }));
    summary.burn = options.burn;
    return summary;
}

JsonValue water_json(const WaterSummary& summary) {
    const WaterReport& report = summary.report;
    JsonValue lakes = JsonValue::array();
    for (std::size_t i = 0; i < report.lakes.size(); ++i) {
        lakes.append(lake_json(report.lakes[i], summary.lake_names[i]));
    }
    JsonValue banks = JsonValue::array();
    for (std::size_t i = 0; i < report.banks.size(); ++i) {
        banks.append(banks_json(report.banks[i], summary.banks_names[i]));
    }
    JsonValue findings = JsonValue::object();
    const WaterFindingCounts counts = count_findings(report.findings);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) {
            findings.set(finding_key(static_cast<WaterFinding::Kind>(i)), counts[i]);
        }
    }
    JsonValue json = JsonValue::object();
    json.set("shore_width", report.shore_width).set("river_width", report.river_width);
    json.set("station_spacing", report.station_spacing);
    json.set("lakes", lakes).set("rivers", rivers_json(summary)).set("banks", banks);
    return json.set("lifted", summary.lifted).set("findings", findings);
}

std::vector<std::pair<std::string, std::string>> water_lines(const WaterSummary& summary) {
    const WaterReport& report = summary.report;
    std::vector<std::pair<std::string, std::string>> lines;
    if (!report.lakes.empty()) {
        lines.emplace_back("lakes", lakes_text(summary));
    }
    const ReachTotals totals = total(report);
    if (summary.rivers > 0) {
        lines.emplace_back("rivers", rivers_text(summary, totals));
    }
    if (!report.banks.empty()) {
        lines.emplace_back("banks", banks_text(report));
    }
    if (summary.rivers > 0 || !report.banks.empty()) {
        lines.emplace_back("", fitted_text(summary, totals));
    }
    if (summary.river_cells) {
        lines.emplace_back("",
                           counted(*summary.river_cells, "cell has", "cells have") + " a river's elevation");
    }
    if (const std::string found = finding_counts_text(count_findings(report.findings)); !found.empty()) {
        lines.emplace_back("found", found);
    }
    return lines;
}

std::vector<std::string> water_warnings(const WaterSummary& summary) {
    std::vector<std::string> warnings;
    const auto add = [&warnings](const WaterFindingCounts& counts, const std::string& before,
                                 const std::string& after) {
        if (const std::string text = finding_counts_text(counts); !text.empty()) {
            warnings.push_back(before + text + after);
        }
    };
    const WaterReport& report = summary.report;
    const std::string list = "; \"tinwright hydro check\" lists each";
    add(count_faults(report, true), "water was put right: ", list);
    add(count_faults(report, false), "water is left as it is: ", list);
    const WaterFindingCounts all = count_findings(report.findings);
    if (const std::size_t beyond = all[static_cast<std::size_t>(WaterFinding::Kind::BeyondLimit)];
        beyond > 0) {
        warnings.push_back("water may still run uphill at " + counted(beyond, "place", "places") +
                           ", where --max-drop and --max-lift do not allow enough" + list);
    }
    std::size_t under = all[static_cast<std::size_t>(WaterFinding::Kind::ShoreUnderWater)];
    under -= std::min(under, summary.lifted);
    if (under > 0) {
        warnings.push_back(counted(under, "sample", "samples") +
                           " beside lakes below their level; --shore-clearance DZ lifts such shores");
    }
    return warnings;
}

io::TinMetadata water_metadata(const WaterSummary& summary) {
    const ReachTotals totals = total(summary.report);
    io::TinMetadata metadata;
    const auto add = [&metadata](const char* key, std::size_t count) {
        if (count > 0) {
            metadata.emplace_back(key, std::to_string(count));
        }
    };
    add(kLakesKey, summary.report.lakes.size());
    add(kReachesKey, totals.rivers);
    add(kSectionsKey, total_sections(summary.report));
    if (summary.burn) {
        metadata.emplace_back(kBurnKey, decimal_text(*summary.burn));
    }
    return metadata;
}

std::string file_water_text(const io::TinMetadata& metadata) {
    constexpr std::array<std::array<std::string_view, 3>, 3> kCounts{{{kLakesKey, "lake", "lakes"},
                                                                      {kReachesKey, "reach", "reaches"},
                                                                      {kSectionsKey, "section", "sections"}}};
    std::string text;
    for (const auto& [key, value] : water_metadata_of(metadata)) {
        for (const auto& [of_kind, one, many] : kCounts) {
            if (key == of_kind) {
                text += (text.empty() ? "" : ", ") + value + " " + std::string(value == "1" ? one : many);
            }
        }
        text += key == kBurnKey ? ", burnt in by " + value : std::string();
    }
    return text;
}

io::TinMetadata water_metadata_of(const io::TinMetadata& metadata) {
    constexpr std::array<std::string_view, 4> kKeys{kLakesKey, kReachesKey, kSectionsKey, kBurnKey};
    io::TinMetadata of_water;
    std::copy_if(metadata.begin(), metadata.end(), std::back_inserter(of_water), [&](const auto& entry) {
        return std::find(kKeys.begin(), kKeys.end(), entry.first) != kKeys.end();
    });
    return of_water;
}

}  // namespace tinwright::tools
