#include "tinwright/io/geographic_extent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tinwright::io {
namespace {

constexpr double kTurn = 360;
constexpr double kHalfTurn = 180;
constexpr double kPole = 90;

/// In [-180, 180), exactly; never a negative zero.
double normalized_longitude(double longitude) {
    const double remainder = std::remainder(longitude, kTurn);
    return remainder == kHalfTurn ? -kHalfTurn : remainder + 0.0;
}

/// As many decimals as tell the ends of the extent apart.
int count_decimals(double span) {
    constexpr int kMost = 6;
    int decimals = 1;
    for (double steps = span * 10; steps < 5 && decimals < kMost; steps *= 10) {
        ++decimals;
    }
    return decimals;
}

std::string angle_text(double angle, int decimals, char positive, char negative) {
    std::array<char, 32> digits{};
    (void)std::snprintf(digits.data(), digits.size(), "%.*f", decimals, std::abs(angle));
    return std::string(digits.data()) + ' ' + (angle < 0 ? negative : positive);
}

}  // namespace

double GeographicExtent::center_longitude() const {
    return has_pole ? 0 : normalized_longitude(west + (east - west) / 2);
}

double GeographicExtent::center_latitude() const {
    if (has_pole) {
        return north == kPole ? kPole : -kPole;
    }
    return south + (north - south) / 2;
}

std::string GeographicExtent::text() const {
    if (is_empty) {
        return "nowhere";
    }
    const double width = has_pole ? 0 : east - west;
    const double height = north - south;
    // The shorter side decides, unless it is none: data along a line.
    const double shorter = std::min(width, height);
    const int decimals = count_decimals(shorter > 0 ? shorter : std::max(width, height));
    const std::string latitudes =
        angle_text(south, decimals, 'N', 'S') + " to " + angle_text(north, decimals, 'N', 'S');
    if (has_pole) {
        return std::string("round the ") + (center_latitude() > 0 ? "north" : "south") + " pole, " +
               latitudes;
    }
    return angle_text(west, decimals, 'E', 'W') + " to " +
           angle_text(normalized_longitude(east), decimals, 'E', 'W') + ", " + latitudes;
}

void ExtentGatherer::add(std::span<const Point3> points) {
    for (const Point3& point : points) {
        if (!std::isfinite(point.x) || !(std::abs(point.y) <= kPole)) {
            continue;
        }
        south_ = std::min(south_, point.y + 0.0);
        north_ = std::max(north_, point.y + 0.0);
        if (std::abs(point.y) == kPole) {
            continue;  // every longitude and none
        }
        const double longitude = normalized_longitude(point.x);
        const double arc = std::floor((longitude + kHalfTurn) * (static_cast<double>(kArcs) / kTurn));
        const auto i = std::min(static_cast<std::size_t>(arc), kArcs - 1);
        if (!has_points_[i]) {
            has_points_.set(i);
            least_[i] = longitude;
            greatest_[i] = longitude;
        }
        least_[i] = std::min(least_[i], longitude);
        greatest_[i] = std::max(greatest_[i], longitude);
    }
}

GeographicExtent ExtentGatherer::extent() const {
    GeographicExtent extent;
    if (north_ < south_) {
        return extent;
    }
    extent.is_empty = false;
    extent.south = south_;
    extent.north = north_;
    std::size_t first = 0;
    while (first < kArcs && !has_points_[first]) {
        ++first;
    }
    double widest_gap = 0;  // of a pole alone
    if (first < kArcs) {
        std::size_t last = first;
        for (std::size_t i = first + 1; i < kArcs; ++i) {
            if (has_points_[i]) {
                last = i;
            }
        }
        // The gap at the antimeridian, unless another is wider.
        extent.west = least_[first];
        extent.east = greatest_[last];
        widest_gap = kTurn - (extent.east - extent.west);
        double before = greatest_[first];
        for (std::size_t i = first + 1; i <= last; ++i) {
            if (!has_points_[i]) {
                continue;
            }
            if (least_[i] - before > widest_gap) {
                widest_gap = least_[i] - before;
                extent.west = least_[i];
                extent.east = before + kTurn;
            }
            before = greatest_[i];
        }
    }
    if (widest_gap < kHalfTurn) {
        extent.has_pole = true;
        extent.west = -kHalfTurn;
        extent.east = kHalfTurn;
        (south_ + north_ >= 0 ? extent.north : extent.south) = south_ + north_ >= 0 ? kPole : -kPole;
    }
    return extent;
}

}  // namespace tinwright::io
