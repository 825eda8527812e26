#include "tinwright/io/transform_points.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {

std::vector<std::size_t> transform_points(std::span<Point3> points, const Crs& from, const Crs& to,
                                          const Progress& progress) {
    const GdalMessages messages;
    const std::unique_ptr<OGRCoordinateTransformation> way(
        OGRCreateCoordinateTransformation(from.gdal(), to.gdal()));
    if (!way) {
        throw InputError("no transformation from " + from.name() + " to " + to.name() + messages.suffix());
    }
    std::vector<std::size_t> failed;
    constexpr std::size_t kBlock = 65536;
    std::vector<double> x(kBlock);
    std::vector<double> y(kBlock);
    std::vector<double> z(kBlock);
    std::vector<int> success(kBlock);
    for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, points.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const Point3& point = points[begin + i];
            x[i] = point.x;
            y[i] = point.y;
            z[i] = point.z;
        }
        way->Transform(static_cast<int>(count), x.data(), y.data(), z.data(), success.data());
        for (std::size_t i = 0; i < count; ++i) {
            if (success[i] != 0 && std::isfinite(x[i]) && std::isfinite(y[i]) && std::isfinite(z[i])) {
                points[begin + i] = {x[i], y[i], z[i]};
            } else {
                failed.push_back(begin + i);
            }
        }
        report_progress(progress, static_cast<double>(begin + count) / static_cast<double>(points.size()));
    }
    return failed;
}

}  // namespace tinwright::io
