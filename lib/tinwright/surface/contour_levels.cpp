#include "tinwright/surface/contour_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

/// base + k * interval, as decimal numbers wherever they fit.
class LevelScale {
  public:
    LevelScale(double base, double interval) : base_(base), interval_(interval) {
        const Decimal origin = shortest_decimal(base);
        const Decimal step = shortest_decimal(interval);
        exponent_ = origin.digits == 0 ? step.exponent : std::min(origin.exponent, step.exponent);
        origin_steps_ = whole_steps(origin, exponent_);
        interval_steps_ = whole_steps(step, exponent_);
    }

    [[nodiscard]] double at(std::int64_t k) const {
        constexpr double kRoom = 1e37;  // an Int128 takes four times as many steps
        if (origin_steps_ && interval_steps_ &&
            std::abs(static_cast<double>(k)) * static_cast<double>(*interval_steps_) < kRoom) {
            return from_steps(*origin_steps_ + k * *interval_steps_, exponent_);
        }
        return base_ + static_cast<double>(k) * interval_;
    }

  private:
    double base_;
    double interval_;
    int exponent_ = 0;
    std::optional<Int128> origin_steps_;
    std::optional<Int128> interval_steps_;
};

void add_steps(std::vector<ContourLevel>& levels, double z_min, double z_max, const ContourRequest& request) {
    const double interval = *request.interval;
    const double first = std::floor((z_min - request.base) / interval);
    const double last = std::ceil((z_max - request.base) / interval);
    if (!(last - first <= kContourLevelLimit)) {
        throw UsageError("an interval of " + decimal_text(interval) +
                         " makes more than a million levels from " + decimal_text(z_min) + " to " +
                         decimal_text(z_max) + ": choose a larger one");
    }
    constexpr double kWhole = 0x1p53;
    if (!(std::abs(first) < kWhole && std::abs(last) < kWhole)) {
        throw UsageError("an interval of " + decimal_text(interval) + " is finer than elevations like " +
                         decimal_text(z_max) + " can be told: choose a larger one");
    }
    const LevelScale scale(request.base, interval);
    // One more at both ends: the quotients are rounded.
    const auto end = static_cast<std::int64_t>(last) + 1;
    for (auto k = static_cast<std::int64_t>(first) - 1; k <= end; ++k) {
        const double level = scale.at(k);
        if (z_min <= level && level < z_max) {
            levels.push_back({level, request.index_every > 0 && k % request.index_every == 0});
        }
    }
}

}  // namespace

void check_contours(const ContourRequest& request) {
    const auto refuse_wild = [](double value, const char* what) {
        if (!std::isfinite(value)) {
            throw UsageError(std::string(what) + " of contours must be a finite number");
        }
    };
    refuse_wild(request.base, "the base");
    for (const double level : request.levels) {
        refuse_wild(level, "a level");
    }
    if (!request.interval && request.levels.empty()) {
        throw UsageError("which contours? Give --interval or --levels");
    }
    if (request.interval && !(std::isfinite(*request.interval) && *request.interval > 0)) {
        throw UsageError("the interval of contours must be above zero, not " +
                         decimal_text(*request.interval));
    }
    if (request.index_every < 0 || (request.index_every > 0 && !request.interval)) {
        throw UsageError("index contours are every so many lines of --interval: give it too");
    }
}

std::vector<ContourLevel> choose_levels(double z_min, double z_max, const ContourRequest& request) {
    check_contours(request);
    std::vector<ContourLevel> levels;
    if (request.interval && z_min < z_max) {
        add_steps(levels, z_min, z_max, request);
    }
    for (const double level : request.levels) {
        if (z_min <= level && level < z_max) {
            levels.push_back({level + 0.0, false});  // zero has no sign
        }
    }
    std::stable_sort(levels.begin(), levels.end(),
                     [](const ContourLevel& a, const ContourLevel& b) { return a.elevation < b.elevation; });
    // Steps come before single levels, so their index marks stay.
    levels.erase(
        std::unique(levels.begin(), levels.end(),
                    [](const ContourLevel& a, const ContourLevel& b) { return a.elevation == b.elevation; }),
        levels.end());
    return levels;
}

}  // namespace tinwright
