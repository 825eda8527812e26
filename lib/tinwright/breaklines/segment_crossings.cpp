#include "tinwright/breaklines/segment_crossings.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {
namespace {

constexpr std::size_t kBlock = 1024;  // segments a task

double half_perimeter(const KeyBox& box) { return (box.high.x - box.low.x) + (box.high.y - box.low.y); }

class CrossingSearch {
  public:
    explicit CrossingSearch(const LineNetwork& network)
        : network_(network), boxes_(boxes_of(network)), tree_(boxes_), is_rounded_(boxes_.size()) {}

    SegmentCrossings find_all() {
        const std::size_t count = tree_.order().size();
        std::vector<std::vector<Key2>> found((count + kBlock - 1) / kBlock);
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
            const std::size_t end = std::min(count, (block + 1) * kBlock);
            for (std::size_t i = block * kBlock; i < end; ++i) {
                find_with(tree_.order()[i], found[block]);
            }
        });
        SegmentCrossings crossings;
        for (const std::vector<Key2>& part : found) {
            crossings.keys.insert(crossings.keys.end(), part.begin(), part.end());
        }
        for (std::uint32_t s = 0; s < is_rounded_.size(); ++s) {
            if (is_rounded_[s] != 0) {
                crossings.rounded.push_back(s);
            }
        }
        return crossings;
    }

  private:
    static std::vector<KeyBox> boxes_of(const LineNetwork& network) {
        std::vector<KeyBox> boxes(network.segments.size());
        for (std::uint32_t s = 0; s < boxes.size(); ++s) {
            const Key2 a = network.a(s);
            const Key2 b = network.b(s);
            boxes[s] = {{a.x, std::min(a.y, b.y)}, {b.x, std::max(a.y, b.y)}};
        }
        return boxes;
    }

    /// Crossings of a segment with those of smaller number; many of them may be in one place.
    void find_with(std::uint32_t segment, std::vector<Key2>& found) {
        const Key2 a = network_.a(segment);
        const Key2 b = network_.b(segment);
        const KeyBox& box = boxes_[segment];
        const double size = half_perimeter(box);
        const std::size_t first = found.size();
        tree_.visit_meeting(
            box,
            // Only boxes smaller than the segment's are worth comparing with its line.
            [&](const KeyBox& node) { return half_perimeter(node) < size && side_of_line(a, b, node) != 0; },
            [&](std::uint32_t other) {
                if (other < segment && do_cross(a, b, network_.a(other), network_.b(other))) {
                    const RoundedCrossing at = round_crossing(a, b, network_.a(other), network_.b(other));
                    found.push_back(at.key);
                    if (!at.is_exact) {
                        mark_rounded(segment);
                        mark_rounded(other);
                    }
                }
                return true;
            });
        const auto own = found.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(own, found.end(), precedes);
        found.erase(std::unique(own, found.end()), found.end());
    }

    /// From any task: all of them write the same.
    void mark_rounded(std::uint32_t segment) {
        std::atomic_ref(is_rounded_[segment]).store(1, std::memory_order_relaxed);
    }

    const LineNetwork& network_;
    std::vector<KeyBox> boxes_;
    BoxTree tree_;
    std::vector<char> is_rounded_;
};

}  // namespace

SegmentCrossings find_crossings(const LineNetwork& network) { return CrossingSearch(network).find_all(); }

}  // namespace tinwright
