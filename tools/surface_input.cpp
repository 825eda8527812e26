#include "surface_input.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/geodesic_measures.hpp"
#include "tinwright/io/length_unit.hpp"
#include "tinwright/io/read_tin.hpp"

#include "conflict_layer.hpp"
#include "located_errors.hpp"
#include "water_lines.hpp"

namespace tinwright::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kZUnitKey = "TINWRIGHT_Z_UNIT";

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Looking for a TIN would use up a stream that can be read only once.
bool can_look_first(const io::Source& source) { return source.path.find("/vsistdin") == std::string::npos; }

bool looks_like_tin(const io::Source& source) {
    if (source.as != io::Source::Kind::Auto) {
        return source.as == io::Source::Kind::Tin;
    }
    return can_look_first(source) && io::is_tin(source);
}

/// Samples and lines as they were read.
struct Inputs {
    io::Samples samples;
    io::Lines lines;
};

Inputs read_inputs(const SurfaceRequest& request, Console& console, double end) {
    const bool has_lines = request.lines != nullptr && !request.lines->sources.empty();
    const double samples_end = has_lines ? 0.9 * end : end;
    Inputs inputs;
    io::ReadOptions options;
    options.skip_bad = request.sources.skip_bad;
    request.crs.apply_to(options);
    options.threads = request.triangulation.threads;
    options.progress = console.progress().stage(0, samples_end);
    inputs.samples = io::read_samples(request.sources.sources, options);
    if (has_lines) {
        io::ReadLinesOptions line_options;
        line_options.skip_bad = options.skip_bad;
        request.crs.apply_to(line_options, inputs.samples);
        line_options.snap = request.lines->noding.snap;
        line_options.progress = console.progress().stage(samples_end, end);
        inputs.lines = io::read_lines(request.lines->sources, line_options);
        const bool is_crs_new = inputs.lines.crs.is_known() && !inputs.samples.crs.is_known();
        if (is_crs_new && !inputs.samples.points.empty() && inputs.lines.plane.is_source_geographic()) {
            throw UsageError("the samples have no CRS, and the lines are in longitude and latitude, " +
                             inputs.lines.plane.source_crs.name() +
                             ": assign the samples' with --source-crs");
        }
        if (is_crs_new && !inputs.samples.points.empty()) {
            inputs.lines.warnings.push_back("the samples have no CRS; taken to be in " +
                                            inputs.lines.crs.name() + " as the lines are");
        }
    }
    for (const std::vector<std::string>* const warnings :
         {&inputs.samples.warnings, &inputs.lines.warnings}) {
        for (const std::string& warning : *warnings) {
            console.warn(warning);
        }
    }
    return inputs;
}

/// Levels the water among the lines, which changes samples and lines.
WaterSummary level_inputs(const SurfaceRequest& request, Inputs& inputs, const Progress& progress) {
    WaterOptions options = request.lines->water_options();
    options.ground =
        io::make_ground_measures(inputs.samples.crs.is_known() ? inputs.samples.plane : inputs.lines.plane);
    options.progress = progress;
    Water water;
    run_located(inputs.samples, inputs.lines, [&] {
        run_with_threads(request.triangulation.threads,
                         [&] { water = level_water(inputs.samples.points, inputs.lines.lines, options); });
    });
    WaterSummary summary = summarize_water(water, inputs.lines, options);
    take_water(inputs.samples, inputs.lines, std::move(water.lines), water.origin, water.lifted);
    return summary;
}

std::vector<io::SampleSlice> slices_without_ids(Inputs& inputs) {
    std::vector<io::SampleSlice> slices = std::move(inputs.samples.slices);
    for (io::SampleSlice& slice : slices) {
        slice.ids = {};
    }
    return slices;
}

/// Of a TIN file, which keeps a unit that its CRS does not tell.
std::string z_unit_of(const io::TinMetadata& metadata, const io::Crs& crs, const CrsOptions& options) {
    const std::string kept = metadata_value(metadata, kZUnitKey);
    return !crs.z_unit().empty() ? crs.z_unit() : !kept.empty() ? kept : options.heights.source_unit;
}

/// Slopes that are asked for, in the units that TINs have: only what decides on creases and where to stop.
void scale_slopes(TriangulateOptions& options, double z_factor) {
    if (options.optimize && options.optimize->scope.kind == Scope::Kind::Above) {
        options.optimize->scope.value /= told_factor(options.optimize->criterion, z_factor);
    }
    if (options.data_dependent) {
        options.data_dependent->z_factor = z_factor;
    }
}

/// What follows from the plane and the units.
void set_references(const CrsOptions& options, io::WorkingPlane plane, Surface& surface) {
    surface.crs = plane.crs;
    surface.plane = std::move(plane);
    const io::Crs asked = options.crs();
    const bool is_elsewhere =
        asked.is_known() && surface.crs.is_known() && !asked.is_same_horizontally(surface.crs);
    surface.output_crs = is_elsewhere ? asked.with_heights_of(surface.crs) : surface.crs;
    if (surface.crs.heights() == io::Crs::Heights::Ellipsoidal &&
        asked.heights() == io::Crs::Heights::Unknown) {
        // Projected systems with ellipsoidal heights have no codes, and few programs read them.
        surface.output_crs = surface.output_crs.horizontal();
    }
    if (!surface.output_crs.z_unit().empty() && surface.output_crs.z_unit() != surface.z_unit) {
        surface.output_crs = surface.output_crs.horizontal();  // must not claim a unit that z does not have
    }
    surface.ground = io::make_ground_measures(surface.plane);
    surface.z_factor = io::unit_factor(surface.z_unit, surface.crs.unit());
    surface.reference_options = options.canonical();
}

SourceName name_of(const io::SampleSlice& slice) {
    using Kind = io::SampleSlice::Kind;
    return {
        "file " + io::quoted(slice.file) + (slice.layer.empty() ? "" : ", layer " + io::quoted(slice.layer)),
        slice.kind == Kind::Text     ? "line"
        : slice.kind == Kind::Raster ? "cell"
                                     : "feature"};
}

std::vector<SourceName> name_sources(const Tin& tin, const TinOrigins& origins, const Inputs& inputs) {
    std::vector<SourceName> names;
    const auto set = [&names](std::int32_t number, const auto& make_name) {
        const auto place = static_cast<std::size_t>(std::max(number, 1)) - 1;
        names.resize(std::max(names.size(), place + 1));
        if (number > 0 && names[place].text.empty()) {
            names[place] = make_name();
        }
    };
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        if (const io::SampleSlice* const slice = inputs.samples.find_slice(tin.sample[v])) {
            set(origins.vertices.source[v], [&] { return name_of(*slice); });
        }
    }
    for (std::size_t i = 0; i < origins.lines.size(); ++i) {
        set(origins.lines[i].source, [&] {
            const io::LineSlice& slice = inputs.lines.slice_of(i);
            return SourceName{"file " + io::quoted(slice.file) + ", layer " + io::quoted(slice.layer),
                              "feature"};
        });
    }
    return names;
}

/// What a TIN file says of where its vertices and lines came from, vertices in the order of the TIN.
TinOrigins origins_of_file(const Tin& tin, const io::TinFile& file) {
    TinOrigins origins;
    origins.lines = file.lines;
    const auto arrange = [&](const auto& of_file, auto& of_tin, auto missing) {
        for (std::uint32_t v = 0; v < tin.vertex_count() && !of_file.empty(); ++v) {
            const std::uint32_t vertex = tin.sample[v];
            of_tin.push_back(vertex < of_file.size() ? of_file[vertex] : missing);
        }
    };
    arrange(file.origins.source, origins.vertices.source, std::int32_t{0});
    arrange(file.origins.feature, origins.vertices.feature, std::int64_t{-1});
    return origins;
}

/// Brings a TIN file's vertices into a plane where they are in degrees.
io::WorkingPlane place_tin(const io::Source& source, const SurfaceRequest& request, io::TinFile& file,
                           Console& console) {
    io::ReadOptions options;
    request.crs.apply_to(options);
    if (file.crs.is_known() && options.crs.heights() != io::Crs::Heights::Unknown &&
        file.crs.heights() != io::Crs::Heights::Unknown && !options.crs.has_same_heights(file.crs)) {
        throw UsageError(
            "--crs " + options.crs.name() + " measures elevations from elsewhere than " +
            io::quoted(source.path) + ", " + file.crs.name() +
            ": those of a TIN are not transformed; add ,as=samples to triangulate its vertices anew");
    }
    io::WorkingPlane plane;
    run_with_threads(request.triangulation.threads, [&] { plane = io::place_tin(file, source, options); });
    for (const std::string& warning : file.warnings) {
        console.warn(warning);
    }
    return plane;
}

/// Has flat faces removed while `options` are carried out, and reported in `surface`.
void treat_flat_faces(const TriangulationOptions& triangulation, Surface& surface,
                      TriangulateOptions& options) {
    const FlatFaces how = triangulation.flat_faces;
    if (how == FlatFaces::Keep) {
        return;
    }
    const bool keeps_delaunay = !triangulation.is_delaunay();
    options.before_optimum = [&surface, how, keeps_delaunay](Tin& tin, const std::vector<bool>& is_water) {
        surface.flat_faces = {treatment_name(how), remove_flat_faces(tin, how, is_water, keeps_delaunay)};
    };
}

}  // namespace

io::Crs Surface::place_crs(const CrsOptions& options) const {
    const io::Crs asked = options.crs();
    return asked.is_known() ? asked : plane.is_source_geographic() ? plane.source_crs : crs;
}

std::string metadata_value(const io::TinMetadata& metadata, const std::string& key) {
    for (const auto& [name, value] : metadata) {
        if (name == key) {
            return value;
        }
    }
    return {};
}

io::TinMetadata unit_metadata(const Surface& surface) {
    const bool is_told = surface.z_unit.empty() || surface.output_crs.z_unit() == surface.z_unit;
    return is_told ? io::TinMetadata() : io::TinMetadata{{kZUnitKey, surface.z_unit}};
}

double z_factor_of(const io::TinFile& file, const CrsOptions& options) {
    return io::unit_factor(z_unit_of(file.metadata, file.crs, options), file.crs.unit());
}

bool is_z_unit_assumed(const Surface& surface) {
    return surface.z_unit.empty() && !surface.crs.unit().empty();
}

std::string z_unit_text(const Surface& surface) {
    if (surface.z_unit.empty()) {
        const std::string unit = surface.crs.unit();
        return unit.empty() ? "unknown" : unit + ", assumed";
    }
    std::array<char, 48> factor{};
    std::snprintf(factor.data(), factor.size(), "%.6g", surface.z_factor);
    return surface.z_unit +
           (surface.z_factor == 1 ? std::string() : ", " + std::string(factor.data()) + " of the CRS's unit");
}

void warn_of_pole(const Surface& surface, Console& console) {
    if (surface.plane.extent.has_pole && surface.output_crs.is_geographic()) {
        console.warn("the data go round a pole, and in " + surface.output_crs.name() +
                     " what crosses the antimeridian jumps by 360 degrees; leave out --crs to write it in " +
                     surface.crs.name());
    }
}

void warn_of_slopes(const Surface& surface, Console& console) {
    if (const std::string warning = slope_warning(surface.crs, surface.z_unit); !warning.empty()) {
        console.warn_once(warning);
    }
}

bool is_existing_tin(const SurfaceRequest& request) {
    const std::vector<io::Source>& sources = request.sources.sources;
    const auto tin = std::find_if(sources.begin(), sources.end(),
                                  [](const io::Source& source) { return looks_like_tin(source); });
    if (tin == sources.end()) {
        return false;
    }
    const std::string name = io::quoted(tin->path);
    if (sources.size() > 1) {
        throw UsageError(name +
                         " is a TIN and cannot be mixed with other sources: give it alone, or add "
                         ",as=samples to take its vertices as samples");
    }
    std::string option = request.triangulation.option_for_samples_only();
    if (option.empty()) {
        option = request.crs.option_for_samples_only();
    }
    if (option.empty() && request.lines != nullptr) {
        option = request.lines->first_given();
    }
    if (!option.empty()) {
        throw UsageError(name + " is a TIN, whose faces are used as they are: " + option +
                         " does not apply; add ,as=samples to triangulate its vertices anew");
    }
    return true;
}

Surface triangulate_sources(const SurfaceRequest& request, Console& console) {
    // Optimising, where there is any, takes longer than all the rest.
    const bool is_optimizing =
        request.triangulation.optimize.has_value() || request.triangulation.data_dependent.has_value();
    const double triangulate_at = request.progress_end * (is_optimizing ? 0.2 : 0.5);
    const double optimize_at = request.progress_end * (is_optimizing ? 0.3 : 1.0);
    const bool has_water = request.lines != nullptr && request.lines->has_water();
    const double read_end = triangulate_at * (has_water ? 0.8 : 1.0);
    Inputs inputs = read_inputs(request, console, read_end);
    TriangulateOptions options = request.triangulation.library_options(
        console.progress().stage(triangulate_at, optimize_at),
        console.progress().stage_to_leave(optimize_at, request.progress_end));
    if (request.lines != nullptr) {
        request.lines->apply_to(options);
    }
    Surface surface;
    const io::WorkingPlane& plane = inputs.samples.crs.is_known() ? inputs.samples.plane : inputs.lines.plane;
    surface.z_unit = inputs.samples.z_unit.empty() ? inputs.lines.z_unit : inputs.samples.z_unit;
    set_references(request.crs, plane, surface);
    options.ground = surface.ground;
    scale_slopes(options, surface.z_factor);
    if (has_water) {
        surface.water = level_inputs(request, inputs, console.progress().stage(read_end, triangulate_at));
    }
    treat_flat_faces(request.triangulation, surface, options);
    Triangulated made;
    run_located(inputs.samples, inputs.lines,
                [&] { made = triangulate(inputs.samples.points, inputs.lines.lines, options); });
    if (surface.flat_faces && surface.flat_faces->report.swapped + surface.flat_faces->report.inserted > 0) {
        made.report.is_conforming = false;
    }
    // What was done while reading comes first, as it was done first.
    std::vector<LineConflict>& conflicts = made.report.lines.conflicts;
    conflicts.insert(conflicts.begin(), inputs.lines.conflicts.begin(), inputs.lines.conflicts.end());

    if (request.keep_origins) {
        surface.origins = make_tin_origins(made.tin, inputs.samples.slices, inputs.lines, request.keep_ids);
        surface.source_names = name_sources(made.tin, surface.origins, inputs);
    }
    if (request.lines != nullptr) {
        surface.lines = summarize_lines(*request.lines, inputs.lines, made.tin, made.report);
        if (!request.lines->conflicts.empty()) {
            const io::OutputPositions positions(surface.crs, surface.output_crs, made.report.bounds);
            for (LineConflict& conflict : conflicts) {
                conflict.location = positions.transform(conflict.location);
            }
            surface.conflicts = write_conflicts(conflicts, {inputs.lines, inputs.samples}, surface.output_crs,
                                                request.lines->conflicts, request.overwrite_conflicts);
        }
    }
    for (const Breakline& line : inputs.lines.lines) {
        surface.is_line_sharp.push_back(line.is_sharp);
        surface.is_river_line.push_back(line.role == LineRole::River);
    }
    if (has_water) {
        surface.is_water_face = find_water_faces(made.tin, inputs.lines.lines);
    }
    surface.tin = std::move(made.tin);
    surface.report = std::move(made.report);
    surface.criterion =
        make_criterion_report(request.triangulation, *surface.report, surface.crs, surface.z_factor);
    std::vector<std::string> warnings = lines_warnings(surface.lines);
    if (surface.water) {
        const std::vector<std::string> of_water = water_warnings(*surface.water);
        warnings.insert(warnings.end(), of_water.begin(), of_water.end());
    }
    for (std::string& warning : criterion_warnings(request.triangulation, *surface.report)) {
        warnings.push_back(std::move(warning));
    }
    if (is_about_slopes(request.triangulation)) {
        warn_of_slopes(surface, console);
    }
    for (const std::string& warning : warnings) {
        console.warn(warning);
    }
    surface.slices = slices_without_ids(inputs);  // the origins have what is wanted of them
    surface.read_seconds = inputs.samples.seconds + inputs.lines.seconds;
    return surface;
}

Surface triangulate_locations(const SurfaceRequest& request, Console& console) {
    const double read_end = 0.6 * request.progress_end;
    Inputs inputs = read_inputs(request, console, read_end);
    TriangulateOptions options;
    options.duplicates = request.triangulation.duplicates;
    options.threads = request.triangulation.threads;
    options.progress = console.progress().stage(read_end, request.progress_end);
    Triangulated made;
    run_located(inputs.samples, inputs.lines,
                [&] { made = tinwright::triangulate_locations(inputs.samples.points, options); });
    Surface surface;
    surface.z_unit = inputs.samples.z_unit;
    set_references(request.crs, inputs.samples.plane, surface);
    surface.tin = std::move(made.tin);
    surface.report = std::move(made.report);
    surface.slices = slices_without_ids(inputs);
    surface.read_seconds = inputs.samples.seconds;
    return surface;
}

Surface read_existing_tin(const SurfaceRequest& request, Console& console) {
    const Clock::time_point start = Clock::now();
    const io::Source& source = request.sources.sources.front();
    io::TinFile file = io::read_tin_file(source, console.progress().stage(0, request.progress_end));
    Surface surface;
    const io::WorkingPlane plane = place_tin(source, request, file, console);
    surface.tin = io::make_tin(file);
    surface.is_water_face = io::water_faces_of(file, surface.tin);
    for (const io::LineOrigin& line : file.lines) {
        surface.is_line_sharp.push_back(line.is_sharp);
        surface.is_river_line.push_back(line.role == LineRole::River);
    }
    if (request.keep_origins) {
        surface.origins = origins_of_file(surface.tin, file);
    }
    surface.z_unit = z_unit_of(file.metadata, plane.crs, request.crs);
    set_references(request.crs, plane, surface);
    surface.metadata = std::move(file.metadata);
    surface.criterion = read_criterion_report(surface.metadata);
    surface.lines = read_lines_summary(surface.metadata);
    surface.tin_layer = std::move(file.layer);
    if (request.triangulation.max_edge) {
        surface.void_faces = drop_long_faces(surface.tin, *request.triangulation.max_edge,
                                             surface.is_water_face, surface.ground);
    }
    surface.read_seconds = seconds_since(start);
    return surface;
}

}  // namespace tinwright::tools
