#ifndef TINWRIGHT_SURFACE_LINEAR_HPP
#define TINWRIGHT_SURFACE_LINEAR_HPP

#include <memory>

#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// The faces themselves: on each the plane through its corners. Continuous, with a crease at every edge.
/// O(1) a place.
std::unique_ptr<Interpolator> make_linear(const Tin& tin);

}  // namespace tinwright

#endif
