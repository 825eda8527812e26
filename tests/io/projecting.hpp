#ifndef TINWRIGHT_TESTS_IO_PROJECTING_HPP
#define TINWRIGHT_TESTS_IO_PROJECTING_HPP

#include <cmath>
#include <memory>
#include <numbers>

#include <ogr_spatialref.h>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/crs.hpp"

namespace tinwright_tests {

/// From longitudes and latitudes, degrees, of a projected system's own datum to that system, by GDAL.
class Projecting {
  public:
    explicit Projecting(const tinwright::io::Crs& plane) : geographic_(plane.gdal()->CloneGeogCS()) {
        geographic_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        units_ = std::numbers::pi / 180 / geographic_->GetAngularUnits();
        transform_.reset(OGRCreateCoordinateTransformation(geographic_.get(), plane.gdal()));
    }

    tinwright::Point2 operator()(double longitude, double latitude) {
        double x = longitude * units_;
        double y = latitude * units_;
        int is_done = 0;
        transform_->Transform(1, &x, &y, nullptr, nullptr, &is_done);
        return is_done != 0 ? tinwright::Point2{x, y} : tinwright::Point2{std::nan(""), std::nan("")};
    }

  private:
    struct Release {
        void operator()(OGRSpatialReference* system) const { system->Release(); }
    };
    std::unique_ptr<OGRSpatialReference, Release> geographic_;
    std::unique_ptr<OGRCoordinateTransformation> transform_;
    double units_ = 1;
};

}  // namespace tinwright_tests

#endif
