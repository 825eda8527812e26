#ifndef TINWRIGHT_TESTS_SUPPORT_ORACLES_HPP
#define TINWRIGHT_TESTS_SUPPORT_ORACLES_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"

/// Slow and plain answers to compare with. They share no code with the library but its types.
namespace tinwright_tests::oracle {

/// Signs of determinants in integers of any length.
int orient2d(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c);
int incircle(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c, tinwright::Key2 d);
/// Sign of |a b| - |c d|, and of the inner product of a - apex and b - apex.
int compare_distances(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c, tinwright::Key2 d);
int angle_sign(tinwright::Key2 a, tinwright::Key2 apex, tinwright::Key2 b);
/// Sign of |a b| - |c d| in a norm.
int compare_lengths(tinwright::Norm norm, tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c,
                    tinwright::Key2 d);
/// Whether `length` is within `relative` of |a b|, relatively.
bool is_length(double length, double relative, tinwright::Norm norm, tinwright::Key2 a, tinwright::Key2 b);

/// `incircle` of points that are truly lifted off the paraboloid: by 2^-4000 times 1, 2^400, 2^800 and
/// 2^1200 in lexicographic order. Any integer determinant of keys is far from both ends of that scale.
int incircle_perturbed(tinwright::Key2 a, tinwright::Key2 b, tinwright::Key2 c, tinwright::Key2 d);

/// Twice the area of a counter-clockwise polygon, as decimal text (it may need more than 64 bits).
std::string twice_area(std::span<const tinwright::Key2> polygon);
/// Sum of `twice_area` over counter-clockwise triangles, three keys each.
std::string twice_area_of_faces(std::span<const std::array<tinwright::Key2, 3>> faces);

/// Corners of the convex hull, counter-clockwise, without collinear ones; monotone chain.
std::vector<tinwright::Key2> convex_hull(std::vector<tinwright::Key2> keys);
/// Indices of the keys on the boundary of the hull, collinear ones included, ascending; by trying every
/// pair of keys as an edge of the hull, O(n^3).
std::vector<std::size_t> keys_on_hull(std::span<const tinwright::Key2> keys);

/// Whether the interiors of two counter-clockwise triangles meet: clips one with the other's sides in
/// rational numbers and looks whether an area is left.
bool do_interiors_meet(const std::array<tinwright::Key2, 3>& a, const std::array<tinwright::Key2, 3>& b);

using Triple = std::array<std::uint32_t, 3>;

/// The faces of the Delaunay triangulation by definition: every counter-clockwise triple whose perturbed
/// circle has none of the other keys inside. Least index first, sorted. O(n^4).
std::vector<Triple> delaunay(std::span<const tinwright::Key2> keys);

/// Bits of x and y interleaved, x first, most significant first: the curve's order as text.
std::string curve_code(tinwright::Key2 key);

/// The double nearest to steps / 10^decimals, by way of its decimal text.
double decimal_value(std::int64_t steps, int decimals);

}  // namespace tinwright_tests::oracle

#endif
