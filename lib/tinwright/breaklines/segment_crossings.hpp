#ifndef TINWRIGHT_BREAKLINES_SEGMENT_CROSSINGS_HPP
#define TINWRIGHT_BREAKLINES_SEGMENT_CROSSINGS_HPP

#include <cstdint>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// Where segments cross in points that are ends of neither.
struct SegmentCrossings {
    /// The lattice points nearest to them, one at least for each; in an order that follows from the network.
    std::vector<Key2> keys;
    /// Segments with a crossing that is not on the lattice, ascending.
    std::vector<std::uint32_t> rounded;
    /// Segments that share more with another than an end of both, those above included, ascending. The rest
    /// meet in ends only, unless a site without segments lies on them.
    std::vector<std::uint32_t> meeting;
};

/// Exact. O((n + p) log n) for p pairs of segments whose boxes meet; parallel inside the caller's task arena.
SegmentCrossings find_crossings(const LineNetwork& network);

}  // namespace tinwright

#endif
