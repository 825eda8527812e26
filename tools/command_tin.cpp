#include "command_tin.hpp"

#include <array>
#include <chrono>
#include <utility>

#include "tinwright/geometry/threads.hpp"

#include "conflict_layer.hpp"
#include "console.hpp"
#include "job_report.hpp"
#include "option_values.hpp"
#include "sample_graph.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

using Clock = std::chrono::steady_clock;
using Geometry = io::WriteTinOptions::Geometry;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr auto kGeometries =
    std::to_array<std::pair<std::string_view, Geometry>>({{"polygon", Geometry::Polygon},
                                                          {"tin", Geometry::Tin},
                                                          {"edges", Geometry::Edges},
                                                          {"vertices", Geometry::Vertices}});

/// As a file's metadata name it: by code, or by WKT where there is none.
std::string recorded_crs(const io::Crs& crs) { return crs.code().empty() ? crs.wkt() : crs.code(); }

void move_graph(std::vector<io::GraphLine>& edges, const io::OutputPositions& positions) {
    std::vector<Point3> ends;
    for (const io::GraphLine& edge : edges) {
        ends.push_back(edge.from);
        ends.push_back(edge.to);
    }
    positions.apply_to(ends);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        edges[i].from = ends[2 * i];
        edges[i].to = ends[2 * i + 1];
    }
}

}  // namespace

void CommandTin::setup(const std::vector<std::string>& arguments) {
    const auto parser = make_parser(
        "tin", "Triangulates elevation samples and writes the TIN.", "SOURCE... -o FILE [options]",
        {"tinwright tin survey.csv -o survey.gpkg",
         "tinwright tin points.gpkg,layer=ground,z=elev -o tin.shp --crs EPSG:3875",
         "tinwright tin a.xyz b.xyz -o tin.gpkg --domain concave:50 --max-edge 80"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    output.add_to(*parser, "TIN file to write", "output driver (default: from the extension)");
    output.add_creation_options_to(*parser);
    add_repeatable(*parser, "--lco", layer_options, "KEY=VALUE", "layer creation option of the driver");
    add_value(*parser, "--layer-name,--nln", layer_name, "NAME", "layer to write (single-layer drivers)");
    add_value(*parser, "--geometry", geometry_text, "WHAT", "polygon (default)|tin|edges|vertices");
    parser->add_flag("--ids", keep_ids, "record line and cell numbers as feature ids");
    graph.add_to(*parser);
    lines.add_all_sources_to(*parser);
    triangulation.add_to(*parser, "convex");
    parser->get_option("--norm")->group("Options")->description("of lengths: l1|l2 (default)|linf|lp:P");
    parser->get_option("--flat-faces")->group("Options");
    lines.add_constraints_to(*parser);
    lines.add_fitting_to(*parser);
    crs.add_to(*parser);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    if (graph.graph_text.empty()) {
        finish_tin();
    } else {
        finish_graph();
    }
    output.finish(true);
    check_key_values("--lco", layer_options);
    talk.finish(output.is_stdout());
    refuse_same_file("--conflicts", lines.conflicts, "-o", output.path);
}

void CommandTin::finish_tin() {
    crs.finish();
    sources.finish(lines.has_breaklines());
    lines.finish(sources.open_options);
    geometry =
        geometry_text.empty() ? Geometry::Polygon : choice_value("--geometry", geometry_text, kGeometries);
    triangulation.finish(DomainRule::Kind::Convex);
}

void CommandTin::finish_graph() {
    std::string option = triangulation.option_for_faces();
    if (option.empty()) {
        option = lines.first_given();
    }
    if (option.empty() && !geometry_text.empty()) {
        option = "--geometry";
    }
    if (option.empty() && keep_ids) {
        option = "--ids";
    }
    if (!option.empty()) {
        throw UsageError("--graph writes lines between samples, and no TIN: " + option + " does not apply");
    }
    crs.finish();
    sources.finish();
    graph.finish(triangulation.norm_text);
    triangulation.finish_samples();
}

io::WriteTinOptions CommandTin::write_options() const {
    io::WriteTinOptions options;
    options.driver = output.driver;
    options.layer_name = layer_name;
    options.geometry = geometry;
    options.creation_options = output.creation_options;
    options.layer_options = layer_options;
    options.overwrite = output.overwrite;
    options.metadata = {{"TINWRIGHT_VERSION", TINWRIGHT_VERSION},
                        {"TINWRIGHT_COMMAND", "tin"},
                        {"TINWRIGHT_OPTIONS", triangulation.canonical() + lines.canonical() +
                                                  (crs.canonical().empty() ? "" : " " + crs.canonical())}};
    return options;
}

io::WriteGraphOptions CommandTin::write_graph_options() const {
    io::WriteGraphOptions options;
    options.driver = output.driver;
    if (!layer_name.empty()) {
        options.layer_name = layer_name;
    }
    options.creation_options = output.creation_options;
    options.layer_options = layer_options;
    options.overwrite = output.overwrite;
    options.metadata = {{"TINWRIGHT_VERSION", TINWRIGHT_VERSION},
                        {"TINWRIGHT_COMMAND", "tin"},
                        {"TINWRIGHT_OPTIONS", graph.canonical() + " " + triangulation.canonical_samples() +
                                                  (crs.canonical().empty() ? "" : " " + crs.canonical())}};
    return options;
}

Outcome CommandTin::run() {
    Console console("tin", talk);
    return graph.kind ? run_graph(console) : run_tin(console);
}

Outcome CommandTin::run_graph(Console& console) {
    refuse_to_overwrite_sources(output.path, sources.sources);
    io::WriteGraphOptions options = write_graph_options();
    check_output_place(output.path, output.overwrite);
    io::check_graph_target(output.path, options);

    const SurfaceRequest request{
        .sources = sources, .crs = crs, .triangulation = triangulation, .progress_end = 0.5};
    const Surface surface = triangulate_locations(request, console);
    auto start = Clock::now();
    std::vector<io::GraphLine> edges;
    run_with_threads(triangulation.threads, [&] {
        edges = make_sample_graph(surface.tin, graph, surface.ground, console.progress().stage(0.5, 0.7));
    });
    JobReport report;
    report.graph = summarize(edges, graph);
    const bool is_geodesic = surface.ground.is_geodesic() && graph.norm.is_euclidean();
    report.graph->unit = is_geodesic                  ? surface.ground.unit
                         : surface.crs.unit().empty() ? kUnknownLengthUnit
                                                      : surface.crs.unit();
    report.graph->seconds = seconds_since(start);
    options.progress = console.progress().stage(0.7, 1);
    start = Clock::now();
    move_graph(edges, surface.output_positions());
    const io::WrittenGraph written = io::write_graph(edges, surface.output_crs, output.path, options);
    report.write_seconds = seconds_since(start);
    console.progress().finish();
    for (const std::string& warning : written.warnings) {
        console.warn(warning);
    }

    report.command = "tin";
    report.duplicate_policy = triangulation.policy_name();
    report.outputs = {output.path};
    report.output_driver = written.driver;
    console.say(report_text(report, surface, {talk.verbose, talk.verbose}));
    if (talk.json) {
        print_result(make_json(report, surface).text());
    }
    return Outcome::Done;
}

Outcome CommandTin::run_tin(Console& console) {
    std::vector<io::Source> read = lines.plain_sources();
    read.insert(read.end(), sources.sources.begin(), sources.sources.end());
    refuse_to_overwrite_sources(output.path, read);
    refuse_to_overwrite_sources(lines.conflicts, read);
    io::WriteTinOptions options = write_options();
    check_output_place(output.path, output.overwrite);
    io::check_tin_target(output.path, options);
    if (!lines.conflicts.empty()) {
        check_output_place(lines.conflicts, output.overwrite);
        check_conflict_target(lines.conflicts);
    }

    const SurfaceRequest request{.sources = sources,
                                 .crs = crs,
                                 .triangulation = triangulation,
                                 .lines = &lines,
                                 .overwrite_conflicts = output.overwrite,
                                 .keep_origins = true,
                                 .keep_ids = keep_ids,
                                 .progress_end = 0.7};
    Surface surface = triangulate_sources(request, console);
    const io::TinMetadata units = unit_metadata(surface);
    options.metadata.insert(options.metadata.end(), units.begin(), units.end());
    const io::TinMetadata criterion = criterion_metadata(surface.criterion);
    options.metadata.insert(options.metadata.end(), criterion.begin(), criterion.end());
    const io::TinMetadata of_lines = lines_metadata(surface.lines);
    options.metadata.insert(options.metadata.end(), of_lines.begin(), of_lines.end());
    if (surface.water) {
        const io::TinMetadata of_water = water_metadata(*surface.water);
        options.metadata.insert(options.metadata.end(), of_water.begin(), of_water.end());
    }
    if (surface.flat_faces) {
        const io::TinMetadata flat = flat_faces_metadata(*surface.flat_faces);
        options.metadata.insert(options.metadata.end(), flat.begin(), flat.end());
    }
    options.is_water_face = surface.is_water_face;
    options.ground = surface.ground;
    if (!surface.is_written_in_plane()) {
        run_with_threads(triangulation.threads, [&] {
            options.positions = io::written_vertices(surface.tin, surface.output_positions());
        });
        options.metadata.emplace_back("TINWRIGHT_WORKING_CRS", recorded_crs(surface.crs));
    }
    options.z_factor = surface.z_factor;
    options.origins = std::move(surface.origins.vertices);
    options.lines = std::move(surface.origins.lines);
    options.progress = console.progress().stage(0.7, 1);
    const auto start = Clock::now();
    warn_of_pole(surface, console);
    const io::WrittenTin written = io::write_tin(surface.tin, surface.output_crs, output.path, options);
    if (surface.conflicts) {
        surface.conflicts->commit();
    }
    console.progress().finish();
    for (const std::string& warning : written.warnings) {
        console.warn(warning);
    }

    JobReport report;
    report.command = "tin";
    report.domain = triangulation.domain_name();
    report.duplicate_policy = triangulation.policy_name();
    report.outputs = {output.path};
    if (surface.conflicts) {
        report.outputs.push_back(lines.conflicts);
    }
    report.output_driver = written.driver;
    report.write_seconds = seconds_since(start);
    console.say(report_text(report, surface, {talk.verbose, talk.verbose}));
    if (talk.json) {
        print_result(make_json(report, surface).text());
    }
    return Outcome::Done;
}

}  // namespace tinwright::tools
