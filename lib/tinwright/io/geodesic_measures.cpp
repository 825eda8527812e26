#include "tinwright/io/geodesic_measures.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <ogr_spatialref.h>

#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/coordinate_transform.hpp"

namespace tinwright::io {
namespace {

double flattening(const OGRSpatialReference& system) {
    const double inverse = system.GetInvFlattening();
    return inverse == 0 ? 0 : 1 / inverse;  // GDAL's 0 stands for a sphere
}

/// The ellipsoid under a plane. Shared by the functions that measure on it, from any thread.
class Ellipsoid {
  public:
    Ellipsoid(const Crs& plane, const Crs& geographic)
        : to_degrees_(plane, geographic),
          degrees_(degrees_per_unit(geographic)),
          geodesic_(geographic.gdal()->GetSemiMajor(), flattening(*geographic.gdal())) {}

    [[nodiscard]] double length(Point2 a, Point2 b) const {
        std::array<Point2, 2> ends{a, b};
        to_degrees_.forward(ends);
        double metres = 0;
        geodesic_.Inverse(ends[0].y * degrees_, ends[0].x * degrees_, ends[1].y * degrees_,
                          ends[1].x * degrees_, metres);
        return metres;
    }

    [[nodiscard]] double area(std::span<const Point2> ring) const {
        std::vector<Point2> corners(ring.begin(), ring.end());
        to_degrees_.forward(corners);
        GeographicLib::PolygonArea polygon(geodesic_);
        for (const Point2& corner : corners) {
            polygon.AddPoint(corner.y * degrees_, corner.x * degrees_);
        }
        double perimeter = 0;
        double area = 0;
        polygon.Compute(false, true, perimeter, area);  // signed: of the two sides the smaller one
        return std::abs(area);
    }

  private:
    CoordinateTransform to_degrees_;
    double degrees_;  // in an angular unit
    GeographicLib::Geodesic geodesic_;
};

}  // namespace

GroundMeasures make_ground_measures(const WorkingPlane& plane) {
    if (!plane.is_source_geographic()) {
        return {};
    }
    GroundMeasures measures = make_geodesic_measures(plane.crs);
    if (measures.is_geodesic()) {
        measures.distortion = plane.scale.distortion() + plane.scale.uncertainty();
    }
    return measures;
}

GroundMeasures make_geodesic_measures(const Crs& plane) {
    if (!plane.is_plane()) {
        return {};
    }
    const Crs geographic = plane.geographic();
    if (!geographic.is_known()) {
        return {};
    }
    const auto ellipsoid = std::make_shared<const Ellipsoid>(plane.horizontal(), geographic);
    GroundMeasures measures;
    measures.length_function = [ellipsoid](Point2 a, Point2 b) { return ellipsoid->length(a, b); };
    measures.area_function = [ellipsoid](std::span<const Point2> ring) { return ellipsoid->area(ring); };
    measures.unit = "metre";
    measures.plane_unit = plane.metres_per_unit();
    measures.distortion = std::numeric_limits<double>::infinity();
    return measures;
}

}  // namespace tinwright::io
