#include "tinwright/breaklines/near_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "tinwright/breaklines/segment_distance.hpp"

namespace tinwright {
namespace {

using Segment = LineSegments::Segment;
using Kind = LineConflict::Kind;

/// Calls `find(i, found)` for i below `count`, in parallel by blocks, and strings together what they find.
template <class Value, class Find>
std::vector<Value> collect(std::size_t count, const Find& find) {
    constexpr std::size_t kBlock = 4096;
    std::vector<std::vector<Value>> blocks((count + kBlock - 1) / kBlock);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
        const std::size_t end = std::min(count, (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < end; ++i) {
            find(i, blocks[block]);
        }
    });
    std::vector<Value> all;
    for (std::vector<Value>& block : blocks) {
        std::move(block.begin(), block.end(), std::back_inserter(all));
    }
    return all;
}

std::vector<LinePoint> list_points(std::span<const CleanLine> lines) {
    std::vector<LinePoint> points;
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
        const bool is_closed = lines[line].is_closed();
        const auto count = static_cast<std::uint32_t>(lines[line].keys.size());
        for (std::uint32_t i = is_closed ? 1 : 0; i < count; ++i) {  // the closing point counts once
            points.push_back({line, i});
        }
    }
    return points;
}

class NearMissFinder {
  public:
    NearMissFinder(std::span<const CleanLine> lines, const LineSegments& segments, double distance)
        : lines_(lines), segments_(segments), distance_(distance) {}

    [[nodiscard]] std::vector<Approach> find() const;
    [[nodiscard]] std::vector<FoundConflict> run() const;

  private:
    void find_at(LinePoint point, std::vector<Approach>& approaches) const;
    [[nodiscard]] std::optional<LinePoint> vertex_near(Key2 key, const Segment& segment) const;
    [[nodiscard]] Key2 key_of(LinePoint point) const { return lines_[point.line].keys[point.index]; }
    [[nodiscard]] double z_of(LinePoint point) const { return lines_[point.line].z[point.index]; }
    [[nodiscard]] FoundConflict conflict_of(const Approach& approach) const;
    void add_gaps(std::vector<FoundConflict>& found) const;

    std::span<const CleanLine> lines_;
    const LineSegments& segments_;
    double distance_;
};

std::optional<LinePoint> NearMissFinder::vertex_near(Key2 key, const Segment& segment) const {
    const double to_start = squared_distance(key, segments_.start(segment));
    const double to_end = squared_distance(key, segments_.end(segment));
    if (std::min(to_start, to_end) > distance_ * distance_) {
        return {};
    }
    std::uint32_t index = segment.index + (to_end < to_start ? 1U : 0U);
    if (index == 0 && lines_[segment.line].is_closed()) {
        index = static_cast<std::uint32_t>(lines_[segment.line].keys.size() - 1);
    }
    return LinePoint{segment.line, index};
}

void NearMissFinder::find_at(LinePoint point, std::vector<Approach>& approaches) const {
    struct Candidate {
        Segment segment;
        SegmentDistance distance;
        bool is_on;
    };
    const Key2 key = key_of(point);
    std::vector<Candidate> candidates;
    segments_.visit_meeting(box_around(key, distance_), [&](const Segment& segment) {
        if (segment.line == point.line) {
            return;
        }
        const Key2 a = segments_.start(segment);
        const Key2 b = segments_.end(segment);
        const bool is_on = is_on_segment(key, a, b);
        const SegmentDistance distance = measure_distance(key, a, b);
        if (is_on || distance.squared <= distance_ * distance_) {
            candidates.push_back({segment, distance, is_on});
        }
    });
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tuple(a.segment.line, !a.is_on, a.distance.squared, a.segment.index) <
               std::tuple(b.segment.line, !b.is_on, b.distance.squared, b.segment.index);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& nearest = candidates[i];
        const bool is_first = i == 0 || candidates[i - 1].segment.line != nearest.segment.line;
        if (is_first && !nearest.is_on) {
            approaches.push_back(
                {point, nearest.segment, nearest.distance, vertex_near(key, nearest.segment)});
        }
    }
}

FoundConflict NearMissFinder::conflict_of(const Approach& approach) const {
    FoundConflict found{{}, key_of(approach.point)};
    LineConflict& conflict = found.conflict;
    conflict.kind = Kind::NearMiss;
    conflict.line_a = approach.point.line;
    conflict.line_b = approach.segment.line;
    conflict.z_a = z_of(approach.point);
    conflict.z_b = segments_.elevation(approach.segment, approach.distance.fraction);
    if (conflict.line_a > conflict.line_b) {
        std::swap(conflict.line_a, conflict.line_b);
        std::swap(conflict.z_a, conflict.z_b);
    }
    return found;
}

/// Lines whose own ends nearly meet.
void NearMissFinder::add_gaps(std::vector<FoundConflict>& found) const {
    for (std::uint32_t line = 0; line < lines_.size(); ++line) {
        const CleanLine& points = lines_[line];
        if (has_gap(points, distance_)) {
            FoundConflict gap{{}, points.keys.back()};
            gap.conflict.kind = Kind::NearMiss;
            gap.conflict.line_a = gap.conflict.line_b = line;
            gap.conflict.z_a = points.z.front();
            gap.conflict.z_b = points.z.back();
            found.push_back(gap);
        }
    }
}

std::vector<Approach> NearMissFinder::find() const {
    const std::vector<LinePoint> points = list_points(lines_);
    return collect<Approach>(points.size(),
                             [&](std::size_t i, std::vector<Approach>& found) { find_at(points[i], found); });
}

std::vector<FoundConflict> NearMissFinder::run() const {
    const std::vector<Approach> approaches = find();
    // Points ascend, and so do the other lines of each.
    const auto key_of_approach = [](const Approach& approach) {
        return std::pair(approach.point, approach.segment.line);
    };
    const auto is_known = [&](LinePoint point, std::uint32_t other) {
        const auto at = std::lower_bound(
            approaches.begin(), approaches.end(), std::pair(point, other),
            [&](const Approach& approach, const auto& key) { return key_of_approach(approach) < key; });
        return at != approaches.end() && key_of_approach(*at) == std::pair(point, other);
    };
    std::vector<FoundConflict> found;
    for (const Approach& approach : approaches) {
        const bool is_seen_from_other = approach.vertex && approach.point.line > approach.segment.line &&
                                        is_known(*approach.vertex, approach.point.line);
        if (!is_seen_from_other) {
            found.push_back(conflict_of(approach));
        }
    }
    add_gaps(found);
    return found;
}

/// An end of a line, and the point before it.
struct LineEnd {
    std::uint32_t line;
    std::uint32_t segment;  ///< index of the first point of the last segment
    Key2 end;
    Key2 before;
    double z;
};

class DanglingFinder {
  public:
    DanglingFinder(const LineSegments& segments, double reach) : segments_(segments), reach_(reach) {}

    void find(const LineEnd& end, std::vector<FoundConflict>& found) const {
        if (!touches_something(end)) {
            reach_out(end, found);
        }
    }

  private:
    [[nodiscard]] bool touches_something(const LineEnd& end) const;
    void reach_out(const LineEnd& end, std::vector<FoundConflict>& found) const;
    [[nodiscard]] static bool is_own(const LineEnd& end, const Segment& segment) {
        return segment.line == end.line && segment.index == end.segment;
    }

    const LineSegments& segments_;
    double reach_;
};

bool DanglingFinder::touches_something(const LineEnd& end) const {
    bool touches = false;
    segments_.visit_meeting({end.end, end.end}, [&](const Segment& segment) {
        touches = touches || (!is_own(end, segment) &&
                              is_on_segment(end.end, segments_.start(segment), segments_.end(segment)));
    });
    return touches;
}

void DanglingFinder::reach_out(const LineEnd& end, std::vector<FoundConflict>& found) const {
    const double length = std::sqrt(squared_distance(end.before, end.end));
    const Key2 tip = {end.end.x + std::round((end.end.x - end.before.x) / length * reach_),
                      end.end.y + std::round((end.end.y - end.before.y) / length * reach_)};
    if (tip == end.end) {
        return;
    }
    std::optional<Segment> nearest;
    SegmentDistance distance;
    segments_.visit_meeting(KeyBox::of(std::array{end.end, tip}), [&](const Segment& segment) {
        const Key2 a = segments_.start(segment);
        const Key2 b = segments_.end(segment);
        if (is_own(end, segment) || !do_segments_meet(end.end, tip, a, b)) {
            return;
        }
        const SegmentDistance to_hit = measure_distance(end.end, a, b);
        if (!nearest || std::tuple(to_hit.squared, segment.line, segment.index) <
                            std::tuple(distance.squared, nearest->line, nearest->index)) {
            nearest = segment;
            distance = to_hit;
        }
    });
    if (!nearest) {
        return;
    }
    FoundConflict dangling{{}, end.end};
    dangling.conflict.kind = Kind::Dangling;
    dangling.conflict.line_a = end.line;
    dangling.conflict.line_b = nearest->line;
    dangling.conflict.z_a = end.z;
    dangling.conflict.z_b = segments_.elevation(*nearest, distance.fraction);
    found.push_back(dangling);
}

/// The lines at one sample.
class SampleFinder {
  public:
    SampleFinder(std::span<const Point3> samples, std::span<const Key2> keys, const LineSegments& segments,
                 const SampleRule& rule)
        : samples_(samples), keys_(keys), segments_(segments), rule_(rule) {}

    void find(std::size_t sample, std::vector<FoundConflict>& found) const;

  private:
    struct Meeting {
        Segment segment;
        SegmentDistance distance;
        bool is_on;
    };
    [[nodiscard]] bool agrees(std::size_t sample, const Meeting& meeting) const;

    std::span<const Point3> samples_;
    std::span<const Key2> keys_;
    const LineSegments& segments_;
    SampleRule rule_;
};

/// An elevation between two points is rounded a few times on the way, and that is no conflict.
bool SampleFinder::agrees(std::size_t sample, const Meeting& meeting) const {
    const double z = segments_.elevation(meeting.segment, meeting.distance.fraction);
    if (std::isnan(z)) {
        return true;
    }
    const double largest = std::max(std::abs(segments_.elevation(meeting.segment, 0)),
                                    std::abs(segments_.elevation(meeting.segment, 1)));
    const bool is_between = meeting.distance.fraction > 0 && meeting.distance.fraction < 1;
    const double rounding = is_between ? 8 * std::numeric_limits<double>::epsilon() * largest : 0;
    return std::abs(samples_[sample].z - z) <= rule_.z_tolerance + rounding;
}

void SampleFinder::find(std::size_t sample, std::vector<FoundConflict>& found) const {
    const Key2 key = keys_[sample];
    std::vector<Meeting> meetings;
    segments_.visit_meeting(box_around(key, rule_.distance), [&](const Segment& segment) {
        const Key2 a = segments_.start(segment);
        const Key2 b = segments_.end(segment);
        const bool is_on = is_on_segment(key, a, b);
        if (!is_on && rule_.distance == 0) {
            return;
        }
        const SegmentDistance distance = measure_distance(key, a, b);
        if (is_on || distance.squared < rule_.distance * rule_.distance) {
            meetings.push_back({segment, distance, is_on});
        }
    });
    // Of each line the place that says most: on it with another z, on it, else the nearest.
    std::sort(meetings.begin(), meetings.end(), [&](const Meeting& a, const Meeting& b) {
        const auto rank = [&](const Meeting& meeting) {
            return std::tuple(meeting.segment.line, !meeting.is_on, meeting.is_on && agrees(sample, meeting),
                              meeting.distance.squared, meeting.segment.index);
        };
        return rank(a) < rank(b);
    });
    for (std::size_t i = 0; i < meetings.size(); ++i) {
        const Meeting& meeting = meetings[i];
        const bool is_first = i == 0 || meetings[i - 1].segment.line != meeting.segment.line;
        if (!is_first || (meeting.is_on && agrees(sample, meeting))) {
            continue;
        }
        FoundConflict conflict{{}, key};
        conflict.conflict.kind = meeting.is_on ? Kind::SampleOnLine : Kind::SampleNearLine;
        conflict.conflict.line_a = meeting.segment.line;
        conflict.conflict.sample = static_cast<std::uint32_t>(sample);
        conflict.conflict.z_a = segments_.elevation(meeting.segment, meeting.distance.fraction);
        conflict.conflict.z_b = samples_[sample].z;
        found.push_back(conflict);
    }
}

}  // namespace

std::vector<Approach> find_approaches(std::span<const CleanLine> lines, const LineSegments& segments,
                                      double distance) {
    return NearMissFinder(lines, segments, distance).find();
}

bool has_gap(const CleanLine& line, double distance) {
    return line.keys.size() > 3 && !line.is_closed() &&
           squared_distance(line.keys.front(), line.keys.back()) <= distance * distance;
}

std::vector<FoundConflict> find_near_misses(std::span<const CleanLine> lines, const LineSegments& segments,
                                            double distance) {
    return NearMissFinder(lines, segments, distance).run();
}

std::vector<FoundConflict> find_dangling_ends(std::span<const CleanLine> lines,
                                              const std::vector<bool>& is_ring, const LineSegments& segments,
                                              double reach) {
    const DanglingFinder finder(segments, reach);
    return collect<FoundConflict>(lines.size(), [&](std::size_t i, std::vector<FoundConflict>& found) {
        const CleanLine& line = lines[i];
        const std::size_t n = line.keys.size();
        if (n < 2 || is_ring[i] || line.is_closed()) {
            return;
        }
        const auto number = static_cast<std::uint32_t>(i);
        finder.find({number, 0, line.keys[0], line.keys[1], line.z[0]}, found);
        finder.find(
            {number, static_cast<std::uint32_t>(n - 2), line.keys[n - 1], line.keys[n - 2], line.z[n - 1]},
            found);
    });
}

std::vector<FoundConflict> find_samples_at_lines(std::span<const Point3> samples, std::span<const Key2> keys,
                                                 const LineSegments& segments, const SampleRule& rule) {
    if (segments.size() == 0) {
        return {};
    }
    const SampleFinder finder(samples, keys, segments, rule);
    return collect<FoundConflict>(
        samples.size(), [&](std::size_t i, std::vector<FoundConflict>& found) { finder.find(i, found); });
}

}  // namespace tinwright
