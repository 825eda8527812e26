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

std::vector<Point3> in_degrees(std::span<const Point3> points, const Crs& crs) {
    std::vector<Point3> degrees(points.begin(), points.end());
    to_degrees(crs, degrees);
    if (const double meridian = crs.geographic().gdal()->GetPrimeMeridian(); meridian != 0) {
        for (Point3& point : degrees) {
            point.x += meridian;
        }
    }
    return degrees;
}

Crs in_plain_degrees(const Crs& geographic) {
    const bool is_plain = degrees_per_unit(geographic) == 1 && geographic.gdal()->GetPrimeMeridian() == 0;
    return is_plain ? geographic : Crs::parse("EPSG:4326");
}

bool is_stray(const Point3& point, double degrees) {
    return !(std::abs(point.x) * degrees <= 360) || !(std::abs(point.y) * degrees <= 90);
}

}  // namespace tinwright::io
