#include "hydro_repair.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>

#include "options_output.hpp"
#include "water_layers.hpp"

namespace tinwright::tools {

namespace {

constexpr const char* kWaterStem = "hydro";

/// Which way the reaches of a river run.
struct Directions {
    bool with_drawing = false;
    bool against = false;
};

std::vector<std::vector<Point3>> downstream_parts(std::uint32_t line, const Directions& directions,
                                                  const Water& water) {
    std::vector<Point3> points = water.lines[line].points;
    if (!directions.against) {
        return {std::move(points)};
    }
    if (!directions.with_drawing) {
        std::reverse(points.begin(), points.end());
        return {std::move(points)};
    }
    std::vector<std::vector<Point3>> parts;
    for (const Reach& reach : water.report.reaches) {
        if (reach.line == line && !reach.is_between_banks && reach.points.size() > 1) {
            parts.push_back(reach.points);
        }
    }
    return parts;
}

}  // namespace

RepairedLines downstream_lines(const LeveledWater& leveled) {
    const Water& water = leveled.water;
    std::vector<Directions> directions(leveled.lines.lines.size());
    for (const Reach& reach : water.report.reaches) {
        if (!reach.is_between_banks) {
            (reach.is_reversed ? directions[reach.line].against : directions[reach.line].with_drawing) = true;
        }
    }
    RepairedLines repaired;
    for (std::uint32_t line = 0; line < directions.size(); ++line) {
        repaired.push_back(downstream_parts(line, directions[line], water));
    }
    return repaired;
}

HydroPlan plan_hydro(const LeveledWater& leveled, const std::string& folder, bool overwrite,
                     std::span<const io::Source> sources) {
    HydroPlan plan{plan_repair(leveled.lines, folder, overwrite, sources, kWaterStem),
                   folder + "/" + kWaterStem + ".gpkg"};
    refuse_to_overwrite_sources(plan.water, sources);
    std::error_code ignored;  // of a folder that is not there
    if (folder.starts_with("/vsi") || std::filesystem::exists(folder, ignored)) {
        check_output_place(plan.water, overwrite);
    }
    return plan;
}

std::vector<std::string> write_hydro(const LeveledWater& leveled, const HydroPlan& plan, bool overwrite,
                                     const io::TinMetadata& metadata) {
    OutputFolder folder(plan.lines.folder);
    const std::unique_ptr<io::AtomicOutput> water = write_water(leveled, plan.water, overwrite, metadata);
    std::vector<std::string> report =
        write_repair(downstream_lines(leveled), leveled.lines, leveled.line_sources, plan.lines,
                     leveled.output_crs, overwrite);
    water->commit();
    folder.keep();
    const auto counted = [](std::size_t count, const std::string& one, const std::string& many) {
        return std::to_string(count) + " " + (count == 1 ? one : many);
    };
    const Water& made = leveled.water;
    report.push_back(plan.water + ": " + counted(made.report.reaches.size(), "reach", "reaches") + ", " +
                     counted(made.lines.size() - leveled.lines.lines.size(), "section", "sections") + ", " +
                     counted(made.report.lakes.size(), "lake", "lakes") + ", " +
                     counted(made.report.findings.size(), "finding", "findings"));
    return report;
}

}  // namespace tinwright::tools
