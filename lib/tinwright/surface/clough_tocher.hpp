#ifndef TINWRIGHT_SURFACE_CLOUGH_TOCHER_HPP
#define TINWRIGHT_SURFACE_CLOUGH_TOCHER_HPP

#include <memory>

#include "tinwright/surface/gradients.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

struct CloughTocherOptions {
    GradientMethod gradients = GradientMethod::Octant;
    bool is_limited = false;  ///< no elevation beyond those of the samples around
};

std::unique_ptr<Interpolator> make_clough_tocher(const Tin& tin, const SharpEdges& sharp,
                                                 const CloughTocherOptions& options = {});

}  // namespace tinwright

#endif
