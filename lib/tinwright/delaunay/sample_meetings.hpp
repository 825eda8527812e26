#ifndef TINWRIGHT_DELAUNAY_SAMPLE_MEETINGS_HPP
#define TINWRIGHT_DELAUNAY_SAMPLE_MEETINGS_HPP

#include <cstdint>
#include <vector>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// A sample's vertex with a line through it.
struct SampleMeeting {
    VertexId vertex;
    double z;            ///< of the line there
    std::uint32_t line;  ///< its number
    bool is_water;       ///< the line's z counts under any policy
    friend auto operator<=>(const SampleMeeting&, const SampleMeeting&) = default;
};

/// Gives each vertex where a sample and lines meet one elevation, by the policy for duplicates, as if lines
/// were read after all samples; water's elevation stands. Counts the others in `duplicates` and returns those
/// that clash, by vertex. Throws BreaklineError under policy Error when any do that are not of water. O(n log
/// n).
std::vector<LineConflict> resolve_meetings(Tin& tin, std::vector<SampleMeeting> meetings,
                                           const DuplicateOptions& options, DuplicateReport& duplicates);

}  // namespace tinwright

#endif
