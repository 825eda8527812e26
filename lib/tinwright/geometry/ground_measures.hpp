#ifndef TINWRIGHT_GEOMETRY_GROUND_MEASURES_HPP
#define TINWRIGHT_GEOMETRY_GROUND_MEASURES_HPP

#include <functional>
#include <span>
#include <string>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Lengths of the plane, CRS units, between which lengths on the ground may be either side of a limit.
struct PlaneBand {
    double shorter = 0;  ///< up to it what the plane measures is shorter than the limit on the ground as well
    double longer = 0;   ///< beyond it, longer
};

/// Lengths and areas that people read, of what lies in the plane that is worked in. As it is made they are
/// those of the plane; where the plane only stands for a part of the earth, whoever knows of it puts
/// functions here that measure on the ellipsoid. May be called from several threads at a time.
struct GroundMeasures {
    /// Distance between two positions (CRS units of the plane), in `unit`; empty: that of the plane.
    std::function<double(Point2, Point2)> length_function{};
    /// Area within a ring of positions, its last not repeating the first, whichever way it turns, in `unit`
    /// squared; empty: that of the plane.
    std::function<double(std::span<const Point2>)> area_function{};
    /// "metre" of functions; empty: CRS units.
    std::string unit{};
    /// A bound on how far lengths of the plane, in `unit`, are off, as a part of them, over the data.
    double distortion = 0;
    double plane_unit = 1;  ///< one CRS unit of the plane in `unit`

    /// Whether lengths are others than the plane's.
    [[nodiscard]] bool is_geodesic() const { return static_cast<bool>(length_function); }
    [[nodiscard]] double length(Point2 a, Point2 b) const;
    /// Where only `length_function` can tell whether something is longer than `length`; without such a
    /// function there is no such place.
    [[nodiscard]] PlaneBand band_around(double length) const;
    /// Never negative.
    [[nodiscard]] double area(std::span<const Point2> ring) const;
    /// Along a line.
    [[nodiscard]] double length(std::span<const Point2> line) const;
};

}  // namespace tinwright

#endif
