#ifndef TINWRIGHT_BREAKLINES_MEETING_CONFLICTS_HPP
#define TINWRIGHT_BREAKLINES_MEETING_CONFLICTS_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/breaklines/line_visits.hpp"
#include "tinwright/breaklines/noding.hpp"

/// Which of the places where lines meet are conflicts. Lines that share a point that both have are none.
namespace tinwright {

/// Two visits that make a conflict; the line of `a` has the smaller number, or the same.
struct VisitPair {
    LineConflict::Kind kind;
    const LineVisit* a;
    const LineVisit* b;
};

/// Crossings, self-crossings and touches at a vertex, at most one of each kind. Lines that run along a common
/// edge there overlap instead. Lines that repeat another (see `find_repeated_lines`) are left out.
/// `visits`: in the order of lines. Quadratic in those with a common edge only.
std::vector<VisitPair> find_meetings(std::span<const LineVisit> visits,
                                     std::span<const std::uint32_t> first_alike);

/// For each line the first that visits the same sites in the same or the opposite order, closed lines from
/// any of them on: itself if there is none before it, or if it has no length. O(n log n) for n points.
std::vector<std::uint32_t> find_repeated_lines(const LinePoints& points, const LineNetwork& network);

/// A stretch that two lines, or two parts of one, have in common.
struct SharedStretch {
    std::uint32_t vertex;  ///< its first in curve order
    std::uint32_t line_a;
    std::uint32_t line_b;
};

/// Edges along which the same lines run, or one repeatedly, joined to stretches. `pieces`: ascending. Of more
/// than two lines the first two are named. O(n log n).
std::vector<SharedStretch> find_shared_stretches(std::span<const NodedPiece> pieces);

}  // namespace tinwright

#endif
