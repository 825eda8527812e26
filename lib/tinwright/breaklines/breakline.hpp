#ifndef TINWRIGHT_BREAKLINES_BREAKLINE_HPP
#define TINWRIGHT_BREAKLINES_BREAKLINE_HPP

#include <cstdint>
#include <limits>
#include <vector>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// What a line is there for.
enum class LineRole : std::uint8_t {
    Breakline,  ///< the surface follows it
    Boundary,   ///< ring of a polygon; outside all such polygons is no terrain
    Hole        ///< ring of a polygon; inside it is no terrain
};

/// `z` of a line's point whose elevation is to be taken from the samples' TIN.
inline constexpr double kDraped = std::numeric_limits<double>::quiet_NaN();

/// A line as it came in: a polyline of two points or more, or the ring of a polygon.
struct Breakline {
    /// CRS units; x and y finite, z finite or `kDraped`. A ring repeats its first point at its end.
    std::vector<Point3> points;
    LineRole role = LineRole::Breakline;
    /// Whether smooth interpolators break the surface's normal across it; nothing to a plain TIN.
    bool is_sharp = true;
    /// Boundary, Hole, and rings of polygons taken as breaklines: rings with the same number belong to one
    /// polygon; a place is inside it if an odd number of its rings goes around it, so inner rings are
    /// islands.
    std::uint32_t polygon = 0;
};

}  // namespace tinwright

#endif
