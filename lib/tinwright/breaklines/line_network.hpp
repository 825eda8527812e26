#ifndef TINWRIGHT_BREAKLINES_LINE_NETWORK_HPP
#define TINWRIGHT_BREAKLINES_LINE_NETWORK_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/lattice.hpp"

/// What several lines have in common before they are cut: distinct locations, and distinct segments between
/// them. Numbers follow from the locations alone, whatever the order and directions of the lines.
namespace tinwright {

inline constexpr std::uint32_t kNoSegment = 0xFFFFFFFFU;

/// The points of all lines, one line after the other.
struct LinePoints {
    std::vector<Key2> keys;
    /// Where each line begins; one entry more than there are lines.
    std::vector<std::uint32_t> start;

    [[nodiscard]] std::size_t line_count() const { return start.size() - 1; }
};

/// Throws InputError for more than 2^29 points.
LinePoints gather_points(std::span<const Breakline> lines, const Lattice& lattice);

/// A straight part of lines between two of their points, which are different.
struct LineSegment {
    std::uint32_t a;  ///< index of a site; precedes the other end in lexicographic order
    std::uint32_t b;
    friend auto operator<=>(const LineSegment&, const LineSegment&) = default;
};

struct LineNetwork {
    std::vector<Key2> sites;            ///< distinct, in curve order
    std::vector<std::uint32_t> site;    ///< one a point
    std::vector<LineSegment> segments;  ///< ascending, distinct
    std::vector<std::uint32_t>
        segment_at;  ///< from a point to the next; none at a line's end, or of no length

    [[nodiscard]] Key2 a(std::uint32_t segment) const { return sites[segments[segment].a]; }
    [[nodiscard]] Key2 b(std::uint32_t segment) const { return sites[segments[segment].b]; }
};

/// O(n log n).
LineNetwork make_network(const LinePoints& points);

}  // namespace tinwright

#endif
