#ifndef TINWRIGHT_BREAKLINES_SNAP_ROUNDING_HPP
#define TINWRIGHT_BREAKLINES_SNAP_ROUNDING_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/breaklines/segment_crossings.hpp"
#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// Segments as chains of vertices that meet in vertices only.
struct RoundedSegments {
    std::vector<Key2> vertices;          ///< distinct, in curve order: the sites and the crossings
    std::vector<std::uint32_t> of_site;  ///< the vertex at each site
    std::vector<std::uint32_t> start;    ///< where each segment's chain begins; one entry more than segments
    std::vector<std::uint32_t> chains;   ///< vertices from end a to end b, both included
    bool is_rounded = false;             ///< whether any chain leaves its segment

    [[nodiscard]] std::span<const std::uint32_t> chain(std::uint32_t segment) const {
        return std::span(chains).subspan(start[segment], start[segment + 1] - start[segment]);
    }
};

/// Leads segments through lattice points so that no two chains cross or touch between vertices, and no chain
/// leaves its segment by more than half a step in x and in y.
///
/// Sites and crossings are hot. Plain snap rounding leads every segment through the hot lattice points whose
/// squares it passes; then none cross [hobby1999; guibas1998]. Here only those are led that have to be:
/// the segments with a crossing that was rounded, those in `led` (indices), and any segment that would cross
/// one of them otherwise. A segment that is not led stays straight and gets the vertices that lie on it.
///
/// This suffices. Let a led segment's part from a square A to the next hot square B, straightened to the
/// edge from A's centre to B's, newly cross a straight segment e. What lies between part and edge contains no
/// hot lattice point, since the part would pass its square; so e does not end there but leaves it, and not
/// across the part itself, as crossings that were not rounded are vertices: e passes A or B off the centre,
/// and so does the part. Hence only squares that led segments pass off their centre have to be looked at, and
/// segments that meet no other are compared with those alone.
///
/// O((n + k) log n) for n segments and k hot points in practice; parallel inside the caller's task arena.
RoundedSegments round_segments(const LineNetwork& network, const SegmentCrossings& crossings,
                               std::span<const std::uint32_t> led = {});

}  // namespace tinwright

#endif
