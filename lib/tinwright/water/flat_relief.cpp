#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/water/flat_axes.hpp"

namespace tinwright::internal {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

class Relief {
  public:
    Relief(const Tin& tin, const FlatAxes& axes)
        : tin_(tin),
          axes_(axes),
          first_(axes.nodes.size() + 1, 0),
          ways_(axes.nodes.size()),
          z_(axes.nodes.size(), std::numeric_limits<double>::quiet_NaN()) {
        for (const AxisLink& link : axes_.links) {
            ++first_[link.from + 1];
        }
        for (std::size_t n = 1; n < first_.size(); ++n) {
            first_[n] += first_[n - 1];
        }
    }

    std::vector<double> find() {
        go_in();
        measure_remaining_ways();
        for (std::size_t n = 0; n < ways_.size(); ++n) {
            const Way& way = ways_[n];
            if (way.done < kFar) {
                z_[n] = level(n) + way.rise * (way.remaining / (way.remaining + way.done));
            }
        }
        raise_closed_regions();
        return std::move(z_);
    }

  private:
    /// From the vertex beyond the nearest way out to a node.
    struct Way {
        double done = kFar;
        double remaining = 0;                    ///< from the node to the farthest dead end behind it
        double rise = 0;                         ///< from the contour to where the way began
        std::uint32_t from = AxisNode::kNone;    ///< the node before
        std::uint32_t outlet = AxisNode::kNone;  ///< the node where it comes in
    };

    [[nodiscard]] double level(std::size_t node) const { return tin_.z[axes_.nodes[node].a.value]; }
    [[nodiscard]] std::span<const AxisLink> links_of(std::size_t node) const {
        return std::span(axes_.links).subspan(first_[node], first_[node + 1] - first_[node]);
    }

    /// The shortest ways of all nodes, from wherever there is one in.
    void go_in() {
        using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // done, node, from
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::uint32_t n = 0; n < axes_.nodes.size(); ++n) {
            const AxisNode& node = axes_.nodes[n];
            if (node.outlet != kGhostVertex) {
                const Key2 outlet = tin_.key(node.outlet);
                queue.emplace(std::hypot(outlet.x - node.x, outlet.y - node.y), n, AxisNode::kNone);
            }
        }
        while (!queue.empty()) {
            const auto [done, n, from] = queue.top();
            queue.pop();
            Way& way = ways_[n];
            if (way.done < kFar) {
                continue;
            }
            way.done = done;
            way.from = from;
            way.outlet = from == AxisNode::kNone ? n : ways_[from].outlet;
            way.rise =
                from == AxisNode::kNone ? tin_.z[axes_.nodes[n].outlet.value] - level(n) : ways_[from].rise;
            order_.push_back(n);
            for (const AxisLink& link : links_of(n)) {
                if (ways_[link.to].done == kFar) {
                    queue.emplace(done + link.length, link.to, n);
                }
            }
        }
    }

    void measure_remaining_ways() {
        std::reverse(order_.begin(), order_.end());  // the farthest first
        for (const std::uint32_t n : order_) {
            Way& way = ways_[n];
            way.remaining = std::max({way.remaining, axes_.nodes[n].end, axes_.nodes[n].half_width});
            for (const AxisLink& link : links_of(n)) {
                way.remaining = std::max(way.remaining, beyond_meeting(n, link));
            }
            if (way.from != AxisNode::kNone) {
                const double length = way.done - ways_[way.from].done;
                Way& before = ways_[way.from];
                before.remaining = std::max(before.remaining, way.remaining + length);
            }
        }
    }

    /// How much remains of a way behind a node where it meets another. Where both come from the same side,
    /// the place is a pass: between hyperbolas whose halves are `half` and `width` from it the squares of
    /// these tell how far it is up from one contour to the other.
    [[nodiscard]] double beyond_meeting(std::uint32_t node, const AxisLink& link) const {
        const Way& way = ways_[node];
        const Way& other = ways_[link.to];
        if (way.from == link.to || other.from == node) {
            return 0;
        }
        const double half = (way.done + link.length + other.done) / 2;
        const bool is_pass = (way.rise > 0) == (other.rise > 0) && way.outlet != other.outlet;
        const double width =
            is_pass ? std::min(axes_.nodes[node].half_width, axes_.nodes[link.to].half_width) : 0;
        return half - way.done + width * width / half;
    }

    /// Regions without a way out, node by node as they hang together.
    void raise_closed_regions() {
        std::vector<bool> is_seen(axes_.nodes.size());
        std::vector<std::uint32_t> region;
        for (std::uint32_t first = 0; first < axes_.nodes.size(); ++first) {
            if (is_seen[first] || ways_[first].done < kFar) {
                continue;
            }
            region.assign(1, first);
            is_seen[first] = true;
            for (std::size_t i = 0; i < region.size(); ++i) {
                for (const AxisLink& link : links_of(region[i])) {
                    if (!is_seen[link.to]) {
                        is_seen[link.to] = true;
                        region.push_back(link.to);
                    }
                }
            }
            std::sort(region.begin(), region.end());
            raise(region);
        }
    }

    void raise(std::span<const std::uint32_t> region) {
        AxisNode sum;
        for (const std::uint32_t n : region) {
            const AxisNode& node = axes_.nodes[n];
            sum.fall += node.fall;
            sum.steepness += node.steepness;
            sum.area += node.area;
            sum.wall_length += node.wall_length;
        }
        // Not where the terrain goes up on one side and down on the other.
        if (std::abs(sum.fall) <= sum.steepness / 2 || sum.area <= 0) {
            return;
        }
        double width = 0;
        for (const std::uint32_t n : region) {
            width = std::max(width, axes_.nodes[n].half_width);
        }
        const double straight = width * sum.steepness / sum.area;
        const double most = sum.steepness / sum.wall_length / 2;
        const double summit = straight / std::sqrt(1 + (straight / most) * (straight / most));
        for (const std::uint32_t n : region) {
            const double share = axes_.nodes[n].half_width / width;  // steepest at the walls, like a dome
            z_[n] = level(n) + std::copysign(summit * (share * (2 - share)), sum.fall);
        }
    }

    const Tin& tin_;
    const FlatAxes& axes_;
    std::vector<std::size_t> first_;  // of each node, among the links
    std::vector<Way> ways_;
    std::vector<std::uint32_t> order_;  // nodes with a way, the nearest first
    std::vector<double> z_;
};

}  // namespace

std::vector<double> find_axis_elevations(const Tin& tin, const FlatAxes& axes) {
    return Relief(tin, axes).find();
}

}  // namespace tinwright::internal
