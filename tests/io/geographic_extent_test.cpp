#include "tinwright/io/geographic_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using tinwright::Point3;
using tinwright::io::ExtentGatherer;
using tinwright::io::GeographicExtent;
using tinwright_tests::Random;

namespace {

GeographicExtent extent_of(const std::vector<Point3>& points) {
    ExtentGatherer gatherer;
    gatherer.add(points);
    return gatherer.extent();
}

/// A multiple of 1/1024 degree, to which whole turns are added exactly.
double angle(Random& random, double low, double high) {
    return std::floor((low + (high - low) * random.real()) * 1024) / 1024;
}

/// By sorting: where data begin and end that leave out the widest gap between longitudes.
struct Span {
    double west = 0;
    double east = 0;
    double gap = 0;
    double second_gap = 0;
};

Span widest_gap_left_out(const std::vector<Point3>& points) {
    std::vector<double> longitudes;
    for (const Point3& point : points) {
        double longitude = std::fmod(point.x + 540, 360) - 180;  // exact for multiples of 1/1024
        longitudes.push_back(longitude);
    }
    std::sort(longitudes.begin(), longitudes.end());
    Span span;
    for (std::size_t i = 0; i < longitudes.size(); ++i) {
        const bool is_last = i + 1 == longitudes.size();
        const double next = is_last ? longitudes.front() + 360 : longitudes[i + 1];
        const double gap = next - longitudes[i];
        if (gap > span.gap) {
            span = {is_last ? next - 360 : next, is_last ? longitudes[i] : longitudes[i] + 360, gap,
                    span.gap};
        } else {
            span.second_gap = std::max(span.second_gap, gap);
        }
    }
    return span;
}

}  // namespace

TEST_SUITE("io/geographic_extent") {
    TEST_CASE("no points have no extent, nor do such as are on no earth") {
        CHECK(ExtentGatherer().extent().is_empty);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const double infinity = std::numeric_limits<double>::infinity();
        const GeographicExtent extent =
            extent_of({{nan, 1, 0}, {infinity, 1, 0}, {1, nan, 0}, {1, 90.001, 0}, {1, -infinity, 0}});
        CHECK(extent.is_empty);
        CHECK(extent == GeographicExtent());
        CHECK(extent.text() == "nowhere");
        CHECK(extent_of({{nan, 1, 0}, {30, 40, nan}, {1, 91, 0}}) == extent_of({{30, 40, 0}}));
    }

    TEST_CASE("the extent of a point is that point") {
        const GeographicExtent extent = extent_of({{25.123456789, -41.987654321, 7}});
        CHECK_FALSE(extent.is_empty);
        CHECK_FALSE(extent.has_pole);
        CHECK(extent.west == 25.123456789);
        CHECK(extent.east == 25.123456789);
        CHECK(extent.south == -41.987654321);
        CHECK(extent.north == -41.987654321);
        CHECK(extent.center_longitude() == 25.123456789);
        CHECK(extent.center_latitude() == -41.987654321);
    }

    TEST_CASE("data on both sides of the antimeridian are one piece") {
        const GeographicExtent extent = extent_of({{179.5, -17, 0}, {-179.25, -16, 0}});
        CHECK(extent.west == 179.5);
        CHECK(extent.east == 180.75);
        CHECK(extent.center_longitude() == -179.875);
        CHECK(extent == extent_of({{179.5, -17, 0}, {180.75, -16, 0}}));
        CHECK(extent.text() == "179.5 E to 179.2 W, 17.0 S to 16.0 S");
    }

    TEST_CASE("180 and -180 are one meridian") {
        const GeographicExtent extent = extent_of({{180, 1, 0}, {-180, 2, 0}, {540, 3, 0}});
        CHECK(extent.west == -180);
        CHECK(extent.east == -180);
        CHECK(extent.center_longitude() == -180);
        CHECK_FALSE(extent.has_pole);
        // The centre of data up to it, from either side.
        CHECK(extent_of({{170, 0, 0}, {180, 0, 0}}).center_longitude() == 175);
        CHECK(extent_of({{-180, 0, 0}, {-170, 0, 0}}).center_longitude() == -175);
    }

    TEST_CASE("half the earth is not all around it, more is") {
        const GeographicExtent half = extent_of({{0, 5, 0}, {180, 6, 0}});
        CHECK_FALSE(half.has_pole);
        CHECK(half.east - half.west == 180);
        const GeographicExtent round = extent_of({{0, 85, 0}, {120, 86, 0}, {240, 84, 0}});
        CHECK(round.has_pole);
        CHECK(round.west == -180);
        CHECK(round.east == 180);
        CHECK(round.south == 84);
        CHECK(round.north == 90);
        CHECK(round.center_latitude() == 90);
        CHECK(round.center_longitude() == 0);
        CHECK(round.text() == "round the north pole, 84.0 N to 90.0 N");
    }

    TEST_CASE("data go round the pole that they are nearer to") {
        const GeographicExtent extent = extent_of({{0, -85, 0}, {120, 70, 0}, {240, -84, 0}});
        CHECK(extent.has_pole);
        CHECK(extent.south == -90);
        CHECK(extent.north == 70);
        CHECK(extent.center_latitude() == -90);
        CHECK(extent.text() == "round the south pole, 90.0 S to 70.0 N");
    }

    TEST_CASE("a point at a pole has no longitude") {
        const GeographicExtent extent = extent_of({{10, 88, 0}, {12, 88.5, 0}, {-150, 90, 0}});
        CHECK(extent.west == 10);
        CHECK(extent.east == 12);
        CHECK(extent.north == 90);
        CHECK_FALSE(extent.has_pole);
        const GeographicExtent pole = extent_of({{77, -90, 0}});
        CHECK(pole.has_pole);
        CHECK(pole.south == -90);
        CHECK(pole.north == -90);
        CHECK(pole.center_latitude() == -90);
        CHECK(pole.text() == "round the south pole, 90.000000 S to 90.000000 S");
    }

    TEST_CASE("text has the decimals that tell the ends apart") {
        GeographicExtent extent{-103.1, -101.5, 35.2, 36, false, false};
        CHECK(extent.text() == "103.1 W to 101.5 W, 35.2 N to 36.0 N");
        extent = {10.001, 10.003, -0.25, 0.25, false, false};
        CHECK(extent.text() == "10.0010 E to 10.0030 E, 0.2500 S to 0.2500 N");
        extent = {0, 0, 45, 46, false, false};
        CHECK(extent.text() == "0.0 E to 0.0 E, 45.0 N to 46.0 N");
    }

    TEST_CASE("neither order nor parts nor the way longitudes are counted matter") {
        for (int seed = 0; seed < tinwright_tests::cases(200); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const double center = angle(random, -180, 180);
            const double width = angle(random, 0, seed % 2 == 0 ? 2 : 360);
            std::vector<Point3> points;
            for (std::int64_t i = random.integer(1, 40); i > 0; --i) {
                points.push_back(
                    {angle(random, center - width / 2, center + width / 2), random.real() * 180 - 90, 0});
            }
            const GeographicExtent extent = extent_of(points);
            ExtentGatherer parts;
            for (std::size_t i = points.size(); i-- > 0;) {
                const Point3 point{points[i].x + 360 * static_cast<double>(random.integer(-2, 2)),
                                   points[i].y, 0};
                parts.add({&point, 1});
            }
            CHECK(parts.extent() == extent);
        }
    }

    TEST_CASE("the widest gap is left out, and the ends are those of the data") {
        for (int seed = 0; seed < tinwright_tests::cases(500); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const double center = angle(random, -180, 180);
            const double width = angle(random, 0, 300);
            std::vector<Point3> points;
            for (std::int64_t i = random.integer(1, 30); i > 0; --i) {
                points.push_back({angle(random, center - width / 2, center + width / 2), 89, 0});
            }
            const Span span = widest_gap_left_out(points);
            const GeographicExtent extent = extent_of(points);
            CHECK(extent.has_pole == (span.gap < 180));
            if (!extent.has_pole && span.gap > span.second_gap) {
                CHECK(extent.west == span.west);
                CHECK(extent.east == span.east);
            }
            for (const Point3& point : points) {
                const double east_of_west = std::fmod(std::fmod(point.x - extent.west, 360) + 360, 360);
                CHECK(east_of_west <= extent.east - extent.west);
            }
        }
    }
}
