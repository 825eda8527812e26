#include "tinwright/breaklines/point_joining.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "tinwright/breaklines/near_lines.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"

namespace tinwright {
namespace {

struct CurveOrder {
    bool operator()(Key2 a, Key2 b) const { return precedes_on_curve(a, b); }
};

/// Groups of keys that become one, each named by its first key along the curve.
class KeyGroups {
  public:
    // Not recursive: a chain of near misses may be as long as the lines.
    Key2 find(Key2 key) {
        for (auto at = parent_.find(key); at != parent_.end();) {
            const auto above = parent_.find(at->second);
            key = at->second;
            if (above != parent_.end()) {
                key = at->second = above->second;
            }
            at = parent_.find(key);
        }
        return key;
    }
    void join(Key2 a, Key2 b) {
        const Key2 first = find(a);
        const Key2 second = find(b);
        if (!(first == second)) {
            const bool is_in_order = precedes_on_curve(first, second);
            parent_[is_in_order ? second : first] = is_in_order ? first : second;
        }
    }
    [[nodiscard]] bool is_empty() const { return parent_.empty(); }

  private:
    std::map<Key2, Key2, CurveOrder> parent_;
};

bool join_own_ends(KeyedLines& keyed) {
    bool has_changed = false;
    for (CleanLine& line : keyed.lines) {
        if (has_gap(line, keyed.snap)) {
            line.keys.back() = line.keys.front();
            line.z.back() = line.z.front();
            has_changed = true;
        }
    }
    return has_changed;
}

}  // namespace

void insert_points(std::span<CleanLine> lines, std::vector<PointInsertion> insertions) {
    std::sort(insertions.begin(), insertions.end(), [](const PointInsertion& a, const PointInsertion& b) {
        return std::tuple(a.line, a.segment, a.fraction, a.key.x, a.key.y) <
               std::tuple(b.line, b.segment, b.fraction, b.key.x, b.key.y);
    });
    for (std::size_t begin = 0, end = 0; begin < insertions.size(); begin = end) {
        const CleanLine& old = lines[insertions[begin].line];
        CleanLine longer;
        std::uint32_t copied = 0;  // points of the old line
        const auto copy_until = [&](std::size_t last) {
            for (; copied < last; ++copied) {
                longer.keys.push_back(old.keys[copied]);
                longer.z.push_back(old.z[copied]);
            }
        };
        for (end = begin; end < insertions.size() && insertions[end].line == insertions[begin].line; ++end) {
            copy_until(insertions[end].segment + 1);
            longer.keys.push_back(insertions[end].key);
            longer.z.push_back(insertions[end].z);
        }
        copy_until(old.keys.size());
        lines[insertions[begin].line] = std::move(longer);
    }
}

bool snap_near_misses(KeyedLines& keyed) {
    if (!(keyed.snap > 0)) {
        return false;
    }
    if (join_own_ends(keyed)) {
        return true;
    }
    const LineSegments segments(keyed.lines);
    const std::vector<Approach> approaches = find_approaches(keyed.lines, segments, keyed.snap);
    KeyGroups groups;
    const auto key_of = [&](LinePoint point) { return keyed.lines[point.line].keys[point.index]; };
    for (const Approach& approach : approaches) {
        if (approach.vertex) {
            groups.join(key_of(approach.point), key_of(*approach.vertex));
        }
    }
    if (!groups.is_empty()) {
        for (CleanLine& line : keyed.lines) {
            for (Key2& key : line.keys) {
                key = groups.find(key);
            }
        }
        return true;
    }
    std::vector<PointInsertion> insertions;
    insertions.reserve(approaches.size());
    for (const Approach& approach : approaches) {
        insertions.push_back({approach.segment.line, approach.segment.index, approach.distance.fraction,
                              key_of(approach.point),
                              segments.elevation(approach.segment, approach.distance.fraction)});
    }
    insert_points(keyed.lines, std::move(insertions));
    return !approaches.empty();
}

}  // namespace tinwright
