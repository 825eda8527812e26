#ifndef TINWRIGHT_SURFACE_RADIAL_KERNEL_HPP
#define TINWRIGHT_SURFACE_RADIAL_KERNEL_HPP

#include <cstddef>
#include <span>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// A power of the distance. With a linear drift any exponent between 0 and 4 but 2 makes a unique interpolant
/// [wendland2005, Ch. 8].
struct RadialKernel {
    double exponent = 1.5;

    /// Of the form that the kernel's matrix has on what no plane can explain: 1 positive, -1 negative
    /// definite.
    [[nodiscard]] double sign() const { return exponent < 2 ? -1 : 1; }
};

/// The kernel's values at the distances of `at` from n places; n is a multiple of kRadialStep.
inline constexpr std::size_t kRadialStep = 4;
void find_kernel_values(RadialKernel kernel, std::span<const double> x, std::span<const double> y, Point2 at,
                        std::span<double> values);

/// The sum of the kernel's values times coefficients, always added in the same order. The same n.
double sum_kernel(RadialKernel kernel, std::span<const double> x, std::span<const double> y,
                  std::span<const double> coefficients, Point2 at);

/// The gradient of that sum along `at`; a place at `at` itself adds nothing.
Point2 sum_kernel_gradient(RadialKernel kernel, std::span<const double> x, std::span<const double> y,
                           std::span<const double> coefficients, Point2 at);

}  // namespace tinwright

#endif
