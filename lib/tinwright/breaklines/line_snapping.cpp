#include "tinwright/breaklines/line_snapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {
namespace {

/// Which points are at each site, and which steps of lines run along each segment.
class Membership {
  public:
    Membership(const LinePoints& points, const LineNetwork& network) {
        line_of_.reserve(points.keys.size());
        for (std::uint32_t line = 0; line < points.line_count(); ++line) {
            line_of_.resize(points.start[line + 1], line);
        }
        group(network.site, network.sites.size(), at_site_, site_start_);
        group(network.segment_at, network.segments.size(), on_segment_, segment_start_);
    }

    [[nodiscard]] std::uint32_t line_of(std::uint32_t point) const { return line_of_[point]; }
    /// Ascending, hence in the order of lines.
    [[nodiscard]] std::span<const std::uint32_t> points_at(std::uint32_t site) const {
        return std::span(at_site_).subspan(site_start_[site], site_start_[site + 1] - site_start_[site]);
    }
    /// The points from which a segment's steps start, ascending.
    [[nodiscard]] std::span<const std::uint32_t> steps_on(std::uint32_t segment) const {
        return std::span(on_segment_)
            .subspan(segment_start_[segment], segment_start_[segment + 1] - segment_start_[segment]);
    }
    [[nodiscard]] bool is_on(std::uint32_t line, std::uint32_t site) const {
        const std::span<const std::uint32_t> points = points_at(site);
        return std::any_of(points.begin(), points.end(),
                           [&](std::uint32_t point) { return line_of_[point] == line; });
    }

  private:
    static void group(std::span<const std::uint32_t> number_of, std::size_t count,
                      std::vector<std::uint32_t>& grouped, std::vector<std::uint32_t>& start) {
        start.resize(count + 1);
        for (const std::uint32_t number : number_of) {
            if (number != kNoSegment) {
                ++start[number + 1];
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            start[i + 1] += start[i];
        }
        grouped.resize(start.back());
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (std::uint32_t i = 0; i < number_of.size(); ++i) {
            if (number_of[i] != kNoSegment) {
                grouped[next[number_of[i]]++] = i;
            }
        }
    }

    std::vector<std::uint32_t> line_of_;
    std::vector<std::uint32_t> at_site_;
    std::vector<std::uint32_t> site_start_;
    std::vector<std::uint32_t> on_segment_;
    std::vector<std::uint32_t> segment_start_;
};

/// A near miss between the lines of some points and those of others, both ascending.
NearMiss miss_between(const Membership& members, std::span<const std::uint32_t> moved,
                      std::span<const std::uint32_t> target) {
    const std::uint32_t line = members.line_of(moved.front());
    const auto other = std::find_if(target.begin(), target.end(),
                                    [&](std::uint32_t point) { return members.line_of(point) != line; });
    const std::uint32_t other_line = other == target.end() ? line : members.line_of(*other);
    return {moved.front(), std::min(line, other_line), std::max(line, other_line)};
}

bool is_nearer(Key2 p, Key2 q, double distance) { return squared_distance(p, q) < distance * distance; }

/// Sites that stay, by square cells as wide as the distance. Only looked up, never walked through.
class StayingSites {
  public:
    explicit StayingSites(double distance) : width_(std::max(1.0, distance)) {}

    void add(std::uint32_t site, Key2 key) { cells_[cell(column(key.x), column(key.y))].push_back(site); }

    template <class Visit>
    void for_each_around(Key2 key, const Visit& visit) const {
        for (std::int64_t x = column(key.x) - 1; x <= column(key.x) + 1; ++x) {
            for (std::int64_t y = column(key.y) - 1; y <= column(key.y) + 1; ++y) {
                const auto found = cells_.find(cell(x, y));
                if (found != cells_.end()) {
                    std::for_each(found->second.begin(), found->second.end(), visit);
                }
            }
        }
    }

  private:
    [[nodiscard]] std::int64_t column(double value) const {
        return static_cast<std::int64_t>(std::floor(value / width_));
    }
    // Cells that share a number only mean a site too many to look at.
    [[nodiscard]] static std::uint64_t cell(std::int64_t x, std::int64_t y) {
        return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(y);
    }

    double width_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// Points to points.
class PointSnapping {
  public:
    PointSnapping(const LinePoints& points, double distance)
        : points_(points), distance_(distance), network_(make_network(points)), members_(points, network_) {}

    void snap(std::vector<NearMiss>& misses) {
        const std::size_t count = network_.sites.size();
        target_.assign(count, 0);
        is_alone_.assign(count, 1);
        StayingSites staying(distance_);
        for (std::uint32_t site = 0; site < count; ++site) {
            find_companions(site);
            target_[site] = nearest(site, staying);
            if (target_[site] == site) {
                staying.add(site, network_.sites[site]);
                continue;
            }
            is_alone_[site] = is_alone_[target_[site]] = 0;
            misses.push_back(
                miss_between(members_, members_.points_at(site), members_.points_at(target_[site])));
        }
    }

    /// Where a point goes, and whether nothing else goes there.
    [[nodiscard]] Key2 key_of(std::uint32_t point) const {
        return network_.sites[target_[network_.site[point]]];
    }
    [[nodiscard]] bool is_alone(std::uint32_t point) const { return is_alone_[network_.site[point]] != 0; }

  private:
    [[nodiscard]] std::uint32_t nearest(std::uint32_t site, const StayingSites& staying) const {
        const Key2 key = network_.sites[site];
        std::uint32_t best = site;
        staying.for_each_around(key, [&](std::uint32_t other) {
            const Key2 at = network_.sites[other];
            if (!is_nearer(key, at, distance_) || is_companion(other)) {
                return;
            }
            const int order = best == site ? 1 : compare_distances(key, network_.sites[best], key, at);
            if (order > 0 || (order == 0 && other < best)) {
                best = other;
            }
        });
        return best;
    }

    /// Sites on the way from a site along its lines, both ways, until it has been left.
    void find_companions(std::uint32_t site) {
        companions_.clear();
        for (const std::uint32_t point : members_.points_at(site)) {
            const std::uint32_t line = members_.line_of(point);
            const std::uint32_t first = points_.start[line];
            const std::uint32_t last = points_.start[line + 1] - 1;
            const bool is_closed = first != last && network_.site[first] == network_.site[last];
            const std::uint32_t steps = last - first;
            follow(point, steps, [&](std::uint32_t i) {
                return i < last ? i + 1 : is_closed ? first + 1 : i;
            });
            follow(point, steps, [&](std::uint32_t i) {
                return i > first ? i - 1 : is_closed ? last - 1 : i;
            });
        }
        std::sort(companions_.begin(), companions_.end());
    }

    template <class Next>
    void follow(std::uint32_t point, std::uint32_t steps, const Next& next) {
        const Key2 from = points_.keys[point];
        std::uint32_t i = point;
        for (std::uint32_t step = 0; step < steps && is_nearer(from, points_.keys[i], distance_); ++step) {
            i = next(i);
            if (companions_.empty() || companions_.back() != network_.site[i]) {
                companions_.push_back(network_.site[i]);
            }
        }
    }

    [[nodiscard]] bool is_companion(std::uint32_t site) const {
        return std::binary_search(companions_.begin(), companions_.end(), site);
    }

    const LinePoints& points_;
    double distance_;
    LineNetwork network_;
    Membership members_;
    std::vector<std::uint32_t> target_;      // one a site
    std::vector<char> is_alone_;             // one a site
    std::vector<std::uint32_t> companions_;  // of the site at hand, ascending
};

/// Points to lines, once points have gone to points.
class LineSnapping {
  public:
    LineSnapping(const LinePoints& points, double distance)
        : distance_(distance),
          network_(make_network(points)),
          members_(points, network_),
          now_(network_.sites),
          is_fixed_(network_.sites.size()),
          tree_(boxes()) {}

    template <class IsAlone>
    void snap(const IsAlone& is_alone, SnappedLines& snapped) {
        for (std::uint32_t site = 0; site < now_.size(); ++site) {
            const std::uint32_t point = members_.points_at(site).front();
            if (is_fixed_[site] != 0 || !is_alone(point)) {
                continue;
            }
            const std::optional<Place> place = nearest(site);
            if (!place) {
                continue;
            }
            now_[site] = place->key;
            const LineSegment& onto = network_.segments[place->segment];
            is_fixed_[site] = is_fixed_[onto.a] = is_fixed_[onto.b] = 1;
            const std::span<const std::uint32_t> steps = members_.steps_on(place->segment);
            snapped.led_from.push_back(steps.front());
            snapped.misses.push_back(miss_between(members_, members_.points_at(site), steps));
        }
    }

    [[nodiscard]] Key2 key_of(std::uint32_t point) const { return now_[network_.site[point]]; }

  private:
    struct Place {
        double squared;
        std::uint32_t segment;
        Key2 key;
    };

    [[nodiscard]] std::vector<KeyBox> boxes() const {
        std::vector<KeyBox> boxes(network_.segments.size());
        for (std::uint32_t s = 0; s < boxes.size(); ++s) {
            boxes[s] = KeyBox::of(std::array{network_.a(s), network_.b(s)});
        }
        return boxes;
    }

    /// The place of a line nearby to go to; none if the site is on one already.
    [[nodiscard]] std::optional<Place> nearest(std::uint32_t site) const {
        const Key2 key = now_[site];
        const double reach = 2 * distance_ + 2;  // ends of segments may have moved too
        std::optional<Place> best;
        bool is_on_line = false;
        tree_.visit_meeting(
            {{key.x - reach, key.y - reach}, {key.x + reach, key.y + reach}},
            [](const KeyBox& /*box*/) { return false; },
            [&](std::uint32_t segment) {
                const std::optional<Place> place = place_on(segment, site);
                is_on_line = is_on_line || (place && place->squared == 0);
                if (place && (!best || place->squared < best->squared ||
                              (place->squared == best->squared && segment < best->segment))) {
                    best = place;
                }
                return !is_on_line;
            });
        return is_on_line ? std::nullopt : best;
    }

    /// Where a site goes to on a segment of another line; its distance is zero only if it is on it.
    [[nodiscard]] std::optional<Place> place_on(std::uint32_t segment, std::uint32_t site) const {
        const LineSegment& ends = network_.segments[segment];
        const Key2 key = now_[site];
        const Key2 a = now_[ends.a];
        const Key2 b = now_[ends.b];
        if (ends.a == site || ends.b == site || a == b || !has_another_line(segment, site)) {
            return std::nullopt;
        }
        if (pass_square(a, b, key) == SquarePass::Center) {
            return Place{0, segment, key};
        }
        const double way_x = b.x - a.x;
        const double way_y = b.y - a.y;
        const double part = ((key.x - a.x) * way_x + (key.y - a.y) * way_y) / (way_x * way_x + way_y * way_y);
        if (!(part > 0 && part < 1)) {
            return std::nullopt;
        }
        const double off_x = a.x + part * way_x - key.x;
        const double off_y = a.y + part * way_y - key.y;
        const double squared = std::max(off_x * off_x + off_y * off_y, std::numeric_limits<double>::min());
        if (!(squared < distance_ * distance_)) {
            return std::nullopt;
        }
        const std::optional<Key2> on = lattice_point_on(a, b, {key.x + off_x, key.y + off_y});
        return on ? std::optional(Place{squared, segment, *on}) : std::nullopt;
    }

    [[nodiscard]] bool has_another_line(std::uint32_t segment, std::uint32_t site) const {
        const std::span<const std::uint32_t> steps = members_.steps_on(segment);
        return std::any_of(steps.begin(), steps.end(),
                           [&](std::uint32_t step) { return !members_.is_on(members_.line_of(step), site); });
    }

    /// The lattice point nearest to a place on a segment (given up to rounding) whose square the segment
    /// passes; none if that is one of its ends.
    [[nodiscard]] static std::optional<Key2> lattice_point_on(Key2 a, Key2 b, Key2 place) {
        std::optional<Key2> best;
        for (double x = std::floor(place.x) - 1; x <= std::floor(place.x) + 2; ++x) {
            for (double y = std::floor(place.y) - 1; y <= std::floor(place.y) + 2; ++y) {
                const Key2 key{x, y};
                const SquarePass pass = pass_square(a, b, key);
                if ((pass == SquarePass::Through || pass == SquarePass::Center) &&
                    (!best || squared_distance(place, key) < squared_distance(place, *best))) {
                    best = key;
                }
            }
        }
        return best && *best != a && *best != b ? best : std::nullopt;
    }

    double distance_;
    LineNetwork network_;
    Membership members_;
    std::vector<Key2> now_;  // one a site
    std::vector<char> is_fixed_;
    BoxTree tree_;
};

}  // namespace

SnappedLines snap_lines(LinePoints& points, double distance) {
    SnappedLines snapped;
    PointSnapping to_points(points, distance);
    to_points.snap(snapped.misses);
    LinePoints joined = points;
    for (std::uint32_t i = 0; i < points.keys.size(); ++i) {
        joined.keys[i] = to_points.key_of(i);
    }
    LineSnapping to_lines(joined, distance);
    to_lines.snap([&](std::uint32_t point) { return to_points.is_alone(point); }, snapped);
    for (std::uint32_t i = 0; i < points.keys.size(); ++i) {
        points.keys[i] = to_lines.key_of(i);
    }
    return snapped;
}

}  // namespace tinwright
