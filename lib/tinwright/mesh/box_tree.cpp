#include "tinwright/mesh/box_tree.hpp"

#include <cmath>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

int side_of_line(Key2 a, Key2 b, const KeyBox& box) {
    // The corners farthest to the left and to the right of the direction a -> b.
    const bool goes_up = b.y > a.y;
    const bool goes_right = b.x > a.x;
    const Key2 leftmost{goes_up ? box.low.x : box.high.x, goes_right ? box.high.y : box.low.y};
    const Key2 rightmost{goes_up ? box.high.x : box.low.x, goes_right ? box.low.y : box.high.y};
    if (orient2d(a, b, leftmost) < 0) {
        return -1;
    }
    return orient2d(a, b, rightmost) > 0 ? 1 : 0;
}

BoxTree::BoxTree(std::span<const KeyBox> boxes) {
    std::vector<Key2> middles(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const KeyBox& box = boxes[i];
        middles[i] = {std::floor(0.5 * (box.low.x + box.high.x)), std::floor(0.5 * (box.low.y + box.high.y))};
    }
    order_ = sort_along_curve(middles);
    items_.reserve(boxes.size());
    for (const std::uint32_t item : order_) {
        items_.push_back(boxes[item]);
    }
    for (const std::vector<KeyBox>* below = &items_; levels_.empty() || below->size() > 1;) {
        std::vector<KeyBox> level;
        level.reserve(below->size() / kChildren + 1);
        for (std::size_t i = 0; i < below->size(); ++i) {
            if (i % kChildren == 0) {
                level.push_back((*below)[i]);
            } else {
                level.back().add((*below)[i]);
            }
        }
        levels_.push_back(std::move(level));
        below = &levels_.back();
    }
}

}  // namespace tinwright
