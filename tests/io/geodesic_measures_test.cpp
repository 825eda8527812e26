#include "tinwright/io/geodesic_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <doctest/doctest.h>
#include <tbb/parallel_for.h>

#include "projecting.hpp"
#include "support/cases.hpp"
#include "support/point_sets.hpp"

using tinwright::GroundMeasures;
using tinwright::Point2;
using tinwright::io::choose_working_plane;
using tinwright::io::Crs;
using tinwright::io::make_geodesic_measures;
using tinwright::io::make_ground_measures;
using tinwright::io::PlaneRequest;
using tinwright::io::WorkingPlane;
using tinwright_tests::Projecting;
using tinwright_tests::Random;

namespace {

struct Place {
    double latitude;
    double longitude;
};

std::vector<Point2> project(const Crs& plane, std::span<const Place> places) {
    Projecting projecting(plane);
    std::vector<Point2> positions;
    for (const Place& place : places) {
        positions.push_back(projecting(place.longitude, place.latitude));
    }
    return positions;
}

WorkingPlane plane_of(const tinwright::io::GeographicExtent& extent) {
    PlaneRequest request;
    request.max_distortion = 0.1;
    return choose_working_plane(Crs::parse("EPSG:4326"), extent, request);
}

}  // namespace

TEST_SUITE("io/geodesic_measures") {
    TEST_CASE("geodesics have their published lengths") {
        // The twenty cases of the test suite that comes with GeographicLib in each of its languages
        // (GeodesicTest): latitudes and longitudes of the ends, metres.
        struct Case {
            Place a;
            Place b;
            double metres;
        };
        const std::array<Case, 20> cases{{
            {{35.60777, -139.44815}, {-11.17491, -69.95921}, 8935244.5604818305},
            {{55.52454, 106.05087}, {77.03196, 197.18234}, 4105086.1713924406},
            {{-21.97856, 142.59065}, {41.84138, 98.56635}, 8394328.894657671},
            {{-66.99028, 112.2363}, {-12.70631, 285.90344}, 11150344.2312080241},
            {{-17.42761, 173.34268}, {-15.84784, 5.93557}, 16076603.1631180673},
            {{32.84994, 48.28919}, {-56.28556, 202.29132}, 16727068.9438164461},
            {{6.96833, 52.74123}, {-7.39675, 206.17291}, 17102477.2496958388},
            {{-50.56724, -16.30485}, {-33.56571, -94.97412}, 6455670.5118668696},
            {{-58.93002, -8.90775}, {-8.91104, 133.13503}, 11756066.0219864627},
            {{-68.82867, -74.28391}, {-50.63005, -8.36685}, 3956936.926063544},
            {{-10.62672, -32.0898}, {5.883, -134.31681}, 11470869.3864563009},
            {{-21.76221, 166.90563}, {48.72884, 213.97627}, 9098627.3986554915},
            {{-19.79938, -174.47484}, {-11.99349, -154.35109}, 2319004.8601169389},
            {{-11.95887, -116.94513}, {4.57352, 7.16501}, 13834722.5801401374},
            {{-87.85331, 85.66836}, {66.48646, 16.09921}, 17286615.3147144645},
            {{1.74708, 128.32011}, {-11.16617, 11.87109}, 12942901.1241347408},
            {{-25.72959, -144.90758}, {-57.70581, -269.17879}, 9413446.7452453107},
            {{-41.22777, 122.32875}, {-7.57291, 130.37946}, 3812686.035106021},
            {{11.01307, 138.25278}, {6.62726, 247.05981}, 11911190.819018408},
            {{-29.47124, 95.14681}, {-27.46601, -69.15955}, 13487015.8381145492},
        }};
        const Crs mercator = Crs::parse("EPSG:3395");  // a plane that holds nearly the whole earth
        const GroundMeasures ground = make_geodesic_measures(mercator);
        CHECK(ground.is_geodesic());
        CHECK(ground.unit == "metre");
        for (const Case& c : cases) {
            const std::array<Place, 2> ends{c.a, c.b};
            const std::vector<Point2> positions = project(mercator, ends);
            CHECK(std::abs(ground.length(positions[0], positions[1]) - c.metres) < 1e-6);
            CHECK(std::abs(ground.length(positions[1], positions[0]) - c.metres) < 1e-6);
        }
    }

    TEST_CASE("a short line near 54 N has its published length") {
        // GeodSolve74 of the same suite.
        const std::array<Place, 2> ends{{{54.1589, 15.3872}, {54.1591, 15.3877}}};
        for (const char* const code : {"EPSG:32633", "EPSG:3857", "EPSG:5041"}) {
            CAPTURE(code);
            const Crs plane = Crs::parse(code);
            const std::vector<Point2> positions = project(plane, ends);
            CHECK(std::abs(make_geodesic_measures(plane).length(positions[0], positions[1]) - 39.527686385) <
                  2e-8);
        }
    }

    TEST_CASE("Antarctica has its published area and perimeter") {
        // The example of Planimeter in GeographicLib's documents and of its C library.
        const std::array<Place, 17> coast{{{-72.9, -74},
                                           {-71.9, -102},
                                           {-74.9, -102},
                                           {-74.3, -131},
                                           {-77.5, -163},
                                           {-77.4, 163},
                                           {-71.7, 172},
                                           {-65.9, 140},
                                           {-65.7, 113},
                                           {-66.6, 88},
                                           {-66.9, 59},
                                           {-69.8, 25},
                                           {-70.0, -4},
                                           {-71.0, -14},
                                           {-77.3, -33},
                                           {-77.9, -46},
                                           {-74.7, -61}}};
        for (const char* const code : {"EPSG:3031", "EPSG:5042", "EPSG:3395"}) {
            CAPTURE(code);
            const Crs plane = Crs::parse(code);
            const GroundMeasures ground = make_geodesic_measures(plane);
            std::vector<Point2> ring = project(plane, coast);
            CHECK(std::abs(ground.area(ring) - 13376856682207.4) < 1);
            std::vector<Point2> closed = ring;
            closed.push_back(ring.front());
            CHECK(std::abs(ground.length(closed) - 14710425.406974) < 1e-5);
            std::reverse(ring.begin(), ring.end());
            CHECK(std::abs(ground.area(ring) - 13376856682207.4) < 1);
            std::rotate(ring.begin(), ring.begin() + 5, ring.end());
            CHECK(std::abs(ground.area(ring) - 13376856682207.4) < 1);
        }
    }

    TEST_CASE("rings round a pole, across the antimeridian and through a pole have their published areas") {
        // Planimeter0 and Planimeter5 of the same suite.
        const Crs north = Crs::parse("EPSG:5041");
        const Crs south = Crs::parse("EPSG:5042");
        const std::array<Place, 4> around{{{89, 0}, {89, 90}, {89, 180}, {89, 270}}};
        CHECK(std::abs(make_geodesic_measures(north).area(project(north, around)) - 24952305678.0) < 1);
        const std::array<Place, 4> below{{{-89, 0}, {-89, 90}, {-89, 180}, {-89, 270}}};
        CHECK(std::abs(make_geodesic_measures(south).area(project(south, below)) - 24952305678.0) < 1);
        const std::array<Place, 3> octant{{{90, 0}, {0, 0}, {0, 90}}};
        CHECK(std::abs(make_geodesic_measures(north).area(project(north, octant)) - 63758202715511.0) < 2);
        const std::array<Place, 3> half{{{89, 0.1}, {89, 90.1}, {89, -179.9}}};
        CHECK(std::abs(make_geodesic_measures(north).area(project(north, half)) - 12476152838.5) < 1);
        // The same diamond at 0 and at 180 degrees.
        const Crs pacific = Crs::parse("EPSG:3832");
        const std::array<Place, 4> diamond{{{0, 179}, {-1, 180}, {0, -179}, {1, 180}}};
        CHECK(std::abs(make_geodesic_measures(pacific).area(project(pacific, diamond)) - 24619419146.0) < 1);
    }

    TEST_CASE("fewer than three positions have no area, none or one no length") {
        const GroundMeasures ground = make_geodesic_measures(Crs::parse("EPSG:32633"));
        const std::vector<Point2> line{{500000, 5e6}, {510000, 5e6}};
        CHECK(ground.area({}) == 0);
        CHECK(ground.area(std::span(line).first(1)) == 0);
        CHECK(ground.area(line) == 0);
        CHECK(ground.length(std::span(line).first(1)) == 0);
        CHECK(ground.length(line[0], line[0]) == 0);
    }

    TEST_CASE("lengths are in metres whatever the plane's unit, on its own ellipsoid") {
        // In feet, in survey feet on Clarke's ellipsoid, northing first, from Paris in grades.
        for (const char* const code : {"EPSG:2222", "EPSG:2964", "EPSG:2193", "EPSG:27572"}) {
            CAPTURE(code);
            const Crs plane = Crs::parse(code);
            const double center = code == std::string("EPSG:2193")    ? 175
                                  : code == std::string("EPSG:27572") ? 0.5
                                                                      : -112;
            const double latitude = code == std::string("EPSG:2193") ? -40 : 46;
            const std::array<Place, 2> ends{{{latitude, center}, {latitude + 0.3, center + 0.4}}};
            const std::vector<Point2> positions = project(plane, ends);
            const GeographicLib::Geodesic geodesic(plane.gdal()->GetSemiMajor(),
                                                   1 / plane.gdal()->GetInvFlattening());
            double metres = 0;
            geodesic.Inverse(ends[0].latitude, ends[0].longitude, ends[1].latitude, ends[1].longitude,
                             metres);
            CHECK(std::abs(make_geodesic_measures(plane).length(positions[0], positions[1]) - metres) < 1e-6);
        }
    }

    TEST_CASE("lengths and areas of the plane are off by no more than the distortion") {
        for (int seed = 0; seed < tinwright_tests::cases(6); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const double west = 360 * random.real() - 180;
            const double south = 150 * random.real() - 80;
            const WorkingPlane plane = plane_of({west, west + 5, south, south + 4, false, false});
            const GroundMeasures ground = make_ground_measures(plane);
            CHECK(ground.is_geodesic());
            CHECK(ground.distortion >= plane.scale.distortion());
            CHECK(ground.distortion < plane.scale.distortion() * 1.01 + 1e-8);
            const GroundMeasures flat;
            Projecting projecting(plane.crs);
            for (int i = 0; i < 50; ++i) {
                // Well inside: straight lines bulge out of an extent between parallels.
                std::array<Point2, 3> ring{};
                for (Point2& corner : ring) {
                    corner = projecting(west + 1 + 3 * random.real(), south + 1 + 2 * random.real());
                }
                const double length = ground.length(ring[0], ring[1]);
                CHECK(std::abs(flat.length(ring[0], ring[1]) - length) <= ground.distortion * length + 1e-6);
                // Small, so that its sides are straight in both.
                ring[1] = {ring[0].x + 100 * random.real(), ring[0].y + 100};
                ring[2] = {ring[0].x - 100, ring[0].y + 50 * random.real()};
                const double area = ground.area(ring);
                const double twice = 2 * ground.distortion + ground.distortion * ground.distortion;
                CHECK(std::abs(flat.area(ring) - area) <= twice * area + 0.01);
            }
        }
    }

    TEST_CASE("measures are the plane's where the sources were in a plane or nothing is known") {
        CHECK_FALSE(make_ground_measures(WorkingPlane()).is_geodesic());
        WorkingPlane plane;
        plane.crs = Crs::parse("EPSG:32633");
        plane.origin = WorkingPlane::Origin::Shared;
        CHECK_FALSE(make_ground_measures(plane).is_geodesic());
        plane.source_crs = Crs::parse("EPSG:4326");
        CHECK(make_ground_measures(plane).is_geodesic());
        CHECK_FALSE(make_geodesic_measures(Crs()).is_geodesic());
        CHECK_FALSE(make_geodesic_measures(Crs::parse("LOCAL_CS[\"site\",UNIT[\"metre\",1]]")).is_geodesic());
        CHECK_FALSE(make_geodesic_measures(Crs::parse("EPSG:4326")).is_geodesic());
    }

    TEST_CASE("threads measure at a time, and copies outlive what they were made from") {
        GroundMeasures copy;
        {
            const GroundMeasures ground = make_geodesic_measures(Crs::parse("EPSG:32633"));
            copy = ground;
        }
        constexpr std::size_t kCount = 2000;
        const auto length = [&](std::size_t i) {
            const double x = 400000 + 100 * static_cast<double>(i);
            return copy.length({x, 5e6}, {x + 50, 5.01e6});
        };
        std::vector<double> lengths(kCount);
        tbb::parallel_for(std::size_t{0}, kCount, [&](std::size_t i) { lengths[i] = length(i); });
        for (std::size_t i = 0; i < kCount; ++i) {
            REQUIRE(lengths[i] == length(i));
        }
    }
}
