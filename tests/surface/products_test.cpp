#include "tinwright/surface/products.hpp"

#include <cmath>

#include <doctest/doctest.h>

using namespace tinwright;

TEST_SUITE("surface/products") {
    TEST_CASE("a slope of one in one is 45 degrees and 100 percent, whichever way it faces") {
        for (const Point2 gradient : {Point2{1, 0}, Point2{0, -1}, Point2{0.6, 0.8}}) {
            CHECK(slope_of(gradient, SlopeUnit::Degree) == doctest::Approx(45).epsilon(1e-14));
            CHECK(slope_of(gradient, SlopeUnit::Percent) == doctest::Approx(100).epsilon(1e-14));
            CHECK(slope_of(gradient, SlopeUnit::Ratio) == doctest::Approx(1).epsilon(1e-14));
        }
        CHECK(slope_of({0, 0}, SlopeUnit::Degree) == 0);
    }

    TEST_CASE("the aspect is where the ground falls to, clockwise from north") {
        CHECK(aspect_of({0, -1}) == 0);   // falls to the north
        CHECK(aspect_of({-1, 0}) == 90);  // to the east
        CHECK(aspect_of({0, 1}) == 180);
        CHECK(aspect_of({1, 0}) == 270);
        CHECK(aspect_of({1, 1}) == doctest::Approx(225));
        CHECK(std::isnan(aspect_of({0, 0})));
        CHECK(aspect_of({1e-300, -1}) < 360);
    }

    TEST_CASE(
        "light from above shades by the cosine of the slope, and the far side of a steep ridge is dark") {
        const Light zenith{.azimuth = 0, .altitude = 90};
        CHECK(hillshade_of({0, 0}, zenith) == doctest::Approx(255));
        CHECK(hillshade_of({1, 0}, zenith) == doctest::Approx(1 + 254 * std::sqrt(0.5)));
        const Light from_east{.azimuth = 90, .altitude = 45};
        CHECK(hillshade_of({-1, 0}, from_east) == doctest::Approx(255));  // turned to it squarely
        CHECK(hillshade_of({3, 0}, from_east) == 1);
        CHECK(hillshade_of({-1, 0}, from_east) == hillshade_of({-0.5, 0}, {90, 45, 2}));
    }
}
