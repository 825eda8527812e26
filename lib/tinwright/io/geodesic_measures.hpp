#ifndef TINWRIGHT_IO_GEODESIC_MEASURES_HPP
#define TINWRIGHT_IO_GEODESIC_MEASURES_HPP

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {

/// Lengths and areas on the ellipsoid of what lies in a plane: of geodesics between positions (GeographicLib
/// Geodesic [karney2013], exact to 15 nm), and within geodesic polygons (PolygonArea), metres; NaN where
/// positions cannot be brought to the ellipsoid. About a microsecond a length and twice that a triangle (UTM
/// 0.6, oblique stereographic 1.4). Those of the plane itself when `plane` did not come of geographic sources
/// or is unknown.
GroundMeasures make_ground_measures(const WorkingPlane& plane);

/// The same for any projected system, whatever the sources were; how far off the plane is remains open
/// (`distortion` infinite).
GroundMeasures make_geodesic_measures(const Crs& plane);

}  // namespace tinwright::io

#endif
