#ifndef TINWRIGHT_BREAKLINES_SEGMENT_CROSSINGS_HPP
#define TINWRIGHT_BREAKLINES_SEGMENT_CROSSINGS_HPP

#include <cstdint>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// Two segments that cross in a point that is an end of neither.
struct SegmentCrossing {
    Key2 key;         ///< the lattice point nearest to it
    std::uint32_t a;  ///< indices of the segments, a < b
    std::uint32_t b;
    bool is_exact;  ///< whether they cross in that very point
};

/// All crossings, each once, in an order that follows from the network alone. Exact.
/// O((n + p) log n) for p pairs of segments whose boxes meet; parallel inside the caller's task arena.
std::vector<SegmentCrossing> find_crossings(const LineNetwork& network);

}  // namespace tinwright

#endif
