#ifndef TINWRIGHT_IO_TRANSFORM_POINTS_HPP
#define TINWRIGHT_IO_TRANSFORM_POINTS_HPP

#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"

namespace tinwright::io {

/// Transforms points in place, elevations included where both systems have them (PROJ). Returns the ascending
/// positions of those that cannot be transformed, left as they were. Throws InputError when there is no way
/// between the systems; Cancelled. O(n).
std::vector<std::size_t> transform_points(std::span<Point3> points, const Crs& from, const Crs& to,
                                          const Progress& progress = {});

}  // namespace tinwright::io

#endif
