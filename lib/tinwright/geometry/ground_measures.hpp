#ifndef TINWRIGHT_GEOMETRY_GROUND_MEASURES_HPP
#define TINWRIGHT_GEOMETRY_GROUND_MEASURES_HPP

#include <functional>
#include <span>
#include <string>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

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

    /// Whether lengths are others than the plane's.
    [[nodiscard]] bool is_geodesic() const { return static_cast<bool>(length_function); }
    [[nodiscard]] double length(Point2 a, Point2 b) const;
    /// Never negative.
    [[nodiscard]] double area(std::span<const Point2> ring) const;
    /// Along a line.
    [[nodiscard]] double length(std::span<const Point2> line) const;
};

}  // namespace tinwright

#endif
