#include "command_sample.hpp"

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/surface/grid.hpp"

#include "conflict_layer.hpp"
#include "console.hpp"
#include "job_report.hpp"
#include "output_metadata.hpp"
#include "surface_sampler.hpp"

namespace tinwright::tools {

namespace {

/// The options that say how the surface is read.
std::string reading_options(const CommandSample& command) {
    const std::string of_places = command.sample.canonical();
    return command.interpolation.canonical() + (of_places.empty() ? "" : " " + of_places);
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// For people: how many places there were, and how lines were divided.
std::string counts_text(const SampledCounts& counts) {
    std::string text;
    if (counts.are_lines) {
        text = counted(counts.lines, "line") + " in " + counted(counts.parts, "part") + ", ";
    }
    text += counted(counts.points, "point") + ", " + std::to_string(counts.outside) + " outside";
    if (!counts.are_lines) {
        return text;
    }
    text += "; points where " + std::string(counts.has_cuts ? "edges are crossed" : "the terrain ends");
    return counts.step > 0 ? text + " and every " + decimal_text(counts.step) : text;
}

JsonValue counts_json(const SampledCounts& counts, const std::string& method) {
    JsonValue json = JsonValue::object();
    json.set("points", counts.points).set("outside", counts.outside);
    if (counts.are_lines) {
        json.set("lines", counts.lines).set("parts", counts.parts).set("cuts", counts.has_cuts);
        if (counts.step > 0) {
            json.set("step", counts.step);
        }
    }
    json.set("method", method);
    return json;
}

}  // namespace

void CommandSample::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("sample", "Reads a surface at points or along lines: elevation, slope, aspect, face.",
                    "SOURCE... --at POINTS|LINES|X,Y [-o FILE] [options]",
                    {"tinwright sample survey.csv --at checks.gpkg -o read.csv",
                     "tinwright sample tin.gpkg --at 3500120,5402310",
                     "tinwright sample tin.gpkg --at axis.gpkg --plot axis.svg"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    sample.add_to(*parser);
    interpolation.add_to(*parser);
    output.add_to(*parser, "table to write (default: CSV on stdout)",
                  "output driver (default: from the extension)");
    lines.add_all_sources_to(*parser);
    triangulation.add_to(*parser, "trimmed");
    lines.add_constraints_to(*parser);
    lines.add_fitting_to(*parser);
    crs.add_to(*parser);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, rewrite_coordinates(arguments));

    crs.finish();
    sources.finish(lines.has_breaklines());
    lines.finish(sources.open_options);
    sample.finish(sources.open_options);
    if (sample.at.empty()) {
        throw UsageError(
            "where to read the surface is not said: --at FILE names points or lines, --at X,Y a position");
    }
    interpolation.finish();
    output.finish(false);
    refuse_same_file("--plot", sample.plot, "-o", output.path);
    check_table_target(output);
    triangulation.finish(DomainRule::Kind::Trimmed);
    talk.finish(is_to_stdout(output));
    refuse_same_file("--conflicts", lines.conflicts, "-o", output.path);
    refuse_same_file("--conflicts", lines.conflicts, "--plot", sample.plot);
}

void CommandSample::check_files() const {
    std::vector<io::Source> read = lines.plain_sources();
    read.insert(read.end(), sources.sources.begin(), sources.sources.end());
    const std::vector<io::Source> places = sample.sources();
    read.insert(read.end(), places.begin(), places.end());
    const std::string table = is_to_stdout(output) ? "" : output.path;
    for (const std::string& file : {table, sample.plot, lines.conflicts}) {
        refuse_to_overwrite_sources(file, read);
        check_output_place(file, output.overwrite);
    }
    if (!lines.conflicts.empty()) {
        check_conflict_target(lines.conflicts);
    }
}

Queries CommandSample::read_places(bool are_lines, const Surface& surface, Console& console) const {
    QueryOptions options;
    options.crs = surface.crs;
    options.place_crs = surface.place_crs(crs);
    options.source_crs = crs.source_crs();
    options.skip_bad = sources.skip_bad;
    options.threads = triangulation.threads;
    options.progress = console.progress().stage(0.6, 0.7);
    Queries queries = read_queries(sample.at, are_lines, options);
    for (const std::string& warning : queries.warnings) {
        console.warn(warning);
    }
    return queries;
}

SampledCounts CommandSample::write_samples(const Queries& queries, const Surface& surface, Console& console,
                                           std::string& driver) const {
    SampledCounts counts;
    counts.are_lines = !queries.lines.empty();
    // Planes change at edges only; other surfaces bend between them, so there points come at even distances.
    ProfileOptions profile{.has_cuts = interpolation.is_linear() || sample.step == 0,
                           .step = sample.step,
                           .ground = surface.ground};
    if (counts.are_lines && !interpolation.is_linear() && sample.step == 0) {
        profile.step = choose_grid(surface.tin, {}).cell_width * surface.ground.plane_unit;
    }
    counts.step = profile.step;
    counts.has_cuts = profile.has_cuts;
    const auto table =
        make_sample_table(output, counts.are_lines ? line_columns() : point_columns(), surface.output_crs,
                          output_metadata("sample", surface, triangulation, lines, reading_options(*this)));
    driver = table->driver();
    std::vector<ProfileCurve> curves;
    run_with_threads(triangulation.threads, [&] {
        const SurfaceSampler sampler(surface, interpolation, sample.slope_unit, surface.place_crs(crs),
                                     triangulation.threads, console.progress().stage(0.7, 1));
        if (counts.are_lines) {
            sampler.sample_lines(queries, profile, *table, counts, sample.plot.empty() ? nullptr : &curves);
        } else {
            sampler.sample_points(queries, *table, counts);
        }
    });
    console.progress().finish();
    if (!sample.plot.empty()) {
        write_drawing(draw_profiles(curves, {surface.length_unit(), surface.z_unit}), sample.plot,
                      output.overwrite);
    }
    table->finish();
    return counts;
}

void CommandSample::report(const SampledCounts& counts, const Surface& surface, bool is_tin,
                           const std::string& driver, Console& console) const {
    JobReport job;
    job.command = "sample";
    job.tells_slopes = true;
    job.domain = is_tin ? "as in the TIN" : triangulation.domain_name();
    job.duplicate_policy = triangulation.policy_name();
    job.details = {{"sampled", counts_text(counts)}};
    job.output_driver = driver;
    if (!is_to_stdout(output)) {
        job.outputs.push_back(output.path);
    }
    for (const std::string& file : {sample.plot, surface.conflicts ? lines.conflicts : std::string()}) {
        if (!file.empty()) {
            job.outputs.push_back(file);
        }
    }
    console.say(report_text(job, surface, {talk.verbose, talk.verbose}));
    if (talk.json) {
        print_result(
            make_json(job, surface).set("sampled", counts_json(counts, interpolation.method_text)).text());
    }
}

Outcome CommandSample::run() {
    Console console("sample", talk);
    check_files();
    const bool lines_wanted = are_lines(sample.at);
    if (!lines_wanted && !sample.plot.empty()) {
        throw UsageError("--plot draws profiles of lines, and --at names points: leave it out");
    }
    if (!lines_wanted && sample.step > 0) {
        throw UsageError("--step divides lines, and --at names points: leave it out");
    }
    const SurfaceRequest request{.sources = sources,
                                 .crs = crs,
                                 .triangulation = triangulation,
                                 .lines = &lines,
                                 .overwrite_conflicts = output.overwrite,
                                 .keep_origins = true,
                                 .progress_end = 0.6};
    const bool is_tin = is_existing_tin(request);
    const Surface surface =
        is_tin ? read_existing_tin(request, console) : triangulate_sources(request, console);
    if (surface.crs.unit() != "metre") {
        warn_of_slopes(surface, console);  // feet and metres are easily mixed
    }
    const Queries queries = read_places(lines_wanted, surface, console);
    std::string driver;
    const SampledCounts counts = write_samples(queries, surface, console, driver);
    if (surface.conflicts) {
        surface.conflicts->commit();
    }
    if (counts.outside == counts.points) {
        console.warn("nothing of what --at names is on the surface: all points are outside");
    }
    report(counts, surface, is_tin, driver, console);
    return Outcome::Done;
}

}  // namespace tinwright::tools
