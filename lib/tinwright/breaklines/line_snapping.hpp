#ifndef TINWRIGHT_BREAKLINES_LINE_SNAPPING_HPP
#define TINWRIGHT_BREAKLINES_LINE_SNAPPING_HPP

#include <cstdint>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"

namespace tinwright {

/// That the points at one location were moved to where another line is.
struct NearMiss {
    std::uint32_t point;   ///< one of them
    std::uint32_t line_a;  ///< the lines with the smallest numbers at both, line_a <= line_b
    std::uint32_t line_b;
};

struct SnappedLines {
    std::vector<NearMiss> misses;
    /// Points from which a segment starts that points were moved onto: it is to be led through them.
    std::vector<std::uint32_t> led_from;
};

/// Moves points that are nearer than `distance` (lattice steps, > 0) to a point of another line, or of their
/// own after the line has been farther away, to one location; what is near no such point, but to a line, to
/// the lattice point nearest to the nearest place there. Each point moves once, by less than `distance` and a
/// step. Decided in curve order of the locations, hence whatever the order and directions of the lines.
SnappedLines snap_lines(LinePoints& points, double distance);

}  // namespace tinwright

#endif
