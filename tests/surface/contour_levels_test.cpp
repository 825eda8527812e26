#include "tinwright/surface/contour_levels.hpp"

#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

std::vector<double> elevations(double z_min, double z_max, const ContourRequest& request) {
    std::vector<double> result;
    for (const ContourLevel& level : choose_levels(z_min, z_max, request)) {
        result.push_back(level.elevation);
    }
    return result;
}

std::string refusal_of(const ContourRequest& request) {
    return message_of<UsageError>([&] { choose_levels(0, 1000, request); });
}

}  // namespace

TEST_SUITE("surface/contour_levels") {
    TEST_CASE("levels are decimal numbers, not sums of doubles") {
        CHECK(elevations(0.05, 0.75, {.interval = 0.1}) ==
              std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7});
        CHECK(elevations(-0.25, 0.1, {.interval = 0.1, .base = 0.05}) ==
              std::vector<double>{-0.25, -0.15, -0.05, 0.05});
    }

    TEST_CASE("the lowest elevation may be a level, the highest none: nothing is above it") {
        CHECK(elevations(10, 30, {.interval = 10}) == std::vector<double>{10, 20});
        CHECK(elevations(10, 10, {.interval = 10}).empty());
        CHECK(elevations(11, 19, {.interval = 10}).empty());
    }

    TEST_CASE("single levels join those of the interval, sorted, each once") {
        CHECK(elevations(0, 35, {.interval = 10, .levels = {25, 12.5, 20, 99, -1}}) ==
              std::vector<double>{0, 10, 12.5, 20, 25, 30});
    }

    TEST_CASE("every so many lines of the interval are index contours, counted from the base") {
        const auto levels =
            choose_levels(-3, 13, {.interval = 2, .base = 1, .levels = {1, 2}, .index_every = 5});
        std::vector<double> index;
        for (const ContourLevel& level : levels) {
            if (level.is_index) {
                index.push_back(level.elevation);
            }
        }
        CHECK(index == std::vector<double>{1, 11});
    }

    TEST_CASE("an interval that is no decimal number of reasonable length still works") {
        CHECK(elevations(0, 1e-300, {.interval = 4e-301, .base = 0}).size() == 3);
        CHECK(elevations(1e300, 3e300, {.interval = 1e300, .base = 1e-5}).size() >= 1);
    }

    TEST_CASE("what makes no levels is refused") {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        CHECK(refusal_of({}) == "which contours? Give --interval or --levels");
        CHECK(refusal_of({.interval = 0.0}) == "the interval of contours must be above zero, not 0");
        CHECK(refusal_of({.interval = -2.0}) == "the interval of contours must be above zero, not -2");
        CHECK(refusal_of({.interval = nan}) == "the interval of contours must be above zero, not nan");
        CHECK(refusal_of({.interval = 1.0, .base = nan}) == "the base of contours must be a finite number");
        CHECK(refusal_of({.levels = {nan}}) == "a level of contours must be a finite number");
        CHECK(refusal_of({.interval = 1e-5}) ==
              "an interval of 0.00001 makes more than a million levels from 0 to 1000: choose a larger one");
        CHECK(refusal_of({.levels = {5}, .index_every = 5}) ==
              "index contours are every so many lines of --interval: give it too");
        CHECK(message_of<UsageError>([] { choose_levels(1e9, 1e9 + 1, {.interval = 1e-8, .base = 0}); }) ==
              "an interval of 1e-08 makes more than a million levels from 1000000000 to 1000000001: choose a "
              "larger one");
        CHECK(
            message_of<UsageError>([] { choose_levels(1e12, 1e12 + 1, {.interval = 1e-5, .base = 0}); }) ==
            "an interval of 0.00001 is finer than elevations like 1000000000001 can be told: choose a larger "
            "one");
    }
}
