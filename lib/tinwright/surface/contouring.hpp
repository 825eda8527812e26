#ifndef TINWRIGHT_SURFACE_CONTOURING_HPP
#define TINWRIGHT_SURFACE_CONTOURING_HPP

#include <cstddef>
#include <optional>
#include <vector>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/surface/contour.hpp"
#include "tinwright/surface/contour_bands.hpp"
#include "tinwright/surface/contour_levels.hpp"
#include "tinwright/surface/interpolator.hpp"

/// The front door to contours.
namespace tinwright {

struct ContourOptions {
    ContourRequest request;
    bool is_bands = false;  ///< polygons between levels instead of lines
    /// Null: lines are cut from the faces, exactly. Else they are traced on this surface over the TIN.
    const Interpolator* surface = nullptr;
    bool is_surface_bounded = true;  ///< that surface never leaves the range of the vertices' elevations
    /// Of traced lines, z units; empty: a twentieth of the interval, without one a thousandth of the range of
    /// elevations.
    std::optional<double> tolerance;
    int threads = 0;  ///< 0: all processors
    Progress progress;
};

/// What tracing came to.
struct TracingReport {
    double tolerance = 0;
    double largest_error = 0;  ///< as `TracedSurface` has it
    std::size_t unresolved = 0;
    std::size_t faces = 0;  ///< of the finer mesh
};

struct Contours {
    std::vector<ContourLevel> levels;  ///< that the terrain reaches
    std::vector<LevelLines> lines;     ///< one entry a level; empty for bands
    std::vector<Band> bands;
    double z_min = 0;  ///< of the terrain
    double z_max = 0;
    std::optional<TracingReport> tracing;
};

/// Chooses levels, traces the surface if there is one, and cuts lines or bands. Throws as `choose_levels`,
/// `make_contours` and `trace_surface` do, and InputError for a TIN without faces.
Contours contour(const Tin& tin, const ContourOptions& options);

}  // namespace tinwright

#endif
