#ifndef TINWRIGHT_IO_ANGULAR_UNIT_HPP
#define TINWRIGHT_IO_ANGULAR_UNIT_HPP

#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/crs.hpp"

namespace tinwright::io {

/// Degrees that the unit of a geographic system's longitudes and latitudes has: 1, or 0.9 of grads.
double degrees_per_unit(const Crs& crs);

/// Brings positions in a system to longitudes and latitudes of the geographic system that it is one of or
/// based on, in degrees; NaN for those that cannot be.
void to_degrees(const Crs& crs, std::vector<Point3>& points);

}  // namespace tinwright::io

#endif
