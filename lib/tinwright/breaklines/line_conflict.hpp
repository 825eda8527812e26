#ifndef TINWRIGHT_BREAKLINES_LINE_CONFLICT_HPP
#define TINWRIGHT_BREAKLINES_LINE_CONFLICT_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// A place where lines, or a line and a sample, do not fit together as they came, and what was done about it.
struct LineConflict {
    enum class Kind : std::uint8_t {
        Crossing,         ///< two lines cross between their points
        SelfCrossing,     ///< a line crosses, or passes through, itself
        Touch,            ///< a point of one line lies on another line between its points
        Overlap,          ///< two lines, or two parts of one, run along the same stretch
        Duplicate,        ///< a whole line repeats another, in either direction
        ZeroLength,       ///< consecutive points at one location
        NearMiss,         ///< a point closer to another line than the snapping distance, but not on it
        ElevationClash,   ///< lines with different z at one location
        SampleOnLine,     ///< a sample on a line, with another z
        SampleNearLine,   ///< a sample closer to a line than the line tolerance, but not on it
        OutsideSamples,   ///< a point to be draped lies where there is no TIN of samples
        OutsideBoundary,  ///< a line, or part of one, outside the boundary
        Dangling,         ///< an end that touches nothing, near another line
        Spike,            ///< a line that turns back on itself
        MissingZ,         ///< a point without elevation
        OpenRing          ///< a ring whose ends do not meet
    };
    enum class Action : std::uint8_t {
        Noded,    ///< the lines share a vertex there
        Merged,   ///< what is there twice is there once
        Dropped,  ///< what has no extent is left out
        Snapped,  ///< moved together
        Chosen,   ///< one elevation taken, by the policy
        Clamped,  ///< elevation of the nearest place that has one
        Reported  ///< nothing
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    Kind kind = Kind::Crossing;
    Action action = Action::Reported;
    /// Index of a line; with two of them, line_a <= line_b, but for Dangling the line that ends there.
    std::uint32_t line_a = kNone;
    std::uint32_t line_b = kNone;
    std::uint32_t sample = kNone;                           ///< index of a sample
    Point2 location;                                        ///< CRS units
    double z_a = std::numeric_limits<double>::quiet_NaN();  ///< of line_a there; NaN: none
    double z_b = std::numeric_limits<double>::quiet_NaN();  ///< of line_b, or of the sample
    /// Index of an earlier sample at the same location, with z_a, where two samples clash.
    std::uint32_t other_sample = kNone;

    static constexpr std::size_t kKinds = 16;
};

/// Number of conflicts of each kind, by the kind's value.
using ConflictCounts = std::array<std::size_t, LineConflict::kKinds>;

inline ConflictCounts count_conflicts(std::span<const LineConflict> conflicts) {
    ConflictCounts counts{};
    for (const LineConflict& conflict : conflicts) {
        ++counts[static_cast<std::size_t>(conflict.kind)];
    }
    return counts;
}

}  // namespace tinwright

#endif
