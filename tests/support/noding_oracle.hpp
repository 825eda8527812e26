#ifndef TINWRIGHT_TESTS_SUPPORT_NODING_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_NODING_ORACLE_HPP

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

/// Segments cut where they meet, by comparing all with all in rational numbers. Shares no code with the
/// library but its types.
namespace tinwright_tests::oracle {

using KeySegment = std::array<tinwright::Key2, 2>;

/// Lexicographic order, for sorted lists.
bool key_less(tinwright::Key2 p, tinwright::Key2 q);
bool segment_less(const KeySegment& p, const KeySegment& q);

/// Whether two segments share a point that is not an end of both.
bool meet_improperly(const KeySegment& p, const KeySegment& q);
/// Indices of two segments that do, if there are any; equal segments count. O(n^2).
std::optional<std::pair<std::size_t, std::size_t>> find_improper(std::span<const KeySegment> segments);

/// Whether a point is at most half a step away, in x and in y, from some point of a segment. If both ends of
/// a piece are, all of it is: such places make a convex set.
bool is_within_half_step(tinwright::Key2 point, const KeySegment& segment);
bool is_on(tinwright::Key2 point, const KeySegment& segment);

/// Where two segments cross in a point that is an end of neither: the lattice point nearest to it (halves
/// rounded up), and whether it is that very point.
struct Crossing {
    tinwright::Key2 key;
    bool is_exact;
};
std::optional<Crossing> crossing(const KeySegment& p, const KeySegment& q);

/// Whether a segment meets the half-open square, one step wide, around a lattice point.
bool passes_square(const KeySegment& segment, tinwright::Key2 center);

/// What noding should give, by its definition: the segments with a rounded crossing are led through all hot
/// squares; as long as an edge of a chain crosses one of another, both of their segments are led.
struct Noded {
    std::vector<tinwright::Key2> vertices;             ///< sorted
    std::vector<std::vector<tinwright::Key2>> chains;  ///< one a segment, from its first to its second end
    std::vector<bool> is_led;
};
/// `points` are hot besides the segments' ends. O(n^2) and worse.
Noded node(std::span<const KeySegment> segments, std::span<const tinwright::Key2> points);

}  // namespace tinwright_tests::oracle

#endif
