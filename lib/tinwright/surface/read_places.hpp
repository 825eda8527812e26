#ifndef TINWRIGHT_SURFACE_READ_PLACES_HPP
#define TINWRIGHT_SURFACE_READ_PLACES_HPP

#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/locator.hpp"

/// Surfaces read at many places, in parallel inside the caller's task arena; results do not depend on the
/// number of threads.
namespace tinwright {

/// The place of each position (CRS units); empty outside the terrain.
std::vector<std::optional<SurfacePlace>> find_places(const SurfaceLocator& locator,
                                                     std::span<const Point2> positions);

/// The reading at each place. Near places are best asked for in succession.
std::vector<SurfaceReading> read_places(const Interpolator& surface, std::span<const SurfacePlace> places);

}  // namespace tinwright

#endif
