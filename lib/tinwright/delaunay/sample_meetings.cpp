#include "tinwright/delaunay/sample_meetings.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

// One elevation for a sample's vertex and the lines through it; tells when they clash.
std::optional<LineConflict> resolve(Tin& tin, std::span<const SampleMeeting> meetings,
                                    const DuplicateOptions& options, DuplicateReport& duplicates) {
    const VertexId v = meetings.front().vertex;
    const double of_sample = tin.z[v.value];
    std::vector<double> sorted = {of_sample};
    for (const SampleMeeting& meeting : meetings) {
        sorted.push_back(meeting.z);
    }
    std::sort(sorted.begin(), sorted.end());
    const bool clashes = sorted.back() - sorted.front() > options.tolerance;
    const auto of_water = std::find_if(meetings.begin(), meetings.end(),
                                       [](const SampleMeeting& meeting) { return meeting.is_water; });
    if (of_water == meetings.end()) {
        (clashes ? duplicates.conflicting : duplicates.equal) += 1;
    }
    if (of_water != meetings.end()) {
        tin.z[v.value] = of_water->z;
    } else if (options.policy == DuplicatePolicy::Last) {
        tin.z[v.value] =
            std::max_element(meetings.begin(), meetings.end(),
                             [](const SampleMeeting& a, const SampleMeeting& b) { return a.line < b.line; })
                ->z;
    } else if (options.policy != DuplicatePolicy::First) {
        tin.z[v.value] = choose_elevation(options.policy, sorted);
    }
    if (!clashes) {
        return std::nullopt;
    }
    const auto other = std::find_if(meetings.begin(), meetings.end(),
                                    [&](const SampleMeeting& m) { return m.z != of_sample; });
    const SampleMeeting& meeting = other == meetings.end() ? meetings.front() : *other;
    LineConflict conflict;
    conflict.kind = LineConflict::Kind::SampleOnLine;
    conflict.action = LineConflict::Action::Chosen;
    conflict.sample = tin.sample[v.value];
    conflict.line_a = meeting.line;
    conflict.location = tin.lattice.position(tin.key(v));
    conflict.z_a = meeting.z;
    conflict.z_b = of_sample;
    return conflict;
}

[[noreturn]] void throw_clashes(const LineConflict& first, std::size_t count) {
    throw BreaklineError(
        std::to_string(count) +
            (count == 1 ? " sample lies on a line that has another elevation there, at "
                        : " samples lie on lines that have another elevation there, the first at ") +
            location_text(first.location) + ": z " + decimal_text(first.z_b) + " of the sample, " +
            decimal_text(first.z_a) +
            " of the line; say which to take with --duplicates first|last|min|max|mean|median, or allow for "
            "the difference with --duplicate-tolerance",
        {first.line_a}, {first.sample});
}

}  // namespace

std::vector<LineConflict> resolve_meetings(Tin& tin, std::vector<SampleMeeting> meetings,
                                           const DuplicateOptions& options, DuplicateReport& duplicates) {
    std::sort(meetings.begin(), meetings.end());
    const auto is_of_water = [](const SampleMeeting& meeting) { return meeting.is_water; };
    std::vector<LineConflict> clashes;
    std::vector<LineConflict> refused;
    for (auto first = meetings.begin(); first != meetings.end();) {
        const auto last = std::find_if(first, meetings.end(),
                                       [&](const SampleMeeting& m) { return m.vertex != first->vertex; });
        if (const auto clash = resolve(tin, {first, last}, options, duplicates)) {
            clashes.push_back(*clash);
            if (std::none_of(first, last, is_of_water)) {
                refused.push_back(*clash);
            }
        }
        first = last;
    }
    if (!refused.empty() && options.policy == DuplicatePolicy::Error) {
        throw_clashes(refused.front(), refused.size());
    }
    return clashes;
}

}  // namespace tinwright
