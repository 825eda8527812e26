#ifndef TINWRIGHT_GEOMETRY_POINT_HPP
#define TINWRIGHT_GEOMETRY_POINT_HPP

namespace tinwright {

/// A position in the plane, in units of the coordinate reference system.
struct Point2 {
    double x = 0;
    double y = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
};

/// A sample: position in units of the coordinate reference system, elevation `z` in its own unit.
struct Point3 {
    double x = 0;
    double y = 0;
    double z = 0;
    friend bool operator==(const Point3&, const Point3&) = default;
};

}  // namespace tinwright

#endif
