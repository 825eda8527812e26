#ifndef TINWRIGHT_MESH_BOX_TREE_HPP
#define TINWRIGHT_MESH_BOX_TREE_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// Closed axis-parallel box of keys.
struct KeyBox {
    Key2 low{};
    Key2 high{};

    /// The box of some keys, one at least.
    static KeyBox of(std::span<const Key2> keys) {
        KeyBox box{keys[0], keys[0]};
        for (const Key2 key : keys) {
            box.add({key, key});
        }
        return box;
    }
    void add(const KeyBox& other) {
        low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
        high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
    }
    [[nodiscard]] bool meets(const KeyBox& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y;
    }
};

/// Which side of the line through two keys a box is on: +1 left, -1 right, 0 on both or on the line.
int side_of_line(Key2 a, Key2 b, const KeyBox& box);

/// Boxes in a tree of eight children a node, items in the order of the curve through their middles: finds
/// those that meet a given box whether items are spread evenly or over many decades.
/// Build: O(n log n), parallel inside the caller's task arena. 36 bytes an item and a little more.
class BoxTree {
  public:
    explicit BoxTree(std::span<const KeyBox> boxes);

    /// Items in the order of the tree: the order to ask for them in, near ones in succession.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

    /// Calls `visit(item)` for the items whose box meets `box`, in the order of the tree, until it returns
    /// false. Subtrees whose box `is_apart` of what is looked for are left out: box -> bool, and a promise
    /// for everything in that box.
    template <class IsApart, class Visit>
    void visit_meeting(const KeyBox& box, const IsApart& is_apart, const Visit& visit) const {
        if (!order_.empty()) {
            visit_node(levels_.size() - 1, 0, box, is_apart, visit);
        }
    }

  private:
    static constexpr std::size_t kChildren = 8;

    template <class IsApart, class Visit>
    bool visit_node(std::size_t level, std::size_t node, const KeyBox& box, const IsApart& is_apart,
                    const Visit& visit) const {
        const std::size_t below = level == 0 ? order_.size() : levels_[level - 1].size();
        const std::size_t end = std::min(below, (node + 1) * kChildren);
        for (std::size_t child = node * kChildren; child < end; ++child) {
            const KeyBox& of_child = level == 0 ? items_[child] : levels_[level - 1][child];
            if (!of_child.meets(box)) {
                continue;
            }
            if (level == 0) {
                if (!visit(order_[child])) {
                    return false;
                }
            } else if (!is_apart(of_child) && !visit_node(level - 1, child, box, is_apart, visit)) {
                return false;
            }
        }
        return true;
    }

    std::vector<std::uint32_t> order_;
    std::vector<KeyBox> items_;                // in the order of order_
    std::vector<std::vector<KeyBox>> levels_;  // level 0: one box for eight items; last level: one box
};

}  // namespace tinwright

#endif
