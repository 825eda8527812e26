#ifndef TINWRIGHT_BREAKLINES_POINT_JOINING_HPP
#define TINWRIGHT_BREAKLINES_POINT_JOINING_HPP

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tinwright/breaklines/keyed_lines.hpp"

namespace tinwright {

/// A point to be put into a segment of a line.
struct PointInsertion {
    std::uint32_t line;
    std::uint32_t segment;  ///< index of its first point
    double fraction;        ///< of the way to its second point: the order of several in one segment
    Key2 key;
    double z;
};

/// Puts points into lines. O(n log n).
void insert_points(std::span<CleanLine> lines, std::vector<PointInsertion> insertions);

/// Joins what a near miss keeps apart, one step of it: points of different lines no farther than `keyed.snap`
/// from each other become one, at the place of the one that is first along the curve; where there are none,
/// lines are led through the points that are near them. The ends of a line that nearly meet do. Elevations
/// stay with their points. Returns whether there was anything to do. Lines may have repeated points
/// afterwards.
bool snap_near_misses(KeyedLines& keyed);

}  // namespace tinwright

#endif
