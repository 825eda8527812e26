#include "benchmarks/composite.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gdal_priv.h>

#include "benchmarks/bare_readers.hpp"
#include "benchmarks/cgal_peer.hpp"

namespace tinwright_benchmarks {

using tinwright::GridGeometry;
using tinwright::Point3;

namespace {

constexpr float kNodata = -9999;

/// The least integer not below `value`, which is 0 or more: std::ceil is a library call on plain x86-64.
std::int64_t ceiling(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return whole + (static_cast<double>(whole) < value ? 1 : 0);
}

/// Fills the cells whose centres lie in the face, half-open in rows and columns. x counts columns from the
/// centre of column 0, y rows from that of row 0.
void scan_face(std::array<Point3, 3> p, std::int64_t columns, std::int64_t rows, float* values) {
    const double ux = p[1].x - p[0].x;
    const double uy = p[1].y - p[0].y;
    const double vx = p[2].x - p[0].x;
    const double vy = p[2].y - p[0].y;
    const double area = ux * vy - uy * vx;
    const double z_per_column = ((p[1].z - p[0].z) * vy - (p[2].z - p[0].z) * uy) / area;
    const double z_per_row = ((p[2].z - p[0].z) * ux - (p[1].z - p[0].z) * vx) / area;
    const Point3 base = p[0];
    std::sort(p.begin(), p.end(), [](const Point3& a, const Point3& b) { return a.y < b.y; });
    const auto slope = [](const Point3& a, const Point3& b) { return (b.x - a.x) / (b.y - a.y); };
    const double long_slope = slope(p[0], p[2]);
    const std::array<double, 2> short_slope{slope(p[0], p[1]), slope(p[1], p[2])};
    const std::int64_t last_row = std::min(ceiling(std::max(p[2].y, 0.0)), rows);
    for (std::int64_t row = ceiling(std::max(p[0].y, 0.0)); row < last_row; ++row) {
        const auto y = static_cast<double>(row);
        const double on_long = p[0].x + (y - p[0].y) * long_slope;
        const double on_short =
            y < p[1].y ? p[0].x + (y - p[0].y) * short_slope[0] : p[1].x + (y - p[1].y) * short_slope[1];
        const std::int64_t first = ceiling(std::max(std::min(on_long, on_short), 0.0));
        const std::int64_t last = std::min(ceiling(std::max({on_long, on_short, 0.0})), columns);
        const double z = base.z + (y - base.y) * z_per_row - base.x * z_per_column;
        for (std::int64_t column = first; column < last; ++column) {
            values[row * columns + column] =
                static_cast<float>(z + static_cast<double>(column) * z_per_column);
        }
    }
}

std::vector<float> scan_convert(std::vector<Point3> points, const std::vector<std::uint32_t>& corners,
                                const GridGeometry& grid) {
    for (Point3& p : points) {
        p.x = (p.x - grid.x_min) / grid.cell_width - 0.5;
        p.y = (grid.y_max - p.y) / grid.cell_height - 0.5;
    }
    std::vector<float> values(static_cast<std::size_t>(grid.columns * grid.rows), kNodata);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        scan_face({points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]}, grid.columns,
                  grid.rows, values.data());
    }
    return values;
}

void write_geotiff(const std::string& path, const GridGeometry& grid, std::vector<float>& values) {
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const auto columns = static_cast<int>(grid.columns);
    const auto rows = static_cast<int>(grid.rows);
    const std::unique_ptr<GDALDataset> dataset(
        driver->Create(path.c_str(), columns, rows, 1, GDT_Float32, nullptr));
    if (!dataset) {
        throw std::runtime_error("cannot write " + path);
    }
    std::array<double, 6> transform{grid.x_min, grid.cell_width, 0, grid.y_max, 0, -grid.cell_height};
    dataset->SetGeoTransform(transform.data());
    dataset->GetRasterBand(1)->SetNoDataValue(static_cast<double>(kNodata));
    if (dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, values.data(), columns, rows,
                                            GDT_Float32, 0, 0, nullptr) != CE_None) {
        throw std::runtime_error("cannot write " + path);
    }
}

}  // namespace

void run_composite(const std::string& input, const GridGeometry& grid, const std::string& output) {
    GDALAllRegister();
    const bool is_geopackage = input.ends_with(".gpkg");
    std::vector<Point3> points = is_geopackage ? read_arrow_barely(input) : read_text_barely(input);
    const std::vector<std::uint32_t> corners = cgal_faces(points);
    std::vector<float> values = scan_convert(std::move(points), corners, grid);
    write_geotiff(output, grid, values);
}

}  // namespace tinwright_benchmarks
