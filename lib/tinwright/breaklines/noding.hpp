#ifndef TINWRIGHT_BREAKLINES_NODING_HPP
#define TINWRIGHT_BREAKLINES_NODING_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/progress.hpp"

namespace tinwright {

/// Which elevation a location gets where lines with different z meet.
enum class CrossingPolicy { Error, Mean, First, Min, Max };

struct NodingOptions {
    CrossingPolicy crossing_z = CrossingPolicy::Error;
    /// Elevations that differ by at most this (unit of z, >= 0) do not clash; their mean is taken.
    double crossing_tolerance = 0;
    /// Points of lines closer than this (CRS units, >= 0) to another line's point, else to another line, are
    /// moved together; 0: nothing is moved.
    double snap = 0;
    bool keep_chains = false;  ///< fills `NodedLines::chains`
    Progress progress;
};

/// A straight part of a line between two vertices that it shares with whatever it meets there.
struct NodedPiece {
    std::uint32_t a = 0;  ///< index of a vertex, a < b
    std::uint32_t b = 0;
    std::uint32_t line = 0;  ///< index of the line it is part of
    std::uint32_t runs = 1;  ///< how often the line runs along it, in either direction
    friend auto operator<=>(const NodedPiece&, const NodedPiece&) = default;
};

/// Lines cut into pieces that meet at their ends only (several lines may run along one piece).
struct NodedLines {
    /// `origin` of a vertex that is no line's point: one made where lines cross.
    static constexpr std::uint32_t kCrossing = 0xFFFFFFFFU;

    std::vector<Key2> keys;  ///< on the lattice handed in, distinct, in curve order (geometry/curve.hpp)
    std::vector<double> z;   ///< one a key; `kDraped` where no line has one
    /// The first point of a line at each key, points counted through all lines in the order given.
    std::vector<std::uint32_t> origin;
    std::vector<NodedPiece> pieces;       ///< by a, b, line; each triple once
    std::vector<LineConflict> conflicts;  ///< by location in curve order, then kind
    bool is_rounded = false;  ///< whether a piece leaves its line, to have its ends on the lattice
    /// Only if asked for: vertices along line i in its direction, consecutive ones different, are
    /// chains[chain_start[i]] up to chains[chain_start[i + 1]], the latter excluded. A line without length
    /// has one vertex, a line without points none.
    std::vector<std::uint32_t> chains;
    std::vector<std::uint32_t> chain_start;
};

/// Cuts lines where they meet: crossings, touching ends, overlaps, duplicates, lines through themselves,
/// points on other lines, parts without length.
///
/// `lattice` is the one that vertices come to lie on (every line's point already does); crossings are found
/// exactly and rounded to it. Segments with a rounded crossing, and any that would cross one of them for
/// that, are led through the lattice squares that they pass, as snap rounding does [hobby1999; guibas1998],
/// so that every piece stays within half a step (in x and in y) of its segment and no two pieces cross. All
/// others stay exactly as they were.
///
/// Elevations: of a line's point its z, else linear along the segment; draped lines take those of others,
/// and so do all lines where they meet water (such a conflict is listed, but no error).
/// Differences that come of rounding do not count, except between points: a part in 10^12 and, where lines
/// were bent, two lattice steps up the steepest segment there. Lines that share points with one z have no
/// conflict.
///
/// Vertices, elevations and pieces do not depend on the order and the directions of the lines, policy First
/// aside; line numbers do as far as they must. Conflicts are one a kind and place, of the lines with the
/// smallest numbers, but for ZeroLength and Duplicate, which name each line; stretches of an Overlap count as
/// one place. Throws BreaklineError under policy Error where elevations clash; InputError for more than 2^29
/// points. O((n + k) log n) for n points and k crossings in practice; parallel inside the caller's task
/// arena.
NodedLines node_lines(std::span<const Breakline> lines, const Lattice& lattice,
                      const NodingOptions& options = {});

}  // namespace tinwright

#endif
