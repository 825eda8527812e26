#ifndef TINWRIGHT_BREAKLINES_SQUARE_PASSES_HPP
#define TINWRIGHT_BREAKLINES_SQUARE_PASSES_HPP

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

/// The ends of a segment.
struct SegmentKeys {
    Key2 a;
    Key2 b;
};

/// That a segment passes the square of a vertex which is none of its ends, or touches its corner.
struct VertexPass {
    std::uint32_t vertex;
    std::uint32_t segment;
    SquarePass kind;
};

/// All passes, ascending by vertex, then segment. `vertices` are distinct and in curve order. Exact.
/// Vertices are halved along the curve, segments handed down to the halves whose box they pass, until few of
/// either are left: O((n + k) log k + p) in practice for n segments, k vertices and p passes; parallel inside
/// the caller's task arena.
std::vector<VertexPass> find_passes(std::span<const Key2> vertices, std::span<const SegmentKeys> segments);

}  // namespace tinwright

#endif
