#include "tinwright/io/coordinate_transform.hpp"

#include <vector>

#include <doctest/doctest.h>

using namespace tinwright;
using io::CoordinateTransform;
using io::Crs;

TEST_SUITE("io/coordinate_transform") {
    TEST_CASE("a zone's central meridian lies at its false easting, whatever the axis order of degrees") {
        const CoordinateTransform way(Crs::parse("EPSG:4326"), Crs::parse("EPSG:32632"));
        std::vector<Point3> points{{9, 0, 12.5}};
        CHECK(way.forward(points).empty());
        CHECK(points[0].x == doctest::Approx(500000).epsilon(1e-14));
        CHECK(points[0].y == doctest::Approx(0));
        CHECK(points[0].z == 12.5);
        CHECK(way.inverse(points).empty());
        CHECK(points[0].x == doctest::Approx(9));
    }
}
