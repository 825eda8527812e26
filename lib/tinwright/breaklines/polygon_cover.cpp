#include "tinwright/breaklines/polygon_cover.hpp"

#include <algorithm>

#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

PolygonCover::PolygonCover(std::vector<CleanLine> rings, std::vector<std::uint32_t> polygons)
    : rings_(std::move(rings)), polygons_(std::move(polygons)), segments_(rings_) {
    for (const CleanLine& ring : rings_) {
        for (const Key2 key : ring.keys) {
            right_ = std::max(right_, key.x);
        }
    }
}

bool PolygonCover::covers(Key2 key) const {
    std::vector<std::uint32_t> passed;  // polygons whose rings the way to the right passes, once a passing
    bool is_on_ring = false;
    segments_.visit_meeting(
        {key, {std::max(right_, key.x), key.y}}, [&](const LineSegments::Segment& segment) {
            const Key2 a = segments_.start(segment);
            const Key2 b = segments_.end(segment);
            is_on_ring = is_on_ring || is_on_segment(key, a, b);
            // Each end belongs to the upper part, so that a corner at the key's height counts once or twice.
            const bool goes_up = a.y <= key.y && b.y > key.y;
            const bool goes_down = b.y <= key.y && a.y > key.y;
            if ((goes_up && orient2d(a, b, key) > 0) || (goes_down && orient2d(a, b, key) < 0)) {
                passed.push_back(polygons_[segment.line]);
            }
        });
    if (is_on_ring) {
        return true;
    }
    std::sort(passed.begin(), passed.end());
    for (std::size_t begin = 0, end = 0; begin < passed.size(); begin = end) {
        end = begin + 1;
        while (end < passed.size() && passed[end] == passed[begin]) {
            ++end;
        }
        if ((end - begin) % 2 != 0) {
            return true;
        }
    }
    return false;
}

}  // namespace tinwright
