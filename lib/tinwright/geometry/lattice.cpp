#include "tinwright/geometry/lattice.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
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

// Whether `value` is a whole number of steps, `steps_per_unit` of them a unit.
bool is_whole(double value, double steps_per_unit) {
    const double scaled = value * steps_per_unit;
    const double steps = Lattice::nearest_integer(scaled);
    // Whole numbers are common enough to spare them the division.
    return std::abs(scaled) < kStepLimit && (steps_per_unit == 1 ? steps : steps / steps_per_unit) == value;
}

// Steps a unit for so many decimals, each step divided by 2^refinement.
double steps_of(int decimals, int refinement) {
    return std::ldexp(kPowersOfTen[static_cast<std::size_t>(std::min(decimals, kMostDecimals))], refinement);
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

// What is surveyed, and on which kind of lattice.
struct SurveyRequest {
    std::span<const Point3> points;
    bool has_elevations = true;
    int refinement = 0;
};

// Raises `decimals` until both coordinates have no more of them.
int raise_decimals(int decimals, int refinement, const Point3& p) {
    while (decimals <= kMostDecimals && !(is_whole(p.x, steps_of(decimals, refinement)) &&
                                          is_whole(p.y, steps_of(decimals, refinement)))) {
        ++decimals;
    }
    return decimals;
}

Survey survey_range(const SurveyRequest& request, std::size_t begin, std::size_t end, Survey seen) {
    Box bounds = seen.bounds;
    int decimals = seen.decimals;
    double steps = steps_of(decimals, request.refinement);
    for (std::size_t i = begin; i != end; ++i) {
        const Point3 p{request.points[i].x, request.points[i].y,
                       request.has_elevations ? request.points[i].z : 0.0};
        // What is a whole number of steps is finite.
        const bool is_plain = is_whole(p.x, steps) && is_whole(p.y, steps) && std::isfinite(p.z);
        if (!is_plain) {
            if (!is_finite(p)) {
                seen.first_bad = std::min(seen.first_bad, i);
                continue;
            }
            decimals = raise_decimals(decimals, request.refinement, p);
            steps = steps_of(decimals, request.refinement);
        }
        bounds.add(p.x, p.y);
    }
    seen.bounds = bounds;
    seen.decimals = decimals;
    return seen;
}

constexpr int kLeastExponent = -960;  // quanta and their reciprocals stay well within the range of doubles

constexpr std::size_t kGrain = 1U << 14U;

Survey survey(const SurveyRequest& request) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, request.points.size(), kGrain), Survey{},
        [&](const tbb::blocked_range<std::size_t>& range, const Survey& seen) {
            return survey_range(request, range.begin(), range.end(), seen);
        },
        Survey::merge);
}

// Steps from the lower to the upper bound on the wider axis; `snap` counts steps.
template <class Snap>
double widest(const Box& bounds, Snap snap) {
    return std::max(snap(bounds.x_max) - snap(bounds.x_min), snap(bounds.y_max) - snap(bounds.y_min));
}

// Decimals of all points on a lattice refined by so many bits; beyond kMostDecimals when there are none. A
// few points tell most data off.
int find_decimals(const std::array<std::span<const Point3>, 2>& points, int refinement) {
    constexpr std::size_t kGlance = 64;
    int decimals = 0;
    for (const bool is_glance : {true, false}) {
        for (const std::span<const Point3> part : points) {
            const auto seen_part = is_glance ? part.first(std::min(part.size(), kGlance)) : part;
            if (decimals <= kMostDecimals) {
                decimals = std::max(decimals, survey({seen_part, false, refinement}).decimals);
            }
        }
    }
    return decimals;
}

[[noreturn]] void throw_bad(std::span<const Point3> samples, std::size_t first_bad) {
    const Point3& bad = samples[first_bad];
    const bool is_elevation = std::isfinite(bad.x) && std::isfinite(bad.y);
    throw InputError(is_elevation ? "the elevation of the sample at " + location_text({bad.x, bad.y}) +
                                        " is not a finite number; remove the sample or give its z"
                                  : "a sample's x or y is not a finite number; remove it",
                     {first_bad});
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

// The coarsest refined decimal lattice that holds all points: what data with made points among them lie on.
std::optional<Lattice> find_refined(const std::array<std::span<const Point3>, 2>& points, const Box& bounds) {
    const double largest = std::max(
        {std::abs(bounds.x_min), std::abs(bounds.x_max), std::abs(bounds.y_min), std::abs(bounds.y_max)});
    std::optional<Lattice> coarsest;
    for (int bits = 1; bits <= kRefinementBits; ++bits) {
        const int decimals = find_decimals(points, bits);
        const double steps_per_unit = steps_of(decimals, bits);
        const auto whole = [&](double v) { return Lattice::nearest_integer(v * steps_per_unit); };
        if (decimals <= kMostDecimals && largest * steps_per_unit < kStepLimit &&
            widest(bounds, whole) < kKeyLimit) {
            // The origin has to lie on the unrefined lattice.
            const double scale = std::ldexp(1.0, bits);
            const Key2 origin{std::floor(whole(bounds.x_min) / scale),
                              std::floor(whole(bounds.y_min) / scale)};
            const Lattice found = Lattice::decimal(decimals, origin).refined(bits);
            coarsest = !coarsest || coarsest->quantum() < found.quantum() ? found : coarsest;
        }
    }
    return coarsest;
}

// The samples' decimal lattice, refined for lines that are not on it (transformed from another CRS, say) and
// are rounded to it. Empty where samples are not decimal or little room is left.
std::optional<Lattice> refine_for_lines(int sample_decimals, const Box& bounds) {
    constexpr int kLeastBits = 8;
    const double largest = std::max(
        {std::abs(bounds.x_min), std::abs(bounds.x_max), std::abs(bounds.y_min), std::abs(bounds.y_max)});
    if (sample_decimals > kMostDecimals || largest * steps_of(sample_decimals, 0) >= kStepLimit) {
        return std::nullopt;
    }
    const double steps_per_unit = steps_of(sample_decimals, 0);
    const Lattice plain = Lattice::decimal(sample_decimals, {std::floor(bounds.x_min * steps_per_unit),
                                                             std::floor(bounds.y_min * steps_per_unit)});
    const Key2 corner = plain.key({bounds.x_max, bounds.y_max});
    const int bits = plain.refinement_room(std::max(corner.x, corner.y) + 1);
    return bits < kLeastBits ? std::nullopt : std::optional(plain.refined(bits));
}

[[noreturn]] void throw_too_wide(int decimals, double steps) {
    const auto text = [](double v) { return std::to_string(static_cast<long long>(v)); };
    throw InputError("the samples span " + text(steps) + " steps of their last decimal, " +
                     decimal_text(Lattice::decimal(decimals, {}).quantum()) + ", above the limit of 2^45 = " +
                     text(kKeyLimit) + "; remove outlying samples or round the coordinates");
}

// Steps of the last decimal across the bounds.
double decimal_steps(int decimals, const Box& bounds) {
    const double power = kPowersOfTen[static_cast<std::size_t>(decimals)];
    return widest(bounds, [power](double v) { return Lattice::nearest_integer(v * power); });
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

Lattice Lattice::refined(int bits) const {
    Lattice fine = *this;
    fine.origin_ = {std::ldexp(origin_.x, bits), std::ldexp(origin_.y, bits)};
    fine.steps_per_unit_ = std::ldexp(steps_per_unit_, bits);
    fine.exponent_ -= decimals_ < 0 ? bits : 0;
    fine.refinement_ += bits;
    return fine;
}

int Lattice::refinement_room(double largest) const {
    // Half the range of keys stays free, and half of that of steps, so that doubles tell points well apart.
    int bits = 0;
    const double from_zero = largest + std::max(std::abs(origin_.x), std::abs(origin_.y));
    while (refinement_ + bits < kRefinementBits && std::ldexp(largest, bits + 1) < kKeyLimit / 2 &&
           std::ldexp(from_zero, bits + 1) < kStepLimit / 2) {
        ++bits;
    }
    return bits;
}

double Lattice::quantum() const { return 1 / steps_per_unit_; }

FoundLattice find_lattice(std::span<const Point3> samples, std::span<const Point3> line_points) {
    Survey seen = survey({samples});
    if (seen.first_bad != kNone) {
        throw_bad(samples, seen.first_bad);
    }
    const int sample_decimals = samples.empty() ? kMostDecimals + 1 : seen.decimals;
    if (!line_points.empty()) {
        const Survey of_lines = survey({line_points, false});
        if (of_lines.first_bad != kNone) {
            throw InputError("a line's x or y is not a finite number; remove the line");
        }
        seen = Survey::merge(seen, of_lines);
    }
    const Box& bounds = seen.bounds;
    if (bounds.is_empty()) {
        return {Lattice{}, bounds};
    }
    const double largest = std::max(
        {std::abs(bounds.x_min), std::abs(bounds.x_max), std::abs(bounds.y_min), std::abs(bounds.y_max)});
    // A sample met early was tested with the decimals known by then, which may be too many for its size.
    const bool is_decimal = seen.decimals <= kMostDecimals &&
                            largest * kPowersOfTen[static_cast<std::size_t>(seen.decimals)] < kStepLimit;
    const double steps = is_decimal ? decimal_steps(seen.decimals, bounds) : 0;
    if (is_decimal && steps < kKeyLimit) {
        const Lattice plain = Lattice::decimal(seen.decimals, {});
        return {Lattice::decimal(seen.decimals, plain.key({bounds.x_min, bounds.y_min})), bounds};
    }
    // Lines with made points may happen to be decimal, with many decimals.
    std::optional<Lattice> refined;
    if (!is_decimal || !line_points.empty()) {
        refined = find_refined({samples, line_points}, bounds);
    }
    if (!refined && !line_points.empty()) {
        refined = refine_for_lines(sample_decimals, bounds);
    }
    if (refined) {
        return {*refined, bounds};
    }
    if (is_decimal) {
        throw_too_wide(seen.decimals, steps);
    }

    const double extent = std::max(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min);
    const auto fits = [&](int exponent) {
        const double step = std::ldexp(1.0, exponent);
        return exponent >= kLeastExponent && exponent <= -kLeastExponent && std::isfinite(extent) &&
               largest / step < kStepLimit &&
               widest(bounds, [&](double v) { return std::nearbyint(v / step); }) < kKeyLimit;
    };
    // Below a 2^46th of the extent no exact lattice is left to be found.
    const int floor = extent > 0 ? std::ilogb(extent) - 46 : kLeastExponent;
    int exponent = std::min(lowest_bit(samples, floor), lowest_bit(line_points, floor));
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
