#include "tinwright/delaunay/water_areas.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

WaterAreas::WaterAreas(const NodedLines& noded, std::span<const Breakline> lines) : noded_(noded) {
    const auto is_side = [&](const NodedPiece& piece) {
        return piece.line < lines.size() && is_cleared_role(lines[piece.line].role) && piece.runs % 2 != 0;
    };
    const auto polygon_of = [&](const NodedPiece& piece) {
        return std::pair(lines[piece.line].role, lines[piece.line].polygon);
    };
    for (const NodedPiece& piece : noded.pieces) {
        if (is_side(piece)) {
            polygons_.push_back(polygon_of(piece));
        }
    }
    std::sort(polygons_.begin(), polygons_.end());
    polygons_.erase(std::unique(polygons_.begin(), polygons_.end()), polygons_.end());
    std::vector<bool> has_box(polygons_.size());
    boxes_.resize(polygons_.size());
    for (const NodedPiece& piece : noded.pieces) {
        if (is_side(piece)) {
            CleanLine side;
            side.keys = {twice(noded.keys[piece.a]), twice(noded.keys[piece.b])};
            side.z.resize(2);
            const KeyBox box = KeyBox::of(side.keys);
            sides_.push_back(std::move(side));
            const auto place = std::lower_bound(polygons_.begin(), polygons_.end(), polygon_of(piece));
            const auto polygon = static_cast<std::size_t>(place - polygons_.begin());
            has_box[polygon] ? boxes_[polygon].add(box) : void(boxes_[polygon] = box);
            has_box[polygon] = true;
            polygon_of_.push_back(static_cast<std::uint32_t>(polygon));
            ends_.emplace_back(piece.a, piece.b);
        }
    }
    segments_.emplace(sides_);
    tree_of_boxes_.emplace(boxes_);
}

std::optional<std::uint32_t> WaterAreas::around(const NodedPiece& piece) const {
    const Key2 a = noded_.keys[piece.a];
    const Key2 b = noded_.keys[piece.b];
    return find({a.x + b.x, a.y + b.y});
}

std::optional<std::uint32_t> WaterAreas::find(Key2 key) const {
    double right = key.x;  // of the boxes that the key is in
    bool is_in_box = false;
    tree_of_boxes_->visit_meeting(
        {key, key}, [](const KeyBox&) { return false; },
        [&](std::uint32_t polygon) {
            right = std::max(right, boxes_[polygon].high.x);
            return is_in_box = true;
        });
    if (!is_in_box) {
        return std::nullopt;
    }
    std::vector<std::uint32_t> passed;  // polygons whose rings the way to the right passes, once a passing
    std::vector<std::uint32_t> touched;
    segments_->visit_meeting({key, {right, key.y}}, [&](const LineSegments::Segment& segment) {
        if (!boxes_[polygon_of_[segment.line]].meets({key, key})) {
            return;  // perhaps not all of it is on the way
        }
        const Key2 a = segments_->start(segment);
        const Key2 b = segments_->end(segment);
        if (is_on_segment(key, a, b)) {
            touched.push_back(polygon_of_[segment.line]);
        }
        // Each end belongs to the upper part, so that a corner at the key's height counts once or twice.
        const bool goes_up = a.y <= key.y && b.y > key.y;
        const bool goes_down = b.y <= key.y && a.y > key.y;
        if ((goes_up && orient2d(a, b, key) > 0) || (goes_down && orient2d(a, b, key) < 0)) {
            passed.push_back(polygon_of_[segment.line]);
        }
    });
    std::sort(passed.begin(), passed.end());
    for (auto first = passed.begin(); first != passed.end();) {
        const auto last = std::upper_bound(first, passed.end(), *first);
        const bool is_inside = (last - first) % 2 != 0;
        if (is_inside && std::find(touched.begin(), touched.end(), *first) == touched.end()) {
            return *first;
        }
        first = last;
    }
    return std::nullopt;
}

double WaterAreas::level(std::uint32_t polygon, Key2 key) {
    std::unique_ptr<Surface>& surface = surfaces_[polygon];
    if (!surface) {
        surface = std::make_unique<Surface>();
        std::vector<std::uint32_t> vertices;
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            if (polygon_of_[i] == polygon) {
                vertices.push_back(ends_[i].first);
                vertices.push_back(ends_[i].second);
            }
        }
        std::sort(vertices.begin(), vertices.end());  // the order of the curve
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        for (const std::uint32_t v : vertices) {
            surface->keys.push_back(noded_.keys[v]);
            surface->z.push_back(noded_.z[v]);
        }
        surface->drape.emplace(surface->keys, surface->z);
    }
    return surface->drape->at(key).z;
}

ClearedAreas clear_areas(const WaterAreas& areas, std::span<const Breakline> lines,
                         std::span<const Key2> samples, NodedLines& noded) {
    ClearedAreas cleared;
    cleared.samples.assign(samples.size(), 0);
    cleared.vertices.assign(noded.keys.size(), 0);
    if (areas.is_empty()) {
        return cleared;
    }
    tbb::parallel_for(std::size_t{0}, samples.size(),
                      [&](std::size_t i) { cleared.samples[i] = areas.around(samples[i]) ? 1 : 0; });
    cleared.sample_count =
        static_cast<std::size_t>(std::count(cleared.samples.begin(), cleared.samples.end(), char{1}));
    std::vector<char> is_kept(noded.keys.size());
    std::vector<char> is_of_water(noded.keys.size());
    cleared.piece_count = std::erase_if(noded.pieces, [&](const NodedPiece& piece) {
        // Lines behind the given ones are borders too.
        const LineRole role = piece.line < lines.size() ? lines[piece.line].role : LineRole::Hole;
        if (role == LineRole::Breakline || role == LineRole::River) {
            return areas.around(piece).has_value();
        }
        is_kept[piece.a] = is_kept[piece.b] = 1;
        if (is_water_role(role)) {
            is_of_water[piece.a] = is_of_water[piece.b] = 1;
        }
        return false;
    });
    for (std::uint32_t v = 0; v < noded.keys.size(); ++v) {
        if (is_of_water[v] != 0 || !areas.around(noded.keys[v])) {
            continue;
        }
        if (is_kept[v] == 0) {
            cleared.vertices[v] = 1;
        } else {
            cleared.borders.push_back(v);
        }
    }
    return cleared;
}

}  // namespace tinwright
