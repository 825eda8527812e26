#include "surface_input.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_tin.hpp"

#include "vertex_origins.hpp"

namespace tinwright::tools {

namespace {

using Clock = std::chrono::steady_clock;

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

/// `message` with the first few of the samples it is about named by file and line or feature.
std::string located(const std::string& message, const io::Samples& samples,
                    std::vector<std::size_t> indices) {
    constexpr std::size_t kNamed = 3;
    std::string text = message;
    for (std::size_t i = 0; i < std::min(indices.size(), kNamed); ++i) {
        text += (i == 0 ? " (" : "; ") + samples.describe(indices[i]);
    }
    if (indices.size() > kNamed) {
        text += "; and " + std::to_string(indices.size() - kNamed) + " more";
    }
    return indices.empty() ? text : text + ")";
}

Triangulated triangulate_located(const io::Samples& samples, const TriangulateOptions& options) {
    try {
        return triangulate(samples.points, options);
    } catch (const DuplicateError& error) {
        std::vector<std::size_t> first;
        if (!error.first().empty()) {
            first = error.first().front().samples;
        }
        throw InputError(located(error.what(), samples, first), first);
    } catch (const InputError& error) {
        throw InputError(located(error.what(), samples, error.samples()), error.samples());
    }
}

}  // namespace

std::string metadata_value(const io::TinMetadata& metadata, const std::string& key) {
    for (const auto& [name, value] : metadata) {
        if (name == key) {
            return value;
        }
    }
    return {};
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
    const std::string option = request.triangulation.option_for_samples_only();
    if (!option.empty()) {
        throw UsageError(name + " is a TIN, whose faces are used as they are: " + option +
                         " does not apply; add ,as=samples to triangulate its vertices anew");
    }
    return true;
}

Surface triangulate_sources(const SurfaceRequest& request, Console& console) {
    // Optimising, where there is any, takes longer than all the rest.
    const bool is_optimizing = request.triangulation.optimize.has_value();
    const double triangulate_at = request.progress_end * (is_optimizing ? 0.2 : 0.5);
    const double optimize_at = request.progress_end * (is_optimizing ? 0.3 : 1.0);
    io::ReadOptions options;
    options.skip_bad = request.sources.skip_bad;
    options.crs = request.crs.crs();
    options.source_crs = request.crs.source_crs();
    options.threads = request.triangulation.threads;
    options.progress = console.progress().stage(0, triangulate_at);
    io::Samples samples = io::read_samples(request.sources.sources, options);
    for (const std::string& warning : samples.warnings) {
        console.warn(warning);
    }

    Triangulated made = triangulate_located(
        samples, request.triangulation.library_options(
                     console.progress().stage(triangulate_at, optimize_at),
                     console.progress().stage_to_leave(optimize_at, request.progress_end)));
    Surface surface;
    if (request.keep_origins) {
        surface.origins = make_vertex_origins(made.tin, samples.slices, request.keep_ids);
    }
    surface.tin = std::move(made.tin);
    surface.report = std::move(made.report);
    surface.crs = samples.crs;
    surface.z_unit = samples.z_unit;
    surface.criterion = make_criterion_report(request.triangulation, surface.report->optimize, surface.crs);
    for (const std::string& warning :
         criterion_warnings(request.triangulation, surface.report->optimize, surface.crs, surface.z_unit)) {
        console.warn(warning);
    }
    surface.slices = std::move(samples.slices);
    for (io::SampleSlice& slice : surface.slices) {
        slice.ids = {};  // the origins have what is wanted of them
    }
    surface.read_seconds = samples.seconds;
    return surface;
}

Surface read_existing_tin(const SurfaceRequest& request, Console& console) {
    const Clock::time_point start = Clock::now();
    const io::Source& source = request.sources.sources.front();
    io::TinFile file = io::read_tin_file(source, console.progress().stage(0, request.progress_end));
    const io::Crs wanted = request.crs.crs();
    if (wanted.is_known() && file.crs.is_known() && !wanted.is_same(file.crs)) {
        throw UsageError("--crs " + wanted.name() + " differs from the CRS of " + io::quoted(source.path) +
                         ", " + file.crs.name() + ": a TIN is not transformed");
    }
    const io::Crs assigned = request.crs.source_crs();
    Surface surface;
    surface.tin = io::make_tin(file);
    surface.crs = file.crs.is_known() ? file.crs : assigned.is_known() ? assigned : wanted;
    surface.z_unit = surface.crs.z_unit();
    surface.metadata = std::move(file.metadata);
    surface.criterion = read_criterion_report(surface.metadata);
    surface.tin_layer = std::move(file.layer);
    if (request.triangulation.max_edge) {
        surface.void_faces = drop_long_faces(surface.tin, *request.triangulation.max_edge);
    }
    surface.read_seconds = seconds_since(start);
    return surface;
}

}  // namespace tinwright::tools
