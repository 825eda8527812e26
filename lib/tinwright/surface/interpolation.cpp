#include "tinwright/surface/interpolation.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <tbb/task_arena.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/surface/clough_tocher.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/natural_neighbor.hpp"
#include "tinwright/surface/nearest.hpp"

namespace tinwright {

namespace {

bool is_smooth(InterpolationMethod method) {
    return method == InterpolationMethod::Smooth || method == InterpolationMethod::SmoothC1;
}

std::unique_ptr<Interpolator> make_method(const Tin& tin, const SharpEdges& sharp,
                                          const InterpolationOptions& options) {
    using Kind = NaturalNeighborOptions::Kind;
    SmoothOptions smooth = options.smooth;
    switch (options.method) {
        case InterpolationMethod::Linear:
            return make_linear(tin);
        case InterpolationMethod::Nearest:
            return make_nearest(tin);
        case InterpolationMethod::NaturalNeighbor:
            return make_natural_neighbor(tin, sharp, {Kind::Sibson, options.gradients});
        case InterpolationMethod::NaturalNeighborLaplace:
            return make_natural_neighbor(tin, sharp, {Kind::Laplace, options.gradients});
        case InterpolationMethod::NaturalNeighborC1:
            return make_natural_neighbor(tin, sharp, {Kind::C1, options.gradients});
        case InterpolationMethod::CloughTocher:
            return make_clough_tocher(tin, sharp, {options.gradients, false});
        case InterpolationMethod::CloughTocherLimit:
            return make_clough_tocher(tin, sharp, {options.gradients, true});
        case InterpolationMethod::Smooth:
            smooth.is_c1 = false;
            return make_smooth(tin, sharp, smooth);
        case InterpolationMethod::SmoothC1:
            smooth.is_c1 = true;
            return make_smooth(tin, sharp, smooth);
    }
    throw std::logic_error("unknown interpolation method");
}

/// Elevations beyond this, squared and multiplied by areas, are no doubles any more.
constexpr double kLargestElevation = 1e100;

void check_elevations(const Tin& tin) {
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        if (std::abs(tin.z[v]) > kLargestElevation) {
            const Point3 p = tin.position({v});
            throw InputError("the elevation " + decimal_text(p.z) + " at " + location_text({p.x, p.y}) +
                             " is beyond 1e100, which only the methods linear and nearest can read");
        }
    }
}

}  // namespace

bool is_bounded(InterpolationMethod method) {
    // Sibson's and Laplace's surfaces are but for rounding.
    return method == InterpolationMethod::Linear || method == InterpolationMethod::Nearest ||
           method == InterpolationMethod::CloughTocherLimit;
}

void check_interpolation(const InterpolationOptions& options) {
    if (is_smooth(options.method)) {
        check_smooth(options.smooth);
    }
}

std::unique_ptr<Interpolator> make_interpolator(const Tin& tin, const SharpEdges& sharp,
                                                const InterpolationOptions& options) {
    if (options.method != InterpolationMethod::Linear && options.method != InterpolationMethod::Nearest) {
        check_elevations(tin);
    }
    std::unique_ptr<Interpolator> made;
    tbb::task_arena arena(count_threads(options.threads));
    arena.execute([&] { made = make_method(tin, sharp, options); });
    return made;
}

}  // namespace tinwright
