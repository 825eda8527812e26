#include "tinwright/criteria/slope.hpp"

#include <array>

namespace tinwright {

namespace {

using internal::kExactIntegers;
using internal::kUnit;
using internal::kUnsure;
using internal::LocalKey;

/// A difference of two elevations and whether it is exact.
struct Rise {
    double value = 0;
    bool is_exact = true;

    Rise(double from, double to) : value(to - from) {
        // What rounding took away [shewchuk1997, Theorem 7].
        const double from_part = to - value;
        const double to_part = value + from_part;
        is_exact = to - to_part == 0 && from_part - from == 0;
    }
};

/// Sign of r a - s b, for integers a and b that are exact below 2^53; `size_a` and `size_b` bound what they
/// were made of.
int compare_products(const Rise& r, double a, double size_a, const Rise& s, double b, double size_b) {
    const double left = r.value * a;
    const double right = s.value * b;
    const double difference = left - right;
    const double size = std::abs(r.value) * size_a + std::abs(s.value) * size_b;
    // Rises, a and b err by up to two units of their size, products and difference by one each.
    if (std::abs(difference) > 8 * kUnit * size) {
        return internal::sign_of(difference);
    }
    if (r.value == 0 && s.value == 0) {
        return 0;
    }
    if (!r.is_exact || !s.is_exact || size_a >= kExactIntegers || size_b >= kExactIntegers) {
        return kUnsure;
    }
    // Two equal numbers round alike, so the rounded products decide, then what rounding took away.
    if (left != right) {
        return internal::sign_of(difference);
    }
    return internal::sign_of(std::fma(r.value, a, -left) - std::fma(s.value, b, -right));
}

}  // namespace

unsigned SlopeCriterion::anchors(VertexId a, VertexId b, VertexId c) const {
    const std::array<VertexId, 3> v{a, b, c};
    // Along a level line of the face's plane corners have an order; its middle one is the anchor. For the
    // edges u and w from one corner, rising by r and s, u is r u.w - s u.u along that line, in units that
    // depend on the face alone. `sign[i]`: of the edge from corner i to corner i + 1.
    std::array<int, 3> sign{};
    for (unsigned i = 0; i < 3; ++i) {
        const VertexId from = v[i];
        const VertexId to = v[next_corner(i)];
        const VertexId other = v[previous_corner(i)];
        const LocalKey u = internal::localize(keys_[to.value], keys_[from.value]);
        const LocalKey w = internal::localize(keys_[other.value], keys_[from.value]);
        const double inner = u.x * w.x + u.y * w.y;
        const double inner_size = std::abs(u.x * w.x) + std::abs(u.y * w.y);
        sign[i] = compare_products(Rise(z_[from.value], z_[to.value]), inner, inner_size,
                                   Rise(z_[from.value], z_[other.value]), u.square, u.square);
    }
    unsigned doubtful = 0;
    for (unsigned i = 0; i < 3; ++i) {
        if (sign[i] == 0) {
            return 0;
        }
        doubtful |= sign[i] == kUnsure ? (1U << i | 1U << next_corner(i)) : 0U;
    }
    if (doubtful != 0) {
        return doubtful;
    }
    for (unsigned i = 0; i < 3; ++i) {
        if (sign[previous_corner(i)] == sign[i]) {
            return 1U << i;
        }
    }
    return 0;
}

}  // namespace tinwright
