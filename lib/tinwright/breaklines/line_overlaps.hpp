#ifndef TINWRIGHT_BREAKLINES_LINE_OVERLAPS_HPP
#define TINWRIGHT_BREAKLINES_LINE_OVERLAPS_HPP

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/keyed_lines.hpp"

namespace tinwright {

/// Tells lines that share stretches as neighbours do (two parcels, a boundary along a breakline) from lines
/// that lie over each other by mistake.
class SharedStretches {
  public:
    using PlainPiece = std::array<std::uint32_t, 3>;  ///< vertices, the smaller first, and line

    /// `noded`: the lines of `keyed`, noded without snapping. O(n log n).
    SharedStretches(const KeyedLines& keyed, std::span<const Breakline> lines, const NodedLines& noded);

    /// Whether whatever two lines have in common goes from point to point of both, and they have different
    /// roles or are rings of different polygons that are not the same.
    [[nodiscard]] bool are_harmless(std::uint32_t line_a, std::uint32_t line_b) const;

  private:
    /// Role and number of a polygon.
    using Polygon = std::pair<LineRole, std::uint32_t>;
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    [[nodiscard]] Polygon polygon_of(std::uint32_t line) const {
        return {lines_[line].role, keyed_.traits[line].polygon};
    }
    [[nodiscard]] bool may_share(std::uint32_t line_a, std::uint32_t line_b) const;
    void find_partial(const NodedLines& noded);
    void add_partial(std::span<const NodedPiece> group, const std::vector<PlainPiece>& segments);
    void find_polygons(const NodedLines& noded);

    const KeyedLines& keyed_;
    std::span<const Breakline> lines_;
    std::set<Edge>
        partial_;  // pairs of lines, the smaller first, with a stretch in common that is no segment
    std::map<Polygon, std::vector<Edge>> polygons_;  // their pieces, ascending
};

}  // namespace tinwright

#endif
