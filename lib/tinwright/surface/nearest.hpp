#ifndef TINWRIGHT_SURFACE_NEAREST_HPP
#define TINWRIGHT_SURFACE_NEAREST_HPP

#include <memory>

#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// The elevation of the nearest vertex that was given rather than made (no Steiner point, no crossing), of
/// several equally near ones that of the smallest id; the gradient is zero. Has steps where the nearest
/// vertex changes, and does not care about breaklines. Build O(n); O(log n) a place.
std::unique_ptr<Interpolator> make_nearest(const Tin& tin);

}  // namespace tinwright

#endif
