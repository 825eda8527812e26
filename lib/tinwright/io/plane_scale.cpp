#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include <ogr_spatialref.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Central differences are taken over so many radians: a few hundred metres, where third derivatives cost some
// 1e-9 of the scale and PROJ's rounding (nanometres) less.
constexpr double kStep = 1e-4;
// Nearer to a pole than this (degrees) a meridian's step would cross it.
constexpr double kPoleDistance = 0.01;

// The net has so many meridians and parallels, an odd number so that the middle is on it; around its extremes
// finer ones are laid, one after the other.
constexpr std::size_t kNet = 25;
constexpr std::size_t kFineNet = 9;
constexpr int kFineNets = 2;

/// The way from longitudes and latitudes, degrees, to a plane in metres, and what it does to lengths.
class ScaleReader {
  public:
    /// `plane` is a projected system, without a vertical part.
    explicit ScaleReader(const OGRSpatialReference& plane)
        : geographic_(plane.CloneGeogCS()), radius_(plane.GetSemiMajor()), metres_(plane.GetLinearUnits()) {
        const double inverse_flattening = plane.GetInvFlattening();
        const double f = inverse_flattening == 0 ? 0 : 1 / inverse_flattening;  // 0 stands for a sphere
        e2_ = f * (2 - f);
        if (geographic_ != nullptr) {
            geographic_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
            units_ = 1 / geographic_->GetAngularUnits();
            transform_.reset(OGRCreateCoordinateTransformation(geographic_.get(), &plane));
        }
    }

    [[nodiscard]] bool is_open() const { return transform_ != nullptr; }

    /// The greatest and least factor at a place, degrees; nothing where it cannot be projected.
    std::optional<ScaleRange> scale_at(Point2 place) {
        const double longitude = place.x * kDegree;
        const double latitude = std::clamp(place.y, kPoleDistance - 90, 90 - kPoleDistance) * kDegree;
        std::array<double, 4> x{longitude - kStep, longitude + kStep, longitude, longitude};
        std::array<double, 4> y{latitude, latitude, latitude - kStep, latitude + kStep};
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] *= units_;
            y[i] *= units_;
        }
        std::array<int, 4> is_done{};
        transform_->Transform(4, x.data(), y.data(), nullptr, nullptr, is_done.data());
        if (std::find(is_done.begin(), is_done.end(), 0) != is_done.end()) {
            return std::nullopt;
        }
        // Radii of curvature: of the parallel, and along the meridian.
        const double sine = std::sin(latitude);
        const double w2 = 1 - e2_ * sine * sine;
        const double parallel = radius_ / std::sqrt(w2) * std::cos(latitude);
        const double meridian = radius_ * (1 - e2_) / (w2 * std::sqrt(w2));
        // Columns: what becomes of a metre east and of a metre north.
        const double a = (x[1] - x[0]) * metres_ / (2 * kStep * parallel);
        const double c = (y[1] - y[0]) * metres_ / (2 * kStep * parallel);
        const double b = (x[3] - x[2]) * metres_ / (2 * kStep * meridian);
        const double d = (y[3] - y[2]) * metres_ / (2 * kStep * meridian);
        // Its singular values are the semi-axes of Tissot's ellipse.
        const double turn = std::hypot(a + d, b - c);
        const double flip = std::hypot(a - d, b + c);
        const ScaleRange scale{std::abs(turn - flip) / 2, (turn + flip) / 2};
        return std::isfinite(scale.greatest) ? std::optional(scale) : std::nullopt;
    }

  private:
    struct Destroy {
        void operator()(OGRSpatialReference* system) const { system->Release(); }
    };
    std::unique_ptr<OGRSpatialReference, Destroy> geographic_;
    std::unique_ptr<OGRCoordinateTransformation> transform_;
    double radius_;     // equatorial, metres
    double metres_;     // in a unit of the plane
    double e2_ = 0;     // eccentricity, squared
    double units_ = 1;  // the geographic system's in a radian
};

/// A part of the earth as a net sees it, degrees.
struct Frame {
    double west = 0;
    double east = 0;
    double south = 0;
    double north = 0;
};

struct Extremes {
    ScaleRange scale{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    Point2 least_at;
    Point2 greatest_at;
};

/// Looks at a net of n by n places. False when one of them cannot be projected.
bool add_net(ScaleReader& reader, const Frame& frame, std::size_t n, Extremes& extremes) {
    const auto between = [n](double from, double to, std::size_t i) {
        const double t = static_cast<double>(i) / static_cast<double>(n - 1);
        return from + (to - from) * t;
    };
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column < n; ++column) {
            const Point2 place{between(frame.west, frame.east, column),
                               between(frame.south, frame.north, row)};
            const std::optional<ScaleRange> scale = reader.scale_at(place);
            if (!scale) {
                return false;
            }
            if (scale->least < extremes.scale.least) {
                extremes.scale.least = scale->least;
                extremes.least_at = place;
            }
            if (scale->greatest > extremes.scale.greatest) {
                extremes.scale.greatest = scale->greatest;
                extremes.greatest_at = place;
            }
        }
    }
    return true;
}

/// The part of `frame` around a place, so far each way.
Frame around(Point2 place, double width, double height, const Frame& frame) {
    return {std::max(frame.west, place.x - width), std::min(frame.east, place.x + width),
            std::max(frame.south, place.y - height), std::min(frame.north, place.y + height)};
}

}  // namespace

double ScaleRange::distortion() const { return std::max(std::abs(least - 1), std::abs(greatest - 1)); }

double ScaleRange::uncertainty() const { return (greatest - least) / 250 + 1e-8; }

std::optional<ScaleRange> find_scale_range(const Crs& crs, const GeographicExtent& extent) {
    const Crs plane = crs.horizontal();
    if (extent.is_empty || !plane.is_known() || plane.gdal()->IsProjected() == 0) {
        return std::nullopt;
    }
    const GdalMessages messages;
    ScaleReader reader(*plane.gdal());
    const Frame frame{extent.west, extent.east, extent.south, extent.north};
    Extremes extremes;
    if (!reader.is_open() || !add_net(reader, frame, kNet, extremes)) {
        return std::nullopt;
    }
    double width = (frame.east - frame.west) / (kNet - 1);
    double height = (frame.north - frame.south) / (kNet - 1);
    for (int i = 0; i < kFineNets; ++i) {
        const Frame least = around(extremes.least_at, width, height, frame);
        const Frame greatest = around(extremes.greatest_at, width, height, frame);
        if (!add_net(reader, least, kFineNet, extremes) || !add_net(reader, greatest, kFineNet, extremes)) {
            return std::nullopt;
        }
        width *= 2.0 / (kFineNet - 1);
        height *= 2.0 / (kFineNet - 1);
    }
    return extremes.scale;
}

}  // namespace tinwright::io
