#include "tinwright/geometry/lattice.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

constexpr int kMostDecimals = 22;  // 10^22 is the largest power of ten that a double holds exactly
constexpr std::array<double, kMostDecimals + 1> kPowersOfTen = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Below 2^51, x * 10^d rounds to within half a step of the integer it stands for.
constexpr double kStepLimit = 2251799813685248.0;

bool is_decimal(double value, double power_of_ten) {
    const double scaled = value * power_of_ten;
    const double steps = Lattice::nearest_integer(scaled);
    // Whole numbers are common enough to spare them the division.
    return std::abs(scaled) < kStepLimit && (power_of_ten == 1 ? steps : steps / power_of_ten) == value;
}

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct Survey {
    Box bounds;
    int decimals = 0;               // beyond kMostDecimals: not decimal
    std::size_t first_bad = kNone;  // first sample with a number that is not finite

    static Survey merge(Survey a, const Survey& b) {
        if (!b.bounds.is_empty()) {
            a.bounds.add(b.bounds.x_min, b.bounds.y_min);
            a.bounds.add(b.bounds.x_max, b.bounds.y_max);
        }
        a.decimals = std::max(a.decimals, b.decimals);
        a.first_bad = std::min(a.first_bad, b.first_bad);
        return a;
    }
};

bool is_finite(const Point3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Raises `decimals` until both coordinates have no more of them.
int raise_decimals(int decimals, const Point3& p) {
    while (decimals <= kMostDecimals &&
           !(is_decimal(p.x, kPowersOfTen[static_cast<std::size_t>(decimals)]) &&
             is_decimal(p.y, kPowersOfTen[static_cast<std::size_t>(decimals)]))) {
        ++decimals;
    }
    return decimals;
}

Survey survey_range(std::span<const Point3> samples, std::size_t begin, std::size_t end, Survey seen) {
    Box bounds = seen.bounds;
    int decimals = seen.decimals;
    double power = kPowersOfTen[static_cast<std::size_t>(std::min(decimals, kMostDecimals))];
    for (std::size_t i = begin; i != end; ++i) {
        const Point3& p = samples[i];
        // What is a decimal is finite.
        const bool is_plain = is_decimal(p.x, power) && is_decimal(p.y, power) && std::isfinite(p.z);
        if (!is_plain) {
            if (!is_finite(p)) {
                seen.first_bad = std::min(seen.first_bad, i);
                continue;
            }
            decimals = raise_decimals(decimals, p);
            power = kPowersOfTen[static_cast<std::size_t>(std::min(decimals, kMostDecimals))];
        }
        bounds.add(p.x, p.y);
    }
    seen.bounds = bounds;
    seen.decimals = decimals;
    return seen;
}

constexpr int kLeastExponent = -960;  // quanta and their reciprocals stay well within the range of doubles

constexpr std::size_t kGrain = 1U << 14U;

Survey survey(std::span<const Point3> samples) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), Survey{},
        [&](const tbb::blocked_range<std::size_t>& range, const Survey& seen) {
            return survey_range(samples, range.begin(), range.end(), seen);
        },
        Survey::merge);
}

// Exponent of the lowest set bit of a finite number; a large number for zero.
int lowest_bit(double value) {
    if (value == 0) {
        return std::numeric_limits<int>::max();
    }
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto exponent = static_cast<int>(bits >> 52U & 0x7FFU);
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52U) - 1);
    // Subnormal numbers have the exponent of the smallest normal ones and no leading one.
    const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52U;
    return std::max(exponent, 1) - 1075 + std::countr_zero(mantissa);
}

// The lowest bit that any coordinate uses, or, at the first glance, one below `floor`.
int lowest_bit(std::span<const Point3> samples, int floor) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), std::numeric_limits<int>::max(),
        [&](const tbb::blocked_range<std::size_t>& range, int lowest) {
            for (std::size_t i = range.begin(); i != range.end() && lowest >= floor; ++i) {
                lowest = std::min({lowest, lowest_bit(samples[i].x), lowest_bit(samples[i].y)});
            }
            return lowest;
        },
        [](int a, int b) { return std::min(a, b); });
}

// Steps from the lower to the upper bound on the wider axis, when a step is `scale` units or 1/scale.
template <class Snap>
double widest(const Box& bounds, Snap snap) {
    return std::max(snap(bounds.x_max) - snap(bounds.x_min), snap(bounds.y_max) - snap(bounds.y_min));
}

}  // namespace

Lattice Lattice::decimal(int decimals, Key2 origin) {
    Lattice lattice;
    lattice.origin_ = origin;
    lattice.decimals_ = decimals;
    lattice.steps_per_unit_ = kPowersOfTen.at(static_cast<std::size_t>(decimals));
    return lattice;
}

Lattice Lattice::binary(int exponent, Key2 origin, bool is_exact) {
    Lattice lattice;
    lattice.origin_ = origin;
    lattice.decimals_ = -1;
    lattice.exponent_ = exponent;
    lattice.steps_per_unit_ = std::ldexp(1.0, -exponent);
    lattice.is_exact_ = is_exact;
    return lattice;
}

double Lattice::quantum() const { return 1 / steps_per_unit_; }

FoundLattice find_lattice(std::span<const Point3> samples) {
    const Survey seen = survey(samples);
    if (seen.first_bad != kNone) {
        const Point3& bad = samples[seen.first_bad];
        const bool is_elevation = std::isfinite(bad.x) && std::isfinite(bad.y);
        throw InputError(is_elevation ? "the elevation of the sample at " + location_text({bad.x, bad.y}) +
                                            " is not a finite number; remove the sample or give its z"
                                      : "a sample's x or y is not a finite number; remove it",
                         {seen.first_bad});
    }
    const Box& bounds = seen.bounds;
    if (bounds.is_empty()) {
        return {Lattice{}, bounds};
    }
    const double largest = std::max(
        {std::abs(bounds.x_min), std::abs(bounds.x_max), std::abs(bounds.y_min), std::abs(bounds.y_max)});
    // A sample met early was tested with the decimals known by then, which may be too many for its size.
    if (seen.decimals <= kMostDecimals &&
        largest * kPowersOfTen[static_cast<std::size_t>(seen.decimals)] < kStepLimit) {
        const Lattice plain = Lattice::decimal(seen.decimals, {});
        const double power = kPowersOfTen[static_cast<std::size_t>(seen.decimals)];
        const double steps = widest(bounds, [&](double v) { return Lattice::nearest_integer(v * power); });
        if (steps >= kKeyLimit) {
            const auto text = [](double v) { return std::to_string(static_cast<long long>(v)); };
            throw InputError("the samples span " + text(steps) + " steps of their last decimal, " +
                             decimal_text(plain.quantum()) + ", above the limit of 2^45 = " +
                             text(kKeyLimit) + "; remove outlying samples or round the coordinates");
        }
        return {Lattice::decimal(seen.decimals, plain.key({bounds.x_min, bounds.y_min})), bounds};
    }

    const double extent = std::max(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min);
    const auto fits = [&](int exponent) {
        const double step = std::ldexp(1.0, exponent);
        return exponent >= kLeastExponent && exponent <= -kLeastExponent && std::isfinite(extent) &&
               largest / step < kStepLimit &&
               widest(bounds, [&](double v) { return std::nearbyint(v / step); }) < kKeyLimit;
    };
    // Below a 2^46th of the extent no exact lattice is left to be found.
    int exponent = lowest_bit(samples, extent > 0 ? std::ilogb(extent) - 46 : kLeastExponent);
    const bool is_exact = fits(exponent);
    if (!is_exact) {
        // As fine as doubles at the largest coordinate are, but for two bits, or as coarse as the limit
        // demands.
        exponent = std::max(std::ilogb(largest) - 50, kLeastExponent);
        while (std::isfinite(extent) && !fits(exponent)) {
            ++exponent;
        }
        if (!std::isfinite(extent) || exponent > -kLeastExponent) {
            throw InputError(
                "the samples' coordinates span the whole range of floating-point numbers; "
                "remove outlying samples");
        }
    }
    const Lattice plain = Lattice::binary(exponent, {}, is_exact);
    return {Lattice::binary(exponent, plain.key({bounds.x_min, bounds.y_min}), is_exact), bounds};
}

}  // namespace tinwright
