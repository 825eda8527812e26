#ifndef TINWRIGHT_SURFACE_INTERPOLATION_HPP
#define TINWRIGHT_SURFACE_INTERPOLATION_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "tinwright/surface/gradients.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/smooth.hpp"

/// The front door to the interpolators.
namespace tinwright {

enum class InterpolationMethod : std::uint8_t {
    Linear,
    Nearest,
    NaturalNeighbor,
    NaturalNeighborLaplace,
    NaturalNeighborC1,
    CloughTocher,
    CloughTocherLimit,
    Smooth,
    SmoothC1
};

/// Names as in `--method`.
inline constexpr auto kInterpolationMethods =
    std::to_array<std::pair<std::string_view, InterpolationMethod>>({
        {"linear", InterpolationMethod::Linear},
        {"nearest", InterpolationMethod::Nearest},
        {"natural-neighbor", InterpolationMethod::NaturalNeighbor},
        {"natural-neighbor:laplace", InterpolationMethod::NaturalNeighborLaplace},
        {"natural-neighbor:c1", InterpolationMethod::NaturalNeighborC1},
        {"clough-tocher", InterpolationMethod::CloughTocher},
        {"clough-tocher:limit", InterpolationMethod::CloughTocherLimit},
        {"smooth", InterpolationMethod::Smooth},
        {"smooth:c1", InterpolationMethod::SmoothC1},
    });

struct InterpolationOptions {
    InterpolationMethod method = InterpolationMethod::Linear;
    GradientMethod gradients = GradientMethod::Octant;  ///< for natural-neighbor:c1 and clough-tocher
    SmoothOptions smooth = {};                          ///< for smooth; `is_c1` is set by the method
    int threads = 1;  ///< 0: all processors; the surface does not depend on it
};

/// Whether the method never leaves the range of the vertices' elevations.
bool is_bounded(InterpolationMethod method);

/// Throws UsageError for options out of range, of the methods that have them.
void check_interpolation(const InterpolationOptions& options);

/// Prepares a surface over the terrain of `tin`, which must outlive it. Throws what `check_interpolation`
/// does, and InputError for elevations beyond 1e100, which only linear and nearest can read. Cost: as the
/// method's header says. `sharp` need not outlive the call.
std::unique_ptr<Interpolator> make_interpolator(const Tin& tin, const SharpEdges& sharp,
                                                const InterpolationOptions& options);

}  // namespace tinwright

#endif
