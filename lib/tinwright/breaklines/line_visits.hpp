#ifndef TINWRIGHT_BREAKLINES_LINE_VISITS_HPP
#define TINWRIGHT_BREAKLINES_LINE_VISITS_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/breaklines/snap_rounding.hpp"

/// Lines as they run from vertex to vertex once they are cut.
namespace tinwright {

inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

/// A vertex on the way along a line.
struct LineStop {
    std::uint32_t vertex;
    /// The line's point there, or the last one before: points are counted through all lines.
    std::uint32_t point;
    bool is_own;       ///< whether it is a point of the line
    bool is_repeated;  ///< whether it is the point before once more
};

/// The stops of one line after the other.
class LineWalk {
  public:
    LineWalk(const LinePoints& points, const LineNetwork& network, const RoundedSegments& rounded)
        : points_(&points), network_(&network), rounded_(&rounded) {}

    /// Calls `visit(stop)` along a line, in its direction.
    template <class Visit>
    void for_each_stop(std::size_t line, const Visit& visit) const {
        const std::uint32_t first = points_->start[line];
        for (std::uint32_t i = first; i < points_->start[line + 1]; ++i) {
            const std::uint32_t vertex = rounded_->of_site[network_->site[i]];
            visit(LineStop{vertex, i, true, i > first && network_->site[i - 1] == network_->site[i]});
            const std::uint32_t segment = network_->segment_at[i];
            if (segment != kNoSegment) {
                visit_between(rounded_->chain(segment), vertex, i, visit);
            }
        }
    }

  private:
    template <class Visit>
    static void visit_between(std::span<const std::uint32_t> chain, std::uint32_t from, std::uint32_t point,
                              const Visit& visit) {
        const std::span<const std::uint32_t> between = chain.subspan(1, chain.size() - 2);
        const auto stop_at = [&](std::uint32_t vertex) { visit(LineStop{vertex, point, false, false}); };
        if (chain.front() == from) {
            std::for_each(between.begin(), between.end(), stop_at);
        } else {
            std::for_each(between.rbegin(), between.rend(), stop_at);
        }
    }

    const LinePoints* points_;
    const LineNetwork* network_;
    const RoundedSegments* rounded_;
};

/// That a line comes by a vertex.
struct LineVisit {
    std::uint32_t line;
    std::uint32_t point;   ///< as of a stop
    std::uint32_t before;  ///< vertices next to it along the line; none at the line's ends
    std::uint32_t after;
    bool is_own;
};

/// The visits at each vertex, in the order of lines and along them. A repeated point, and the last point of a
/// closed line, is a visit of its own without neighbours.
struct LineVisits {
    std::vector<LineVisit> all;
    std::vector<std::uint32_t> start;  ///< one entry more than vertices

    [[nodiscard]] std::span<const LineVisit> at(std::uint32_t vertex) const {
        return std::span(all).subspan(start[vertex], start[vertex + 1] - start[vertex]);
    }
    /// Those of one line. O(log) of all there.
    [[nodiscard]] std::span<const LineVisit> of_line(std::uint32_t line, std::uint32_t vertex) const {
        const std::span<const LineVisit> visits = at(vertex);
        const auto is_before = [line](const LineVisit& visit) { return visit.line < line; };
        const auto is_not_after = [line](const LineVisit& visit) { return visit.line <= line; };
        const auto first = std::partition_point(visits.begin(), visits.end(), is_before);
        return {first, std::partition_point(first, visits.end(), is_not_after)};
    }
};

/// O(stops).
LineVisits gather_visits(const LineWalk& walk, std::size_t lines, std::size_t vertices);

}  // namespace tinwright

#endif
