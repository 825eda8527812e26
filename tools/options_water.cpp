#include "options_water.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kFlows = std::to_array<std::pair<std::string_view, FlowRule>>(
    {{"digitized", FlowRule::Digitized}, {"auto", FlowRule::Auto}});

constexpr auto kFits = std::to_array<std::pair<std::string_view, RiverFit>>(
    {{"isotonic", RiverFit::Isotonic}, {"min", RiverFit::Min}});

std::optional<double> positive(std::string_view option, const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(positive_value(option, text));
}

std::optional<double> not_negative(std::string_view option, const std::string& text) {
    if (text.empty()) {
        return std::nullopt;
    }
    const double value = number_value(option, text);
    if (value < 0) {
        throw UsageError(std::string(option) + " needs a number from 0 up, not " + io::quoted(text));
    }
    return value;
}

LevelRule level_rule(const std::string& text) {
    constexpr std::string_view kPercentile = "percentile:";
    if (text == "min") {
        return {LevelRule::Kind::Min, 0};
    }
    if (text == "mean") {
        return {LevelRule::Kind::Mean, 0};
    }
    if (text.starts_with(kPercentile)) {
        const std::optional<double> percent = find_number(std::string_view(text).substr(kPercentile.size()));
        if (percent && *percent >= 0 && *percent <= 100) {
            return {LevelRule::Kind::Percentile, *percent};
        }
        throw UsageError("--lake-level needs a percentile from 0 to 100, as percentile:5, not " +
                         io::quoted(text));
    }
    throw UsageError("--lake-level takes min, percentile:P or mean, not " + io::quoted(text));
}

}  // namespace

std::string level_rule_name(const LevelRule& rule) {
    switch (rule.kind) {
        case LevelRule::Kind::Min:
            return "min";
        case LevelRule::Kind::Mean:
            return "mean";
        case LevelRule::Kind::Percentile:
            break;
    }
    return "percentile:" + decimal_text(rule.percent);
}

void WaterChoice::add_sources_to(CLI::App& parser) {
    add_repeatable(parser, "--lakes", lake_texts, "SOURCE", "polygons of standing water, level each");
    add_repeatable(parser, "--rivers", river_texts, "SOURCE", "lines that water runs down along");
    add_repeatable(parser, "--banks", bank_texts, "SOURCE", "polygons of rivers, level from bank to bank");
}

void WaterChoice::add_levels_to(CLI::App& parser, bool are_shown) {
    const std::string group = are_shown ? "Options" : "";
    const auto add = [&](const char* name, std::string& text, const char* placeholder, const char* help) {
        add_value(parser, name, text, placeholder, help)->group(group);
    };
    add("--lake-level", lake_level_text, "RULE", "min|percentile:P|mean (default: percentile:5)");
    add("--shore-width", shore_width_text, "D", "samples this close to water measure it");
    add("--shore-clearance", shore_clearance_text, "DZ", "lift shores under water this far above it");
    add("--flow", flow_text, "RULE", "digitized (default)|auto");
    add("--river-fit", river_fit_text, "FIT", "isotonic (default)|min");
    add("--river-width", river_width_text, "D", "samples this close to a river measure it");
    add("--max-drop", max_drop_text, "DZ", "most that a river is dug in");
    add("--max-lift", max_lift_text, "DZ", "most that a river is lifted");
    add("--station-spacing", station_spacing_text, "D", "distance of stations along rivers");
    add("--burn", burn_text, "DEPTH", "dig rivers in: culverts and drains");
    add("--level-tolerance", tolerance_text, "DZ", "levels that differ less agree (0.001)");
}

std::vector<std::pair<const char*, const std::string*>> WaterChoice::level_texts() const {
    return {{"--lake-level", &lake_level_text},
            {"--shore-width", &shore_width_text},
            {"--shore-clearance", &shore_clearance_text},
            {"--flow", &flow_text},
            {"--river-fit", &river_fit_text},
            {"--river-width", &river_width_text},
            {"--max-drop", &max_drop_text},
            {"--max-lift", &max_lift_text},
            {"--station-spacing", &station_spacing_text},
            {"--burn", &burn_text},
            {"--level-tolerance", &tolerance_text}};
}

void WaterChoice::finish_lakes() {
    if (!lake_level_text.empty()) {
        options.lake_level = level_rule(lake_level_text);
    }
    options.shore_width = positive("--shore-width", shore_width_text);
    options.shore_clearance = not_negative("--shore-clearance", shore_clearance_text);
    options.tolerance = not_negative("--level-tolerance", tolerance_text).value_or(WaterOptions{}.tolerance);
}

void WaterChoice::finish_rivers() {
    if (!flow_text.empty()) {
        options.flow = choice_value("--flow", flow_text, kFlows);
    }
    options.burn = positive("--burn", burn_text);
    // What is burnt in is dug and never filled, unless that is asked for.
    options.river_fit = options.burn ? RiverFit::Min : RiverFit::Isotonic;
    if (!river_fit_text.empty()) {
        options.river_fit = choice_value("--river-fit", river_fit_text, kFits);
    }
    options.river_width = not_negative("--river-width", river_width_text);
    options.max_drop = not_negative("--max-drop", max_drop_text);
    options.max_lift = not_negative("--max-lift", max_lift_text);
    options.station_spacing = positive("--station-spacing", station_spacing_text);
}

void add_line_sources(const std::vector<std::string>& texts, LineRole role,
                      const std::vector<std::string>& open_options, std::vector<io::LineSource>& sources) {
    for (const std::string& text : texts) {
        io::Source source = io::parse_source(text);
        source.open_options.insert(source.open_options.begin(), open_options.begin(), open_options.end());
        sources.push_back({std::move(source), role});
    }
}

void WaterChoice::finish(const std::vector<std::string>& open_options) {
    sources.clear();
    const auto add = [&](const std::vector<std::string>& texts, LineRole role) {
        add_line_sources(texts, role, open_options, sources);
    };
    add(lake_texts, LineRole::Lake);
    add(bank_texts, LineRole::Bank);
    add(river_texts, LineRole::River);
    options = {};
    finish_lakes();
    finish_rivers();
}

WaterChoice::Roles WaterChoice::roles() const {
    return {!lake_texts.empty(), !river_texts.empty(), !bank_texts.empty()};
}

void WaterChoice::check_roles(const Roles& roles) const {
    if (!burn_text.empty() && (roles.lakes || roles.banks)) {
        throw UsageError(std::string("--burn digs rivers in and ") + (roles.lakes ? "--lakes" : "--banks") +
                         " makes water flat, and the two are kept apart: run one job with the lakes and "
                         "banks, another with --burn");
    }
    const auto require = [](const std::string& text, bool has_water, const char* option, const char* needed) {
        if (!text.empty() && !has_water) {
            throw UsageError(std::string(option) + " is for " + needed + " too");
        }
    };
    require(burn_text, roles.rivers, "--burn", "rivers: give --rivers");
    require(river_width_text, roles.rivers, "--river-width", "rivers: give --rivers");
    require(lake_level_text, roles.lakes, "--lake-level", "lakes: give --lakes");
    require(shore_clearance_text, roles.lakes, "--shore-clearance", "lakes: give --lakes");
    const bool has_flow = roles.rivers || roles.banks;
    const char* const flowing = "running water: give --rivers or --banks";
    require(flow_text, has_flow, "--flow", flowing);
    require(river_fit_text, has_flow, "--river-fit", flowing);
    require(max_drop_text, has_flow, "--max-drop", flowing);
    require(max_lift_text, has_flow, "--max-lift", flowing);
    require(station_spacing_text, has_flow, "--station-spacing", flowing);
    const bool has_any = has_flow || roles.lakes;
    require(shore_width_text, has_any, "--shore-width", "water: give --lakes, --rivers or --banks");
    require(tolerance_text, has_any, "--level-tolerance", "water: give --lakes, --rivers or --banks");
}

std::string WaterChoice::first_given() const {
    const Roles given = roles();
    if (given.lakes || given.rivers || given.banks) {
        return given.lakes ? "--lakes" : given.rivers ? "--rivers" : "--banks";
    }
    for (const auto& [name, text] : level_texts()) {
        if (!text->empty()) {
            return name;
        }
    }
    return {};
}

std::string WaterChoice::canonical(const Roles& given) const {
    std::string text;
    const auto add = [&text](const char* option, const std::optional<double>& value) {
        text += value ? " " + std::string(option) + " " + decimal_text(*value) : std::string();
    };
    if (given.lakes) {
        text += " --lake-level " + level_rule_name(options.lake_level);
        add("--shore-clearance", options.shore_clearance);
    }
    add("--shore-width", options.shore_width);
    if (given.rivers || given.banks) {
        text += " --flow " + choice_name(options.flow, kFlows);
        text += " --river-fit " + choice_name(options.river_fit, kFits);
        add("--river-width", options.river_width);
        add("--max-drop", options.max_drop);
        add("--max-lift", options.max_lift);
        add("--station-spacing", options.station_spacing);
        add("--burn", options.burn);
    }
    if (!text.empty() && options.tolerance != WaterOptions{}.tolerance) {
        add("--level-tolerance", options.tolerance);
    }
    return text;
}

}  // namespace tinwright::tools
