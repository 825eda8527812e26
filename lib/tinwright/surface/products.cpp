#include "tinwright/surface/products.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace tinwright {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace

double slope_of(Point2 gradient, SlopeUnit unit) {
    const double ratio = std::hypot(gradient.x, gradient.y);
    switch (unit) {
        case SlopeUnit::Degree:
            return std::atan(ratio) * kDegrees;
        case SlopeUnit::Percent:
            return 100 * ratio;
        case SlopeUnit::Ratio:
            break;
    }
    return ratio;
}

double aspect_of(Point2 gradient) {
    if (gradient.x == 0 && gradient.y == 0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double azimuth = std::atan2(-gradient.x, -gradient.y) * kDegrees;
    const double positive = azimuth < 0 ? azimuth + 360 : azimuth + 0.0;
    return positive < 360 ? positive : 0;
}

double hillshade_of(Point2 gradient, const Light& light) {
    const double azimuth = light.azimuth / kDegrees;
    const double altitude = light.altitude / kDegrees;
    const double x = gradient.x * light.z_factor;
    const double y = gradient.y * light.z_factor;
    // The cosine between the surface's normal (-x, -y, 1) and the direction of the light.
    const double facing =
        (std::sin(altitude) - std::cos(altitude) * (x * std::sin(azimuth) + y * std::cos(azimuth))) /
        std::sqrt(1 + x * x + y * y);
    return facing > 0 ? 1 + 254 * facing : 1;
}

}  // namespace tinwright
