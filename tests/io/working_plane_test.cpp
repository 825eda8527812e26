#include "tinwright/io/working_plane.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cpl_vsi.h>
#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "projecting.hpp"
#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"

using tinwright::InputError;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::UsageError;
using tinwright::io::check_distortion;
using tinwright::io::choose_working_plane;
using tinwright::io::Crs;
using tinwright::io::ExtentGatherer;
using tinwright::io::find_scale_range;
using tinwright::io::GeographicExtent;
using tinwright::io::parse_plane_request;
using tinwright::io::PlaneRequest;
using tinwright::io::ScaleRange;
using tinwright::io::WorkingPlane;
using tinwright_tests::message_of;
using tinwright_tests::Projecting;
using tinwright_tests::Random;
using Origin = WorkingPlane::Origin;
using Rule = PlaneRequest::Rule;

namespace {

GeographicExtent box(double west, double east, double south, double north) {
    return {west, east, south, north, false, false};
}

GeographicExtent cap(double south, double north) { return {-180, 180, south, north, false, true}; }

PlaneRequest request(Rule rule, double max_distortion = 0.001) {
    PlaneRequest request;
    request.rule = rule;
    request.max_distortion = max_distortion;
    return request;
}

WorkingPlane choose(const GeographicExtent& extent, Rule rule = Rule::Auto, double max_distortion = 0.001,
                    const std::string& source = "EPSG:4326") {
    return choose_working_plane(Crs::parse(source), extent, request(rule, max_distortion));
}

/// As the rules have been drawn: Norway's 32V, Svalbard's 31X to 37X, whole zones elsewhere.
int drawn_zone(double longitude, double latitude) {
    if (latitude >= 84 || latitude < -80) {
        return 0;
    }
    if (latitude >= 72 && longitude >= 0 && longitude < 42) {
        return longitude < 9 ? 31 : longitude < 21 ? 33 : longitude < 33 ? 35 : 37;
    }
    if (latitude >= 56 && latitude < 64 && longitude >= 3 && longitude < 12) {
        return 32;
    }
    return static_cast<int>(std::floor((longitude + 180) / 6)) + 1;
}

std::string utm_code(int zone, bool is_north) {
    if (zone == 0) {
        return is_north ? "EPSG:5041" : "EPSG:5042";
    }
    return "EPSG:" + std::to_string((is_north ? 32600 : 32700) + zone);
}

/// Whether short lines at random places of the extent are as much longer or shorter in the plane as `scale`
/// says: by geodesics, without a derivative.
void check_by_geodesics(const Crs& plane, double metres, const GeographicExtent& extent,
                        const ScaleRange& scale, Random& random) {
    const OGRSpatialReference& system = *plane.gdal();
    const double inverse = system.GetInvFlattening();
    const GeographicLib::Geodesic geodesic(system.GetSemiMajor(), inverse == 0 ? 0 : 1 / inverse);
    Projecting project(plane);
    const double slack = scale.uncertainty() + 1e-7;
    for (int i = 0; i < 40; ++i) {
        const double longitude = extent.west + (extent.east - extent.west) * random.real();
        const double latitude = extent.south + (extent.north - extent.south) * random.real();
        const double azimuth = 360 * random.real();
        double far_latitude = 0;
        double far_longitude = 0;
        const double length = 100;
        geodesic.Direct(latitude, longitude, azimuth, length / 2, far_latitude, far_longitude);
        const Point2 b = project(far_longitude, far_latitude);
        geodesic.Direct(latitude, longitude, azimuth, -length / 2, far_latitude, far_longitude);
        const Point2 a = project(far_longitude, far_latitude);
        const double ratio = std::hypot(b.x - a.x, b.y - a.y) * metres / length;
        CAPTURE(longitude);
        CAPTURE(latitude);
        CHECK(ratio >= scale.least - slack);
        CHECK(ratio <= scale.greatest + slack);
    }
}

/// A random extent with sides of so many degrees at most.
GeographicExtent random_box(Random& random, double width, double height) {
    const double west = std::floor(random.real() * 3600) / 10 - 180;
    const double south = -88 + (176 - height) * random.real();
    return box(west, west + width * random.real(), south, south + height * random.real());
}

}  // namespace

TEST_SUITE("io/working_plane") {
    TEST_CASE("a request is a rule or a projected system") {
        CHECK(parse_plane_request("auto").rule == Rule::Auto);
        CHECK(parse_plane_request("UTM").rule == Rule::Utm);
        CHECK(parse_plane_request("local").rule == Rule::Local);
        CHECK_FALSE(parse_plane_request("auto").crs.is_known());
        CHECK(parse_plane_request("auto").max_distortion == 0.001);
        const PlaneRequest given = parse_plane_request("EPSG:3067");
        CHECK(given.rule == Rule::Given);
        CHECK(given.crs.code() == "EPSG:3067");
        CHECK(parse_plane_request("EPSG:3067+3900").rule == Rule::Given);
    }

    TEST_CASE("a request that is no plane is refused with what is one") {
        const auto message = [](const std::string& text) {
            return message_of<UsageError>([&] { parse_plane_request(text); });
        };
        const std::string advice =
            "; give a projected system such as EPSG:32632, or \"auto\", \"utm\" or \"local\"";
        CHECK(message("utm32") == "--working-crs \"utm32\": not understood" + advice);
        CHECK(message("") == "--working-crs \"\": not understood" + advice);
        CHECK(message("EPSG:4326") ==
              "--working-crs \"EPSG:4326\": EPSG:4326 (WGS 84) is in degrees, which are no plane" + advice);
        CHECK(message("EPSG:4326+5773").find("is in degrees, which are no plane") != std::string::npos);
        CHECK(message("EPSG:4978") ==
              "--working-crs \"EPSG:4978\": EPSG:4978 (WGS 84) is geocentric, which is no plane" + advice);
        CHECK(message("EPSG:5773") ==
              "--working-crs \"EPSG:5773\": EPSG:5773 (EGM96 height) is for elevations alone" + advice);
    }

    TEST_CASE("zones are those drawn, at their borders and at random places") {
        std::vector<Point2> places;
        for (int zone = 1; zone <= 60; zone += 7) {
            const double west = 6 * zone - 186;
            places.insert(places.end(), {{west, 10}, {west + 1e-9, -10}, {west + 3, 0}});
            places.push_back({zone == 1 ? 180 - 1e-9 : west - 1e-9, -1});
        }
        for (const double longitude : {2.999, 3.0, 6.0, 11.999, 12.0}) {  // Norway
            places.insert(places.end(),
                          {{longitude, 55.999}, {longitude, 56}, {longitude, 63.999}, {longitude, 64}});
        }
        for (const double longitude : {-0.001, 0.0, 8.999, 9.0, 20.999, 21.0, 32.999, 33.0, 41.999, 42.0}) {
            places.insert(places.end(),
                          {{longitude, 71.999}, {longitude, 72}, {longitude, 83.999}, {longitude, 84}});
        }
        for (const double longitude : {-180.0, 179.999, 0.0, 45.0}) {
            places.insert(places.end(),
                          {{longitude, -80}, {longitude, -80.001}, {longitude, 90}, {longitude, -90}});
        }
        Random random(8);
        for (int i = 0; i < tinwright_tests::cases(40); ++i) {
            places.push_back({360 * random.real() - 180, 180 * random.real() - 90});
        }
        for (const Point2& place : places) {
            CAPTURE(place.x);
            CAPTURE(place.y);
            const int zone = drawn_zone(place.x, place.y);
            REQUIRE(GeographicLib::UTMUPS::StandardZone(place.y, place.x) == zone);
            const WorkingPlane plane = choose(box(place.x, place.x, place.y, place.y), Rule::Utm, 0.01);
            CHECK(plane.crs.code() == utm_code(zone, place.y >= 0));
            CHECK(plane.origin == Origin::Utm);
        }
    }

    TEST_CASE("a zone is on the sources' own datum and has its code where there is one") {
        const GeographicExtent extent = box(10, 11, 50, 51);
        CHECK(choose(extent, Rule::Auto, 0.001, "EPSG:4258").crs.code() == "EPSG:25832");
        CHECK(choose(extent, Rule::Auto, 0.001, "EPSG:4230").crs.code() == "EPSG:23032");
        CHECK(choose(box(-111, -110, 40, 41), Rule::Auto, 0.001, "EPSG:4269").crs.code() == "EPSG:26912");
        CHECK(choose(box(147, 148, -35, -34), Rule::Auto, 0.001, "EPSG:4283").crs.code() == "EPSG:28355");
        CHECK(choose(box(147, 148, -35, -34), Rule::Auto, 0.001, "EPSG:7844").crs.code() == "EPSG:7855");
        // ETRS89 ends at Europe.
        const WorkingPlane far = choose(box(-111, -110, 40, 41), Rule::Auto, 0.001, "EPSG:4258");
        CHECK(far.crs.code().empty());
        CHECK(far.crs.name() == "ETRS89 / UTM zone 12N");
        CHECK(far.crs.unit() == "metre");
        // A datum of nobody's.
        const WorkingPlane own =
            choose(extent, Rule::Auto, 0.001, "+proj=longlat +a=6378000 +rf=300 +type=crs");
        CHECK(own.crs.code().empty());
        CHECK(own.crs.gdal()->GetSemiMajor() == 6378000);
        CHECK(own.crs.gdal()->GetInvFlattening() == doctest::Approx(300));
    }

    TEST_CASE("longitudes may count from Paris, in grades") {
        // The zone's meridian is 3 degrees east of Greenwich; longitudes here are from Paris.
        const WorkingPlane plane = choose(box(0, 1, 45, 46), Rule::Auto, 0.001, "EPSG:4807");
        CHECK(plane.crs.name() == "NTF (Paris) / UTM zone 31N");
        const double paris = 2.5969213 * 0.9;
        const Point2 axis = Projecting(plane.crs)(3 - paris, 45.5);
        CHECK(axis.x == doctest::Approx(500000).epsilon(1e-9));
        const Point2 greenwich =
            Projecting(Crs::parse("+proj=utm +zone=31 +a=6378249.2 +b=6356515"))(3.7, 45.5);
        const Point2 here = Projecting(plane.crs)(3.7 - paris, 45.5);
        CHECK(std::hypot(here.x - greenwich.x, here.y - greenwich.y) < 0.01);
    }

    TEST_CASE("UTM's scale is GeographicLib's") {
        for (int seed = 0; seed < tinwright_tests::cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            GeographicExtent extent = random_box(random, 6, 6);
            extent.south = std::clamp(extent.south, -79.0, 77.0);
            extent.north = std::max(extent.south, std::min(extent.north, 83.0));
            const WorkingPlane plane = choose(extent, Rule::Utm, 0.1);
            const int zone =
                GeographicLib::UTMUPS::StandardZone(extent.center_latitude(), extent.center_longitude());
            double least = 10;
            double greatest = 0;
            for (int i = 0; i < 3000; ++i) {
                const bool is_corner = i < 4;
                const double u = is_corner ? i % 2 : random.real();
                const double v = is_corner ? static_cast<double>(i >= 2) : random.real();
                double x = 0;
                double y = 0;
                double gamma = 0;
                double k = 0;
                GeographicLib::TransverseMercator::UTM().Forward(
                    6 * zone - 183, extent.south + (extent.north - extent.south) * v,
                    extent.west + (extent.east - extent.west) * u, x, y, gamma, k);
                least = std::min(least, k);
                greatest = std::max(greatest, k);
            }
            const double uncertainty = plane.scale.uncertainty();
            CHECK(plane.scale.least <= least + uncertainty);
            CHECK(plane.scale.greatest >= greatest - uncertainty);
            CHECK(plane.scale.least >=
                  least - (greatest - least) / 30 - 1e-8);  // 3000 random places are near
            CHECK(plane.scale.greatest <= greatest + (greatest - least) / 30 + 1e-8);
        }
    }

    TEST_CASE("UPS has GeographicLib's scale, which grows from the pole") {
        for (const bool is_north : {true, false}) {
            const GeographicExtent extent = is_north ? cap(80, 90) : cap(-90, -80);
            const WorkingPlane plane = choose(extent, Rule::Utm, 0.01);
            CHECK(plane.crs.code() == (is_north ? "EPSG:5041" : "EPSG:5042"));
            double x = 0;
            double y = 0;
            double gamma = 0;
            double k = 0;
            GeographicLib::PolarStereographic::UPS().Forward(is_north, is_north ? 80 : -80, 33, x, y, gamma,
                                                             k);
            CHECK(std::abs(plane.scale.greatest - k) < 1e-8);
            CHECK(std::abs(plane.scale.least - 0.994) < 2e-8);
            const Point2 place = Projecting(plane.crs)(33, is_north ? 80 : -80);
            CHECK(place.x == doctest::Approx(x + 2e6).epsilon(1e-12));
            CHECK(place.y == doctest::Approx(y + 2e6).epsilon(1e-12));
        }
    }

    TEST_CASE("poles get a plane in one piece") {
        const WorkingPlane north = choose(cap(85, 90));
        CHECK(north.origin == Origin::Local);
        CHECK(north.crs.name() == "tinwright local stereographic at 0.00 E 90.00 N");
        CHECK(north.scale.distortion() < 0.001);
        const WorkingPlane south = choose(cap(-90, -85));
        CHECK(south.crs.name() == "tinwright local stereographic at 0.00 E 90.00 S");
        CHECK(south.scale.least == doctest::Approx(north.scale.least).epsilon(1e-9));
        CHECK(south.scale.greatest == doctest::Approx(north.scale.greatest).epsilon(1e-9));
        // The pole is the origin; meridians 90 degrees apart are at right angles.
        Projecting project(north.crs);
        const Point2 pole = project(0, 90);
        CHECK(std::hypot(pole.x, pole.y) < 1e-6);
        const Point2 a = project(0, 89);
        const Point2 b = project(90, 89);
        CHECK(std::abs(a.x * b.x + a.y * b.y) < 1);
        CHECK(b.x > 0);
        CHECK(a.y < 0);
        Random random(90);
        check_by_geodesics(north.crs, 1, north.extent, north.scale, random);
        check_by_geodesics(south.crs, 1, south.extent, south.scale, random);
    }

    TEST_CASE("elevations in a source's system do not matter to the plane") {
        for (const char* const source : {"EPSG:4979", "EPSG:4326+5773"}) {
            CAPTURE(source);
            CHECK(choose(box(10, 11, 45, 46), Rule::Auto, 0.001, source).crs.code() == "EPSG:32632");
            CHECK(choose(box(10, 11, 45, 46), Rule::Local, 0.001, source)
                      .crs.is_same(choose(box(10, 11, 45, 46), Rule::Local).crs));
        }
    }

    TEST_CASE("other bodies have local planes") {  // PROJ has no UTM on a sphere
        const WorkingPlane moon = choose(box(4, 5, 50, 51), Rule::Auto, 0.001, "IAU_2015:30100");
        CHECK(moon.origin == Origin::Local);
        Random random(1);
        check_by_geodesics(moon.crs, 1, moon.extent, moon.scale, random);
        CHECK(message_of<InputError>([] {
                  choose(box(4, 34, 0, 30), Rule::Auto, 0.001, "IAU_2015:30100");
              }).find("(910 by 910 km): UTM zone 34N cannot hold it, ") != std::string::npos);
    }

    TEST_CASE("data across the antimeridian get the plane of data elsewhere") {
        ExtentGatherer here;
        ExtentGatherer across;
        ExtentGatherer eastward;
        Random random(5);
        for (int i = 0; i < 100; ++i) {
            const double u = std::floor(random.real() * 1024) / 1024;
            const double v = std::floor(random.real() * 1024) / 1024;
            const double longitude = 179.5 + u;
            const Point3 point{longitude >= 180 ? longitude - 360 : longitude, -16 - v, 0};
            across.add({&point, 1});
            const Point3 same{longitude, -16 - v, 0};
            eastward.add({&same, 1});
            const Point3 shifted{179.5 + u - 30, -16 - v, 0};
            here.add({&shifted, 1});
        }
        for (const Rule rule : {Rule::Utm, Rule::Local}) {
            const WorkingPlane plane = choose(across.extent(), rule, 0.01);
            CHECK(plane.crs.wkt() == choose(eastward.extent(), rule, 0.01).crs.wkt());
            CHECK(plane.extent == eastward.extent());
            const WorkingPlane other = choose(here.extent(), rule, 0.01);
            CHECK(plane.scale.least == doctest::Approx(other.scale.least).epsilon(1e-9));
            CHECK(plane.scale.greatest == doctest::Approx(other.scale.greatest).epsilon(1e-9));
            // In one piece: a degree is as long as elsewhere.
            Projecting project(plane.crs);
            const Point2 west = project(179.5, -16.5);
            const Point2 east = project(-179.5, -16.5);
            CHECK(std::hypot(east.x - west.x, east.y - west.y) < 107000);
        }
    }

    TEST_CASE("UTM is taken as long as it is within the limit, then a plane of the data's own") {
        CHECK(choose(box(9, 12, 45, 46)).origin == Origin::Utm);
        const WorkingPlane local = choose(box(9, 14, 0, 1));
        CHECK(local.origin == Origin::Local);
        CHECK(choose(box(9, 14, 0, 1), Rule::Auto, 0.01).origin == Origin::Utm);
        CHECK(choose(box(9, 12, 45, 46), Rule::Local).origin == Origin::Local);
        CHECK(choose(box(9, 12, 45, 46), Rule::Auto, 1e-4).origin == Origin::Local);
        CHECK(local.source_crs.code() == "EPSG:4326");
        CHECK(local.is_source_geographic());
        CHECK(local.extent == box(9, 14, 0, 1));
    }

    TEST_CASE("tall extents get a transverse Mercator, round and wide ones a stereographic") {
        const auto name = [](const GeographicExtent& extent) {
            return choose(extent, Rule::Local, 0.1).crs.name();
        };
        CHECK(name(box(30.1, 30.3, -10, 12)) == "tinwright local transverse Mercator at 30.20 E 1.00 N");
        CHECK(name(box(-75, -69, -55, -18)).find("transverse Mercator") != std::string::npos);  // Chile
        CHECK(name(box(10, 16, 45, 49)).find("stereographic") != std::string::npos);
        CHECK(name(box(30, 50, 40, 41)) == "tinwright local stereographic at 40.00 E 40.50 N");
    }

    TEST_CASE("of two local planes that of less distortion is taken, and errors are balanced") {
        for (int seed = 0; seed < tinwright_tests::cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const GeographicExtent extent = random_box(random, 8, 12);
            const WorkingPlane plane = choose(extent, Rule::Local, 0.1);
            const double over = plane.scale.greatest - 1;
            const double under = 1 - plane.scale.least;
            CHECK(std::abs(over - under) < 2e-6);  // the scale is rounded to millionths
            // Neither kind is better at this centre, whatever its scale there.
            const double longitude = std::round(extent.center_longitude() * 100) / 100;
            const double latitude = std::round(extent.center_latitude() * 100) / 100;
            for (const std::string kind : {"tmerc", "sterea"}) {
                const Crs other = Crs::parse("+proj=" + kind + " +lat_0=" + std::to_string(latitude) +
                                             " +lon_0=" + std::to_string(longitude) + " +datum=WGS84");
                const auto scale = find_scale_range(other, extent);
                REQUIRE(scale);
                const double k = 2 / (scale->least + scale->greatest);
                CHECK(plane.scale.distortion() <= k * scale->greatest - 1 + 2e-6);
            }
        }
    }

    TEST_CASE("lengths all over the extent are within the scale found") {
        for (int seed = 0; seed < tinwright_tests::cases(8); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const GeographicExtent extent = random_box(random, 6, 10);
            const WorkingPlane plane = choose(extent, seed % 2 == 0 ? Rule::Utm : Rule::Local, 1,
                                              seed % 3 == 0 ? "EPSG:4269" : "EPSG:4326");
            check_by_geodesics(plane.crs, 1, extent, plane.scale, random);
        }
    }

    TEST_CASE("the scale of systems of any kind, unit and order of axes is found") {
        struct Case {
            const char* code;
            double metres;
            GeographicExtent extent;
        };
        const std::vector<Case> cases{
            {"EPSG:3035", 1, box(5, 20, 42, 60)},                   // equal area, northing first
            {"EPSG:2222", 0.3048, box(-111, -109.5, 32, 35)},       // foot
            {"EPSG:2964", 1200.0 / 3937, box(-160, -140, 55, 70)},  // Albers, survey foot
            {"EPSG:5514", 1, box(13, 18, 48.6, 51)},                // oblique
            {"EPSG:2053", 1, box(28, 30, -28, -26)},                // westing, southing
            {"EPSG:27572", 1, box(-2, 3, 44, 48)},                  // from Paris, grades
            {"EPSG:2193", 1, box(167, 178.5, -47, -35)},            // northing first
            {"EPSG:32661", 1, cap(75, 90)},
            {"EPSG:3857", 1, box(5, 15, 45, 55)},  // a sphere's formula, an ellipsoid's coordinates
            {"EPSG:3832", 1, box(150, 210, -20, 20)},
        };
        for (const Case& c : cases) {
            CAPTURE(c.code);
            Random random(1);
            const Crs crs = Crs::parse(c.code);
            const auto scale = find_scale_range(crs, c.extent);
            REQUIRE(scale);
            check_by_geodesics(crs, c.metres, c.extent, *scale, random);
        }
        // Web Mercator at 60 N: along the parallel 1.995, along the meridian 1.998.
        const auto web = find_scale_range(Crs::parse("EPSG:3857"), box(10, 10, 60, 60));
        REQUIRE(web);
        CHECK(web->least == doctest::Approx(1.9949728971).epsilon(1e-8));
        CHECK(web->greatest == doctest::Approx(1.9983341756).epsilon(1e-8));
    }

    TEST_CASE("a scale that cannot be told is not told") {
        CHECK_FALSE(find_scale_range(Crs(), box(0, 1, 0, 1)));
        CHECK_FALSE(find_scale_range(Crs::parse("EPSG:32632"), GeographicExtent()));
        CHECK_FALSE(find_scale_range(Crs::parse("EPSG:4326"), box(0, 1, 0, 1)));
        CHECK_FALSE(find_scale_range(Crs::parse("LOCAL_CS[\"site\",UNIT[\"metre\",1]]"), box(0, 1, 0, 1)));
        CHECK_FALSE(find_scale_range(Crs::parse("EPSG:32632"), cap(-90, 90)));
        CHECK(ScaleRange().distortion() == 0);
    }

    TEST_CASE("too large an extent is refused with figures and what would do") {
        const GeographicExtent extent = box(-115, -105.3, 20, 30);
        const std::string message = message_of<InputError>([&] { choose(extent); });
        CHECK(message ==
              "no plane keeps lengths right to 0.1 % (--max-distortion) over the data's extent, 115.0 W to "
              "105.3 W, 20.0 N to 30.0 N (1015 by 1113 km): UTM zone 12N is off by up to 0.4 %, a local "
              "transverse "
              "Mercator is off by up to 0.16 %, a local stereographic is off by up to 0.17 %; give "
              "--max-distortion 0.16%, cut the data with where=, or name a projected system made for the "
              "area, "
              "such as a country's Lambert or Albers, with --working-crs");
        CHECK(choose(extent, Rule::Auto, 0.0016).origin == Origin::Local);

        const std::string pole = message_of<InputError>([] { choose(cap(89, 90), Rule::Utm); });
        CHECK(
            pole.find("round the north pole, 89.0 N to 90.0 N (up to 111 km from it): UPS North is off by up "
                      "to 0.6 %; give --max-distortion 0.6") != std::string::npos);
        CHECK(pole.find("choose --working-crs local, ") != std::string::npos);

        const std::string earth = message_of<InputError>([] { choose(cap(-90, 90)); });
        CHECK(earth.find("cannot hold it") != std::string::npos);
        CHECK(earth.find('\n') == std::string::npos);
    }

    TEST_CASE("without longitudes and latitudes no plane is chosen") {
        CHECK(message_of<InputError>([] { choose(GeographicExtent()); }) ==
              "no plane can be chosen without longitudes and latitudes to choose it for; name one with "
              "--working-crs");
    }

    TEST_CASE("the limit told of in a refusal is kept") {
        for (int seed = 0; seed < tinwright_tests::cases(5); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const GeographicExtent extent = random_box(random, 60, 60);
            const std::string message = message_of<InputError>([&] { choose(extent, Rule::Local, 1e-9); });
            const std::string word = "give --max-distortion ";
            const std::size_t at = message.find(word);
            REQUIRE(at != std::string::npos);
            const double limit = std::stod(message.substr(at + word.size())) / 100;
            const WorkingPlane plane = choose(extent, Rule::Local, limit);
            CHECK(plane.scale.distortion() > 0.9 * limit);
        }
    }

    TEST_CASE("files hold a plane of the data's own") {
        tinwright::io::register_drivers();
        const std::vector<std::pair<std::string, GeographicExtent>> cases{
            {"EPSG:4326", box(30.1, 30.3, -10, 12)},
            {"EPSG:4258", box(9, 15.3, 45, 50)},
            {"EPSG:4326", cap(88, 90)},
            {"EPSG:4326", cap(-90, -88)},
            {"EPSG:4807", box(0, 3, 45, 48)}};
        for (const auto& [source, extent] : cases) {
            const WorkingPlane plane = choose(extent, Rule::Local, 0.01, source);
            CAPTURE(plane.crs.name());
            const Crs from_wkt = Crs::parse(plane.crs.wkt());
            CHECK(from_wkt.is_same(plane.crs));
            CHECK(from_wkt.name() == plane.crs.name());
            for (const std::string driver : {"GTiff", "GPKG"}) {
                CAPTURE(driver);
                const std::string path = "/vsimem/plane." + driver;
                GDALDriver* const writer = GetGDALDriverManager()->GetDriverByName(driver.c_str());
                GDALDatasetUniquePtr made(writer->Create(path.c_str(), 2, 2, 1, GDT_Byte, nullptr));
                REQUIRE(made);
                double geotransform[6] = {0, 1, 0, 0, 0, -1};
                made->SetGeoTransform(geotransform);
                made->SetSpatialRef(plane.crs.gdal());
                made.reset();
                const GDALDatasetUniquePtr read(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
                REQUIRE(read);
                const Crs crs = Crs::from_gdal(read->GetSpatialRef());
                CHECK(crs.is_same(plane.crs));
                CHECK(crs.name() == plane.crs.name());
                const double longitude = extent.west + 0.3;
                const double latitude = extent.south + 0.4;
                const Point2 before = Projecting(plane.crs)(longitude, latitude);
                const Point2 after = Projecting(crs)(longitude, latitude);
                CHECK(std::hypot(after.x - before.x, after.y - before.y) < 1e-6);
                VSIUnlink(path.c_str());
            }
        }
    }

    TEST_CASE("a plane is told of in a line") {
        CHECK(WorkingPlane().text() == "none");
        CHECK(choose(box(-111, -110.5, 35, 36)).text() ==
              "EPSG:32612 (WGS 84 / UTM zone 12N), chosen for the data's longitudes and latitudes; scale "
              "0.99960 to "
              "0.99963");
        CHECK(
            choose(box(10, 16, 45, 49)).text() ==
            "tinwright local stereographic at 13.00 E 47.00 N, made for the data's longitudes and latitudes; "
            "scale 0.99968 to 1.00032");
        WorkingPlane plane;
        plane.crs = Crs::parse("EPSG:3067");
        plane.origin = Origin::Asked;
        CHECK(plane.text() == "EPSG:3067 (ETRS89 / TM35FIN(E,N)), as asked for");
        plane.origin = Origin::Shared;
        CHECK(plane.text() == "EPSG:3067 (ETRS89 / TM35FIN(E,N)), the sources' own");
    }

    TEST_CASE("a named plane far off is warned of, and refused where a limit was given") {
        WorkingPlane plane;
        plane.crs = Crs::parse("EPSG:3857");
        plane.origin = Origin::Shared;
        plane.extent = box(10, 11, 45, 46);
        plane.scale = {1.41, 1.44};
        PlaneRequest asked;
        CHECK(check_distortion(plane, asked) ==
              "EPSG:3857 (WGS 84 / Pseudo-Mercator) stretches lengths by 1.41 to 1.44 over the data (10.0 E "
              "to 11.0 "
              "E, 45.0 N to 46.0 N): distances, areas and slopes are off by that; --working-crs local makes "
              "a plane "
              "for the data");
        asked.is_limit_given = true;
        CHECK(message_of<InputError>([&] { (void)check_distortion(plane, asked); }) ==
              "EPSG:3857 (WGS 84 / Pseudo-Mercator) stretches lengths by 1.41 to 1.44 over the data (10.0 E "
              "to 11.0 "
              "E, 45.0 N to 46.0 N), more than the 0.1 % of --max-distortion; give --working-crs local, "
              "--max-distortion 44% or another projected system");
        plane.scale = {2.5, 3};  // no limit allows that
        CHECK(message_of<InputError>([&] {
                  (void)check_distortion(plane, asked);
              }).ends_with("give --working-crs local or another projected system"));
        plane.scale = {1.41, 1.44};
        asked.max_distortion = 0.5;
        CHECK_FALSE(check_distortion(plane, asked).empty());  // within the limit, but still worth a word
        plane.scale = {0.995, 1.005};
        CHECK(check_distortion(plane, asked).empty());
        asked.is_limit_given = false;
        asked.max_distortion = 0.001;
        CHECK(check_distortion(plane, asked).empty());
        plane.origin = Origin::Utm;  // chosen: the limit always counts
        CHECK_FALSE(message_of<InputError>([&] { (void)check_distortion(plane, asked); }).empty());
        plane.extent = GeographicExtent();
        CHECK(check_distortion(plane, asked).empty());
    }
}
