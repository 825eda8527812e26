#include "tinwright/surface/contouring.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/surface/traced_surface.hpp"

namespace tinwright {

namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double z) {
        low = std::min(low, z);
        high = std::max(high, z);
    }
};

template <class ElevationOf>
Range range_of(const TriangleMesh& mesh, const ElevationOf& elevation_of) {
    Range range;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            range.add(elevation_of(mesh.vertex({f}, corner)));
        }
    }
    if (!(range.low <= range.high)) {
        throw InputError("the surface has no faces, so it has no contours");
    }
    return range;
}

std::vector<double> elevations_of(const std::vector<ContourLevel>& levels) {
    std::vector<double> elevations;
    elevations.reserve(levels.size());
    for (const ContourLevel& level : levels) {
        elevations.push_back(level.elevation);
    }
    return elevations;
}

Progress part_of(const Progress& progress, double from, double to) {
    if (!progress) {
        return {};
    }
    return [&progress, from, to](double done) { return progress(from + (to - from) * done); };
}

/// What `contour` does, inside the arena.
class Contouring {
  public:
    Contouring(const Tin& tin, const ContourOptions& options) : tin_(tin), options_(options) {}

    Contours run() {
        const Range range = range_of(tin_.mesh, [this](VertexId v) { return tin_.z[v.value]; });
        if (options_.surface != nullptr) {
            trace(range);
            return std::move(result_);
        }
        choose(range);
        const std::vector<double> levels = elevations_of(result_.levels);
        if (options_.is_bands) {
            result_.bands = make_bands(tin_, levels, options_.progress);
        } else {
            result_.lines = make_contours(tin_, levels, options_.progress);
        }
        return std::move(result_);
    }

  private:
    void choose(const Range& range) {
        result_.levels = choose_levels(range.low, range.high, options_.request);
        result_.z_min = range.low;
        result_.z_max = range.high;
    }

    [[nodiscard]] double tolerance(const Range& range) const {
        if (options_.tolerance) {
            return *options_.tolerance;
        }
        if (options_.request.interval) {
            return *options_.request.interval / 20;
        }
        return range.high > range.low ? (range.high - range.low) / 1000 : 1;
    }

    void trace(const Range& range) {
        // A surface may rise over its vertices and fall below them; how far is found out by reading it.
        const double room = options_.is_surface_bounded ? 0 : range.high - range.low;
        const std::vector<double> near =
            elevations_of(choose_levels(range.low - room, range.high + room, options_.request));
        TracingReport report;
        report.tolerance = tolerance(range);
        const TracedSurface traced = trace_surface(tin_, *options_.surface, near, report.tolerance,
                                                   part_of(options_.progress, 0, 0.8));
        report.largest_error = traced.largest_error;
        report.unresolved = traced.unresolved;
        report.faces = traced.mesh.count_terrain();
        result_.tracing = report;
        choose(range_of(traced.mesh, [&](VertexId v) { return traced.vertices[v.value].z; }));
        const std::vector<double> levels = elevations_of(result_.levels);
        const Progress progress = part_of(options_.progress, 0.8, 1);
        if (options_.is_bands) {
            result_.bands = make_bands(traced.mesh, traced.vertices, levels, progress);
        } else {
            result_.lines = make_contours(traced.mesh, traced.vertices, levels, progress);
        }
    }

    const Tin& tin_;
    const ContourOptions& options_;
    Contours result_;
};

}  // namespace

Contours contour(const Tin& tin, const ContourOptions& options) {
    check_contours(options.request);
    tbb::task_arena arena(count_threads(options.threads));
    Contours result;
    arena.execute([&] { result = Contouring(tin, options).run(); });
    return result;
}

}  // namespace tinwright
