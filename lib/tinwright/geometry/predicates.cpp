#include "tinwright/geometry/predicates.hpp"

#include <cmath>
#include <cstdint>

#include "tinwright/geometry/predicates_internal.hpp"

namespace tinwright {

namespace {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

template <class Number>
int sign(Number value) {
    return (value > 0) - (value < 0);
}

std::int64_t difference(double a, double b) { return static_cast<std::int64_t>(a - b); }

// A 256-bit integer in two's complement.
struct Int256 {
    UInt128 high = 0;
    UInt128 low = 0;

    Int256& operator+=(const Int256& other) {
        low += other.low;
        high += other.high + (low < other.low ? 1U : 0U);
        return *this;
    }
    [[nodiscard]] int sign() const {
        if ((high >> 127U) != 0) {
            return -1;
        }
        return (high | low) != 0 ? 1 : 0;
    }
};

UInt128 magnitude(Int128 value) {
    return value < 0 ? UInt128{0} - static_cast<UInt128>(value) : static_cast<UInt128>(value);
}

// Schoolbook product of magnitudes on 64-bit halves.
Int256 product(Int128 a, Int128 b) {
    const UInt128 ua = magnitude(a);
    const UInt128 ub = magnitude(b);
    const UInt128 mask = ~std::uint64_t{0};
    const UInt128 low_low = (ua & mask) * (ub & mask);
    const UInt128 high_low = (ua >> 64U) * (ub & mask);
    const UInt128 low_high = (ua & mask) * (ub >> 64U);
    const UInt128 high_high = (ua >> 64U) * (ub >> 64U);
    const UInt128 middle = (low_low >> 64U) + (high_low & mask) + (low_high & mask);
    Int256 result{high_high + (high_low >> 64U) + (low_high >> 64U) + (middle >> 64U),
                  (low_low & mask) | (middle << 64U)};
    if ((a < 0) != (b < 0)) {
        result.low = UInt128{0} - result.low;
        result.high = ~result.high + (result.low == 0 ? 1U : 0U);
    }
    return result;
}

// Sign of a b - c d.
int compare_products(Int128 a, Int128 b, Int128 c, Int128 d) {
    Int256 difference = product(a, b);
    difference += product(-c, d);
    return difference.sign();
}

// Where a segment meets another, as the fraction num / den of the way from one end to the other; 0 < num <
// den if they cross.
struct Fraction {
    Int128 num;
    Int128 den;
    double value;  // errs by at most three units of itself
};

// Of the way from a to b where the line through c and d meets it; the two are not parallel.
Fraction way_to_line(Key2 a, Key2 b, Key2 c, Key2 d) {
    const Int128 dx = difference(d.x, c.x);
    const Int128 dy = difference(d.y, c.y);
    Fraction way{difference(c.x, a.x) * dy - difference(c.y, a.y) * dx,
                 difference(b.x, a.x) * dy - difference(b.y, a.y) * dx, 0};
    if (way.den < 0) {
        way.num = -way.num;
        way.den = -way.den;
    }
    way.value = static_cast<double>(way.num) / static_cast<double>(way.den);
    return way;
}

struct RoundedStep {
    std::int64_t steps;
    bool is_exact;
};

// `fraction` of `whole` steps rounded to the nearest integer, halves up.
RoundedStep round_part(const Fraction& fraction, std::int64_t whole) {
    const double guess = fraction.value * static_cast<double>(whole);
    const double error = 5 * internal::kUnit * std::abs(guess);
    const double nearest = std::floor(guess + 0.5);
    auto steps = static_cast<std::int64_t>(nearest);
    const double off = guess - nearest;
    if (std::abs(off) > error && std::abs(off) < 0.5 - error) {
        return {steps, false};
    }
    const auto is_below = [&](std::int64_t half_steps) {
        return compare_products(2 * fraction.num, whole, fraction.den, half_steps) < 0;
    };
    while (is_below(2 * steps - 1)) {
        --steps;
    }
    while (!is_below(2 * steps + 1)) {
        ++steps;
    }
    return {steps, compare_products(fraction.num, whole, fraction.den, steps) == 0};
}

}  // namespace

namespace internal {

int turn_int128(Direction a, Direction b) {
    const auto integer = [](double value) { return static_cast<Int128>(static_cast<std::int64_t>(value)); };
    return sign(integer(a.x) * integer(b.y) - integer(a.y) * integer(b.x));
}

int orient2d_int128(Key2 a, Key2 b, Key2 c) { return turn_int128(direction(a, c), direction(b, c)); }

int incircle_int128(Key2 a, Key2 b, Key2 c, Key2 d) {
    // Squares and cross products stay below 2^61, their products below 2^122, the sum below 2^124.
    constexpr double kLimit = 1073741824.0;  // 2^30
    const double ax = a.x - d.x;
    const double ay = a.y - d.y;
    const double bx = b.x - d.x;
    const double by = b.y - d.y;
    const double cx = c.x - d.x;
    const double cy = c.y - d.y;
    for (const double difference : {ax, ay, bx, by, cx, cy}) {
        if (std::abs(difference) > kLimit) {
            return kUnsure;
        }
    }
    const auto integer = [](double value) { return static_cast<std::int64_t>(value); };
    const auto term = [&](double px, double py, double qx, double qy, double rx, double ry) {
        const std::int64_t square = integer(px) * integer(px) + integer(py) * integer(py);
        const std::int64_t cross = integer(qx) * integer(ry) - integer(qy) * integer(rx);
        return static_cast<Int128>(square) * cross;
    };
    return sign(term(ax, ay, bx, by, cx, cy) + term(bx, by, cx, cy, ax, ay) + term(cx, cy, ax, ay, bx, by));
}

int incircle_int256(Key2 a, Key2 b, Key2 c, Key2 d) {
    // Differences stay below 2^54, squares and cross products below 2^109, the sum below 2^220.
    const Int128 ax = difference(a.x, d.x);
    const Int128 ay = difference(a.y, d.y);
    const Int128 bx = difference(b.x, d.x);
    const Int128 by = difference(b.y, d.y);
    const Int128 cx = difference(c.x, d.x);
    const Int128 cy = difference(c.y, d.y);
    Int256 sum = product(ax * ax + ay * ay, bx * cy - by * cx);
    sum += product(bx * bx + by * by, cx * ay - cy * ax);
    sum += product(cx * cx + cy * cy, ax * by - ay * bx);
    return sum.sign();
}

int incircle_tie(Key2 a, Key2 b, Key2 c, Key2 d) {
    // Lifting a point changes the determinant by the orientation of the other three; the last point in
    // lexicographic order is lifted incomparably more than the rest. No three of four co-circular points
    // are collinear, so this one orientation decides.
    const Key2 last_ab = precedes(a, b) ? b : a;
    const Key2 last_cd = precedes(c, d) ? d : c;
    const Key2 last = precedes(last_ab, last_cd) ? last_cd : last_ab;
    if (last == d) {
        return -orient2d(a, b, c);
    }
    if (last == a) {
        return orient2d(b, c, d);
    }
    return last == b ? orient2d(c, a, d) : orient2d(a, b, d);
}

int compare_distances_int128(Key2 a, Key2 b, Key2 c, Key2 d) {
    const auto square = [](Key2 p, Key2 q) {
        const Int128 x = difference(p.x, q.x);
        const Int128 y = difference(p.y, q.y);
        return x * x + y * y;
    };
    return sign(square(a, b) - square(c, d));
}

int angle_sign_int128(Key2 a, Key2 apex, Key2 b) {
    return sign(static_cast<Int128>(difference(a.x, apex.x)) * difference(b.x, apex.x) +
                static_cast<Int128>(difference(a.y, apex.y)) * difference(b.y, apex.y));
}

SquarePass pass_square_int128(Key2 a, Key2 b, Key2 c) {
    const Int128 dx = difference(b.x, a.x);
    const Int128 dy = difference(b.y, a.y);
    const Int128 side = dx * difference(c.y, a.y) - dy * difference(c.x, a.x);
    if (side == 0) {
        return SquarePass::Center;
    }
    const int reach =
        sign(static_cast<Int128>(magnitude(dx) + magnitude(dy)) - static_cast<Int128>(2 * magnitude(side)));
    if (reach != 0) {
        return reach < 0 ? SquarePass::Apart : SquarePass::Through;
    }
    // Through a corner: only the lower left one belongs to the square. A segment that falls from left to
    // right meets it if c lies above.
    const bool falls = (dx < 0) != (dy < 0);
    return falls && (side > 0) == (dx > 0) ? SquarePass::Through : SquarePass::Corner;
}

}  // namespace internal

int orient2d(Key2 a, Key2 b, Key2 c) {
    const int fast = internal::orient2d_double(a, b, c);
    return fast != internal::kUnsure ? fast : internal::orient2d_int128(a, b, c);
}

int incircle(Key2 a, Key2 b, Key2 c, Key2 d) {
    const int fast = internal::incircle_double(a, b, c, d);
    if (fast != internal::kUnsure) {
        return fast;
    }
    const int medium = internal::incircle_int128(a, b, c, d);
    return medium != internal::kUnsure ? medium : internal::incircle_int256(a, b, c, d);
}

int incircle_perturbed(Key2 a, Key2 b, Key2 c, Key2 d) {
    const int exact = incircle(a, b, c, d);
    return exact != 0 ? exact : internal::incircle_tie(a, b, c, d);
}

int compare_distances(Key2 a, Key2 b, Key2 c, Key2 d) {
    const int fast =
        internal::compare_squares(internal::localize(a, b).square, internal::localize(c, d).square);
    return fast != internal::kUnsure ? fast : internal::compare_distances_int128(a, b, c, d);
}

int angle_sign(Key2 a, Key2 apex, Key2 b) {
    const int fast = internal::inner_product_local(internal::localize(a, apex), internal::localize(b, apex));
    return fast != internal::kUnsure ? fast : internal::angle_sign_int128(a, apex, b);
}

bool do_cross(Key2 a, Key2 b, Key2 c, Key2 d) {
    return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

RoundedCrossing round_crossing(Key2 a, Key2 b, Key2 c, Key2 d) {
    const Fraction way = way_to_line(a, b, c, d);
    const RoundedStep x = round_part(way, difference(b.x, a.x));
    const RoundedStep y = round_part(way, difference(b.y, a.y));
    return {{a.x + static_cast<double>(x.steps), a.y + static_cast<double>(y.steps)},
            x.is_exact && y.is_exact};
}

int compare_crossings(Key2 a, Key2 b, Key2 c, Key2 d, Key2 e, Key2 f) {
    const Fraction one = way_to_line(a, b, c, d);
    const Fraction other = way_to_line(a, b, e, f);
    const double difference = one.value - other.value;
    if (std::abs(difference) > 8 * internal::kUnit * (std::abs(one.value) + std::abs(other.value))) {
        return sign(difference);
    }
    return compare_products(one.num, other.den, other.num, one.den);
}

SquarePass pass_square(Key2 a, Key2 b, Key2 c) {
    const auto is_between = [](double value, double p, double q) {
        return (p <= value && value <= q) || (q <= value && value <= p);
    };
    if (!is_between(c.x, a.x, b.x) || !is_between(c.y, a.y, b.y) ||
        internal::is_apart_double(a, internal::direction(b, a), c)) {
        return SquarePass::Apart;
    }
    return internal::pass_square_int128(a, b, c);
}

}  // namespace tinwright
