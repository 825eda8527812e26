#ifndef TINWRIGHT_OPTIMAL_EXPANDABLE_EDGE_HPP
#define TINWRIGHT_OPTIMAL_EXPANDABLE_EDGE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/optimal/incomplete_polygon.hpp"
#include "tinwright/optimal/wall_polygon.hpp"

namespace tinwright::internal {

/// Finds the edge that a complete polygon, all whose sides are empty towards its inside, is to be divided by
/// [tan1993, Sec. 5.6].
///
/// A diagonal is a 2-edge if it is empty on neither side, and expandable if on each side it can be the base
/// of a face beneath the face's other two edges. The shortest expandable 2-edge is the longest edge of a
/// min-max length triangulation (2-Edge Lemma).
class ExpandableEdgeSearch {
  public:
    struct Diagonal {
        std::uint32_t low;  ///< positions of its ends
        std::uint32_t high;
    };

    explicit ExpandableEdgeSearch(WallPolygon& polygon) : polygon_(polygon) {}

    /// The shortest expandable 2-edge among those that come before a pair of vertices which is no shorter
    /// than any side; empty if there is none, or when stopped. `at_least`: comes before no edge that can be
    /// the one, since no triangulation without an edge like `before` has all its edges before it.
    ///
    /// Only lines of sight before the pair are looked at. That leaves the result as it is: the faces at an
    /// expandable edge lie in its lune, so their edges, which alone can make it pass the test of step 3, are
    /// shorter than it is; and what passes with fewer lines passes with all. O(n^2) for n sides, less where
    /// little is seen within that length; 120 MB at most: if more 2-edges come into question, they are taken
    /// in several turns, shorter ones first, of which one is enough as a rule.
    std::optional<Diagonal> find_among_many(VertexPair at_least, VertexPair before, const Poll& poll);
    /// The same, for few sides: pairs of corners are tried shortest first. As a rule one of the first is the
    /// one, and only what its ends see has to be found. Makes the polygon keep its sights.
    std::optional<Diagonal> find_among_few(VertexPair at_least, VertexPair before);

    /// 2-edges that came into question, over all calls.
    [[nodiscard]] std::size_t candidates() const { return candidates_; }

  private:
    /// What is known of a 2-edge at one end: among the lines of sight from there, the nearest on either side
    /// of it that are empty towards it.
    struct HalfKnown {
        Diagonal edge;
        bool is_from_high;
        std::uint32_t before;  ///< position it leads to, clockwise of the 2-edge
        std::uint32_t behind;  ///< counter-clockwise
    };

    static constexpr std::size_t kMostKnown = 6'000'000;

    void note(std::uint32_t eye, VertexPair from, VertexPair limit,
              std::span<const WallPolygon::Sight> sights);
    VertexPair keep_shorter_half();
    [[nodiscard]] std::optional<Diagonal> find_among_known();
    [[nodiscard]] std::optional<HalfKnown> know(std::uint32_t eye, std::uint32_t other, VertexPair before);
    void collect_pairs(VertexPair at_least, VertexPair before);
    [[nodiscard]] bool is_shorter(VertexPair x, VertexPair y) const {
        return polygon_.order().is_shorter(x.first, x.second, y.first, y.second);
    }
    [[nodiscard]] VertexPair ends(const Diagonal& diagonal) const {
        return {polygon_.vertex(diagonal.low), polygon_.vertex(diagonal.high)};
    }
    [[nodiscard]] bool is_crossed_on_both_sides(const HalfKnown& of_low, const HalfKnown& of_high) const;

    WallPolygon& polygon_;
    std::vector<WallPolygon::Sight> space_;
    std::vector<std::uint32_t> behind_;
    std::vector<HalfKnown> known_;
    std::vector<Diagonal> pairs_;
    std::size_t candidates_ = 0;
};

}  // namespace tinwright::internal

#endif
