#include "tinwright/breaklines/line_network.hpp"

#include <algorithm>
#include <string>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {
namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 29U;

void number_sites(const LinePoints& points, LineNetwork& network) {
    const std::vector<std::uint32_t> order = sort_along_curve(points.keys);
    network.site.resize(points.keys.size());
    for (const std::uint32_t point : order) {
        if (network.sites.empty() || network.sites.back() != points.keys[point]) {
            network.sites.push_back(points.keys[point]);
        }
        network.site[point] = static_cast<std::uint32_t>(network.sites.size() - 1);
    }
}

/// A segment with the point that it starts from.
struct Step {
    LineSegment segment;
    std::uint32_t point;
};

/// Sorted by segment: by first site in buckets, each of which is short as a rule.
std::vector<Step> sorted_steps(const LinePoints& points, const LineNetwork& network) {
    const auto segment_from = [&](std::uint32_t point) {
        const std::uint32_t p = network.site[point];
        const std::uint32_t q = network.site[point + 1];
        return precedes(network.sites[p], network.sites[q]) ? LineSegment{p, q} : LineSegment{q, p};
    };
    const auto for_each_step = [&](const auto& visit) {
        for (std::size_t line = 0; line < points.line_count(); ++line) {
            for (std::uint32_t i = points.start[line]; i + 1 < points.start[line + 1]; ++i) {
                if (network.site[i] != network.site[i + 1]) {
                    visit(Step{segment_from(i), i});
                }
            }
        }
    };
    std::vector<std::uint32_t> next(network.sites.size() + 1);
    for_each_step([&](const Step& step) { ++next[step.segment.a + 1]; });
    for (std::size_t site = 0; site < network.sites.size(); ++site) {
        next[site + 1] += next[site];
    }
    std::vector<Step> steps(next.back());
    for_each_step([&](const Step& step) { steps[next[step.segment.a]++] = step; });
    std::uint32_t first = 0;
    for (std::size_t site = 0; site < network.sites.size(); ++site) {
        std::sort(steps.begin() + first, steps.begin() + next[site],
                  [](const Step& p, const Step& q) { return p.segment.b < q.segment.b; });
        first = next[site];
    }
    return steps;
}

}  // namespace

LinePoints gather_points(std::span<const Breakline> lines, const Lattice& lattice) {
    std::size_t count = 0;
    for (const Breakline& line : lines) {
        count += line.points.size();
    }
    if (count > kMostPoints) {
        throw InputError(std::to_string(count) + " points of lines are more than the limit of 2^29 = " +
                         std::to_string(kMostPoints) + "; simplify or tile the lines");
    }
    LinePoints points;
    points.keys.reserve(count);
    points.start.reserve(lines.size() + 1);
    for (const Breakline& line : lines) {
        points.start.push_back(static_cast<std::uint32_t>(points.keys.size()));
        for (const Point3& point : line.points) {
            points.keys.push_back(lattice.key({point.x, point.y}));
        }
    }
    points.start.push_back(static_cast<std::uint32_t>(points.keys.size()));
    return points;
}

LineNetwork make_network(const LinePoints& points) {
    LineNetwork network;
    number_sites(points, network);
    network.segment_at.assign(points.keys.size(), kNoSegment);
    for (const Step& step : sorted_steps(points, network)) {
        if (network.segments.empty() || network.segments.back() != step.segment) {
            network.segments.push_back(step.segment);
        }
        network.segment_at[step.point] = static_cast<std::uint32_t>(network.segments.size() - 1);
    }
    return network;
}

}  // namespace tinwright
