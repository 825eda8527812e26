#include "hydro_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "tinwright/geometry/decimal.hpp"

#include "job_report.hpp"
#include "part_names.hpp"
#include "water_finding_text.hpp"
#include "water_report.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kListed = 1000;  // of each kind

std::string counted(std::size_t count, const std::string& singular, const std::string& plural) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// With `left_only` the faults that repairing leaves, else all.
std::vector<WaterFinding> select_findings(const LeveledWater& leveled, bool left_only) {
    std::vector<WaterFinding> findings = leveled.findings();
    if (left_only) {
        std::erase_if(findings,
                      [](const WaterFinding& finding) { return finding.is_repaired || !is_fault(finding); });
    }
    return findings;
}

/// Calls `visit` for those that are listed. Returns how many of each kind are not.
template <class Visit>
WaterFindingCounts for_each_listed(const std::vector<WaterFinding>& findings, const Visit& visit) {
    WaterFindingCounts seen{};
    for (const WaterFinding& finding : findings) {
        if (++seen[static_cast<std::size_t>(finding.kind)] <= kListed) {
            visit(finding);
        }
    }
    for (std::size_t& count : seen) {
        count -= std::min(count, kListed);
    }
    return seen;
}

/// Features of a role: a polygon or a line each.
std::size_t count_role(const LeveledWater& leveled, LineRole role) {
    std::set<std::pair<std::uint32_t, std::size_t>> distinct;
    for (std::size_t i = 0; i < leveled.lines.lines.size(); ++i) {
        const Breakline& line = leveled.lines.lines[i];
        if (line.role == role) {
            distinct.emplace(line.polygon, is_polygon_role(role) ? 0 : i);
        }
    }
    return distinct.size();
}

std::string inputs_text(const LeveledWater& leveled) {
    std::vector<std::string> parts;
    const auto add = [&parts](std::size_t count, const char* one, const char* many) {
        if (count > 0) {
            parts.push_back(counted(count, one, many));
        }
    };
    add(count_role(leveled, LineRole::Lake), "lake", "lakes");
    add(count_role(leveled, LineRole::River), "river", "rivers");
    add(count_role(leveled, LineRole::Bank), "polygon of banks", "polygons of banks");
    add(leveled.samples.points.size(), "sample", "samples");
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        text += i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ";
        text += parts[i];
    }
    return text;
}

JsonValue number_json(double value) { return std::isnan(value) ? JsonValue() : JsonValue(value); }

void set_feature(JsonValue& json, const std::string& before, std::int64_t source, std::int64_t feature) {
    json.set(before + "source", source).set(before + "feature", feature);
}

JsonValue finding_json(const WaterFinding& finding, const LeveledWater& leveled) {
    JsonValue json = JsonValue::object();
    json.set("kind", finding_key(finding.kind)).set("fault", is_fault(finding));
    json.set("repaired", finding.is_repaired);
    if (finding.line != WaterFinding::kNone) {
        set_feature(json, "", leveled.source_of_line(finding.line),
                    leveled.lines.parts[finding.line].feature);
    }
    if (finding.other_line != WaterFinding::kNone) {
        set_feature(json, "other_", leveled.source_of_line(finding.other_line),
                    leveled.lines.parts[finding.other_line].feature);
    } else if (const io::SampleSlice* const slice = leveled.samples.find_slice(finding.sample)) {
        set_feature(json, "other_", leveled.source_of_sample(finding.sample),
                    slice->id(finding.sample - slice->first));
    }
    json.set("location", JsonValue::array_of({finding.location.x, finding.location.y}));
    json.set("z", number_json(finding.z)).set("other_z", number_json(finding.other_z));
    return json.set("amount", finding.amount).set("chainage", finding.chainage).set("length", finding.length);
}

JsonValue sources_json(const LeveledWater& leveled) {
    JsonValue list = JsonValue::array();
    for (const io::LineSlice& slice : leveled.lines.slices) {
        list.append(JsonValue::object()
                        .set("number", slice.source + 1)
                        .set("role", role_name(slice.role))
                        .set("file", slice.file)
                        .set("layer", slice.layer));
    }
    for (const io::SampleSlice& slice : leveled.samples.slices) {
        list.append(JsonValue::object()
                        .set("number", leveled.line_sources.size() + slice.source + 1)
                        .set("role", "samples")
                        .set("file", slice.file)
                        .set("layer", slice.layer));
    }
    return list;
}

JsonValue raster_json(const CheckedRaster& raster) {
    const RasterCheckReport& report = raster.report;
    return JsonValue::object()
        .set("file", raster.file)
        .set("type", raster.data_type)
        .set("tolerance", raster.tolerance)
        .set("reaches", report.rivers)
        .set("river_cells", report.river_cells)
        .set("lakes", report.lakes)
        .set("lake_cells", report.lake_cells)
        .set("empty_cells", report.empty_cells)
        .set("highest_rise", report.highest_rise)
        .set("widest_range", report.widest_range);
}

std::string found_text(const std::vector<WaterFinding>& findings) {
    const std::string text = finding_counts_text(count_findings(findings));
    return text.empty() ? "clean" : text;
}

}  // namespace

std::size_t count_hydro_faults(const LeveledWater& leveled, bool left_only) {
    const std::vector<WaterFinding> findings = select_findings(leveled, left_only);
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_fault));
}

std::string hydro_lines(const LeveledWater& leveled, bool left_only) {
    const PartNames names(leveled.lines, leveled.samples);
    std::string list;
    const WaterFindingCounts unlisted =
        for_each_listed(select_findings(leveled, left_only),
                        [&](const WaterFinding& finding) { list += finding_text(finding, names) + "\n"; });
    const std::string more = finding_counts_text(unlisted);
    return more.empty() ? list : list + "and " + more + " more\n";
}

std::string hydro_plane(const LeveledWater& leveled) {
    return leveled.options.ground.is_geodesic()
               ? "plane " + leveled.plane.text() + "; lengths geodesic, " + leveled.options.ground.unit
               : std::string();
}

std::string hydro_verdict(const LeveledWater& leveled) {
    return inputs_text(leveled) + ": " + found_text(leveled.water.report.findings);
}

std::string raster_verdict(const CheckedRaster& raster) {
    const RasterCheckReport& report = raster.report;
    std::string text = raster.file + " (" + raster.data_type +
                       "): " + counted(report.rivers, "reach", "reaches") + " along " +
                       counted(report.river_cells, "cell", "cells");
    text += report.rivers > 0 ? ", highest rise " + decimal_text(rounded(report.highest_rise)) : "";
    text += "; " + counted(report.lakes, "lake", "lakes") + " over " +
            counted(report.lake_cells, "cell", "cells");
    text += report.lakes > 0 ? ", widest range " + decimal_text(rounded(report.widest_range)) : "";
    text += report.empty_cells > 0 ? "; " + counted(report.empty_cells, "cell", "cells") + " without a value"
                                   : std::string();
    return text + "; tolerance " + decimal_text(raster.tolerance) + ": " + found_text(report.findings);
}

std::string hydro_repair_verdict(const LeveledWater& leveled) {
    const std::vector<WaterFinding> left = select_findings(leveled, true);
    return "repaired; left: " + (left.empty() ? "nothing" : found_text(left));
}

JsonValue hydro_json(const LeveledWater& leveled, const std::string& command,
                     const std::vector<std::string>& outputs) {
    const bool is_repair = command == "hydro repair";
    JsonValue findings = JsonValue::array();
    for_each_listed(leveled.findings(),
                    [&](const WaterFinding& finding) { findings.append(finding_json(finding, leveled)); });
    const std::size_t faults = count_hydro_faults(leveled, false);
    JsonValue json = JsonValue::object();
    json.set("version", TINWRIGHT_VERSION).set("command", command).set("crs", crs_json(leveled.output_crs));
    if (leveled.crs.is_known()) {
        json.set("working_crs", plane_json(leveled.plane));
    }
    set_lengths(json, leveled.options.ground, leveled.crs);
    json.set("clean", faults == 0).set("faults", faults);
    if (is_repair) {
        json.set("faults_left", count_hydro_faults(leveled, true));
    }
    json.set("samples", leveled.samples.points.size()).set("sources", sources_json(leveled));
    json.set("water", water_json(summarize_water(leveled.water, leveled.lines, leveled.options)));
    json.set("findings", findings);
    if (leveled.raster) {
        json.set("raster", raster_json(*leveled.raster));
    }
    return json.set("outputs", JsonValue::array_of(outputs)).set("peak_memory_bytes", peak_memory_bytes());
}

}  // namespace tinwright::tools
