#ifndef TINWRIGHT_GEOMETRY_PREDICATES_INTERNAL_HPP
#define TINWRIGHT_GEOMETRY_PREDICATES_INTERNAL_HPP

#include <cmath>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"

/// The tiers behind the predicates, opened to their tests and to the loop of the Delaunay construction. A
/// tier that answers is right; one that cannot tell says `kUnsure`, and the next is asked [shewchuk1997].
///
/// The double tier is inline, hence every file that includes this header is built without contraction of
/// multiply and add; it is not installed.
namespace tinwright::internal {

inline constexpr int kUnsure = 2;

/// Integers of this magnitude and below are exact in a double (2^53).
inline constexpr double kExactIntegers = 9007199254740992.0;
/// Half a unit in the last place of 1.
inline constexpr double kUnit = 1.0 / kExactIntegers;

inline int sign_of(double value) { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }

/// A key seen from another, with its squared distance. Coordinates are exact; the square rounds.
struct LocalKey {
    double x = 0;
    double y = 0;
    double square = 0;
};

inline LocalKey localize(Key2 key, Key2 origin) {
    const double x = key.x - origin.x;
    const double y = key.y - origin.y;
    return {x, y, x * x + y * y};
}

/// Sign of (origin, a, b). Answers when the determinant exceeds its error bound, or when every
/// intermediate is an integer below 2^53.
inline int orient2d_local(const LocalKey& a, const LocalKey& b) {
    const double left = a.x * b.y;
    const double right = a.y * b.x;
    const double det = left - right;
    const double size = std::abs(left) + std::abs(right);
    // Each product errs by at most one unit of itself, the difference by one of the result; 4 covers
    // the rounding of `size` too.
    if (std::abs(det) > 4 * kUnit * size || size < kExactIntegers) {
        return sign_of(det);
    }
    return kUnsure;
}

/// The way from one key to another, exact.
struct Direction {
    double x = 0;
    double y = 0;
};

inline Direction direction(Key2 to, Key2 from) { return {to.x - from.x, to.y - from.y}; }

/// 128-bit integers; always answers.
int turn_int128(Direction a, Direction b);

/// Side to which one turns from direction a to direction b: +1 left, -1 right, 0 neither. Exact.
[[gnu::always_inline]] inline int turn(Direction a, Direction b) {
    const double left = a.x * b.y;
    const double right = a.y * b.x;
    const double det = left - right;
    const double size = std::abs(left) + std::abs(right);
    if (std::abs(det) > 4 * kUnit * size || size < kExactIntegers) [[likely]] {
        return sign_of(det);
    }
    return turn_int128(a, b);
}

/// Position of the origin relative to the circle through a, b, c (counter-clockwise): +1 inside. With the
/// usual permanent replaced by a bound that takes five operations.
inline int incircle_local(const LocalKey& a, const LocalKey& b, const LocalKey& c) {
    const double det = a.square * (b.x * c.y - b.y * c.x) + b.square * (c.x * a.y - c.y * a.x) +
                       c.square * (a.x * b.y - a.y * b.x);
    // |a|^2 |b x c| <= |a|^2 |b||c| <= |a|^2 (|b|^2 + |c|^2) / 2, likewise for the other two terms.
    const double size = a.square * (b.square + c.square) + b.square * c.square;
    // A term errs by 2 units for its square, 2 for its cross product and 1 for their product, the two sums
    // by 2 more, and `size` itself by less than 3: 12 is ample. Below 2^53 nothing rounds at all.
    if (std::abs(det) > 12 * kUnit * size || size < kExactIntegers) {
        return sign_of(det);
    }
    return kUnsure;
}

/// Sign of the inner product of two keys seen from the same origin; answers as `orient2d_local` does.
inline int inner_product_local(const LocalKey& a, const LocalKey& b) {
    const double left = a.x * b.x;
    const double right = a.y * b.y;
    const double sum = left + right;
    const double size = std::abs(left) + std::abs(right);
    if (std::abs(sum) > 4 * kUnit * size || size < kExactIntegers) {
        return sign_of(sum);
    }
    return kUnsure;
}

/// Sign of the difference of two squared lengths, as `localize` rounds them.
inline int compare_squares(double a, double b) {
    const double difference = a - b;
    // A square errs by at most two units of itself.
    if (std::abs(difference) > 8 * kUnit * (a + b) || a + b < kExactIntegers) {
        return sign_of(difference);
    }
    return kUnsure;
}

/// Double precision: differences of keys are exact, so only products and sums round.
inline int orient2d_double(Key2 a, Key2 b, Key2 c) { return orient2d_local(localize(a, c), localize(b, c)); }
/// 128-bit integers; always answers.
int orient2d_int128(Key2 a, Key2 b, Key2 c);

/// As `orient2d_double`.
inline int incircle_double(Key2 a, Key2 b, Key2 c, Key2 d) {
    return incircle_local(localize(a, d), localize(b, d), localize(c, d));
}
/// 128-bit integers; answers when all coordinate differences to d are at most 2^30.
int incircle_int128(Key2 a, Key2 b, Key2 c, Key2 d);
/// 256-bit integers; always answers.
int incircle_int256(Key2 a, Key2 b, Key2 c, Key2 d);

/// Whether the line through a in direction `ab` certainly passes the square of c (see `pass_square`) by: its
/// distance from c, times the length of `ab`, exceeds what reaches the square's corners and the error.
[[gnu::always_inline]] inline bool is_apart_double(Key2 a, Direction ab, Key2 c) {
    const double left = ab.x * (c.y - a.y);
    const double right = ab.y * (c.x - a.x);
    const double reach = 0.5 * (std::abs(ab.x) + std::abs(ab.y));
    // As for `turn`, and one unit more for the sum on the right.
    return std::abs(left - right) > reach + 5 * kUnit * (std::abs(left) + std::abs(right) + reach);
}
/// 128-bit integers; always answers, where c is in the box of a and b.
SquarePass pass_square_int128(Key2 a, Key2 b, Key2 c);

/// 128-bit integers; always answer.
int compare_distances_int128(Key2 a, Key2 b, Key2 c, Key2 d);
int angle_sign_int128(Key2 a, Key2 apex, Key2 b);

/// The side on which the symbolic perturbation puts d when `incircle` is zero: see `incircle_perturbed`.
int incircle_tie(Key2 a, Key2 b, Key2 c, Key2 d);

}  // namespace tinwright::internal

#endif
