#include "tinwright/geometry/norm.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

__extension__ using UInt128 = unsigned __int128;

constexpr double kUnit = 0x1p-53;

/// Magnitudes of the two coordinates' differences, the greater first. Whole numbers up to 2^53, exact.
struct Extent {
    double large;
    double small;
};

Extent extent(Key2 a, Key2 b) {
    const double x = std::abs(a.x - b.x);
    const double y = std::abs(a.y - b.y);
    return {std::max(x, y), std::min(x, y)};
}

int sign(double value) { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

/// base^power for a base of 0 to 1, by squaring: `power` - 1 rounded products, some of them perhaps too small
/// to be told from zero.
double to_power(double base, int power) {
    double result = (power & 1) != 0 ? base : 1;
    for (int rest = power >> 1; rest != 0; rest >>= 1) {
        base *= base;
        if ((rest & 1) != 0) {
            result *= base;
        }
    }
    return result;
}

/// A whole number that the sum of two largest powers fits in.
class PowerSum {
  public:
    /// x^power + y^power for whole numbers up to 2^53.
    PowerSum(double x, double y, int power) {
        const Limbs first = to_power(static_cast<std::uint64_t>(x), power);
        const Limbs second = to_power(static_cast<std::uint64_t>(y), power);
        UInt128 carry = 0;
        for (std::size_t i = 0; i < limbs_.size(); ++i) {
            carry += static_cast<UInt128>(first[i]) + second[i];
            limbs_[i] = static_cast<std::uint64_t>(carry);
            carry >>= 64U;
        }
    }

    friend int compare(const PowerSum& a, const PowerSum& b) {
        for (std::size_t i = a.limbs_.size(); i-- > 0;) {
            if (a.limbs_[i] != b.limbs_[i]) {
                return a.limbs_[i] < b.limbs_[i] ? -1 : 1;
            }
        }
        return 0;
    }

  private:
    static constexpr int kBits = 53 * Norm::kLargestPower + 2;
    using Limbs = std::array<std::uint64_t, (kBits + 63) / 64>;

    static Limbs to_power(std::uint64_t base, int power) {
        Limbs result{1};
        std::size_t used = 1;
        for (int i = 0; i < power; ++i) {
            UInt128 carry = 0;
            for (std::size_t limb = 0; limb < used; ++limb) {
                carry += static_cast<UInt128>(result[limb]) * base;
                result[limb] = static_cast<std::uint64_t>(carry);
                carry >>= 64U;
            }
            if (carry != 0) {
                result[used++] = static_cast<std::uint64_t>(carry);
            }
        }
        return result;
    }

    Limbs limbs_{};  // the lowest first
};

/// The sign of large^p + small^p of `a` less that of `b`.
int compare_power_sums(Extent a, Extent b, int power) {
    // Also settles, and at once, the equal lengths that are many: those of a lattice.
    if (a.large == b.large || a.small == b.small || (a.large > b.large) == (a.small > b.small)) {
        const int order = sign(a.large - b.large);
        return order != 0 ? order : sign(a.small - b.small);
    }
    if (a.large < b.large) {
        return -compare_power_sums(b, a, power);
    }
    // Over the power of the largest, a.large. Of each of the three other quotients, at most 1, the power has
    // p rounded factors and p - 1 rounded products, which makes less than 2p units of rounding (underflow is
    // nothing beside them); the three differences, at most 1, are rounded too: 6p and little more.
    const auto part = [&a, power](double value) { return to_power(value / a.large, power); };
    const double difference = (1 - part(b.large)) - (part(b.small) - part(a.small));
    const double bound = (8 * power + 8) * kUnit;
    if (std::abs(difference) > bound) {
        return sign(difference);
    }
    return compare(PowerSum(a.large, a.small, power), PowerSum(b.large, b.small, power));
}

}  // namespace

Norm Norm::lp(int p) {
    if (p < 1 || p > kLargestPower) {
        throw UsageError("there is no norm lp:" + std::to_string(p) + "; p is a whole number from 1 to " +
                         std::to_string(kLargestPower) + ", or use linf");
    }
    return Norm(p);
}

int compare_lengths(Norm norm, Key2 a, Key2 b, Key2 c, Key2 d) {
    if (norm.is_euclidean()) {
        return compare_distances(a, b, c, d);
    }
    const Extent one = extent(a, b);
    const Extent other = extent(c, d);
    if (norm.is_maximum()) {
        return sign(one.large - other.large);
    }
    if (norm.power() == 1) {  // both differences are exact, the sums might not be
        const double gain = one.large - other.large;
        const double loss = other.small - one.small;
        return sign(gain - loss);
    }
    return compare_power_sums(one, other, norm.power());
}

double length(Norm norm, Key2 a, Key2 b) {
    const auto [large, small] = extent(a, b);
    if (norm.is_euclidean()) {
        return std::sqrt(large * large + small * small);  // below 2^107
    }
    if (norm.is_maximum() || small == 0) {
        return large;
    }
    if (norm.power() == 1) {
        return large + small;
    }
    // The root divides the error of the sum by p.
    return large * std::pow(1 + to_power(small / large, norm.power()), 1.0 / norm.power());
}

std::string norm_name(Norm norm) {
    if (norm.is_maximum()) {
        return "linf";
    }
    return (norm.power() <= 2 ? "l" : "lp:") + std::to_string(norm.power());
}

std::optional<Norm> find_norm(std::string_view name) {
    if (name == "l1") {
        return Norm::lp(1);
    }
    if (name == "l2") {
        return Norm();
    }
    if (name == "linf") {
        return Norm::maximum();
    }
    constexpr std::string_view kPrefix = "lp:";
    if (!name.starts_with(kPrefix)) {
        return std::nullopt;
    }
    int p = 0;
    const auto [end, error] = std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), p);
    if (error != std::errc{} || end != name.data() + name.size() || p < 1 || p > Norm::kLargestPower) {
        return std::nullopt;
    }
    return Norm::lp(p);
}

}  // namespace tinwright
