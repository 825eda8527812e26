#include "command_hydro.hpp"

#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_tin.hpp"

#include "console.hpp"
#include "hydro_repair.hpp"
#include "hydro_report.hpp"
#include "leveled_water.hpp"
#include "option_values.hpp"
#include "options_lines.hpp"
#include "point_layer.hpp"
#include "water_layers.hpp"
#include "written_places.hpp"

namespace tinwright::tools {

namespace {

bool is_help(const std::string& argument) { return argument == "--help" || argument == "-h"; }

io::TinMetadata metadata_of(const std::string& command, const WaterChoice& water,
                            const LeveledWater& leveled) {
    WaterChoice::Roles roles;
    for (const io::LineSlice& slice : leveled.lines.slices) {
        roles.lakes = roles.lakes || slice.role == LineRole::Lake;
        roles.rivers = roles.rivers || slice.role == LineRole::River;
        roles.banks = roles.banks || slice.role == LineRole::Bank;
    }
    return {{"TINWRIGHT_VERSION", TINWRIGHT_VERSION},
            {"TINWRIGHT_COMMAND", command},
            {"TINWRIGHT_OPTIONS", water.canonical(roles).substr(1)}};
}

}  // namespace

std::string CommandHydro::name() const { return action == Action::Check ? "hydro check" : "hydro repair"; }

std::unique_ptr<CLI::App> CommandHydro::make_parser_of(std::optional<Action> wanted) {
    const bool is_check = wanted != Action::Repair;
    const bool is_repair = wanted != Action::Check;
    std::unique_ptr<CLI::App> parser;
    if (!wanted) {
        parser = make_parser("hydro", "Checks lakes, rivers and banks, or writes them put right.",
                             "check|repair [SOURCE...] [options]",
                             {"tinwright hydro check dtm.gpkg --rivers streams.gpkg --lakes lakes.gpkg",
                              "tinwright hydro check --rivers streams.gpkg --raster dem.tif",
                              "tinwright hydro repair dtm.gpkg --rivers streams.gpkg -o clean"});
    } else if (is_check) {
        parser = make_parser("hydro check", "Lists what is wrong with lakes, rivers and banks.",
                             "[SOURCE...] [-o FILE] [options]",
                             {"tinwright hydro check dtm.gpkg --rivers streams.gpkg -o found.gpkg",
                              "tinwright hydro check --rivers streams.gpkg --raster dem.tif"});
    } else {
        parser = make_parser("hydro repair", "Writes lakes, rivers and banks put right.",
                             "[SOURCE...] -o FOLDER [options]",
                             {"tinwright hydro repair dtm.gpkg --rivers streams.gpkg -o clean",
                              "tinwright hydro repair dtm.tif --rivers net.gpkg --flow auto -o clean"});
    }
    parser->get_option("--help")->description("this screen; \"tinwright help hydro\" tells all");
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    water.add_sources_to(*parser);
    water.add_levels_to(*parser, true);
    add_value(*parser, "--crossing-z", crossing_z_text, "POLICY",
              "lakes that meet: error (default)|mean|...");
    if (is_check) {
        add_value(*parser, "--raster", raster_text, "RASTER", "check its cells along water too");
        add_value(*parser, "--raster-tolerance", raster_tolerance_text, "DZ",
                  "cells that differ less are equal (0.001)");
    }
    output.add_to(*parser,
                  !wanted    ? "file for the findings, or folder for the lines"
                  : is_check ? "write the findings as points"
                             : "folder to write the lines into",
                  "output driver (default: from the extension)");
    if (is_repair && wanted) {
        parser->remove_option(parser->get_option("--of"));
    }
    crs.add_to(*parser);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    return parser;
}

void CommandHydro::setup(const std::vector<std::string>& arguments) {
    if (!arguments.empty() && is_help(arguments.front())) {
        throw HelpRequest{make_parser_of(std::nullopt)->help()};
    }
    const std::string first = arguments.empty() ? std::string() : arguments.front();
    if (first != "check" && first != "repair") {
        throw UsageError(R"(hydro needs "check" or "repair" first)" +
                         (first.empty() ? std::string() : ", not " + io::quoted(first)) +
                         "; see \"tinwright hydro --help\"");
    }
    action = first == "check" ? Action::Check : Action::Repair;
    const auto parser = make_parser_of(action);
    parse_options(*parser, {arguments.begin() + 1, arguments.end()});

    crs.finish();
    sources.finish(true);
    water.finish(sources.open_options);
    if (sources.sources.empty() && water.sources.empty()) {
        throw UsageError("no water is given: name it with --lakes, --rivers or --banks");
    }
    if (sources.sources.empty()) {
        water.check_roles(water.roles());
    }
    if (!crossing_z_text.empty()) {
        meeting_levels = choice_value("--crossing-z", crossing_z_text, kCrossingPolicies);
    }
    triangulation.finish_samples();
    action == Action::Check ? finish_check() : finish_repair();
    talk.finish(output.is_stdout());
}

void CommandHydro::finish_check() {
    output.finish(false);
    if (!raster_text.empty()) {
        raster = io::parse_source(raster_text);
        raster->open_options.insert(raster->open_options.begin(), sources.open_options.begin(),
                                    sources.open_options.end());
    }
    if (raster_tolerance_text.empty()) {
        return;
    }
    if (!raster) {
        throw UsageError("--raster-tolerance is for --raster: name the raster too");
    }
    raster_tolerance = number_value("--raster-tolerance", raster_tolerance_text);
    if (raster_tolerance < 0) {
        throw UsageError("--raster-tolerance needs a number from 0 up, not " +
                         io::quoted(raster_tolerance_text));
    }
}

void CommandHydro::finish_repair() const {
    if (output.path.empty()) {
        throw UsageError("hydro repair needs a folder for the repaired lines: name it with -o FOLDER");
    }
    output.finish(true);
}

std::vector<io::Source> CommandHydro::all_sources() const {
    std::vector<io::Source> all = sources.sources;
    for (const io::LineSource& source : water.sources) {
        all.push_back(source.source);
    }
    if (raster) {
        all.push_back(*raster);
    }
    return all;
}

LevelRequest CommandHydro::sort_sources(Console& console) const {
    LevelRequest request;
    request.lines = water.sources;
    WaterChoice::Roles roles = water.roles();
    for (const io::Source& source : sources.sources) {
        if (io::is_tin(source)) {
            throw UsageError(io::quoted(source.path) +
                             " is a TIN: add ,as=samples to take its vertices as samples");
        }
        if (!io::has_lines(source)) {
            request.samples.push_back(source);
            continue;
        }
        const bool are_lakes = io::has_polygons(source);
        (are_lakes ? roles.lakes : roles.rivers) = true;
        request.lines.push_back({source, are_lakes ? LineRole::Lake : LineRole::River});
        console.say("tinwright " + name() + ": " + source.path +
                    (are_lakes ? ": polygons, taken as lakes\n" : ": lines, taken as rivers\n"));
    }
    if (request.lines.empty()) {
        throw UsageError(
            "no water is given: the sources are samples; name it with --lakes, --rivers or --banks");
    }
    water.check_roles(roles);
    request.crs = crs;
    request.skip_bad = sources.skip_bad;
    request.threads = triangulation.threads;
    request.options = water.options;
    request.options.meeting_levels = meeting_levels;
    return request;
}

void CommandHydro::check_target() const {
    if (!output.path.empty()) {
        refuse_to_overwrite_sources(output.path, all_sources());
        PointLayer::check_target(output.path, output.driver);
        check_output_place(output.path, output.overwrite);
    }
}

void CommandHydro::report(const LeveledWater& leveled, const std::string& list,
                          const std::vector<std::string>& outputs) const {
    if (talk.json) {
        print_result(hydro_json(leveled, name(), outputs).text());
    } else if (!output.is_stdout()) {
        print_result(list);
    }
}

void CommandHydro::say_plane(const LeveledWater& leveled, Console& console) const {
    if (const std::string plane = hydro_plane(leveled); !plane.empty()) {
        console.say("tinwright " + name() + ": " + plane + "\n");
    }
}

Outcome CommandHydro::run_check(Console& console) {
    check_target();
    LevelRequest request = sort_sources(console);
    request.options.keeps_faults = true;
    request.raster = raster;
    request.progress_end = raster ? 0.7 : 1;
    LeveledWater leveled = read_leveled_water(request, console);
    if (raster) {
        check_against_raster(leveled, *raster,
                             {.tolerance = raster_tolerance, .progress = console.progress().stage(0.7, 1)});
    }
    bring_to_output(leveled, crs);
    std::vector<std::string> outputs;
    if (!output.path.empty()) {
        write_findings(leveled, output.path, output.driver, output.overwrite,
                       metadata_of(name(), water, leveled))
            ->commit();
        outputs.push_back(output.path);
    }
    console.progress().finish();
    say_plane(leveled, console);
    console.say("tinwright hydro check: " + hydro_verdict(leveled) + "\n");
    if (leveled.raster) {
        console.say("tinwright hydro check: " + raster_verdict(*leveled.raster) + "\n");
    }
    report(leveled, hydro_lines(leveled, false), outputs);
    return count_hydro_faults(leveled, false) == 0 ? Outcome::Done : Outcome::ViolationsFound;
}

Outcome CommandHydro::run_repair(Console& console) {
    LeveledWater leveled = read_leveled_water(sort_sources(console), console);
    bring_to_output(leveled, crs);
    const HydroPlan plan = plan_hydro(leveled, output.path, output.overwrite, all_sources());
    const std::vector<std::string> written =
        write_hydro(leveled, plan, output.overwrite, metadata_of(name(), water, leveled));
    std::vector<std::string> outputs;
    for (const RepairPlan::File& file : plan.lines.files) {
        outputs.push_back(file.target);
    }
    outputs.push_back(plan.water);
    console.progress().finish();
    for (const std::string& line : written) {
        console.say("tinwright hydro repair: wrote " + line + "\n");
    }
    say_plane(leveled, console);
    console.say("tinwright hydro repair: " + hydro_verdict(leveled) + "\n");
    console.say("tinwright hydro repair: " + hydro_repair_verdict(leveled) + "\n");
    report(leveled, hydro_lines(leveled, true), outputs);
    return Outcome::Done;
}

Outcome CommandHydro::run() {
    Console console(name(), talk);
    return action == Action::Check ? run_check(console) : run_repair(console);
}

}  // namespace tinwright::tools
