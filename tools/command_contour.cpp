#include "command_contour.hpp"

#include <chrono>
#include <memory>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/surface/contouring.hpp"

#include "conflict_layer.hpp"
#include "console.hpp"
#include "job_report.hpp"
#include "option_values.hpp"
#include "output_metadata.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

void CommandContour::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("contour", "Draws contours of elevation samples, or of an existing TIN.",
                    "SOURCE... -o FILE --interval D [options]",
                    {"tinwright contour survey.csv -o contours.gpkg --interval 0.5",
                     "tinwright contour tin.gpkg -o contours.shp --interval 2 --index 5",
                     "tinwright contour tin.gpkg -o bands.gpkg --levels 80,85,90 --polygons"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    output.add_to(*parser, "vector file to write", "output driver (default: from the extension)");
    output.add_creation_options_to(*parser);
    add_repeatable(*parser, "--lco", layer_options, "KEY=VALUE", "layer creation option of the driver");
    add_value(*parser, "--layer-name,--nln", layer_name, "NAME", "layer to write (contours, bands)");
    contours.add_to(*parser);
    interpolation.add_to(*parser);
    lines.add_all_sources_to(*parser);
    triangulation.add_to(*parser, "trimmed");
    lines.add_constraints_to(*parser);
    lines.add_fitting_to(*parser);
    crs.add_to(*parser, false);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    crs.finish();
    sources.finish(lines.has_breaklines());
    lines.finish(sources.open_options);
    output.finish(true);
    check_key_values("--lco", layer_options);
    interpolation.finish();
    if (interpolation.options.method == InterpolationMethod::Nearest) {
        throw UsageError("--method nearest has steps and no slopes: contours need another method");
    }
    contours.finish(interpolation.is_linear());
    triangulation.finish(DomainRule::Kind::Trimmed);
    talk.finish(output.is_stdout());
    refuse_same_file("--conflicts", lines.conflicts, "-o", output.path);
}

io::WriteContoursOptions CommandContour::write_options() const {
    io::WriteContoursOptions options;
    options.driver = output.driver;
    options.layer_name = !layer_name.empty() ? layer_name : contours.is_bands ? "bands" : "contours";
    options.creation_options = output.creation_options;
    options.layer_options = layer_options;
    options.overwrite = output.overwrite;
    options.has_index = contours.request.index_every > 0;
    return options;
}

Contours CommandContour::make(const Surface& surface, Console& console) const {
    ContourOptions options;
    options.request = contours.request;
    options.is_bands = contours.is_bands;
    options.tolerance = contours.tolerance;
    options.threads = triangulation.threads;
    options.progress = console.progress().stage(0.6, 0.8);
    std::unique_ptr<Interpolator> reading;
    if (!interpolation.is_linear()) {
        reading = interpolation.make(surface, triangulation.threads);
        options.surface = reading.get();
        options.is_surface_bounded = is_bounded(interpolation.options.method);
    }
    return contour(surface.tin, options);
}

io::WrittenContours CommandContour::write(const Contours& made, const Surface& surface,
                                          const io::WriteContoursOptions& options) const {
    const io::OutputPositions positions = surface.output_positions();
    const io::Crs& crs_written = surface.output_crs;
    if (contours.is_bands) {
        return positions.is_identity() ? io::write_bands(made.bands, crs_written, output.path, options)
                                       : io::write_bands(io::written_bands(made.bands, positions),
                                                         crs_written, output.path, options);
    }
    return positions.is_identity()
               ? io::write_contours(made.levels, made.lines, crs_written, output.path, options)
               : io::write_contours(made.levels, io::written_lines(made.lines, positions), crs_written,
                                    output.path, options);
}

void CommandContour::warn_about(const Contours& made, Console& console) const {
    if (made.levels.empty()) {
        console.warn("none of the levels lies between the lowest and the highest elevation, " +
                     decimal_text(made.z_min) + " and " + decimal_text(made.z_max) +
                     (contours.is_bands ? ": all is one band" : ": there are no contours"));
    }
    if (made.tracing && made.tracing->unresolved > 0) {
        console.warn("at " + std::to_string(made.tracing->unresolved) +
                     " places the surface has steps: there lines are off by up to " +
                     decimal_text(made.tracing->largest_error));
    }
}

Outcome CommandContour::run() {
    Console console("contour", talk);
    std::vector<io::Source> read = lines.plain_sources();
    read.insert(read.end(), sources.sources.begin(), sources.sources.end());
    refuse_to_overwrite_sources(output.path, read);
    refuse_to_overwrite_sources(lines.conflicts, read);
    io::WriteContoursOptions options = write_options();
    check_output_place(output.path, output.overwrite);
    io::check_contour_target(output.path, options, contours.is_bands);
    if (!lines.conflicts.empty()) {
        check_output_place(lines.conflicts, output.overwrite);
        check_conflict_target(lines.conflicts);
    }

    const SurfaceRequest request{.sources = sources,
                                 .crs = crs,
                                 .triangulation = triangulation,
                                 .lines = &lines,
                                 .overwrite_conflicts = output.overwrite,
                                 .progress_end = 0.6};
    const bool is_tin = is_existing_tin(request);
    const Surface surface =
        is_tin ? read_existing_tin(request, console) : triangulate_sources(request, console);
    auto start = Clock::now();
    const Contours made = make(surface, console);
    JobReport report;
    report.contours = summarize(made, surface.ground, interpolation.method_text);
    report.contours->seconds = seconds_since(start);

    warn_of_pole(surface, console);
    options.metadata = output_metadata("contour", surface, triangulation, lines,
                                       interpolation.canonical() + " " + contours.canonical());
    options.progress = console.progress().stage(0.8, 1);
    start = Clock::now();
    const io::WrittenContours written = write(made, surface, options);
    if (surface.conflicts) {
        surface.conflicts->commit();
    }
    report.write_seconds = seconds_since(start);
    console.progress().finish();
    for (const std::string& warning : written.warnings) {
        console.warn(warning);
    }
    warn_about(made, console);

    report.command = "contour";
    report.domain = is_tin ? "as in the TIN" : triangulation.domain_name();
    report.duplicate_policy = triangulation.policy_name();
    report.outputs = {output.path};
    if (surface.conflicts) {
        report.outputs.push_back(lines.conflicts);
    }
    report.output_driver = written.driver;
    console.say(report_text(report, surface, {talk.verbose, talk.verbose}));
    if (talk.json) {
        print_result(make_json(report, surface).text());
    }
    return Outcome::Done;
}

}  // namespace tinwright::tools
