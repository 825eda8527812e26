#ifndef TINWRIGHT_BREAKLINES_LINE_REPAIR_HPP
#define TINWRIGHT_BREAKLINES_LINE_REPAIR_HPP

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_check.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/point.hpp"

namespace tinwright {

struct LineRepairOptions {
    LineCheckOptions check;  ///< what counts as a conflict; `snap` is also how far points are moved
    /// Which elevation a location gets where points with different z meet there.
    CrossingPolicy crossing_z = CrossingPolicy::Mean;
    /// Elevation at a location in CRS units, for points that lack z; empty: they stay without, as those of
    /// lines do that are to be draped later (`LineTraits::is_draped`).
    std::function<double(Point2)> drape;
};

struct LineRepair {
    /// What became of each line: parts of two points or more, in its order and direction; none when it has
    /// no extent or is there already. Rings are whole, or none.
    std::vector<std::vector<std::vector<Point3>>> lines;
    LineCheckReport found;  ///< of the lines as they came
    LineCheckReport left;   ///< of the repaired ones, by the numbers of the lines as they came
    std::size_t rounds = 0;
};

/// Whether a repair puts right what an audit has found: not so for dangling ends, samples, lines outside the
/// boundary, and elevations that are missing.
bool is_repairable(const LineConflict& conflict);

/// Puts lines right so that an audit with the same options finds nothing repairable any more.
///
/// Points without extent are merged, spikes cut off and rings closed as `clean_line` does, near misses
/// joined, crossings and touches made points of all lines concerned, and what runs along a line a second time
/// left out: of lines the stretch, of polygons only the whole repetition. Points without z are draped where
/// that is asked for, samples on such a line becoming points of it. Where cutting and joining makes new
/// conflicts all is done again, a few rounds at most; what then remains is in `left`.
/// Throws as `check_lines` and `node_lines` do; BreaklineError under policy Error where elevations differ.
LineRepair repair_lines(std::span<const Breakline> lines, std::span<const Point3> samples,
                        const LineRepairOptions& options);

}  // namespace tinwright

#endif
