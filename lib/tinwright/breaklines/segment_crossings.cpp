#include "tinwright/breaklines/segment_crossings.hpp"

#include <algorithm>

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
        : network_(network), boxes_(boxes_of(network)), tree_(boxes_) {}

    std::vector<SegmentCrossing> find_all() const {
        const std::size_t count = tree_.order().size();
        std::vector<std::vector<SegmentCrossing>> found((count + kBlock - 1) / kBlock);
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
            const std::size_t end = std::min(count, (block + 1) * kBlock);
            for (std::size_t i = block * kBlock; i < end; ++i) {
                find_with(tree_.order()[i], found[block]);
            }
        });
        std::vector<SegmentCrossing> all;
        for (const std::vector<SegmentCrossing>& part : found) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
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

    /// Crossings of a segment with those of smaller number.
    void find_with(std::uint32_t segment, std::vector<SegmentCrossing>& found) const {
        const Key2 a = network_.a(segment);
        const Key2 b = network_.b(segment);
        const KeyBox& box = boxes_[segment];
        const double size = half_perimeter(box);
        tree_.visit_meeting(
            box,
            // Only boxes smaller than the segment's are worth comparing with its line.
            [&](const KeyBox& node) { return half_perimeter(node) < size && side_of_line(a, b, node) != 0; },
            [&](std::uint32_t other) {
                if (other < segment && do_cross(a, b, network_.a(other), network_.b(other))) {
                    const RoundedCrossing at = round_crossing(a, b, network_.a(other), network_.b(other));
                    found.push_back({at.key, other, segment, at.is_exact});
                }
                return true;
            });
    }

    const LineNetwork& network_;
    std::vector<KeyBox> boxes_;
    BoxTree tree_;
};

}  // namespace

std::vector<SegmentCrossing> find_crossings(const LineNetwork& network) {
    return CrossingSearch(network).find_all();
}

}  // namespace tinwright
