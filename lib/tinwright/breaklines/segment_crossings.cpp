#include "tinwright/breaklines/segment_crossings.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {
namespace {

constexpr std::size_t kGroup = 8;   // segments that look for others together
constexpr std::size_t kBlock = 64;  // groups a task
constexpr double kLong = 8;         // times the median size: a segment that looks by itself

double half_perimeter(const KeyBox& box) { return (box.high.x - box.low.x) + (box.high.y - box.low.y); }

/// Neighbours of similar size, with their boxes.
class Groups {
  public:
    /// `numbers`: of segments; `boxes` of all segments.
    Groups(std::vector<std::uint32_t> numbers, std::span<const KeyBox> boxes)
        : numbers_(along_curve(std::move(numbers), boxes)),
          boxes_(boxes_of(numbers_, boxes)),
          group_boxes_(joined(boxes_)),
          tree_(group_boxes_) {}

    [[nodiscard]] std::size_t count() const { return group_boxes_.size(); }
    [[nodiscard]] static std::size_t begin(std::size_t group) { return group * kGroup; }
    [[nodiscard]] std::size_t end(std::size_t group) const {
        return std::min(numbers_.size(), (group + 1) * kGroup);
    }
    [[nodiscard]] std::uint32_t number(std::size_t i) const { return numbers_[i]; }
    [[nodiscard]] const KeyBox& box(std::size_t i) const { return boxes_[i]; }

    /// Calls `visit(i)` for the places i from `first` on whose box meets `box`; subtrees that are apart from
    /// it are left out.
    template <class IsApart, class Visit>
    void visit_meeting(const KeyBox& box, std::size_t first, const IsApart& is_apart,
                       const Visit& visit) const {
        tree_.visit_meeting(box, is_apart, [&](std::uint32_t group) {
            for (std::size_t i = std::max(first, begin(group)); i < end(group); ++i) {
                if (boxes_[i].meets(box)) {
                    visit(i);
                }
            }
            return true;
        });
    }

    /// Calls `visit(i, j)` for the pairs i < j of places whose boxes meet, i in `group`.
    template <class Visit>
    void visit_pairs(std::size_t group, const Visit& visit) const {
        const auto never = [](const KeyBox& /*box*/) { return false; };
        tree_.visit_meeting(group_boxes_[group], never, [&](std::uint32_t other) {
            if (other >= group) {
                visit_pairs_of(group, other, visit);
            }
            return true;
        });
    }

  private:
    template <class Visit>
    void visit_pairs_of(std::size_t group, std::size_t other, const Visit& visit) const {
        for (std::size_t i = begin(group); i < end(group); ++i) {
            if (!boxes_[i].meets(group_boxes_[other])) {
                continue;
            }
            for (std::size_t j = std::max(i + 1, begin(other)); j < end(other); ++j) {
                if (boxes_[i].meets(boxes_[j])) {
                    visit(i, j);
                }
            }
        }
    }

    static std::vector<std::uint32_t> along_curve(std::vector<std::uint32_t> numbers,
                                                  std::span<const KeyBox> boxes) {
        std::vector<Key2> middles;
        middles.reserve(numbers.size());
        for (const std::uint32_t number : numbers) {
            const KeyBox& box = boxes[number];
            middles.push_back(
                {std::floor(0.5 * (box.low.x + box.high.x)), std::floor(0.5 * (box.low.y + box.high.y))});
        }
        std::vector<std::uint32_t> order = sort_along_curve(middles);
        for (std::uint32_t& place : order) {
            place = numbers[place];
        }
        return order;
    }

    static std::vector<KeyBox> boxes_of(std::span<const std::uint32_t> numbers,
                                        std::span<const KeyBox> boxes) {
        std::vector<KeyBox> own;
        own.reserve(numbers.size());
        for (const std::uint32_t number : numbers) {
            own.push_back(boxes[number]);
        }
        return own;
    }

    static std::vector<KeyBox> joined(std::span<const KeyBox> boxes) {
        std::vector<KeyBox> groups;
        groups.reserve(boxes.size() / kGroup + 1);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (i % kGroup == 0) {
                groups.push_back(boxes[i]);
            } else {
                groups.back().add(boxes[i]);
            }
        }
        return groups;
    }

    std::vector<std::uint32_t> numbers_;
    std::vector<KeyBox> boxes_;
    std::vector<KeyBox> group_boxes_;
    BoxTree tree_;
};

/// Short segments look for each other in groups; long ones, whose boxes tell little, one by one with their
/// lines, for short ones and for each other.
class CrossingSearch {
  public:
    CrossingSearch(const LineNetwork& network, std::span<const KeyBox> boxes,
                   std::array<std::vector<std::uint32_t>, 2> short_and_long)
        : network_(network),
          short_(std::move(short_and_long[0]), boxes),
          long_(std::move(short_and_long[1]), boxes),
          marks_(boxes.size()) {}

    SegmentCrossings find_all() {
        const std::size_t groups = short_.count() + long_.count();
        std::vector<std::vector<Key2>> found((groups + kBlock - 1) / kBlock);
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
            const std::size_t end = std::min(groups, (block + 1) * kBlock);
            for (std::size_t group = block * kBlock; group < end; ++group) {
                find_with(group, found[block]);
            }
        });
        SegmentCrossings crossings;
        for (const std::vector<Key2>& part : found) {
            crossings.keys.insert(crossings.keys.end(), part.begin(), part.end());
        }
        crossings.rounded = marked(kRounded);
        crossings.meeting = marked(kMeets);
        return crossings;
    }

  private:
    /// Many of a group's crossings may be in one place.
    void find_with(std::size_t group, std::vector<Key2>& found) {
        const std::size_t first = found.size();
        if (group < short_.count()) {
            short_.visit_pairs(group, [&](std::size_t i, std::size_t j) {
                try_pair(short_.number(i), short_.number(j), found);
            });
        } else {
            group -= short_.count();
            for (std::size_t i = Groups::begin(group); i < long_.end(group); ++i) {
                find_with_long(i, found);
            }
        }
        const auto own = found.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(own, found.end(), precedes);
        found.erase(std::unique(own, found.end()), found.end());
    }

    void find_with_long(std::size_t i, std::vector<Key2>& found) {
        const std::uint32_t segment = long_.number(i);
        const Key2 a = network_.a(segment);
        const Key2 b = network_.b(segment);
        const KeyBox& box = long_.box(i);
        const double size = half_perimeter(box);
        // Only boxes smaller than the segment's are worth comparing with its line.
        const auto is_apart = [&](const KeyBox& node) {
            return half_perimeter(node) < size && side_of_line(a, b, node) != 0;
        };
        short_.visit_meeting(box, 0, is_apart,
                             [&](std::size_t j) { try_pair(segment, short_.number(j), found); });
        long_.visit_meeting(box, i + 1, is_apart,
                            [&](std::size_t j) { try_pair(segment, long_.number(j), found); });
    }

    /// `p` and `q`: different segments whose boxes meet.
    void try_pair(std::uint32_t p, std::uint32_t q, std::vector<Key2>& found) {
        const LineSegment& of_p = network_.segments[p];
        const LineSegment& of_q = network_.segments[q];
        if (of_p.a == of_q.a || of_p.a == of_q.b) {
            try_pair_at(of_p.a, p, of_p.b, q);
            return;
        }
        if (of_p.b == of_q.a || of_p.b == of_q.b) {
            try_pair_at(of_p.b, p, of_p.a, q);
            return;
        }
        const Key2 a = network_.a(p);
        const Key2 b = network_.b(p);
        const Key2 c = network_.a(q);
        const Key2 d = network_.b(q);
        const int across_p = orient2d(a, b, c) * orient2d(a, b, d);
        if (across_p > 0) {
            return;
        }
        const int across_q = orient2d(c, d, a) * orient2d(c, d, b);
        if (across_q > 0) {
            return;
        }
        mark(p, kMeets);
        mark(q, kMeets);
        if (across_p == 0 || across_q == 0) {
            return;  // an end of one lies on the other
        }
        const RoundedCrossing at = round_crossing(a, b, c, d);
        found.push_back(at.key);
        if (!at.is_exact) {
            mark(p, kMeets | kRounded);
            mark(q, kMeets | kRounded);
        }
    }

    /// Of two segments from the same site; `far_p` is the other end of p.
    void try_pair_at(std::uint32_t site, std::uint32_t p, std::uint32_t far_p, std::uint32_t q) {
        const LineSegment& of_q = network_.segments[q];
        const Key2 apex = network_.sites[site];
        const Key2 to_p = network_.sites[far_p];
        const Key2 to_q = network_.sites[of_q.a == site ? of_q.b : of_q.a];
        if (orient2d(to_p, apex, to_q) == 0 && angle_sign(to_p, apex, to_q) > 0) {
            mark(p, kMeets);
            mark(q, kMeets);
        }
    }

    static constexpr unsigned char kMeets = 1;
    static constexpr unsigned char kRounded = 2;

    /// From any task: bits are only ever added.
    void mark(std::uint32_t segment, unsigned char bits) {
        const std::atomic_ref<unsigned char> marks(marks_[segment]);
        if ((marks.load(std::memory_order_relaxed) & bits) != bits) {
            marks.fetch_or(bits, std::memory_order_relaxed);
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> marked(unsigned char bits) const {
        std::vector<std::uint32_t> segments;
        for (std::uint32_t s = 0; s < marks_.size(); ++s) {
            if ((marks_[s] & bits) != 0) {
                segments.push_back(s);
            }
        }
        return segments;
    }

    const LineNetwork& network_;
    Groups short_;
    Groups long_;
    std::vector<unsigned char> marks_;  // one a segment
};

std::array<std::vector<std::uint32_t>, 2> split_by_size(std::span<const KeyBox> boxes) {
    std::vector<double> sizes;
    sizes.reserve(boxes.size());
    for (const KeyBox& box : boxes) {
        sizes.push_back(half_perimeter(box));
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    std::array<std::vector<std::uint32_t>, 2> short_and_long;
    for (std::uint32_t s = 0; s < boxes.size(); ++s) {
        short_and_long[half_perimeter(boxes[s]) > kLong * *middle ? 1 : 0].push_back(s);
    }
    return short_and_long;
}

}  // namespace

SegmentCrossings find_crossings(const LineNetwork& network) {
    std::vector<KeyBox> boxes(network.segments.size());
    for (std::uint32_t s = 0; s < boxes.size(); ++s) {
        boxes[s] = KeyBox::of(std::array{network.a(s), network.b(s)});
    }
    return boxes.empty() ? SegmentCrossings{}
                         : CrossingSearch(network, boxes, split_by_size(boxes)).find_all();
}

}  // namespace tinwright
