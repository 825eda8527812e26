#include "tinwright/io/transform_points.hpp"

#include "tinwright/io/coordinate_transform.hpp"

namespace tinwright::io {

std::vector<std::size_t> transform_points(std::span<Point3> points, const Crs& from, const Crs& to,
                                          const Progress& progress) {
    TransformOptions options;
    options.has_elevations = !from.z_unit().empty() && !to.z_unit().empty();
    return CoordinateTransform(from, to, options).forward(points, progress);
}

}  // namespace tinwright::io
