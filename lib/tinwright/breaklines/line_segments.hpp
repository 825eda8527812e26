#ifndef TINWRIGHT_BREAKLINES_LINE_SEGMENTS_HPP
#define TINWRIGHT_BREAKLINES_LINE_SEGMENTS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {

/// The segments of many lines, to be found by where they are.
class LineSegments {
  public:
    struct Segment {
        std::uint32_t line;   ///< index of the line
        std::uint32_t index;  ///< of its first point within the line
    };

    /// `lines` must outlive this object. O(n log n), parallel inside the caller's task arena.
    explicit LineSegments(std::span<const CleanLine> lines);

    [[nodiscard]] std::size_t size() const { return segments_.size(); }
    [[nodiscard]] const Segment& operator[](std::size_t i) const { return segments_[i]; }
    [[nodiscard]] Key2 start(const Segment& segment) const {
        return lines_[segment.line].keys[segment.index];
    }
    [[nodiscard]] Key2 end(const Segment& segment) const {
        return lines_[segment.line].keys[segment.index + 1];
    }
    [[nodiscard]] double elevation(const Segment& segment, double fraction) const;
    /// Median length of a segment, in keys; 0 without segments. O(n).
    [[nodiscard]] double median_length() const;

    /// Calls `visit(segment)` for the segments whose box meets `box`.
    template <class Visit>
    void visit_meeting(const KeyBox& box, const Visit& visit) const {
        tree_.visit_meeting(
            box, [](const KeyBox&) { return false; },
            [&](std::uint32_t i) {
                visit(segments_[i]);
                return true;
            });
    }

  private:
    std::span<const CleanLine> lines_;
    std::vector<Segment> segments_;
    BoxTree tree_;
};

/// The box of everything within `distance` of a key.
inline KeyBox box_around(Key2 key, double distance) {
    return {{key.x - distance, key.y - distance}, {key.x + distance, key.y + distance}};
}

}  // namespace tinwright

#endif
