#ifndef TINWRIGHT_IO_ANGULAR_UNIT_HPP
#define TINWRIGHT_IO_ANGULAR_UNIT_HPP

#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/crs.hpp"

namespace tinwright::io {

/// Degrees that the unit of a geographic system's longitudes and latitudes has: 1, or 0.9 of grads.
double degrees_per_unit(const Crs& crs);

/// Brings positions in a system to longitudes and latitudes of the geographic system that it is one of or
/// based on, in degrees; NaN for those that cannot be.
void to_degrees(const Crs& crs, std::vector<Point3>& points);

/// Positions in a system as degrees east of Greenwich and north; NaN for those that cannot be.
std::vector<Point3> in_degrees(std::span<const Point3> points, const Crs& crs);

/// The system that such degrees can be taken to be in: the geographic one given, or WGS 84 for one of other
/// units or another meridian.
Crs in_plain_degrees(const Crs& geographic);

/// Whether a position, in units of so many degrees, is no longitude and latitude however one counts.
bool is_stray(const Point3& point, double degrees);

}  // namespace tinwright::io

#endif
