#ifndef TINWRIGHT_GEOMETRY_PREDICATES_HPP
#define TINWRIGHT_GEOMETRY_PREDICATES_HPP

#include <cstdint>

#include "tinwright/geometry/lattice.hpp"

/// The only place where the sign of a determinant is decided. Every function is exact for keys whose
/// coordinates are integers of magnitude up to 2^52, and returns -1, 0 or +1.
namespace tinwright {

/// Side of `c` relative to the directed line a -> b: +1 left (a, b, c counter-clockwise), -1 right, 0 on
/// the line. Rotating the arguments keeps the sign, swapping two negates it; zero only when collinear.
int orient2d(Key2 a, Key2 b, Key2 c);

/// Position of `d` relative to the circle through a, b, c (counter-clockwise): +1 inside, -1 outside,
/// 0 on it. Rotating a, b, c keeps the sign, swapping any two of the four arguments negates it.
int incircle(Key2 a, Key2 b, Key2 c, Key2 d);

/// As `incircle`, never zero for four distinct points of which a, b, c are counter-clockwise: ties are
/// broken as if each point were lifted off the paraboloid by an amount that grows without bound along
/// the lexicographic order (x, then y) of keys. One Delaunay triangulation is thereby singled out,
/// whatever the order and numbering of the vertices; on a square grid all its diagonals are parallel.
/// [edelsbrunner1990]
int incircle_perturbed(Key2 a, Key2 b, Key2 c, Key2 d);

/// Sign of the squared distance of a and b less that of c and d: +1 if a and b are farther apart.
int compare_distances(Key2 a, Key2 b, Key2 c, Key2 d);

/// Sign of the cosine of the angle at `apex` between a and b: +1 acute, 0 right, -1 obtuse. Swapping a and b
/// keeps it.
int angle_sign(Key2 a, Key2 apex, Key2 b);

/// Whether the segments a b and c d cross in a point that is an end of neither. Any order, any direction.
bool do_cross(Key2 a, Key2 b, Key2 c, Key2 d);

/// The lattice point nearest to where two segments that `do_cross` meet; of two at half a step, the greater.
struct RoundedCrossing {
    Key2 key;
    bool is_exact;  ///< whether they meet in that very point
};
RoundedCrossing round_crossing(Key2 a, Key2 b, Key2 c, Key2 d);

/// Sign of the way from a to where the line a b meets c d, less that to where it meets e f: +1 if it meets
/// c d later. c d and e f each `do_cross` the line (their ends lie on different sides of it).
int compare_crossings(Key2 a, Key2 b, Key2 c, Key2 d, Key2 e, Key2 f);

/// How a segment passes the square of a lattice point: all that rounds to it, the half-open square around it
/// whose sides are one step long.
enum class SquarePass : std::uint8_t {
    Apart,    ///< not even its boundary
    Corner,   ///< touches a corner that belongs to another square
    Through,  ///< through the square, not through the lattice point
    Center    ///< through the lattice point, or ends there
};
SquarePass pass_square(Key2 a, Key2 b, Key2 c);

/// In which octant around `from` another key is: 0 to 7 counter-clockwise, each from its first ray, included,
/// to the next, 45 degrees on; 0 starts along x.
inline int octant(Key2 from, Key2 to) {
    const double x = to.x - from.x;
    const double y = to.y - from.y;
    if (y >= 0 && x > 0) {
        return y < x ? 0 : 1;
    }
    if (x <= 0 && y > 0) {
        return -x < y ? 2 : 3;
    }
    if (y <= 0 && x < 0) {
        return -y < -x ? 4 : 5;
    }
    return x < -y ? 6 : 7;
}

/// Lexicographic order of keys, x before y.
inline bool precedes(Key2 a, Key2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace tinwright

#endif
