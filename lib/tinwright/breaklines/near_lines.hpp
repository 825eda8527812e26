#ifndef TINWRIGHT_BREAKLINES_NEAR_LINES_HPP
#define TINWRIGHT_BREAKLINES_NEAR_LINES_HPP

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

/// Parts of the audit of lines (line_check.hpp): what is near a line without being part of it. Locations are
/// left to the caller. All O(n log n) in practice, parallel inside the caller's task arena; the order of what
/// is found does not depend on the number of threads.
namespace tinwright {

/// A conflict whose location is not filled in yet.
struct FoundConflict {
    LineConflict conflict;
    Key2 key{};
};

/// A point of a line.
struct LinePoint {
    std::uint32_t line;
    std::uint32_t index;
    friend auto operator<=>(const LinePoint&, const LinePoint&) = default;
};

/// A place where a point comes near another line that it is not on: the nearest place of that line.
struct Approach {
    LinePoint point{};
    LineSegments::Segment segment{};
    SegmentDistance distance;
    std::optional<LinePoint> vertex;  ///< the nearer end of the segment, if that is within the distance too
};

/// All points at most `distance` (in keys, > 0) from another line, by point, then other line.
std::vector<Approach> find_approaches(std::span<const CleanLine> lines, const LineSegments& segments,
                                      double distance);

/// Whether a line's own ends are apart, and at most `distance` (in keys).
bool has_gap(const CleanLine& line, double distance);

/// NearMiss: points at most `distance` (in keys, > 0) from another line.
std::vector<FoundConflict> find_near_misses(std::span<const CleanLine> lines, const LineSegments& segments,
                                            double distance);

/// Dangling: ends of lines that touch nothing, and would reach another line within `reach` (in keys, > 0).
/// Lines for which `is_ring` is set have no ends.
std::vector<FoundConflict> find_dangling_ends(std::span<const CleanLine> lines,
                                              const std::vector<bool>& is_ring, const LineSegments& segments,
                                              double reach);

struct SampleRule {
    double z_tolerance = 0;  ///< elevations that differ by at most this agree
    double distance = 0;     ///< in keys; samples closer to a line than this, but not on it, are listed
};

/// SampleOnLine where z differs, and SampleNearLine. `keys`: one a sample.
std::vector<FoundConflict> find_samples_at_lines(std::span<const Point3> samples, std::span<const Key2> keys,
                                                 const LineSegments& segments, const SampleRule& rule);

}  // namespace tinwright

#endif
