#include "tinwright/surface/segment_passage.hpp"

#include <algorithm>
#include <array>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

using Kind = PassageMark::Kind;

/// Order along the line from a to b.
class AlongLine {
  public:
    AlongLine(Key2 a, Key2 b) : a_(a), b_(b), is_forward_(precedes(a, b)) {}

    [[nodiscard]] int compare_keys(Key2 u, Key2 v) const {
        return u == v ? 0 : precedes(u, v) == is_forward_ ? -1 : 1;
    }

    /// Negative: `one` comes first. The start and the end are first and last whatever the others say.
    [[nodiscard]] int compare(const PassageMark& one, const PassageMark& other) const {
        if (is_end(one) || is_end(other)) {
            return static_cast<int>(one.kind) - static_cast<int>(other.kind);
        }
        if (one.kind == Kind::Vertex) {
            return other.kind == Kind::Vertex ? compare_keys(one.p, other.p)
                                              : orient2d(other.p, other.q, one.p);
        }
        if (other.kind == Kind::Vertex) {
            return -orient2d(one.p, one.q, other.p);
        }
        return one.p == other.p && one.q == other.q
                   ? 0
                   : compare_crossings(a_, b_, one.p, one.q, other.p, other.q);
    }

    /// A mark on the line as one of the segment: -1 before its start, +1 behind its end; what is on an end
    /// becomes that end.
    int clip(PassageMark& mark) const {
        const bool is_vertex = mark.kind == Kind::Vertex;
        // Ahead of an edge from the left to the right of the line is its left side.
        const int from_a = is_vertex ? compare_keys(mark.p, a_) : -orient2d(mark.p, mark.q, a_);
        const int from_b = is_vertex ? compare_keys(mark.p, b_) : -orient2d(mark.p, mark.q, b_);
        if (from_a == 0) {
            mark = {Kind::Start, a_, a_};
        } else if (from_b == 0) {
            mark = {Kind::End, b_, b_};
        }
        return from_a < 0 ? -1 : from_b > 0 ? 1 : 0;
    }

  private:
    static bool is_end(const PassageMark& mark) { return mark.kind == Kind::Start || mark.kind == Kind::End; }

    Key2 a_;
    Key2 b_;
    bool is_forward_;
};

/// What a segment has in common with a face.
struct FacePassage {
    FaceId face{};
    PassageMark in;
    PassageMark out;
};

std::optional<FacePassage> pass_face(const FaceTree& faces, FaceId f, const AlongLine& line, Key2 a, Key2 b) {
    const std::array corner{faces.corner(f, 0), faces.corner(f, 1), faces.corner(f, 2)};
    std::array<int, 3> side{};
    for (unsigned i = 0; i < 3; ++i) {
        side[i] = orient2d(a, b, corner[i]);
    }
    // A line meets a triangle in two places at most: vertices on it, and edges between its two sides.
    std::array<PassageMark, 2> met;
    std::size_t count = 0;
    for (unsigned i = 0; i < 3 && count < 2; ++i) {
        const unsigned j = next_corner(i);
        if (side[i] == 0) {
            met[count++] = {Kind::Vertex, corner[i], corner[i]};
        } else if (side[i] * side[j] < 0) {
            met[count++] = side[i] > 0 ? PassageMark{Kind::Edge, corner[i], corner[j]}
                                       : PassageMark{Kind::Edge, corner[j], corner[i]};
        }
    }
    if (count == 0) {
        return std::nullopt;
    }
    FacePassage passage{f, met[0], met[count - 1]};
    if (line.compare(passage.in, passage.out) > 0) {
        std::swap(passage.in, passage.out);
    }
    const int in = line.clip(passage.in);
    const int out = line.clip(passage.out);
    if (in > 0 || out < 0) {
        return std::nullopt;
    }
    if (in < 0) {
        passage.in = {Kind::Start, a, a};
    }
    if (out > 0) {
        passage.out = {Kind::End, b, b};
    }
    return passage;
}

void keep_smaller(std::optional<FaceId>& kept, FaceId f) {
    if (!kept || f < *kept) {
        kept = f;
    }
}

}  // namespace

SegmentPassage find_passage(const FaceTree& faces, Key2 a, Key2 b) {
    const AlongLine line(a, b);
    std::vector<FacePassage> passed;
    const KeyBox box = KeyBox::of(std::array{a, b});
    faces.visit_meeting(
        box, [&](const KeyBox& node) { return side_of_line(a, b, node) != 0; },
        [&](FaceId f) {
            if (const auto passage = pass_face(faces, f, line, a, b)) {
                passed.push_back(*passage);
            }
            return true;
        });

    SegmentPassage result;
    std::vector<PassageMark>& marks = result.marks;
    marks = {{Kind::Start, a, a}, {Kind::End, b, b}};
    for (const FacePassage& passage : passed) {
        marks.push_back(passage.in);
        marks.push_back(passage.out);
    }
    const auto is_before = [&](const PassageMark& one, const PassageMark& other) {
        return line.compare(one, other) < 0;
    };
    std::sort(marks.begin(), marks.end(), is_before);
    marks.erase(std::unique(marks.begin(), marks.end(),
                            [&](const PassageMark& one, const PassageMark& other) {
                                return line.compare(one, other) == 0;
                            }),
                marks.end());
    result.touched.resize(marks.size());
    result.covers.resize(marks.size() - 1);
    const auto place_of = [&](const PassageMark& mark) {
        return static_cast<std::size_t>(std::lower_bound(marks.begin(), marks.end(), mark, is_before) -
                                        marks.begin());
    };
    for (const FacePassage& passage : passed) {
        const std::size_t out = place_of(passage.out);
        for (std::size_t i = place_of(passage.in); i < out; ++i) {
            keep_smaller(result.touched[i], passage.face);
            keep_smaller(result.covers[i], passage.face);
        }
        keep_smaller(result.touched[out], passage.face);
    }
    return result;
}

}  // namespace tinwright
