#ifndef TINWRIGHT_BREAKLINES_POLYGON_COVER_HPP
#define TINWRIGHT_BREAKLINES_POLYGON_COVER_HPP

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/breaklines/line_segments.hpp"

namespace tinwright {

/// The area of polygons together: a place is in it if it is inside one of them, on a ring of one, or both.
class PolygonCover {
  public:
    /// `rings`: closed lines; `polygons`: the number of each one's polygon. Keys of magnitude up to 2^52.
    PolygonCover(std::vector<CleanLine> rings, std::vector<std::uint32_t> polygons);
    ~PolygonCover() = default;
    PolygonCover(const PolygonCover&) = delete;
    PolygonCover& operator=(const PolygonCover&) = delete;

    /// Exact. O(sqrt n + k) in practice for k ring segments to the right of the key at its height.
    [[nodiscard]] bool covers(Key2 key) const;

  private:
    std::vector<CleanLine> rings_;
    std::vector<std::uint32_t> polygons_;
    LineSegments segments_;
    double right_ = 0;  // nothing is further right
};

}  // namespace tinwright

#endif
