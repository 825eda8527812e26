#ifndef TINWRIGHT_SURFACE_SMOOTH_HPP
#define TINWRIGHT_SURFACE_SMOOTH_HPP

#include <memory>
#include <vector>

#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

struct SmoothOptions {
    /// A candidate of which each vertex takes the one that predicts its neighbours best.
    struct Kernel {
        double exponent = 1.5;  ///< of the distance; 0: none, a plane
        double stretch = 1;     ///< at most, along the direction of least change; 1: the same all around
        double handicap = 1;    ///< its prediction error counts times this
    };
    std::vector<Kernel> kernels{{1.5, 1, 1}, {1, 4, 1.04}, {2.5, 1, 1}};
    int neighbors = 24;  ///< beside those that the TIN has, spread over eight octants
    double guard =
        0.25;            ///< elevations keep within the neighbours' range grown by this share; infinite: free
    bool is_c1 = false;  ///< continuous gradients: kernels with exponents of 1.5 and more only
};

/// Throws UsageError for options out of range.
void check_smooth(const SmoothOptions& options);

std::unique_ptr<Interpolator> make_smooth(const Tin& tin, const SharpEdges& sharp,
                                          const SmoothOptions& options = {});

}  // namespace tinwright

#endif
