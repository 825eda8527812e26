#include "tinwright/surface/scan_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tinwright/geometry/decimal.hpp"

namespace tinwright {

namespace {

constexpr double kExactLimit = 4503599627370496.0;  // 2^52, what orient2d takes

struct AxisRequest {
    const Lattice& lattice;
    double origin;
    double key_limit;
    double sign;  // of the step
    double start;
    double step;
    std::int64_t count;
};

/// Largest distance, in cells, of a vertex or centre from centre 0.
double reach(const ScanAxis& axis, const AxisRequest& request) {
    const double first = axis.centres.empty() ? 0 : axis.centres.front();
    const double span = std::max(std::abs(first), std::abs(request.key_limit * axis.scale - first));
    return span * axis.inverse_step + static_cast<double>(request.count);
}

/// Centres on the lattice of half steps of 10^exponent, if that is fine and coarse enough.
std::optional<ScanAxis> make_decimal_axis(const AxisRequest& request) {
    if (request.lattice.decimals() < 0) {
        return std::nullopt;
    }
    const Decimal start = shortest_decimal(request.start);
    const Decimal step = shortest_decimal(request.step);
    const int decimals = request.lattice.decimals();
    const int exponent = std::min({-decimals, start.exponent, step.exponent});
    const std::optional<Int128> quantum_steps = whole_steps({1, -decimals}, exponent);
    std::optional<Int128> start_steps = whole_steps(start, exponent);
    std::optional<Int128> step_steps = whole_steps(step, exponent);
    constexpr Int128 kStepLimit = static_cast<Int128>(1) << 78U;  // leaves room to multiply by 2^45
    if (!quantum_steps || !start_steps || !step_steps || *step_steps > kStepLimit) {
        return std::nullopt;
    }
    // The lattice's steps, and so the half steps of 10^exponent, are divided by 2^refinement.
    const Int128 refinement = Int128{1} << static_cast<unsigned>(request.lattice.refinement());
    *start_steps *= refinement;
    *step_steps *= refinement;
    ScanAxis axis;
    axis.scale = 2 * static_cast<double>(*quantum_steps);
    if (axis.scale * std::max(request.key_limit, 1.0) > kExactLimit) {
        return std::nullopt;
    }
    // scale is below 2^53 and the origin too, so this product fits.
    const Int128 origin = 2 * *quantum_steps * static_cast<Int128>(request.origin);
    const Int128 half_step = request.sign < 0 ? -*step_steps : *step_steps;
    Int128 centre = 2 * *start_steps - origin + half_step;
    axis.centres.resize(static_cast<std::size_t>(request.count));
    for (double& value : axis.centres) {
        value = static_cast<double>(centre);
        centre += 2 * half_step;
    }
    axis.inverse_step = 1 / (2 * static_cast<double>(*step_steps));
    // A handful of roundings of 2^-53 each, relative to the reach.
    axis.uncertainty = std::ldexp(reach(axis, request), -47);
    return axis;
}

ScanAxis make_rounded_axis(const AxisRequest& request) {
    const Lattice& lattice = request.lattice;
    const bool is_decimal = lattice.decimals() >= 0;
    const double quantum = lattice.quantum();
    const double end = request.start + request.sign * request.step * static_cast<double>(request.count);
    const double magnitude = std::max(
        {std::abs(request.start), std::abs(end), (std::abs(request.origin) + request.key_limit) * quantum});
    // The spacing of doubles at the largest coordinate, a few times: what a computed centre is good for.
    const double noise = 8 * (std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude);
    ScanAxis axis;
    while (quantum / (2 * axis.scale) >= noise &&
           2 * axis.scale * std::max(request.key_limit, 1.0) <= kExactLimit) {
        axis.scale *= 2;
    }
    const long double per_unit =
        is_decimal
            ? std::ldexp(static_cast<long double>(std::pow(10.0, lattice.decimals())), lattice.refinement())
            : std::ldexp(1.0L, -lattice.exponent());
    axis.centres.resize(static_cast<std::size_t>(request.count));
    for (std::int64_t i = 0; i < request.count; ++i) {
        const double centre = request.start + request.sign * (static_cast<double>(i) + 0.5) * request.step;
        const long double steps = static_cast<long double>(centre) * per_unit - request.origin;
        axis.centres[static_cast<std::size_t>(i)] = static_cast<double>(std::round(steps * axis.scale));
    }
    axis.inverse_step = quantum / (request.step * axis.scale);
    // Rounding to the lattice moved centres by half a step, roundings before it by less than another.
    axis.uncertainty = std::ldexp(reach(axis, request), -47) + 2 * axis.inverse_step;
    return axis;
}

}  // namespace

std::vector<double> ScanAxis::centres_at(double steps) const {
    std::vector<double> at(centres.size());
    // The quotient is the centre on the TIN's lattice, rounded once: exact where the centre lies on it.
    std::transform(centres.begin(), centres.end(), at.begin(),
                   [&](double centre) { return std::nearbyint(centre / scale * steps); });
    return at;
}

ScanAxis make_scan_axis(const Lattice& lattice, double origin, double key_limit, AxisDirection direction,
                        double start, double step, std::int64_t count) {
    const AxisRequest request{lattice, origin, key_limit, direction == AxisDirection::East ? 1.0 : -1.0,
                              start,   step,   count};
    if (std::optional<ScanAxis> axis = make_decimal_axis(request)) {
        return *std::move(axis);
    }
    return make_rounded_axis(request);
}

}  // namespace tinwright
