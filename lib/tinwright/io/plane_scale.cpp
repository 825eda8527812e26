#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {
namespace {

constexpr double kRadian = std::numbers::pi / 180;  // times degrees

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

/// What a projected system does to lengths, by its differences over short steps.
class ScaleReader {
  public:
    /// `plane` is a projected system, without a vertical part. Throws InputError when PROJ knows no way to
    /// it.
    ScaleReader(const Crs& plane, const Crs& geographic)
        : project_(geographic, plane),
          units_(1 / degrees_per_unit(geographic)),
          metres_(plane.gdal()->GetLinearUnits()),
          radius_(plane.gdal()->GetSemiMajor()) {
        const double inverse_flattening = plane.gdal()->GetInvFlattening();
        const double f = inverse_flattening == 0 ? 0 : 1 / inverse_flattening;  // 0 stands for a sphere
        e2_ = f * (2 - f);
    }

    /// The greatest and least factor at each of `places`, degrees; not finite where they cannot be told.
    [[nodiscard]] std::vector<ScaleRange> scales_at(std::span<const Point2> places) const {
        std::vector<Point2> ends;
        ends.reserve(4 * places.size());
        const double step = units_ * kStep / kRadian;
        for (const Point2& place : places) {
            const double x = units_ * place.x;
            const double y = units_ * away_from_poles(place.y);
            ends.insert(ends.end(), {{x - step, y}, {x + step, y}, {x, y - step}, {x, y + step}});
        }
        project_.forward(ends);
        std::vector<ScaleRange> scales;
        scales.reserve(places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            scales.push_back(
                scale_of(std::span(ends).subspan(4 * i).first<4>(), away_from_poles(places[i].y)));
        }
        return scales;
    }

  private:
    static double away_from_poles(double latitude) {
        return std::clamp(latitude, kPoleDistance - 90, 90 - kPoleDistance);
    }

    /// By what has become of a step west, east, south and north.
    [[nodiscard]] ScaleRange scale_of(std::span<const Point2, 4> ends, double latitude) const {
        // Radii of curvature: of the parallel, and along the meridian.
        const double sine = std::sin(latitude * kRadian);
        const double w2 = 1 - e2_ * sine * sine;
        const double parallel = radius_ / std::sqrt(w2) * std::cos(latitude * kRadian);
        const double meridian = radius_ * (1 - e2_) / (w2 * std::sqrt(w2));
        // Columns of the derivative: what becomes of a metre east and of a metre north.
        const double a = (ends[1].x - ends[0].x) * metres_ / (2 * kStep * parallel);
        const double c = (ends[1].y - ends[0].y) * metres_ / (2 * kStep * parallel);
        const double b = (ends[3].x - ends[2].x) * metres_ / (2 * kStep * meridian);
        const double d = (ends[3].y - ends[2].y) * metres_ / (2 * kStep * meridian);
        // Its singular values are the semi-axes of Tissot's ellipse.
        const double turn = std::hypot(a + d, b - c);
        const double flip = std::hypot(a - d, b + c);
        return {std::abs(turn - flip) / 2, (turn + flip) / 2};
    }

    CoordinateTransform project_;
    double units_;   // the geographic system's in a degree
    double metres_;  // in a unit of the plane
    double radius_;  // equatorial, metres
    double e2_ = 0;  // eccentricity, squared
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
bool add_net(const ScaleReader& reader, const Frame& frame, std::size_t n, Extremes& extremes) {
    const auto between = [n](double from, double to, std::size_t i) {
        return from + (to - from) * (static_cast<double>(i) / static_cast<double>(n - 1));
    };
    std::vector<Point2> places;
    for (std::size_t i = 0; i < n * n; ++i) {
        places.push_back({between(frame.west, frame.east, i % n), between(frame.south, frame.north, i / n)});
    }
    const std::vector<ScaleRange> scales = reader.scales_at(places);
    for (std::size_t i = 0; i < scales.size(); ++i) {
        if (!std::isfinite(scales[i].greatest)) {
            return false;
        }
        if (scales[i].least < extremes.scale.least) {
            extremes.scale.least = scales[i].least;
            extremes.least_at = places[i];
        }
        if (scales[i].greatest > extremes.scale.greatest) {
            extremes.scale.greatest = scales[i].greatest;
            extremes.greatest_at = places[i];
        }
    }
    return true;
}

/// The part of `frame` around a place, so far each way.
Frame around(Point2 place, double width, double height, const Frame& frame) {
    return {std::max(frame.west, place.x - width), std::min(frame.east, place.x + width),
            std::max(frame.south, place.y - height), std::min(frame.north, place.y + height)};
}

/// Nets over `frame`, then around the extremes found so far. False when a place cannot be projected.
bool find_extremes(const ScaleReader& reader, const Frame& frame, Extremes& extremes) {
    if (!add_net(reader, frame, kNet, extremes)) {
        return false;
    }
    double width = (frame.east - frame.west) / (kNet - 1);
    double height = (frame.north - frame.south) / (kNet - 1);
    for (int i = 0; i < kFineNets; ++i) {
        const Frame least = around(extremes.least_at, width, height, frame);
        const Frame greatest = around(extremes.greatest_at, width, height, frame);
        if (!add_net(reader, least, kFineNet, extremes) || !add_net(reader, greatest, kFineNet, extremes)) {
            return false;
        }
        width *= 2.0 / (kFineNet - 1);
        height *= 2.0 / (kFineNet - 1);
    }
    return true;
}

}  // namespace

double ScaleRange::distortion() const { return std::max(std::abs(least - 1), std::abs(greatest - 1)); }

double ScaleRange::uncertainty() const { return (greatest - least) / 250 + 1e-8; }

std::optional<ScaleRange> find_scale_range(const Crs& crs, const GeographicExtent& extent) {
    const Crs plane = crs.horizontal();
    const Crs geographic = crs.geographic();
    if (extent.is_empty || !geographic.is_known() || plane.gdal()->IsProjected() == 0) {
        return std::nullopt;
    }
    try {
        const ScaleReader reader(plane, geographic);
        Extremes extremes;
        if (find_extremes(reader, {extent.west, extent.east, extent.south, extent.north}, extremes)) {
            return extremes.scale;
        }
    } catch (const InputError&) {  // no way to it: no scale either
    }
    return std::nullopt;
}

}  // namespace tinwright::io
