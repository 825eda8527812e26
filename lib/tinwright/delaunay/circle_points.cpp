#include "tinwright/delaunay/circle_points.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

std::vector<CirclePoint> make_points(const BlockingDisks& disks, std::span<const Key2> keys,
                                     const LinesInDisks& lines) {
    std::vector<CirclePoint> points;
    const auto rounded = [](Key2 key, double x, double y) {
        return Key2{std::round(key.x + x), std::round(key.y + y)};
    };
    for (std::uint32_t k = 0; k < lines.edges.size(); ++k) {
        const LineInDisks& edge = lines.edges[k];
        const Key2 p = keys[edge.p.value];
        const Key2 q = keys[edge.q.value];
        for (const Chord& chord : edge.chords) {
            for (const double t : {chord.from, chord.to}) {
                if (t > 0 && t < 1) {
                    points.push_back({rounded(p, t * (q.x - p.x), t * (q.y - p.y)), k, chord.disk});
                }
            }
        }
    }
    for (const std::uint32_t disk : lines.touching) {
        const Offset offset = disks.touching_point(keys, disk);
        const Key2 vertex = keys[disks.disks()[disk].vertex.value];
        points.push_back({rounded(vertex, offset.x, offset.y), CirclePoint::kNone, disk});
    }
    return points;
}

std::vector<KeyBox> boxes_of(std::span<const CirclePoint> points) {
    std::vector<KeyBox> boxes;
    boxes.reserve(points.size());
    for (const CirclePoint& point : points) {
        boxes.push_back({point.key, point.key});
    }
    return boxes;
}

}  // namespace

CirclePoints::CirclePoints(const BlockingDisks& disks, std::span<const Key2> keys, const LinesInDisks& lines)
    : points_(make_points(disks, keys, lines)), index_(boxes_of(points_)) {}

CirclePoints::Cap::Cap(Key2 a, Key2 b, Key2 c) : a_(a), b_(b) {
    // For the angle t at c, the cap is |ab| / 2 tan((pi - t) / 2) high.
    const double length = std::sqrt(inner_product(b, a, b));
    const double product = std::sqrt(inner_product(a, c, a) * inner_product(b, c, b));
    height_ = 0.5 * length * doubled_area(a, b, c) / (product - inner_product(a, c, b));
    height_ = height_ * (1 + 1e-9) + 1;
    normal_ = {(a.y - b.y) / length, (b.x - a.x) / length};
    const double x = height_ * normal_.x;
    const double y = height_ * normal_.y;
    box_.low = {std::floor(std::min(a.x, b.x) + std::min(x, 0.0)) - 1,
                std::floor(std::min(a.y, b.y) + std::min(y, 0.0)) - 1};
    box_.high = {std::ceil(std::max(a.x, b.x) + std::max(x, 0.0)) + 1,
                 std::ceil(std::max(a.y, b.y) + std::max(y, 0.0)) + 1};
}

bool CirclePoints::Cap::is_apart(const KeyBox& box) const {
    if (side_of_line(a_, b_, box) < 0) {
        return true;
    }
    const double x = normal_.x > 0 ? box.low.x : box.high.x;
    const double y = normal_.y > 0 ? box.low.y : box.high.y;
    return normal_.x * (x - a_.x) + normal_.y * (y - a_.y) > height_;
}

}  // namespace tinwright
