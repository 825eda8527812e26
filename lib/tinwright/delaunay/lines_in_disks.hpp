#ifndef TINWRIGHT_DELAUNAY_LINES_IN_DISKS_HPP
#define TINWRIGHT_DELAUNAY_LINES_IN_DISKS_HPP

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/delaunay/blocking_disks.hpp"

namespace tinwright {

/// An edge of a line, from p to q, and the disks that it passes through.
struct LineInDisks {
    VertexId p{};
    VertexId q{};
    double length = 0;          ///< steps of the lattice
    std::vector<Chord> chords;  ///< the protected parts, in their order
    std::uint32_t first = 0;    ///< its unprotected edges, in their order, from this one on
    std::uint32_t last = 0;     ///< to before this one
};

/// A part of an edge of a line outside all disks: an unprotected edge of [tan1993, Sec. 6.2.1].
struct UnprotectedEdge {
    std::uint32_t line_edge = 0;
    std::uint32_t gap = 0;  ///< it lies before the chord of this index, the last one behind all of them
    double from = 0;        ///< shares of the way from p to q
    double to = 1;
    std::uint32_t from_disk = 0;  ///< the disk on whose circle it begins
    std::uint32_t to_disk = 0;
};

/// Protected and unprotected parts of the edges of lines. Parts shorter than a step of the lattice, where no
/// vertex can be between two others, are none.
struct LinesInDisks {
    std::vector<LineInDisks> edges;
    std::vector<UnprotectedEdge> unprotected;
    /// The places where disks touch the earlier one that they name, but not where a line passes there, where
    /// it has a vertex anyway; ascending numbers of disks that are not full.
    std::vector<std::uint32_t> touching;
};

/// `line_edges`: pairs of vertices. Those for which `is_left_alone` (one flag an edge) have no parts at all.
LinesInDisks find_lines_in_disks(const BlockingDisks& disks, std::span<const Key2> keys,
                                 std::span<const std::pair<VertexId, VertexId>> line_edges,
                                 const std::vector<bool>& is_left_alone);

}  // namespace tinwright

#endif
