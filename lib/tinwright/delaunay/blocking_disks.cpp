#include "tinwright/delaunay/blocking_disks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tinwright {

namespace {

// Differences of keys are exact.
Offset way(Key2 from, Key2 to) { return {to.x - from.x, to.y - from.y}; }
Offset operator+(Offset a, Offset b) { return {a.x + b.x, a.y + b.y}; }
Offset operator-(Offset a, Offset b) { return {a.x - b.x, a.y - b.y}; }
Offset operator*(double factor, Offset a) { return {factor * a.x, factor * a.y}; }
double dot(Offset a, Offset b) { return a.x * b.x + a.y * b.y; }
double cross(Offset a, Offset b) { return a.x * b.y - a.y * b.x; }

// The vertices' neighbours in the tree, ascending.
class Neighbors {
  public:
    Neighbors(std::size_t count, std::span<const GraphEdge> tree)
        : first_(count + 1), other_(2 * tree.size()) {
        for (const GraphEdge& edge : tree) {
            ++first_[edge.a.value + 1];
            ++first_[edge.b.value + 1];
        }
        for (std::size_t v = 0; v < count; ++v) {
            first_[v + 1] += first_[v];
        }
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (const GraphEdge& edge : tree) {
            other_[next[edge.a.value]++] = edge.b;
            other_[next[edge.b.value]++] = edge.a;
        }
        for (std::size_t v = 0; v < count; ++v) {
            std::sort(other_.begin() + first_[v], other_.begin() + first_[v + 1]);
        }
    }

    [[nodiscard]] std::span<const VertexId> of(VertexId v) const {
        return std::span(other_).subspan(first_[v.value], first_[v.value + 1] - first_[v.value]);
    }

  private:
    std::vector<std::uint32_t> first_;
    std::vector<VertexId> other_;
};

// The disks of the tree's edges, in the order of the labels of their vertices j.
std::vector<BlockingDisk> full_disks(std::span<const Key2> keys, std::span<const GraphEdge> tree) {
    const Neighbors neighbors(keys.size(), tree);
    std::vector<BlockingDisk> disks;
    disks.reserve(tree.size());
    std::vector<std::uint8_t> is_labelled(keys.size());
    const auto label_neighbors = [&](VertexId i) {
        is_labelled[i.value] = 1;
        for (const VertexId j : neighbors.of(i)) {
            if (is_labelled[j.value] == 0) {
                const Offset center = 0.5 * way(keys[j.value], keys[i.value]);
                disks.push_back(
                    {.vertex = j, .towards = i, .center = center, .radius = std::sqrt(dot(center, center))});
            }
        }
    };
    label_neighbors({0});
    std::size_t next = 0;
    while (next < disks.size()) {
        label_neighbors(disks[next++].vertex);
    }
    return disks;
}

KeyBox box_of(std::span<const Key2> keys, const BlockingDisk& disk) {
    const Key2 vertex = keys[disk.vertex.value];
    const Key2 center{vertex.x + disk.center.x, vertex.y + disk.center.y};
    const double reach = std::ceil(disk.radius) + 1;
    return {{std::floor(center.x) - reach, std::floor(center.y) - reach},
            {std::ceil(center.x) + reach, std::ceil(center.y) + reach}};
}

std::vector<KeyBox> boxes_of(std::span<const Key2> keys, std::span<const BlockingDisk> disks) {
    std::vector<KeyBox> boxes;
    boxes.reserve(disks.size());
    for (const BlockingDisk& disk : disks) {
        boxes.push_back(box_of(keys, disk));
    }
    return boxes;
}

std::optional<Chord> chord_of(std::span<const Key2> keys, const BlockingDisk& disk, VertexId p, VertexId q) {
    const Offset edge = way(keys[p.value], keys[q.value]);
    const Offset from_center = way(keys[disk.vertex.value], keys[p.value]) - disk.center;
    const double square = dot(edge, edge);
    const double offset = cross(from_center, edge) / std::sqrt(square);
    const double half_square = disk.radius * disk.radius - offset * offset;
    if (!(half_square > 0)) {
        return std::nullopt;
    }
    const double middle = -dot(from_center, edge) / square;
    const double half = std::sqrt(half_square / square);
    // Where an end of the edge is on the circle, that is where the chord ends.
    const auto is_on_circle = [&](VertexId v) {
        return v == disk.vertex || (v == disk.towards && disk.is_full);
    };
    const double from = is_on_circle(p) ? 0 : std::max(middle - half, 0.0);
    const double to = is_on_circle(q) ? 1 : std::min(middle + half, 1.0);
    if (!(middle > 0 && middle < 1) || (to - from) * std::sqrt(square) < 1) {
        return std::nullopt;
    }
    return Chord{from, to, 0};
}

constexpr auto kNowhereApart = [](const KeyBox& /*box*/) { return false; };

}  // namespace

BlockingDisks::BlockingDisks(std::span<const Key2> keys, std::span<const GraphEdge> tree)
    : BlockingDisks(keys, full_disks(keys, tree)) {}

BlockingDisks::BlockingDisks(std::span<const Key2> keys, std::vector<BlockingDisk> disks)
    : disks_(std::move(disks)), disk_at_(keys.size()), index_(boxes_of(keys, disks_)) {
    for (std::uint32_t disk = 0; disk < disks_.size(); ++disk) {
        disk_at_[disks_[disk].vertex.value] = disk;
    }
    for (std::uint32_t disk = 1; disk < disks_.size(); ++disk) {
        grow(keys, disk);
    }
}

// Shrinks a full disk until it meets no earlier one.
void BlockingDisks::grow(std::span<const Key2> keys, std::uint32_t disk) {
    // A disk that reaches i_j but for rounding is full: no earlier circle can stop it closer.
    constexpr double kFull = 1 - 1e-12;
    BlockingDisk& grown = disks_[disk];
    const double full = grown.radius;
    const Offset direction = (1 / full) * grown.center;
    double radius = full;
    std::uint32_t touched = BlockingDisk::kNone;
    index_.visit_meeting(box_of(keys, grown), kNowhereApart, [&](std::uint32_t item) {
        if (item < disk) {
            // |w - r u| = r + s for the radius s of the earlier disk and its centre w, seen from j: with
            // squares, r = (w^2 - s^2) / 2 (w u + s). With w = d + c by way of the vertex on that circle,
            // w^2 - s^2 = d (w + c). j is outside all disks, so r > 0 where there is one.
            const BlockingDisk& earlier = disks_[item];
            const Offset d = way(keys[grown.vertex.value], keys[earlier.vertex.value]);
            const Offset w = d + earlier.center;
            const double divisor = 2 * (dot(w, direction) + earlier.radius);
            const double r = dot(d, w + earlier.center) / divisor;
            if (divisor > 0 && (r < radius || (r == radius && item < touched))) {
                radius = std::max(r, 0.0);
                touched = item;
            }
        }
        return true;
    });
    grown.is_full = radius >= kFull * full;
    if (grown.is_full) {
        grown.touched = disk_at_[grown.towards.value];
        return;
    }
    grown.radius = radius;
    grown.center = radius * direction;
    grown.touched = touched;
}

std::vector<Chord> BlockingDisks::find_chords(std::span<const Key2> keys, VertexId p, VertexId q) const {
    const Key2 a = keys[p.value];
    const Key2 b = keys[q.value];
    std::vector<Chord> chords;
    const auto is_apart = [&](const KeyBox& box) { return side_of_line(a, b, box) != 0; };
    index_.visit_meeting(KeyBox::of(std::vector{a, b}), is_apart, [&](std::uint32_t item) {
        std::optional<Chord> chord = chord_of(keys, disks_[item], p, q);
        if (chord) {
            chord->disk = item;
            chords.push_back(*chord);
        }
        return true;
    });
    std::sort(chords.begin(), chords.end(), [](const Chord& x, const Chord& y) {
        return std::pair(x.from, x.disk) < std::pair(y.from, y.disk);
    });
    for (std::size_t i = 1; i < chords.size(); ++i) {
        chords[i].from = std::max(chords[i].from, chords[i - 1].to);
    }
    std::erase_if(chords, [](const Chord& chord) { return !(chord.from < chord.to); });
    return chords;
}

Offset BlockingDisks::touching_point(std::span<const Key2> keys, std::uint32_t disk) const {
    const BlockingDisk& later = disks_[disk];
    const BlockingDisk& earlier = disks_[later.touched];
    const Offset between =
        way(keys[later.vertex.value], keys[earlier.vertex.value]) + earlier.center - later.center;
    return later.center + (later.radius / std::sqrt(dot(between, between))) * between;
}

}  // namespace tinwright
