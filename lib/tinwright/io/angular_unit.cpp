#include "tinwright/io/angular_unit.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <ogr_spatialref.h>

#include "tinwright/io/coordinate_transform.hpp"

namespace tinwright::io {

double degrees_per_unit(const Crs& crs) {
    const double degrees = crs.gdal()->GetAngularUnits(nullptr) * 180 / std::numbers::pi;
    // Files write a degree with 13 to 17 digits.
    const double tenths = std::round(degrees * 10) / 10;
    return std::abs(degrees - tenths) < 1e-9 ? tenths : degrees;
}

void to_degrees(const Crs& crs, std::vector<Point3>& points) {
    const Crs geographic = crs.geographic();
    if (!crs.is_same_horizontally(geographic)) {  // a rotated pole makes a geographic system of another
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        const CoordinateTransform transform(crs.horizontal(), geographic);
        for (const std::size_t i : transform.forward(points)) {
            points[i] = {kNone, kNone, 0};
        }
    }
    const double degrees = degrees_per_unit(geographic);
    for (Point3& point : points) {
        point = {point.x * degrees, point.y * degrees, 0};
    }
}

}  // namespace tinwright::io
