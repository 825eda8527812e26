#include "tinwright/delaunay/tree_of_regions.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tinwright {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// A place on a circle where the boundary of the region outside leaves it. Codes 2e and 2e + 1 are the ends
// of unprotected edge e, or the two circles of touching e - edges; the boundary arrives at the one and leaves
// from the other.
struct Exit {
    std::uint32_t disk;
    double angle;  // where on the circle
    double tilt;   // of the edge away from the ray from the centre, counter-clockwise
    std::uint32_t code;
};

// Exits of all circles, each circle's clockwise.
class Exits {
  public:
    Exits(const BlockingDisks& disks, std::span<const Key2> keys, const LinesInDisks& lines)
        : disks_(disks), keys_(keys) {
        const std::vector<UnprotectedEdge>& edges = lines.unprotected;
        exits_.reserve(2 * (edges.size() + disks.disks().size()));
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            add_edge(lines.edges[edges[e].line_edge], edges[e], e);
        }
        for (std::uint32_t disk = 1; disk < disks.disks().size(); ++disk) {
            add_touching(disk, static_cast<std::uint32_t>(edges.size()) + disk);
        }
        std::sort(exits_.begin(), exits_.end(), [](const Exit& x, const Exit& y) {
            return std::tie(x.disk, y.angle, y.tilt, x.code) < std::tie(y.disk, x.angle, x.tilt, y.code);
        });
    }

    // For each code the next one that a boundary takes which arrives where that one leaves.
    [[nodiscard]] std::vector<std::uint32_t> next_codes(std::size_t code_count) const {
        std::vector<std::uint32_t> next(code_count, kNone);
        for (auto first = exits_.begin(); first != exits_.end();) {
            const auto last = std::find_if(
                first, exits_.end(), [disk = first->disk](const Exit& exit) { return exit.disk != disk; });
            for (auto exit = first; exit != last; ++exit) {
                // The region is on the left of what arrives, the disk on the right: on, clockwise.
                next[exit->code ^ 1U] = exit + 1 == last ? first->code : (exit + 1)->code;
            }
            first = last;
        }
        return next;
    }

  private:
    [[nodiscard]] const BlockingDisk& disk(std::uint32_t index) const { return disks_.disks()[index]; }

    // From the centre of a disk to an offset from a vertex.
    [[nodiscard]] Offset from_center(std::uint32_t index, VertexId v, Offset offset) const {
        const Key2 a = keys_[disk(index).vertex.value];
        const Key2 b = keys_[v.value];
        return {b.x - a.x - disk(index).center.x + offset.x, b.y - a.y - disk(index).center.y + offset.y};
    }

    void add(std::uint32_t disk, Offset ray, Offset away, std::uint32_t code) {
        const double tilt = std::atan2(ray.x * away.y - ray.y * away.x, ray.x * away.x + ray.y * away.y);
        exits_.push_back({disk, std::atan2(ray.y, ray.x), tilt, code});
    }

    void add_edge(const LineInDisks& line, const UnprotectedEdge& edge, std::uint32_t index) {
        const Key2 a = keys_[line.p.value];
        const Key2 b = keys_[line.q.value];
        const Offset forth{b.x - a.x, b.y - a.y};
        const Offset back{-forth.x, -forth.y};
        const double rest = 1 - edge.to;
        add(edge.from_disk, from_center(edge.from_disk, line.p, {edge.from * forth.x, edge.from * forth.y}),
            forth, 2 * index);
        add(edge.to_disk, from_center(edge.to_disk, line.q, {rest * back.x, rest * back.y}), back,
            2 * index + 1);
    }

    void add_touching(std::uint32_t index, std::uint32_t code) {
        const BlockingDisk& later = disk(index);
        const VertexId at = later.is_full ? later.towards : later.vertex;
        const Offset offset = later.is_full ? Offset{} : disks_.touching_point(keys_, index);
        for (const std::uint32_t side : {0U, 1U}) {
            const std::uint32_t circle = side == 0 ? index : later.touched;
            const Offset ray = from_center(circle, at, offset);
            add(circle, ray, ray, 2 * code + side);
        }
    }

    const BlockingDisks& disks_;
    std::span<const Key2> keys_;
    std::vector<Exit> exits_;
};

// Sides of unprotected edges, 2e the left of edge e and 2e + 1 the right, and the regions there.
class Regions {
  public:
    Regions(std::size_t side_count, const std::vector<std::uint32_t>& next_code)
        : region_(side_count, kNone) {
        for (std::uint32_t side = 0; side < side_count; ++side) {
            if (region_[side] == kNone) {
                for (std::uint32_t code = side; code >= side_count || region_[code] == kNone;
                     code = next_code[code]) {
                    if (code < side_count) {
                        region_[code] = count_;
                    }
                }
                ++count_;
            }
        }
        first_.resize(count_ + 1);
        for (const std::uint32_t region : region_) {
            ++first_[region + 1];
        }
        for (std::size_t r = 0; r < count_; ++r) {
            first_[r + 1] += first_[r];
        }
        sides_.resize(side_count);
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t side = 0; side < side_count; ++side) {
            sides_[next[region_[side]]++] = side;
        }
    }

    // From every region but the roots the side of the edge to its parent; parents before children.
    struct Node {
        std::uint32_t region;
        std::uint32_t to_parent;  // kNone: a root
    };
    [[nodiscard]] std::vector<Node> make_trees() const {
        std::vector<Node> nodes;
        nodes.reserve(count_);
        std::vector<std::uint8_t> is_reached(count_);
        for (std::uint32_t root = 0; root < count_; ++root) {
            if (is_reached[root] != 0) {
                continue;
            }
            is_reached[root] = 1;
            nodes.push_back({root, kNone});
            for (std::size_t n = nodes.size() - 1; n < nodes.size(); ++n) {
                for (const std::uint32_t side : sides_of(nodes[n].region)) {
                    const std::uint32_t other = region_[side ^ 1U];
                    if (is_reached[other] == 0) {
                        is_reached[other] = 1;
                        nodes.push_back({other, side ^ 1U});
                    }
                }
            }
        }
        return nodes;
    }

    [[nodiscard]] std::span<const std::uint32_t> sides_of(std::uint32_t region) const {
        return std::span(sides_).subspan(first_[region], first_[region + 1] - first_[region]);
    }

  private:
    std::vector<std::uint32_t> region_;  // of each side
    std::uint32_t count_ = 0;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> sides_;
};

}  // namespace

std::vector<Export> order_exports(const BlockingDisks& disks, std::span<const Key2> keys,
                                  const LinesInDisks& lines) {
    const std::size_t side_count = 2 * lines.unprotected.size();
    const Exits exits(disks, keys, lines);
    const Regions regions(side_count, exits.next_codes(side_count + 2 * disks.disks().size()));
    const std::vector<Regions::Node> nodes = regions.make_trees();

    std::vector<Export> order;
    order.reserve(side_count);
    const auto add = [&](std::uint32_t side) { order.push_back({side / 2, side % 2 == 0}); };
    std::for_each(nodes.rbegin(), nodes.rend(), [&](const Regions::Node& node) {
        if (node.to_parent != kNone) {
            add(node.to_parent);
        }
    });
    for (const Regions::Node& node : nodes) {
        for (const std::uint32_t side : regions.sides_of(node.region)) {
            if (side != node.to_parent) {
                add(side);
            }
        }
    }
    return order;
}

}  // namespace tinwright
