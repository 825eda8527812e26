#include "command_grid.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string_view>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/cell_places.hpp"
#include "tinwright/water/river_cells.hpp"

#include "conflict_layer.hpp"
#include "console.hpp"
#include "job_report.hpp"
#include "option_values.hpp"
#include "output_metadata.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kRiverCells =
    std::to_array<std::pair<std::string_view, bool>>({{"line", true}, {"surface", false}});

bool has_rivers(const Surface& surface) {
    return std::find(surface.is_river_line.begin(), surface.is_river_line.end(), true) !=
           surface.is_river_line.end();
}

/// Metres that a cell in the raster's middle has along parallel and meridian; nothing where it is not degrees
/// that the raster is in.
std::optional<Point2> ground_size(const Surface& surface, const GridGeometry& grid) {
    return surface.output_crs.is_geographic()
               ? std::optional(io::cell_size_on_ground(grid, surface.output_crs))
               : std::nullopt;
}

}  // namespace

void CommandGrid::setup(const std::vector<std::string>& arguments) {
    const auto parser = make_parser(
        "grid", "Turns elevation samples, or an existing TIN, into a raster.", "SOURCE... -o FILE [options]",
        {"tinwright grid survey.csv -o dem.tif",
         "tinwright grid points.gpkg -o dem.tif --resolution 0.5 --co COMPRESS=ZSTD",
         "tinwright grid tin.gpkg -o dem.tif --like other.tif --preview dem.png",
         "tinwright grid tin.gpkg -o slope.tif --method smooth --product slope"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    output.add_to(*parser, "raster to write", "output driver (default: from the extension)");
    output.add_creation_options_to(*parser);
    raster.add_geometry_to(*parser);
    interpolation.add_to(*parser);
    products.add_to(*parser);
    raster.add_values_to(*parser);
    lines.add_all_sources_to(*parser);
    triangulation.add_to(*parser, "trimmed");
    lines.add_constraints_to(*parser);
    lines.add_fitting_to(*parser);
    add_value(*parser, "--river-cells", river_cells_text, "RULE", "line (default)|surface")->group("");
    for (const char* const rare :
         {"--conforming-method", "--max-steiner", "--crossing-tolerance", "--line-tolerance"}) {
        parser->get_option(rare)->group("");  // the screen is full: told of in the manual page
    }
    crs.add_to(*parser, false);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    crs.finish();
    sources.finish(lines.has_breaklines());
    lines.finish(sources.open_options);
    output.finish(true);
    raster.finish();
    interpolation.finish();
    products.finish();
    if (!raster.preview.empty() && products.options.products.front() != Product::Elevation) {
        throw UsageError("--preview shades elevations: let --product begin with elevation");
    }
    if (!river_cells_text.empty()) {
        are_river_cells = choice_value("--river-cells", river_cells_text, kRiverCells);
    }
    triangulation.finish(DomainRule::Kind::Trimmed);
    talk.finish(output.is_stdout());
    for (const std::string& target : products.targets(output.path)) {
        refuse_same_file("--preview", raster.preview, "-o", target);
        refuse_same_file("--conflicts", lines.conflicts, "-o", target);
    }
    refuse_same_file("--conflicts", lines.conflicts, "--preview", raster.preview);
}

io::WriteGridOptions CommandGrid::write_options() const {
    io::WriteGridOptions options;
    options.driver = output.driver;
    options.data_type = raster.data_type;
    options.nodata = raster.nodata;
    options.creation_options = output.creation_options;
    options.overwrite = output.overwrite;
    options.preview = raster.preview;
    options.threads = triangulation.threads;
    options.gridding = products.options;
    return options;
}

io::Crs CommandGrid::output_crs(const Surface& surface, const io::Crs& like_crs) const {
    const bool is_like = like_crs.is_known() && surface.crs.is_known() && crs.crs_text.empty();
    return is_like && !like_crs.is_same_horizontally(surface.output_crs)
               ? like_crs.with_heights_of(surface.crs)
               : surface.output_crs;
}

void CommandGrid::check_like(const io::Crs& like_crs) const {
    if (!like_crs.is_known() || crs.crs_text.empty() || like_crs.is_same_horizontally(crs.crs())) {
        return;
    }
    throw UsageError("--like " + io::quoted(raster.like) + " is in " + like_crs.name() + ", --crs asks for " +
                     crs.crs().name() + ": drop --crs to get the raster of --like");
}

GridGeometry CommandGrid::grid_for(const Surface& surface) const {
    const GridRequest& request = raster.request;
    if (surface.is_written_in_plane()) {
        return choose_grid(surface.tin, request);
    }
    if (request.extent && (request.resolution || request.size)) {
        return choose_grid(GridBasis{}, request);
    }
    GridBasis basis;
    run_with_threads(triangulation.threads,
                     [&] { basis = io::find_grid_basis(surface.tin, surface.crs, surface.output_crs); });
    return choose_grid(basis, request);
}

void CommandGrid::check_degrees(const Surface& surface, const GridGeometry& grid) const {
    const Box extent = grid.extent();
    const bool is_asked_for = raster.request.extent.has_value();
    if (!is_asked_for || !surface.output_crs.is_geographic() || surface.output_crs.unit() != "degree") {
        return;
    }
    const double cell = grid.cell_height;  // whole cells may reach beyond a pole
    if (extent.y_min < -90 - cell || extent.y_max > 90 + cell || extent.x_min < -360 || extent.x_max > 720) {
        throw UsageError(
            "--extent is in the CRS of the raster, " + surface.output_crs.name() +
            ", and goes beyond its longitudes and latitudes; give west south east north in degrees");
    }
}

RasterPlacing CommandGrid::placing_for(const Surface& surface, const GridGeometry& grid) const {
    RasterPlacing placing;
    if (!surface.is_written_in_plane()) {
        run_with_threads(triangulation.threads,
                         [&] { placing = io::make_raster_placing(grid, surface.output_crs, surface.crs); });
    }
    return placing;
}

void CommandGrid::set_slopes(const Surface& surface, GriddingOptions& options, Console& console) const {
    if (products.has_gradients() && products.z_factor_text.empty()) {
        options.z_factor = surface.z_factor;
        warn_of_slopes(surface, console);
    }
}

io::WrittenGrid CommandGrid::write(const Surface& surface, const GridGeometry& grid,
                                   std::span<const std::string> targets,
                                   io::WriteGridOptions& options) const {
    std::unique_ptr<Interpolator> reading;
    double seconds = 0;
    if (!interpolation.is_linear()) {
        const auto start = std::chrono::steady_clock::now();
        reading = interpolation.make(surface, triangulation.threads);
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        options.surface = reading.get();
        options.is_surface_bounded = is_bounded(interpolation.options.method);
    }
    io::WrittenGrid written = targets.size() == 1
                                  ? io::write_grid(surface.tin, surface.output_crs, grid, targets[0], options)
                                  : io::write_grids(surface.tin, surface.output_crs, grid, targets, options);
    written.interpolate_seconds += seconds;
    return written;
}

std::string CommandGrid::reading_options(const Surface& surface) const {
    const std::string cells = " --river-cells " + choice_name(are_river_cells, kRiverCells);
    return interpolation.canonical() + products.canonical() + (has_rivers(surface) ? cells : std::string());
}

void CommandGrid::set_river_cells(Surface& surface, const GridGeometry& grid, const RasterPlacing& placing,
                                  GriddingOptions& gridding) const {
    if (!are_river_cells || !has_rivers(surface)) {
        return;
    }
    run_with_threads(triangulation.threads, [&] {
        gridding.cells =
            find_river_cells(surface.tin, surface.is_river_line, surface.is_water_face, grid, placing);
    });
    if (surface.water) {
        surface.water->river_cells = gridding.cells.size();
    }
}

void CommandGrid::check_targets(std::span<const std::string> targets,
                                const io::WriteGridOptions& options) const {
    std::vector<io::Source> read = lines.plain_sources();
    read.insert(read.end(), sources.sources.begin(), sources.sources.end());
    for (const std::string& target : targets) {
        refuse_to_overwrite_sources(target, read);
        check_output_place(target, output.overwrite);
        io::check_grid_target(target, options);
    }
    refuse_to_overwrite_sources(raster.preview, read);
    refuse_to_overwrite_sources(lines.conflicts, read);
    check_output_place(raster.preview, output.overwrite);
    if (!lines.conflicts.empty()) {
        check_output_place(lines.conflicts, output.overwrite);
        check_conflict_target(lines.conflicts);
    }
}

JobReport CommandGrid::make_report(const Surface& surface, const GridGeometry& grid,
                                   const io::WrittenGrid& written) const {
    JobReport report;
    report.command = "grid";
    report.duplicate_policy = triangulation.policy_name();
    const bool is_resolution_chosen =
        raster.like.empty() && !raster.request.resolution && !raster.request.size;
    report.raster = RasterReport{grid,
                                 written,
                                 is_resolution_chosen,
                                 interpolation.method_text,
                                 ground_size(surface, grid),
                                 surface.output_crs.unit()};
    if (talk.verbose && !surface.is_written_in_plane()) {
        report.details.emplace_back("cells", "centres brought from " + surface.output_crs.name() + " to " +
                                                 surface.crs.name() + ", to " +
                                                 decimal_text(io::kCellPlaceError) +
                                                 " of a cell, and the surface read there");
    }
    report.output_driver = written.driver;
    return report;
}

std::vector<std::string> CommandGrid::outputs(std::span<const std::string> targets,
                                              const Surface& surface) const {
    std::vector<std::string> files(targets.begin(), targets.end());
    if (!raster.preview.empty()) {
        files.push_back(raster.preview);
    }
    if (surface.conflicts) {
        files.push_back(lines.conflicts);
    }
    return files;
}

Outcome CommandGrid::run() {
    Console console("grid", talk);
    const std::vector<std::string> targets = products.targets(output.path);
    io::WriteGridOptions options = write_options();
    check_targets(targets, options);
    io::Crs like_crs;
    std::optional<GridGeometry> like;
    if (!raster.like.empty()) {
        like = io::read_grid_geometry(raster.like, &like_crs);
        check_like(like_crs);
    }

    const SurfaceRequest request{.sources = sources,
                                 .crs = crs,
                                 .triangulation = triangulation,
                                 .lines = &lines,
                                 .overwrite_conflicts = output.overwrite,
                                 .progress_end = 0.6};
    const bool is_tin = is_existing_tin(request);
    if (!is_tin && !river_cells_text.empty() && lines.water.river_texts.empty()) {
        throw UsageError("--river-cells is for rivers: give --rivers too");
    }
    Surface surface = is_tin ? read_existing_tin(request, console) : triangulate_sources(request, console);
    surface.output_crs = output_crs(surface, like_crs);
    const GridGeometry grid = like ? *like : grid_for(surface);
    check_degrees(surface, grid);
    const RasterPlacing placing = placing_for(surface, grid);
    if (like_crs.is_known() && !surface.crs.is_known()) {
        console.warn("the source carries no CRS, so the raster has none, though --like " +
                     io::quoted(raster.like) + " is in " + like_crs.name() + "; --source-crs assigns one");
    }
    set_slopes(surface, options.gridding, console);
    options.metadata = output_metadata("grid", surface, triangulation, lines, reading_options(surface));
    options.gridding.find_places = placing.find_places;
    options.gridding.ground = surface.ground;
    set_river_cells(surface, grid, placing, options.gridding);
    options.progress = console.progress().stage(0.6, 1);
    const io::WrittenGrid written = write(surface, grid, targets, options);
    if (surface.conflicts) {
        surface.conflicts->commit();
    }
    console.progress().finish();
    for (const std::string& warning : written.warnings) {
        console.warn(warning);
    }
    if (written.cells_with_value == 0) {
        console.warn("no cell has a value: no centre of a cell lies on the surface");
    }

    JobReport report = make_report(surface, grid, written);
    report.domain = is_tin ? "as in the TIN" : triangulation.domain_name();
    report.outputs = outputs(targets, surface);
    console.say(report_text(report, surface, {talk.verbose, talk.verbose}));
    if (talk.json) {
        print_result(make_json(report, surface).text());
    }
    return Outcome::Done;
}

}  // namespace tinwright::tools
