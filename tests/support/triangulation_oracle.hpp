#ifndef TINWRIGHT_TESTS_SUPPORT_TRIANGULATION_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_TRIANGULATION_ORACLE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"

#include "support/oracles.hpp"

/// The best of all triangulations of a few points, found without insertions, anchors or theorems. Shares no
/// code with the library but its types; signs are decided in 128-bit integers, so keys may reach 2^45.
namespace tinwright_tests::oracle {

using Edge = std::array<std::uint32_t, 2>;

/// Points to be triangulated, not all on a line: all of them become vertices. Constrained edges are in every
/// triangulation; they cross neither each other nor a point.
struct Sites {
    std::vector<tinwright::Key2> keys;  ///< distinct
    std::vector<double> z;              ///< one a key
    std::vector<Edge> constraints;
};

/// A point with elevation.
struct Site {
    tinwright::Key2 key{};
    double z = 0;
};

/// Sign of twice the area of a, b, c.
int turn(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c);
/// Whether the two segments cross in a point inside both.
bool do_cross(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c, tinwright::Key2 d);
/// Whether `p` is inside the segment a b, its ends excluded.
bool is_inside_segment(tinwright::Key2 p, tinwright::Key2 a, tinwright::Key2 b);

/// The criterion's measure of a triangle in degrees, keys, or z over keys; negated for height, so that
/// greater is always worse. The corners in any order, the same bits. `norm` is for length.
long double badness(tinwright::Criterion criterion, Site a, Site b, Site c, tinwright::Norm norm = {});

/// Sorted badnesses, worst first, of the triangulation for which they come first in lexicographic order.
///
/// Every triangulation is swept from the lower to the upper hull by monotone paths that advance over one
/// triangle at a time. A path is the set of points on it, so there are 2^(n-2) at most, and what is left to
/// be done above one depends on nothing else: best completions are tabulated. n <= 16; O(2^n n^2).
std::vector<long double> best_badnesses(const Sites& sites, tinwright::Criterion criterion,
                                        tinwright::Norm norm = {});

/// Calls `visit` once with the faces of each triangulation (counter-clockwise). Plain recursion over the
/// first edge without a face; a few thousand triangulations at nine points.
void for_each_triangulation(const Sites& sites, const std::function<void(const std::vector<Triple>&)>& visit);

}  // namespace tinwright_tests::oracle

#endif
