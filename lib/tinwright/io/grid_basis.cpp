#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <ogr_spatialref.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/cell_places.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/geographic_extent.hpp"
#include "tinwright/mesh/border.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright::io {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Parts of an edge of the border: its curve in the other system is then flat between points.
constexpr double kMostParts = 1000;
// Vertices that the spacing is found at.
constexpr std::size_t kProbes = 255;
// This near to a pole, degrees, longitudes tell nothing.
constexpr double kAtPole = 1e-9;

/// The vertices of the terrain's border and points along its edges, no farther apart than the spacing unless
/// that makes too many.
std::vector<Point3> border_points(const Tin& tin, double spacing) {
    std::vector<Point3> points;
    for (const HalfEdgeId h : find_border(tin.mesh)) {
        const Point3 a = tin.position(tin.mesh.origin(h));
        const Point3 b = tin.position(tin.mesh.destination(h));
        const double parts =
            std::clamp(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / spacing), 1.0, kMostParts);
        for (double i = 0; i < parts; ++i) {
            points.push_back({a.x + i / parts * (b.x - a.x), a.y + i / parts * (b.y - a.y), 0});
        }
    }
    return points;
}

/// Those that are left, in the other system.
std::vector<Point3> transformed(std::vector<Point3> points, const CoordinateTransform& transform) {
    for (const std::size_t i : transform.forward(points)) {
        points[i].x = kNone;
    }
    std::erase_if(points, [](const Point3& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
    return points;
}

Box bounds_of(const std::vector<Point3>& points) {
    Box box;
    for (const Point3& point : points) {
        box.add(point.x, point.y);
    }
    return box;
}

bool is_on_terrain(const Tin& tin, Point2 position) {
    const QueryLattice lattice(tin);
    const Key2 at = lattice.at(position);
    if (!QueryLattice::is_near(at)) {
        return false;
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        std::array<Key2, 3> corner{};
        for (unsigned i = 0; i < 3; ++i) {
            corner[i] = lattice.scaled(tin.key(tin.mesh.vertex({f}, i)));
        }
        if (orient2d(corner[0], corner[1], at) >= 0 && orient2d(corner[1], corner[2], at) >= 0 &&
            orient2d(corner[2], corner[0], at) >= 0) {
            return true;
        }
    }
    return false;
}

/// Bounds in longitude and latitude of a border given in the system's units.
Box geographic_bounds(const Tin& tin, const CoordinateTransform& transform, const std::vector<Point3>& border,
                      double degrees) {
    Box box = bounds_of(border);
    std::vector<Point3> in_degrees;
    in_degrees.reserve(border.size());
    for (const Point3& point : border) {
        if (std::abs(point.y) * degrees < 90 - kAtPole) {
            in_degrees.push_back({point.x * degrees, point.y * degrees, 0});
        }
    }
    ExtentGatherer gatherer;
    gatherer.add(in_degrees);
    const GeographicExtent extent = gatherer.extent();
    box.x_min = extent.has_pole ? -180 / degrees : extent.west / degrees;
    box.x_max = extent.has_pole ? 180 / degrees : extent.east / degrees;
    for (const double pole : {-90 / degrees, 90 / degrees}) {
        std::array<Point2, 1> place{Point2{0, pole}};
        transform.inverse(place);
        const Box plane = tin.bounds();
        const bool is_near = place[0].x >= plane.x_min && place[0].x <= plane.x_max &&
                             place[0].y >= plane.y_min && place[0].y <= plane.y_max;
        if (is_near && is_on_terrain(tin, place[0])) {
            box.y_min = std::min(box.y_min, pole);
            box.y_max = std::max(box.y_max, pole);
        }
    }
    return box;
}

/// Units of the system to a unit of the plane: typical of the terrain's vertices.
std::optional<double> find_scale(const Tin& tin, const CoordinateTransform& transform, double spacing,
                                 bool is_geographic) {
    const std::size_t step = std::max<std::size_t>(tin.vertex_count() / kProbes, 1);
    std::vector<Point2> points;
    for (std::size_t v = 0; v < tin.vertex_count(); v += step) {
        const Point3 at = tin.position({static_cast<std::uint32_t>(v)});
        points.insert(points.end(), {{at.x, at.y}, {at.x + spacing, at.y}, {at.x, at.y + spacing}});
    }
    transform.forward(points);
    std::vector<double> scales;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Point2 along_x{points[i + 1].x - points[i].x, points[i + 1].y - points[i].y};
        const Point2 along_y{points[i + 2].x - points[i].x, points[i + 2].y - points[i].y};
        // A step across ground is so many degrees of latitude whatever its direction, but not of longitude.
        const double scale = is_geographic
                                 ? std::hypot(along_x.y, along_y.y)
                                 : std::sqrt(std::abs(along_x.x * along_y.y - along_x.y * along_y.x));
        if (std::isfinite(scale) && scale > 0) {
            scales.push_back(scale / spacing);
        }
    }
    if (scales.empty()) {
        return std::nullopt;
    }
    const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
    std::nth_element(scales.begin(), middle, scales.end());
    return *middle;
}

/// Rounded away from the box to a decimal of at most a thousandth of the spacing: corners of rasters then are
/// numbers that people can read and formats can hold. What is beyond such a decimal by less than a thousandth
/// of its step is so by the way there and back.
Box rounded_outward(const Box& box, double spacing) {
    constexpr double kNoise = 1e-3;
    const int exponent = static_cast<int>(std::floor(std::log10(spacing))) - 3;
    const auto down = [exponent](double value) {
        const double steps = std::floor(value / std::pow(10.0, exponent) + kNoise);
        if (!(std::abs(steps) < 0x1p53)) {
            return value;
        }
        return from_steps(static_cast<Int128>(steps), exponent);
    };
    return {down(box.x_min), down(box.y_min), -down(-box.x_max), -down(-box.y_max)};
}

}  // namespace

GridBasis find_grid_basis(const Tin& tin, const Crs& plane, const Crs& grid_crs) {
    const double spacing = median_spacing(tin);
    if (!(spacing > 0)) {
        throw InputError("the surface has no faces to make a grid of");
    }
    const std::vector<Point3> in_plane = border_points(tin, spacing);
    GeographicExtent extent;
    if (plane.geographic().is_known()) {
        std::vector<Point3> in_degrees = in_plane;
        to_degrees(plane, in_degrees);
        ExtentGatherer gatherer;
        gatherer.add(in_degrees);
        extent = gatherer.extent();
    }
    const CoordinateTransform transform(plane.horizontal(), grid_crs.horizontal(), {.extent = extent});
    const std::vector<Point3> border = transformed(in_plane, transform);
    const std::optional<double> scale = find_scale(tin, transform, spacing, grid_crs.is_geographic());
    if (border.empty() || !scale) {
        throw InputError("no part of the surface, in " + plane.name() + ", has a place in " +
                         grid_crs.name() + "; give another --crs");
    }
    const double own_spacing = spacing * *scale;
    if (!grid_crs.is_geographic()) {
        return {rounded_outward(bounds_of(border), own_spacing), own_spacing};
    }
    const double degrees = degrees_per_unit(grid_crs);
    Box bounds = rounded_outward(geographic_bounds(tin, transform, border, degrees), own_spacing);
    bounds.y_min = std::max(bounds.y_min, -90 / degrees);
    bounds.y_max = std::min(bounds.y_max, 90 / degrees);
    return {bounds, own_spacing};
}

Point2 cell_size_on_ground(const GridGeometry& grid, const Crs& grid_crs) {
    const Box box = grid.extent();
    const double radians = degrees_per_unit(grid_crs) * std::numbers::pi / 180;
    const double latitude = (box.y_min + box.y_max) / 2 * radians;
    const double flattening =
        grid_crs.gdal()->GetInvFlattening() > 0 ? 1 / grid_crs.gdal()->GetInvFlattening() : 0;
    const double eccentricity = flattening * (2 - flattening);  // squared
    const double sine = std::sin(latitude);
    const double w = std::sqrt(1 - eccentricity * sine * sine);
    const double across = grid_crs.gdal()->GetSemiMajor() / w;
    const double along = across * (1 - eccentricity) / (w * w);
    return {grid.cell_width * radians * across * std::cos(latitude), grid.cell_height * radians * along};
}

}  // namespace tinwright::io
