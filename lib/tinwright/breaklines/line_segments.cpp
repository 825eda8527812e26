#include "tinwright/breaklines/line_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tinwright/breaklines/segment_distance.hpp"

namespace tinwright {
namespace {

std::vector<LineSegments::Segment> list_segments(std::span<const CleanLine> lines) {
    std::vector<LineSegments::Segment> segments;
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
        for (std::uint32_t i = 0; i + 1 < lines[line].keys.size(); ++i) {
            segments.push_back({line, i});
        }
    }
    return segments;
}

std::vector<KeyBox> boxes_of(std::span<const CleanLine> lines,
                             std::span<const LineSegments::Segment> segments) {
    std::vector<KeyBox> boxes;
    boxes.reserve(segments.size());
    for (const LineSegments::Segment& segment : segments) {
        const std::vector<Key2>& keys = lines[segment.line].keys;
        boxes.push_back(KeyBox::of(std::array{keys[segment.index], keys[segment.index + 1]}));
    }
    return boxes;
}

}  // namespace

LineSegments::LineSegments(std::span<const CleanLine> lines)
    : lines_(lines), segments_(list_segments(lines)), tree_(boxes_of(lines, segments_)) {}

double LineSegments::elevation(const Segment& segment, double fraction) const {
    const std::vector<double>& z = lines_[segment.line].z;
    return elevation_at(z[segment.index], z[segment.index + 1], fraction);
}

double LineSegments::median_length() const {
    if (segments_.empty()) {
        return 0;
    }
    std::vector<double> squares;
    squares.reserve(segments_.size());
    for (const Segment& segment : segments_) {
        squares.push_back(squared_distance(start(segment), end(segment)));
    }
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return std::sqrt(*middle);
}

}  // namespace tinwright
