#ifndef TINWRIGHT_BREAKLINES_LINE_SNAPPING_HPP
#define TINWRIGHT_BREAKLINES_LINE_SNAPPING_HPP

#include <cstdint>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"

namespace tinwright {

/// That the points at one location were moved to another location, or onto another line.
struct NearMiss {
    std::uint32_t point;  ///< one of them
    std::uint32_t
        line_a;  ///< the first line there and the first other one where it went, if there is another
    std::uint32_t line_b;  ///< line_a <= line_b
};

struct SnappedLines {
    std::vector<NearMiss> misses;
    /// Points from which segments start that points were moved onto: they are to be led through them.
    std::vector<std::uint32_t> led_from;
};

/// Moves points that are nearer than `distance` (lattice steps, > 0) to other points, or else to another
/// line.
///
/// First each location, in curve order, goes to the nearest one before it that stayed, if one is near. Points
/// of one line count as near each other only if the line has been farther away in between, so that dense
/// points along it stay. Then each location that neither moved nor took in another goes to the lattice point
/// nearest to the nearest place of a line that it is not on, unless it is on another line anyway; the ends of
/// such a segment stay from then on. Each point moves once, by less than `distance` and a step.
/// Independent of the order and the directions of the lines. O(n log n) for distances of the size of the gaps
/// between lines.
SnappedLines snap_lines(LinePoints& points, double distance);

}  // namespace tinwright

#endif
