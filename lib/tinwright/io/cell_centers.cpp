#include "tinwright/io/cell_centers.hpp"

#include <cmath>

#include "tinwright/io/read_number.hpp"

namespace tinwright::io {
namespace {

/// Whether `value` is the double nearest to integer / 10^places; the integer goes to `digits`.
bool is_decimal(double value, double power, double& digits) {
    digits = std::nearbyint(value * power);
    return digits / power == value;
}

}  // namespace

CellCenters::CellCenters(const std::array<double, 6>& transform, int cells) {
    constexpr std::size_t kMostPlaces = 9;
    constexpr double kLargestExact =
        9007199254740992.0;  // 2^53: every term and sum below it is an exact integer
    for (std::size_t places = 0; places <= kMostPlaces && !are_decimal_; ++places) {
        const double power = kPowersOfTen[places];
        are_decimal_ = true;
        double largest = 0;
        for (std::size_t k = 0; k < 6; ++k) {
            double digits = 0;
            are_decimal_ = are_decimal_ && is_decimal(transform[k], power, digits);
            const bool is_origin = k == 0 || k == 3;
            scaled_[k] = is_origin ? 2 * digits : digits;
            largest += std::abs(scaled_[k]) * (is_origin ? 1.0 : 2.0 * cells + 1);
        }
        are_decimal_ = are_decimal_ && largest < kLargestExact;
        divisor_ = 2 * power;
    }
    if (!are_decimal_) {
        scaled_ = {2 * transform[0], transform[1], transform[2],
                   2 * transform[3], transform[4], transform[5]};
        divisor_ = 2;
    }
}

}  // namespace tinwright::io
