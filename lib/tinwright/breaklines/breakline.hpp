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
    Hole,       ///< ring of a polygon; inside it is no terrain
    Lake,       ///< ring of a polygon of standing water: nothing but water inside it
    Bank,       ///< ring of a polygon of running water: nothing but water and sections inside it
    River,      ///< middle of running water
    Section     ///< from bank to bank; `Breakline::polygon` is that of the banks
};

/// "breakline", "boundary", ...: as in files and reports.
const char* role_name(LineRole role);

/// Whether lines of the role are rings of polygons.
constexpr bool is_polygon_role(LineRole role) {
    return role != LineRole::Breakline && role != LineRole::River && role != LineRole::Section;
}

/// Whether lines of the role stand for water. Where they meet other lines or samples, the elevation is
/// theirs.
constexpr bool is_water_role(LineRole role) { return role >= LineRole::Lake; }

/// Whether a polygon of the role is kept clear: samples, breaklines and rivers inside it count for nothing.
constexpr bool is_cleared_role(LineRole role) { return role == LineRole::Lake || role == LineRole::Bank; }

/// `z` of a line's point whose elevation is to be taken from the samples' TIN.
inline constexpr double kDraped = std::numeric_limits<double>::quiet_NaN();

/// A line as it came in: a polyline of two points or more, or the ring of a polygon.
struct Breakline {
    /// CRS units; x and y finite, z finite or `kDraped`. A ring repeats its first point at its end.
    std::vector<Point3> points;
    LineRole role = LineRole::Breakline;
    /// Whether smooth interpolators break the surface's normal across it; nothing to a plain TIN.
    bool is_sharp = true;
    /// Roles of polygons, and rings of polygons taken as breaklines: rings with the same number belong to one
    /// polygon; a place is inside it if an odd number of its rings goes around it, so inner rings are
    /// islands.
    std::uint32_t polygon = 0;
};

}  // namespace tinwright

#endif
