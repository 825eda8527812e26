#ifndef TINWRIGHT_BREAKLINES_LINE_OVERLAPS_HPP
#define TINWRIGHT_BREAKLINES_LINE_OVERLAPS_HPP

#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/keyed_lines.hpp"
#include "tinwright/breaklines/near_lines.hpp"
#include "tinwright/breaklines/noding.hpp"

namespace tinwright {

/// Overlap and Duplicate without what lines may share as neighbours do, two parcels for instance, or a
/// boundary along a breakline: lines of different roles, and rings of different polygons that are not the
/// same, where all that they have in common goes from point to point of both.
/// `noded`: `keyed` noded without snapping. Stretches that more than two lines share count once. O(n log n).
std::vector<FoundConflict> find_overlaps(const KeyedLines& keyed, std::span<const Breakline> lines,
                                         const NodedLines& noded);

}  // namespace tinwright

#endif
