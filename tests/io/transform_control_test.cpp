// Control points and independent formulas for what PROJ does on our behalf.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <doctest/doctest.h>
#include <proj.h>

#include "tinwright/io/coordinate_transform.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using io::CoordinateTransform;
using io::Crs;
using io::TransformOptions;
using tinwright_tests::cases;
using tinwright_tests::Random;

namespace {

constexpr double kMetresPerDegree = 111320;

Point3 moved(const CoordinateTransform& way, Point3 point) {
    REQUIRE(way.forward(std::span(&point, 1)).empty());
    return point;
}

double between(Random& random, double least, double greatest) {
    return std::lerp(least, greatest, random.real());
}

/// Metres between two positions in degrees, near enough for small distances.
double degrees_apart(const Point3& a, const Point3& b) {
    const double narrowing = std::cos(a.y * std::numbers::pi / 180);
    const double x = std::remainder(a.x - b.x, 360.0) * narrowing;
    return std::hypot(x, a.y - b.y) * kMetresPerDegree;
}

struct Control {
    const char* from;
    const char* to;
    double longitude;
    double latitude;
    double x;
    double y;
    double tolerance;  // metres, or the unit of x
};

}  // namespace

TEST_SUITE("io/transform_control") {
    TEST_CASE("published control points of projections are met") {
        // From the test files of PROJ (folders test/gigs and test/gie): GIGS series 5100 of IOGP, EPSG
        // guidance note 7-2, and PROJ's own.
        const std::array controls{
            // 5110, Lambert azimuthal equal area
            Control{"EPSG:4258", "EPSG:3035", 5, 70, 4127824.65822, 5214090.649, 0.01},
            Control{"EPSG:4258", "EPSG:3035", 10, 52, 4321000, 3210000, 0.001},
            Control{"EPSG:4258", "EPSG:3035", 0, 50, 3606514.43, 3036305.967, 0.01},
            // 5109, Albers
            Control{"EPSG:4283", "EPSG:3577", 140, -40, 693250.21, -4395794.49, 0.01},
            Control{"EPSG:4283", "EPSG:3577", 170, -60, 2656914.716, -6784621.89, 0.01},
            // 5104, oblique stereographic
            Control{"EPSG:4289", "EPSG:28992", 5, 58, 132023.27, 1114054.87, 0.01},
            Control{"EPSG:4289", "EPSG:28992", 11, 53, 531469.2, 571538.84, 0.01},
            // 5108, Cassini-Soldner
            Control{"EPSG:4742", "EPSG:3377", 106, 10, 267186.017, 881108.902, 0.05},
            Control{"EPSG:4742", "EPSG:3377", 109, 5, 603116.703, 329668.599, 0.05},
            // 5111, Mercator, across the antimeridian
            Control{"EPSG:4211", "EPSG:3001", 100.0876483, 77.6534822, 2800000, 15000000, 0.05},
            Control{"EPSG:4211", "EPSG:3001", -71, -2, 23764105.84, 679490.65, 0.01},
            // 5113, transverse Mercator to the south-west: x points west, y south
            Control{"EPSG:4148", "EPSG:2049", 21.5, -25, -50475.46, 2766147.25, 0.01},
            // 5102 and 5103, Lambert conformal conic with one and two standard parallels; the first is
            // deprecated
            Control{"EPSG:4230", "EPSG:2192", 5, 58, 760722.92, 3457368.68, 0.03},
            Control{"EPSG:4313", "EPSG:31370", 5, 58, 187742.7, 969521.653, 0.03},
            Control{"EPSG:4313", "EPSG:31370", 11, 53, 595117.95, 430202.63, 0.03},
            // 5105, oblique Mercator
            Control{"EPSG:4237", "EPSG:23700", 16, 48.5, 424714.235, 355124.6, 0.05},
            Control{"EPSG:4237", "EPSG:23700", 22.3, 49.3, 886565.935, 444656.613, 0.05},
            // more_builtins.gie: UTM; Lambert conformal conic, Michigan, in US survey feet
            Control{"EPSG:4258", "EPSG:25832", 12, 55, 691875.63214, 6098907.82501, 1e-4},
            Control{"EPSG:4267", "EPSG:6201", -83 - 1.0 / 6, 43.75, 2308335.75, 160210.48, 0.01},
            // 4D-API_cs2cs-style.gie: Mercator on a sphere; Swiss oblique Mercator, datum shift included
            Control{"EPSG:4326", "EPSG:3857", -100.33333333, 24.38178694, -11169055.58, 2800000, 0.01},
            Control{"EPSG:4326", "EPSG:2056", 7.438632495, 46.951082877, 2600000, 1200000, 0.2},
            // EPSG guidance note 7-2, Krovak: x points south, y west
            Control{"EPSG:4156", "EPSG:5513", 16 + 50.0 / 60 + 59.179 / 3600, 50 + 12.0 / 60 + 32.442 / 3600,
                    1050538.643, 568990.997, 0.02}};
        for (const Control& control : controls) {
            CAPTURE(std::string(control.to));
            const CoordinateTransform way(Crs::parse(control.from), Crs::parse(control.to));
            const Point3 point = moved(way, {control.longitude, control.latitude, 7});
            CHECK(std::abs(point.x - control.x) <= control.tolerance);
            CHECK(std::abs(point.y - control.y) <= control.tolerance);
            CHECK(point.z == 7);
        }
    }

    TEST_CASE("UTM and UPS agree with GeographicLib to 20 nm, beyond the zones' borders too") {
        Random random(81);
        double worst = 0;
        for (int zone = 1; zone <= 60; zone += 7) {
            for (const bool is_north : {true, false}) {
                const CoordinateTransform way(
                    Crs::parse("EPSG:4326"),
                    Crs::parse("EPSG:" + std::to_string((is_north ? 32600 : 32700) + zone)));
                for (int i = 0; i < cases(200); ++i) {
                    const double latitude = is_north ? between(random, 0, 84) : between(random, -80, 0);
                    const double longitude =
                        std::remainder(6 * zone - 183 + between(random, -3.5, 3.5), 360.0);
                    int found = 0;
                    bool north = false;
                    double x = 0;
                    double y = 0;
                    GeographicLib::UTMUPS::Forward(latitude, longitude, found, north, x, y, zone);
                    const Point3 point = moved(way, {longitude, latitude, 0});
                    worst = std::max({worst, std::abs(point.x - x), std::abs(point.y - y)});
                }
            }
        }
        // Farther than a zone is ever used, by the series alone.
        const CoordinateTransform far(Crs::parse("EPSG:4326"), Crs::parse("EPSG:32631"));
        for (int i = 0; i < cases(500); ++i) {
            const double latitude = between(random, -84, 84);
            const double longitude = 3 + between(random, -30, 30);
            double x = 0;
            double y = 0;
            GeographicLib::TransverseMercator::UTM().Forward(3, latitude, longitude, x, y);
            const Point3 point = moved(far, {longitude, latitude, 0});
            worst = std::max({worst, std::abs(point.x - 500000 - x), std::abs(point.y - y)});
        }
        CHECK(worst < 2e-8);
        worst = 0;
        for (const bool is_north : {true, false}) {
            const CoordinateTransform way(Crs::parse("EPSG:4326"),
                                          Crs::parse(is_north ? "EPSG:32661" : "EPSG:32761"));
            for (int i = 0; i < cases(500); ++i) {
                const double latitude = (is_north ? 1 : -1) * between(random, 83.6, 90);
                const double longitude = between(random, -180, 180);
                int zone = 0;
                bool north = false;
                double x = 0;
                double y = 0;
                GeographicLib::UTMUPS::Forward(latitude, longitude, zone, north, x, y,
                                               GeographicLib::UTMUPS::UPS);
                const Point3 point = moved(way, {longitude, latitude, 0});
                worst = std::max({worst, std::abs(point.x - x), std::abs(point.y - y)});
            }
        }
        CHECK(worst < 2e-8);
    }

    TEST_CASE("polar stereographic with a true parallel agrees with GeographicLib to 20 nm") {
        struct Polar {
            const char* code;
            double true_latitude;
            double meridian;
        };
        Random random(82);
        double worst = 0;
        for (const Polar& polar : {Polar{"EPSG:3031", -71, 0}, Polar{"EPSG:3413", 70, -45}}) {
            GeographicLib::PolarStereographic formula(GeographicLib::Constants::WGS84_a(),
                                                      GeographicLib::Constants::WGS84_f(), 1);
            formula.SetScale(std::abs(polar.true_latitude), 1);
            const CoordinateTransform way(Crs::parse("EPSG:4326"), Crs::parse(polar.code));
            for (int i = 0; i < cases(500); ++i) {
                const double latitude = std::copysign(between(random, 60, 90), polar.true_latitude);
                const double longitude = between(random, -180, 180);
                double x = 0;
                double y = 0;
                formula.Forward(latitude > 0, latitude, longitude - polar.meridian, x, y);
                const Point3 point = moved(way, {longitude, latitude, 0});
                worst = std::max({worst, std::abs(point.x - x), std::abs(point.y - y)});
            }
        }
        CHECK(worst < 2e-8);
    }

    TEST_CASE(
        "transverse Mercator on other ellipsoids, north first in the register, agrees with GeographicLib") {
        struct Belt {
            const char* geographic;
            const char* code;
            double a, inverse_f, scale, meridian, false_easting, false_northing, south, north;
        };
        Random random(83);
        double worst = 0;
        for (const Belt& belt :
             {Belt{"EPSG:4167", "EPSG:2193", 6378137, 298.257222101, 0.9996, 173, 1600000, 10000000, -48,
                   -34},
              Belt{"EPSG:4314", "EPSG:31467", 6377397.155, 299.1528128, 1, 9, 3500000, 0, 47, 55},
              Belt{"EPSG:4123", "EPSG:2393", 6378388, 297, 1, 27, 3500000, 0, 59, 71}}) {
            const GeographicLib::TransverseMercator formula(belt.a, 1 / belt.inverse_f, belt.scale);
            const CoordinateTransform way(Crs::parse(belt.geographic), Crs::parse(belt.code));
            for (int i = 0; i < cases(300); ++i) {
                const double latitude = between(random, belt.south, belt.north);
                const double longitude = belt.meridian + between(random, -6, 6);
                double x = 0;
                double y = 0;
                formula.Forward(belt.meridian, latitude, longitude, x, y);
                const Point3 point = moved(way, {longitude, latitude, 0});
                worst = std::max({worst, std::abs(point.x - belt.false_easting - x),
                                  std::abs(point.y - belt.false_northing - y)});
            }
        }
        CHECK(worst < 2e-8);
    }

    TEST_CASE("Alice Springs goes from GDA94 to GDA2020 as published") {
        // GDA2020 technical manual 1.0, in PROJ's test/gie/GDA.gie, to 2 mm.
        TransformOptions options;
        options.has_elevations = true;
        const CoordinateTransform way(Crs::parse("EPSG:4939"), Crs::parse("EPSG:7843"), options);
        const Point3 point = moved(way, {133.88551329, -23.67012389, 603.3466});
        CHECK(degrees_apart(point, {133.8855216, -23.67011014, 0}) < 0.002);
        CHECK(std::abs(point.z - 603.2489) < 0.002);
        CHECK(way.warning().empty());
        CHECK(way.accuracy() == 0.01);
    }

    TEST_CASE("Alice Springs goes from ITRF2014 at epoch 2018 to GDA2020 as published") {
        // The same manual, geocentric X, Y, Z, to 40 um.
        const GeographicLib::Geocentric earth(6378137, 1 / 298.257222101);
        Point3 point;
        earth.Reverse(-4052052.6588, 4212835.9938, -2545104.6946, point.y, point.x, point.z);
        const Point3 before = point;
        TransformOptions options;
        options.has_elevations = true;
        options.epoch = 2018;
        const CoordinateTransform way(Crs::parse("EPSG:7912"), Crs::parse("EPSG:7843"), options);
        point = moved(way, point);
        double x = 0;
        double y = 0;
        double z = 0;
        earth.Forward(point.y, point.x, point.z, x, y, z);
        CHECK(std::abs(x + 4052052.7373) < 1e-4);
        CHECK(std::abs(y - 4212835.9835) < 1e-4);
        CHECK(std::abs(z + 2545104.5867) < 1e-4);
        CHECK(way.warning().empty());
        // Without an epoch it is that of the shift's definition, and nothing moves.
        options.epoch.reset();
        const CoordinateTransform still(Crs::parse("EPSG:7912"), Crs::parse("EPSG:7843"), options);
        const Point3 same = moved(still, before);
        CHECK(degrees_apart(same, before) < 1e-6);
        CHECK(still.warning() ==
              "from EPSG:7912 (ITRF2014) to EPSG:7843 (GDA2020): the shift changes with time and is taken at "
              "epoch 2020; say with --epoch when the coordinates were measured");
    }

    TEST_CASE("the shift from NTF to RGF93 is that of IGN's grid") {
        // 4D-API_cs2cs-style.gie, to 1 mm.
        const CoordinateTransform way(Crs::parse("EPSG:4275"), Crs::parse("EPSG:4171"));
        const Point3 point = moved(way, {2.250704350387, 46.500051597273, 0});
        CHECK(degrees_apart(point, {2.25, 46.5, 0}) < 0.001);
        CHECK(way.accuracy() == 1.0);
        // IGN's constant shift of the earth's centre, -168, -60, 320, is stated to be good to some metres.
        const GeographicLib::Geocentric clarke(6378249.2, (6378249.2 - 6356515) / 6378249.2);
        const GeographicLib::Geocentric grs80(6378137, 1 / 298.257222101);
        Random random(84);
        double worst = 0;
        for (int i = 0; i < cases(300); ++i) {
            const Point3 from{between(random, -1, 7), between(random, 43.5, 49.5), 0};
            double x = 0;
            double y = 0;
            double z = 0;
            clarke.Forward(from.y, from.x, 0, x, y, z);
            Point3 expected;
            grs80.Reverse(x - 168, y - 60, z + 320, expected.y, expected.x, expected.z);
            worst = std::max(worst, degrees_apart(moved(way, from), expected));
        }
        CHECK(worst < 8);
    }

    TEST_CASE("heights above the geoid EGM96 are as published") {
        TransformOptions options;
        options.has_elevations = true;
        const CoordinateTransform way(Crs::parse("EPSG:4979"), Crs::parse("EPSG:4326+5773"), options);
        // more_builtins.gie, at nodes of the grid of 15', one of them on the antimeridian.
        CHECK(std::abs(moved(way, {12.5, 55.5, 100}).z - (100 - 36.021305084228516)) < 1e-9);
        CHECK(std::abs(moved(way, {180, 0, 0}).z + 21.1533) < 1e-3);
        CHECK(std::abs(moved(way, {-180, 0, 0}).z + 21.1533) < 1e-3);
        // GeographicLib's manual: 28.7068 at Timbuktu, by a cubic in a grid of 5'. Bilinear interpolation in
        // one of 15' has a root mean square error of 40 mm.
        CHECK(std::abs(moved(way, {-(3 + 34.0 / 3600), 16 + 46.0 / 60 + 33.0 / 3600, 0}).z + 28.7068) < 0.04);
        CHECK(way.warning().empty());
    }

    TEST_CASE("there and back is the same within a tenth of a millimetre; by equal areas, two") {
        // PROJ goes back from the authalic latitude by a series of three terms, good to 1.6 mm.
        const std::array equal_area{3035, 6933, 8857};
        const std::array codes{2056,  2065,  2180,  2193,  2263, 2272,  2393,  2443, 2952,  3006,  3031,
                               3035,  3067,  3112,  3375,  3395, 3413,  3577,  3832, 3857,  3976,  4087,
                               5070,  5513,  5514,  5880,  6201, 6933,  7405,  8857, 23700, 27200, 28992,
                               29100, 31370, 31467, 32661, 2154, 27572, 32761, 54009};
        Random random(85);
        PJ_CONTEXT* const context = proj_context_create();
        for (const int code : codes) {
            CAPTURE(code);
            const Crs plane = Crs::parse((code == 54009 ? "ESRI:" : "EPSG:") + std::to_string(code));
            PJ* const system = proj_create(context, plane.wkt().c_str());
            double west = 0;
            double south = 0;
            double east = 0;
            double north = 0;
            REQUIRE(proj_get_area_of_use(context, system, &west, &south, &east, &north, nullptr) != 0);
            proj_destroy(system);
            east = east < west ? east + 360 : east;
            const CoordinateTransform way(plane.geographic(), plane);
            CHECK(way.warning().empty());
            std::vector<Point3> points(static_cast<std::size_t>(cases(500)));
            for (Point3& point : points) {
                point = {std::remainder(between(random, west, east), 360.0),
                         between(random, std::max(south, -89.9), std::min(north, 89.9)), random.real()};
            }
            const std::vector<Point3> before = points;
            REQUIRE(way.forward(points).empty());
            REQUIRE(way.inverse(points).empty());
            double worst = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                worst = std::max(worst, degrees_apart(points[i], before[i]));
                CHECK(points[i].z == before[i].z);
            }
            CHECK(worst <
                  (std::find(equal_area.begin(), equal_area.end(), code) == equal_area.end() ? 1e-4 : 2e-3));
        }
        proj_context_destroy(context);
    }
}
