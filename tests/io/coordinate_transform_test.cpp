#include "tinwright/io/coordinate_transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/transform_points.hpp"

#include "support/messages.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using io::CoordinateTransform;
using io::Crs;
using io::GeographicExtent;
using io::TransformOptions;
using tinwright_tests::message_of;
using tinwright_tests::Random;

namespace {

CoordinateTransform between(const char* from, const char* to, const TransformOptions& options = {}) {
    return {Crs::parse(from), Crs::parse(to), options};
}

TransformOptions with_elevations() {
    TransformOptions options;
    options.has_elevations = true;
    return options;
}

GeographicExtent extent(double west, double east, double south, double north) {
    GeographicExtent area;
    area.west = west;
    area.east = east;
    area.south = south;
    area.north = north;
    area.is_empty = false;
    return area;
}

TransformOptions within(double west, double east, double south, double north) {
    TransformOptions options;
    options.extent = extent(west, east, south, north);
    return options;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Longitudes and latitudes in France, some of them impossible.
std::vector<Point3> points_in_france(std::size_t count) {
    Random random(91);
    std::vector<Point3> points(count);
    for (Point3& point : points) {
        point = {8 * random.real(), 42 + 8 * random.real(), 1000 * random.real()};
        if (random.integer(0, 999) == 0) {
            point.y = 95;
        }
    }
    return points;
}

}  // namespace

TEST_SUITE("io/coordinate_transform") {
    TEST_CASE("a zone's central meridian lies at its false easting, whatever the axis order of degrees") {
        const CoordinateTransform way = between("EPSG:4326", "EPSG:32632");
        std::vector<Point3> points{{9, 0, 12.5}};
        CHECK(way.forward(points).empty());
        CHECK(std::abs(points[0].x - 500000) < 1e-8);
        CHECK(std::abs(points[0].y) < 1e-8);
        CHECK(points[0].z == 12.5);
        CHECK(way.inverse(points).empty());
        CHECK(std::abs(points[0].x - 9) < 1e-13);
        CHECK(way.operation() == "UTM zone 32N");
        CHECK(way.warning().empty());
    }

    TEST_CASE("elevations that are not asked for keep every bit, whatever the systems say of heights") {
        for (const char* const to : {"EPSG:32632", "EPSG:32632+5773", "EPSG:4979", "EPSG:2154"}) {
            CAPTURE(std::string(to));
            const CoordinateTransform way = between("EPSG:4979", to);
            std::vector<Point3> points{{9, 45, -0.0},
                                       {9, 46, std::numeric_limits<double>::quiet_NaN()},
                                       {9, 47, std::numeric_limits<double>::infinity()},
                                       {9, 48, 1e300}};
            const std::vector<Point3> before = points;
            CHECK(way.forward(points).empty());
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK(std::memcmp(&points[i].z, &before[i].z, sizeof(double)) == 0);
            }
        }
    }

    TEST_CASE("points that cannot be transformed stay as they were and are listed in order") {
        const double inf = std::numeric_limits<double>::infinity();
        const double nan = std::numeric_limits<double>::quiet_NaN();
        std::vector<Point3> points = points_in_france(5000);
        for (Point3& point : points) {
            point.y = std::min(point.y, 50.0);
        }
        // Spread over several blocks, the first and the last point among them.
        const std::vector<std::size_t> bad{0, 1, 1022, 1023, 1024, 2500, 4998, 4999};
        const std::vector<Point3> values{{3, 95, 1},   {3, -90.1, 2}, {nan, 45, 3}, {3, nan, 4},
                                         {inf, 45, 5}, {3, inf, 6},   {3, 1e30, 7}, {nan, nan, 8}};
        for (std::size_t i = 0; i < bad.size(); ++i) {
            points[bad[i]] = values[i];
        }
        const CoordinateTransform way = between("EPSG:4326", "EPSG:2154");
        std::vector<Point3> moved = points;
        CHECK(way.forward(moved) == bad);
        for (const std::size_t i : bad) {
            CHECK(std::memcmp(&moved[i], &points[i], sizeof(Point3)) == 0);
        }
        CHECK(moved[2].x > 1e5);
    }

    TEST_CASE("any number of threads gives the same bytes") {
        const std::vector<Point3> points = points_in_france(300000);
        // With a grid, and with PROJ choosing between operations for each point.
        for (const char* const to : {"EPSG:2154", "EPSG:27572", "EPSG:23031"}) {
            CAPTURE(std::string(to));
            const CoordinateTransform way = between("EPSG:4326", to);
            std::vector<Point3> first;
            std::vector<std::size_t> first_failed;
            for (const int threads : {1, 2, 4}) {
                std::vector<Point3> moved = points;
                std::vector<std::size_t> failed;
                tbb::task_arena(threads).execute([&] { failed = way.forward(moved); });
                CHECK(!failed.empty());
                if (threads == 1) {
                    first = moved;
                    first_failed = failed;
                }
                CHECK(failed == first_failed);
                CHECK(std::memcmp(moved.data(), first.data(), moved.size() * sizeof(Point3)) == 0);
            }
        }
    }

    TEST_CASE("positions alone go the same way, and those that cannot become NaN") {
        const std::vector<Point3> points = points_in_france(3000);
        const CoordinateTransform way = between("EPSG:4326", "EPSG:27572");
        std::vector<Point3> moved = points;
        const std::vector<std::size_t> failed = way.forward(moved);
        std::vector<Point2> positions;
        for (const Point3& point : points) {
            positions.push_back({point.x, point.y});
        }
        way.forward(positions);
        std::size_t next = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (next < failed.size() && failed[next] == i) {
                ++next;
                CHECK(std::isnan(positions[i].x));
                CHECK(std::isnan(positions[i].y));
            } else {
                CHECK(positions[i] == Point2{moved[i].x, moved[i].y});
            }
        }
        CHECK(next == failed.size());
        way.inverse(positions);
        CHECK(std::abs(positions[0].x - points[0].x) < 1e-8);
        way.forward(std::span<Point2>());
    }

    TEST_CASE("progress goes up to one, and can stop the work") {
        std::vector<Point3> points = points_in_france(600000);
        const CoordinateTransform way = between("EPSG:4326", "EPSG:2154");
        std::vector<double> fractions;
        way.forward(points, [&](double fraction) {
            fractions.push_back(fraction);
            return true;
        });
        CHECK(fractions.size() > 1);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.back() == 1);
        CHECK_THROWS_AS(way.inverse(points, [](double) { return false; }), Cancelled);
        CHECK(way.forward(std::span<Point3>()).empty());
    }

    TEST_CASE("a system is brought to itself unchanged, a local one too") {
        for (const char* const system :
             {"EPSG:4326", "EPSG:2393", "EPSG:4326+5773", R"(LOCAL_CS["site grid",UNIT["metre",1]])"}) {
            std::vector<Point3> points{{12.3456789, 45.678901234, 3}};
            const std::vector<Point3> before = points;
            CHECK(between(system, system).forward(points).empty());
            CHECK(points == before);
        }
        CHECK(message_of<InputError>([] {
                  between(R"(LOCAL_CS["site grid",UNIT["metre",1]])", "EPSG:4326");
              }) == "no transformation from site grid to EPSG:4326 (WGS 84)");
    }

    TEST_CASE("the operation is chosen for the extent, across the antimeridian too") {
        CHECK(between("EPSG:4267", "EPSG:4326", within(-110, -109, 35, 36)).operation() ==
              "NAD27 to WGS 84 (6)");
        CHECK(between("EPSG:4267", "EPSG:4326", within(-150, -149, 63, 64)).operation() ==
              "NAD27 to WGS 84 (7)");
        // A single point is an extent.
        CHECK(between("EPSG:4267", "EPSG:4326", within(-149.5, -149.5, 63, 63)).operation() ==
              "NAD27 to WGS 84 (7)");
        // The Aleutian Islands lie on both sides of it.
        const CoordinateTransform east = between("EPSG:4267", "EPSG:4326", within(-172, -170, 52, 53));
        const CoordinateTransform both = between("EPSG:4267", "EPSG:4326", within(179, 181, 51, 52));
        CHECK(has(east.operation(), "NAD27 to WGS 84"));
        CHECK(has(both.operation(), "NAD27 to WGS 84"));
        std::vector<Point3> points{{179.5, 51.5, 0}, {-179.5, 51.5, 0}};
        CHECK(both.forward(points).empty());
        CHECK(std::abs(points[0].x - 179.5) < 0.01);
        CHECK(std::abs(points[1].x + 179.5) < 0.01);
        CHECK(between("EPSG:4267", "EPSG:4326", within(-180, 180, 60, 90)).accuracy().has_value());
    }

    TEST_CASE("a shift that is not known is told of, one within a datum never") {
        const CoordinateTransform way = between("+proj=utm +zone=32 +ellps=intl +type=crs", "EPSG:4326");
        CHECK(way.warning() ==
              "from unnamed, Transverse Mercator to EPSG:4326 (WGS 84): the shift between the two datums is "
              "unknown and taken to be "
              "none, so that positions may be off by up to hundreds of metres");
        CHECK(!way.accuracy());
        for (const char* const to : {"EPSG:32632", "EPSG:3857", "EPSG:3031", "EPSG:4979", "EPSG:4326+5773"}) {
            CHECK(between("EPSG:4326", to).warning().empty());
        }
        CHECK(between("EPSG:32632", "EPSG:32633").warning().empty());
        CHECK(between("EPSG:3067", "EPSG:3035").warning().empty());
    }

    TEST_CASE("grids that are optional may be missing") {
        const CoordinateTransform way = between(
            "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +wktext +units=m +type=crs", "EPSG:3857");
        std::vector<Point3> points{{-11169055.58, 2800000, 1}};
        CHECK(way.forward(points).empty());
        CHECK(std::abs(points[0].x + 11169055.58) < 1e-6);
        CHECK(std::abs(points[0].y - 2800000) < 1e-6);
        points[0] = {12, 55, 0};
        CHECK(between("+proj=longlat +ellps=GRS80 +nadgrids=@no_such_grid.gsb,@null +type=crs", "EPSG:4326")
                  .forward(points)
                  .empty());
    }

    TEST_CASE("a better operation that lacks its grid is named, with both accuracies") {
        // Grids of North America are in none of Debian's packages.
        const std::string warning = between("EPSG:4267", "EPSG:4326", within(-110, -109, 35, 36)).warning();
        CHECK(
            has(warning,
                "from EPSG:4267 (NAD27) to EPSG:4326 (WGS 84): taken is NAD27 to WGS 84 (6) (accuracy 7 m); "
                "the better NAD27 to WGS 84 (79) (accuracy 5 m) needs the grid us_noaa_conus.tif, which is "
                "not in "));
        CHECK(has(warning, "/share/proj"));
        CHECK(has(warning,
                  ": install PROJ's package of grids, run projsync --file us_noaa_conus.tif, or name "
                  "the grid's folder in PROJ_DATA"));
        CHECK(!has(warning, "\n"));
    }

    TEST_CASE("elevations that need a grid that is missing are refused, never left as they are") {
        const std::string message =
            message_of<InputError>([] { between("EPSG:4979", "EPSG:4326+3855", with_elevations()); });
        CHECK(has(message, "elevations cannot be transformed from EPSG:4979 (WGS 84) to "));
        CHECK(has(message,
                  "WGS 84 to EGM2008 height (1) (accuracy 1 m) needs the grid us_nga_egm08_25.tif, "
                  "which is not in "));
        CHECK(has(message, "/share/proj"));
        CHECK(has(message,
                  "; install PROJ's package of grids, run projsync --file us_nga_egm08_25.tif, or name "
                  "the grid's folder in PROJ_DATA, or give a geoid with --geoid FILE.pgm"));
        CHECK(!has(message, "\n"));
        // From one geoid to another, one of the two is missing.
        CHECK(has(
            message_of<InputError>([] { between("EPSG:4326+5773", "EPSG:4326+3855", with_elevations()); }),
            "needs the grid us_nga_egm08_25.tif"));
        // A file that nobody has.
        CHECK(has(message_of<InputError>([] {
                      between("+proj=longlat +datum=WGS84 +geoidgrids=no_such_geoid.gtx +vunits=m +type=crs",
                              "EPSG:4979", with_elevations());
                  }),
                  "needs the grid no_such_geoid.gtx, which is not in "));
        // Nor is anything known between these two.
        CHECK(has(
            message_of<InputError>([] { between("EPSG:5514+5705", "EPSG:4258+5621", with_elevations()); }),
            ": PROJ knows no way between their heights; give a geoid with --geoid FILE.pgm"));
        // Without elevations there is nothing to refuse.
        CHECK(between("EPSG:4979", "EPSG:4326+3855").warning().empty());
    }

    TEST_CASE("elevations of one datum change their unit, without any grid") {
        const CoordinateTransform way = between("EPSG:6318+5703", "EPSG:6339+6360", with_elevations());
        std::vector<Point3> points{{-122, 45, 1200}};
        CHECK(way.forward(points).empty());
        CHECK(std::abs(points[0].z - 3937) < 1e-9);
        CHECK(way.inverse(points).empty());
        CHECK(std::abs(points[0].z - 1200) < 1e-9);
        CHECK(way.warning().empty());
        // Other positions, the same heights.
        std::vector<Point3> same{{500000, 6700000, 123.456}};
        CHECK(between("EPSG:3067+3900", "EPSG:3035+3900", with_elevations()).forward(same).empty());
        CHECK(same[0].z == 123.456);
    }

    TEST_CASE("elevations are refused where a system does not say what they are measured from") {
        CHECK(has(message_of<InputError>([] { between("EPSG:4326", "EPSG:4326+5773", with_elevations()); }),
                  ": EPSG:4326 (WGS 84) does not say what z is measured from; name a system that does, for "
                  "example EPSG:32632+5773 for heights above the geoid EGM96"));
        CHECK(has(message_of<InputError>([] { between("EPSG:4979", "EPSG:32632", with_elevations()); }),
                  "EPSG:32632 (WGS 84 / UTM zone 32N) does not say"));
    }

    TEST_CASE("geocentric systems are refused with advice") {
        for (const bool has_elevations : {false, true}) {
            TransformOptions options;
            options.has_elevations = has_elevations;
            CHECK(
                message_of<InputError>([&] { between("EPSG:4978", "EPSG:4979", options); }) ==
                "CRS EPSG:4978 (WGS 84) is geocentric: X, Y, Z from the earth's centre, no positions with "
                "elevations; transform the data to longitudes, latitudes and heights first, for example with "
                "cs2cs to EPSG:4979");
        }
    }

    TEST_CASE("transform_points takes elevations along where both systems have them") {
        std::vector<Point3> points{{12.5, 55.5, 100}};
        const Crs ellipsoidal = Crs::parse("EPSG:4979");
        CHECK(io::transform_points(points, ellipsoidal, Crs::parse("EPSG:4326+5773")).empty());
        CHECK(std::abs(points[0].z - 63.9787) < 0.15);
        points[0] = {12.5, 55.5, 100};
        CHECK(io::transform_points(points, ellipsoidal, Crs::parse("EPSG:32632")).empty());
        CHECK(points[0].z == 100);
    }
}
