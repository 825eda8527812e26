#include "tinwright/surface/radial_kernel.hpp"

#include <array>
#include <cmath>

namespace tinwright {

namespace {

// The usual exponents need square roots only, two or four of which a processor takes at a time.

struct Power1 {
    static double value(double squared) { return std::sqrt(squared); }
    static double slope(double squared) { return 1 / std::sqrt(squared); }
};
struct Power3Halves {
    static double value(double squared) {
        const double distance = std::sqrt(squared);
        return distance * std::sqrt(distance);
    }
    static double slope(double squared) { return 1.5 / std::sqrt(std::sqrt(squared)); }
};
struct Power5Halves {
    static double value(double squared) { return squared * std::sqrt(std::sqrt(squared)); }
    static double slope(double squared) { return 2.5 * std::sqrt(std::sqrt(squared)); }
};
struct Power3 {
    static double value(double squared) { return squared * std::sqrt(squared); }
    static double slope(double squared) { return 3 * std::sqrt(squared); }
};
struct AnyPower {
    double exponent;
    [[nodiscard]] double value(double squared) const { return std::pow(squared, exponent / 2); }
    [[nodiscard]] double slope(double squared) const {
        return exponent * std::pow(squared, exponent / 2 - 1);
    }
};

/// Calls `visit` with the fastest form of the kernel.
template <class Visit>
auto visit_power(RadialKernel kernel, const Visit& visit) {
    if (kernel.exponent == 1.5) {
        return visit(Power3Halves{});
    }
    if (kernel.exponent == 1) {
        return visit(Power1{});
    }
    if (kernel.exponent == 2.5) {
        return visit(Power5Halves{});
    }
    if (kernel.exponent == 3) {
        return visit(Power3{});
    }
    return visit(AnyPower{kernel.exponent});
}

double total(const std::array<double, kRadialStep>& sums) {
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void find_kernel_values(RadialKernel kernel, std::span<const double> x, std::span<const double> y, Point2 at,
                        std::span<double> values) {
    visit_power(kernel, [&](auto power) {
        const std::size_t count = x.size();
        const double* const xs = x.data();
        const double* const ys = y.data();
        double* const to = values.data();
        for (std::size_t i = 0; i < count; ++i) {
            const double dx = at.x - xs[i];
            const double dy = at.y - ys[i];
            to[i] = power.value(dx * dx + dy * dy);
        }
    });
}

double sum_kernel(RadialKernel kernel, std::span<const double> x, std::span<const double> y,
                  std::span<const double> coefficients, Point2 at) {
    return visit_power(kernel, [&](auto power) {
        std::array<double, kRadialStep> sums{};
        const double* const xs = x.data();
        const double* const ys = y.data();
        const double* const cs = coefficients.data();
        for (std::size_t i = 0; i < x.size(); i += kRadialStep) {
            for (std::size_t j = 0; j < kRadialStep; ++j) {
                const double dx = at.x - xs[i + j];
                const double dy = at.y - ys[i + j];
                sums[j] += cs[i + j] * power.value(dx * dx + dy * dy);
            }
        }
        return total(sums);
    });
}

Point2 sum_kernel_gradient(RadialKernel kernel, std::span<const double> x, std::span<const double> y,
                           std::span<const double> coefficients, Point2 at) {
    return visit_power(kernel, [&](auto power) {
        std::array<double, kRadialStep> x_sums{};
        std::array<double, kRadialStep> y_sums{};
        const double* const xs = x.data();
        const double* const ys = y.data();
        const double* const cs = coefficients.data();
        for (std::size_t i = 0; i < x.size(); i += kRadialStep) {
            for (std::size_t j = 0; j < kRadialStep; ++j) {
                const double dx = at.x - xs[i + j];
                const double dy = at.y - ys[i + j];
                const double squared = dx * dx + dy * dy;
                const double slope = squared > 0 ? cs[i + j] * power.slope(squared) : 0.0;
                x_sums[j] += slope * dx;
                y_sums[j] += slope * dy;
            }
        }
        return Point2{total(x_sums), total(y_sums)};
    });
}

}  // namespace tinwright
