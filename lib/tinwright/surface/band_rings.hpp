#ifndef TINWRIGHT_SURFACE_BAND_RINGS_HPP
#define TINWRIGHT_SURFACE_BAND_RINGS_HPP

#include <vector>

#include "tinwright/surface/contour_bands.hpp"

/// Private to contour bands: closed ways around an area as the rings of polygons.
namespace tinwright {

/// Cuts a closed way (its first point not repeated) into rings that meet no point twice, and appends them;
/// what goes forth and back, or stays in one point, leaves none. O(n log n).
void cut_rings(std::vector<Point2> way, std::vector<BandRing>& rings);

/// The rings around one connected area, outer ring first.
BandPolygon as_polygon(std::vector<BandRing> rings);

/// Order of rings and polygons by their points.
bool precedes(const BandRing& a, const BandRing& b);
bool precedes(const BandPolygon& a, const BandPolygon& b);

}  // namespace tinwright

#endif
