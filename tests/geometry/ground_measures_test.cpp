#include "tinwright/geometry/ground_measures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using tinwright::GroundMeasures;
using tinwright::Point2;
using tinwright_tests::Random;

TEST_SUITE("geometry/ground_measures") {
    TEST_CASE("as they are made, measures are those of the plane") {
        const GroundMeasures ground;
        CHECK_FALSE(ground.is_geodesic());
        CHECK(ground.unit.empty());
        CHECK(ground.distortion == 0);
        CHECK(ground.length(Point2{1, 2}, Point2{4, 6}) == 5);
        const std::vector<Point2> line{{0, 0}, {3, 4}, {3, 10}, {11, 16}};
        CHECK(ground.length(line) == 5 + 6 + 10);
        CHECK(ground.area(line) == 22);  // triangles from the first: (18 - 62) / 2
    }

    TEST_CASE("nothing has no length and no area") {
        const GroundMeasures ground;
        const std::vector<Point2> line{{7, 8}};
        CHECK(ground.length(std::vector<Point2>()) == 0);
        CHECK(ground.length(line) == 0);
        CHECK(ground.area(std::vector<Point2>()) == 0);
        CHECK(ground.area(line) == 0);
        CHECK(ground.area(std::vector<Point2>{{0, 0}, {5, 5}}) == 0);
    }

    TEST_CASE("an area does not depend on the turn or on the first position, nor on a far origin") {
        for (int seed = 0; seed < tinwright_tests::cases(100); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            // A star around a centre: whole coordinates, so that everything is exact.
            std::vector<Point2> ring;
            const std::int64_t n = random.integer(3, 20);
            for (std::int64_t i = 0; i < n; ++i) {
                const double turn = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
                const double radius = 100 + 900 * random.real();
                ring.push_back({std::round(radius * std::cos(turn)), std::round(radius * std::sin(turn))});
            }
            // Independent: trapezoids down to an axis.
            double area = 0;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Point2& a = ring[i];
                const Point2& b = ring[(i + 1) % ring.size()];
                area += (a.y + b.y) * (a.x - b.x) / 2;
            }
            const GroundMeasures ground;
            CHECK(ground.area(ring) == std::abs(area));
            std::rotate(ring.begin(), ring.begin() + 1, ring.end());
            CHECK(ground.area(ring) == std::abs(area));
            std::reverse(ring.begin(), ring.end());
            CHECK(ground.area(ring) == std::abs(area));
            for (Point2& corner : ring) {
                corner = {corner.x + 4e6, corner.y + 7e6};
            }
            CHECK(ground.area(ring) == std::abs(area));
        }
    }

    TEST_CASE("functions put in measure instead") {
        GroundMeasures ground;
        ground.length_function = [](Point2 a, Point2 b) { return 2 * std::hypot(b.x - a.x, b.y - a.y); };
        ground.area_function = [](std::span<const Point2> ring) { return -static_cast<double>(ring.size()); };
        ground.unit = "metre";
        CHECK(ground.is_geodesic());
        CHECK(ground.length(Point2{0, 0}, Point2{3, 4}) == 10);
        const std::vector<Point2> line{{0, 0}, {3, 4}, {3, 0}};
        CHECK(ground.length(line) == 18);
        CHECK(ground.area(line) == 3);  // never negative
    }
}
