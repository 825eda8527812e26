#ifndef TINWRIGHT_WATER_STATIONS_HPP
#define TINWRIGHT_WATER_STATIONS_HPP

#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Adds points to a line so that consecutive ones are at most `spacing` (CRS units, > 0) apart: each segment
/// is divided into equal parts, the same ones in whichever direction the line runs. Points are moved to the
/// lattice; z is linear between the line's points, or draped. O(points made).
std::vector<Point3> add_stations(const std::vector<Point3>& line, double spacing, const Lattice& lattice);

}  // namespace tinwright

#endif
