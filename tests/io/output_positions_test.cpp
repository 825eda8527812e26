#include "tinwright/io/output_positions.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <GeographicLib/UTMUPS.hpp>
#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright::io;
using namespace tinwright_tests;

namespace {

/// Longitude and latitude of a place of a northern UTM zone.
Point2 lon_lat(int zone, Point2 p) {
    double latitude = 0;
    double longitude = 0;
    GeographicLib::UTMUPS::Reverse(zone, true, p.x, p.y, latitude, longitude);
    return {longitude, latitude};
}

Point2 utm(int zone, Point2 p) {
    int chosen = 0;
    bool is_north = true;
    Point2 placed;
    GeographicLib::UTMUPS::Forward(p.y, p.x, chosen, is_north, placed.x, placed.y, zone);
    return placed;
}

Box box_around(double x, double y, double reach) {
    Box box;
    box.add(x - reach, y - reach);
    box.add(x + reach, y + reach);
    return box;
}

bool is_multiple(double value, double steps) { return std::nearbyint(value * steps) / steps == value; }

}  // namespace

TEST_SUITE("io/output_positions") {
    TEST_CASE("positions are written as they are in the plane's own system, and where one is unknown") {
        const Crs plane = Crs::parse("EPSG:32612");
        const Box box = box_around(500000, 4e6, 1000);
        CHECK(OutputPositions().is_identity());
        CHECK(OutputPositions(plane, plane, box).is_identity());
        CHECK(OutputPositions(plane, Crs(), box).is_identity());
        CHECK(OutputPositions(Crs(), plane, box).is_identity());
        CHECK(OutputPositions(plane, Crs::parse("EPSG:32612+5703"), box).is_identity());
        CHECK(OutputPositions().transform(Point2{0.1, 0.2}) == Point2{0.1, 0.2});
        CHECK(OutputPositions().bounds(box) == box);
    }

    TEST_CASE("longitudes and latitudes are those of GeographicLib, easting first, to 1e-10 degrees") {
        const OutputPositions positions(Crs::parse("EPSG:32612"), Crs::parse("EPSG:4326"),
                                        box_around(500000, 4e6, 3e5));
        REQUIRE(positions.is_geographic());
        Random random(3);
        std::vector<Point2> places;
        for (int i = 0; i < 500; ++i) {
            places.push_back({static_cast<double>(random.integer(200000000, 800000000)) / 1000,
                              static_cast<double>(random.integer(3700000000, 4300000000)) / 1000});
        }
        const std::vector<Point2> written = positions.transform(places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Point2 expected = lon_lat(12, places[i]);
            CHECK(std::abs(written[i].x - expected.x) < 6e-11);
            CHECK(std::abs(written[i].y - expected.y) < 6e-11);
            CHECK(is_multiple(written[i].x, 1e10));
            CHECK(is_multiple(written[i].y, 1e10));
            CHECK(positions.transform(places[i]) == written[i]);
        }
        Point3 point{places[0].x, places[0].y, 7.25};
        positions.apply_to(std::span(&point, 1));
        CHECK(point == Point3{written[0].x, written[0].y, 7.25});
    }

    TEST_CASE("longitudes are in one piece from the data's west eastward, past 180 at the antimeridian") {
        const Crs degrees = Crs::parse("EPSG:4326");
        struct Case {
            const char* crs;
            int zone;
            double longitude;
            double least;
        };
        for (const Case& c : {Case{"EPSG:32660", 60, 180.0, 179.5}, Case{"EPSG:32601", 1, -180.0, 179.5},
                              Case{"EPSG:32660", 60, 178.0, 177.5}, Case{"EPSG:32601", 1, -177.0, -177.5}}) {
            CAPTURE(c.crs);
            CAPTURE(c.longitude);
            const Point2 middle = utm(c.zone, {c.longitude, 10});
            const OutputPositions positions(Crs::parse(c.crs), degrees,
                                            box_around(middle.x, middle.y, 40000));
            double before = -1000;
            for (double offset = -0.3; offset <= 0.3; offset += 0.05) {
                const Point2 written = positions.transform(utm(c.zone, {c.longitude + offset, 10.1}));
                CHECK(written.x == doctest::Approx(c.least + 0.5 + offset).epsilon(1e-10));
                CHECK(written.x > before);
                before = written.x;
            }
            const Box bounds = positions.bounds(box_around(middle.x, middle.y, 40000));
            CHECK(bounds.x_max - bounds.x_min < 1);
            CHECK(bounds.x_min > c.least);
        }
    }

    TEST_CASE("around a pole longitudes are from -180 to 180") {
        const OutputPositions positions(Crs::parse("EPSG:32661"), Crs::parse("EPSG:4326"),
                                        box_around(2e6, 2e6, 50000));
        for (const Point2 p : {Point2{2e6 + 1, 2e6}, Point2{2e6 - 1, 2e6 + 1}, Point2{2e6 - 1, 2e6 - 1}}) {
            const Point2 written = positions.transform(p);
            CHECK(written.x >= -180);
            CHECK(written.x < 180);
            CHECK(written.y > 89.9999);
        }
    }

    TEST_CASE("another plane's positions are rounded to a millionth of a unit") {
        const OutputPositions positions(Crs::parse("EPSG:32612"), Crs::parse("EPSG:32613"),
                                        box_around(700000, 4e6, 1000));
        const Point2 p{700123.456, 4000321.125};
        const Point2 written = positions.transform(p);
        const Point2 expected = utm(13, lon_lat(12, p));
        CHECK(std::abs(written.x - expected.x) < 2e-6);
        CHECK(std::abs(written.y - expected.y) < 2e-6);
        CHECK(is_multiple(written.x, 1e6));
    }

    TEST_CASE("a position that cannot be transformed is named") {
        const OutputPositions positions(Crs::parse("EPSG:32612"), Crs::parse("EPSG:4326"),
                                        box_around(500000, 4e6, 1000));
        const std::vector<Point2> places{{500000, 4e6}, {1e12, 5}};
        const std::string expected =
            "(1000000000000, 5) cannot be transformed from EPSG:32612 (WGS 84 / UTM zone 12N) to "
            "EPSG:4326 (WGS 84): choose another --crs";
        CHECK(message_of<InputError>([&] { static_cast<void>(positions.transform(places)); }) == expected);
        CHECK(message_of<InputError>([&] { static_cast<void>(positions.transform(places[1])); }) == expected);
    }

    TEST_CASE("chords of contours keep to the tolerance, the same whichever way they run") {
        const int zone = 33;
        const OutputPositions positions(Crs::parse("EPSG:32633"), Crs::parse("EPSG:4326"),
                                        box_around(500000, 7e6, 1e5));
        const std::vector<Point2> chain{
            {450000, 7e6}, {490000, 7e6}, {490010, 7e6 + 10}, {420000, 7.06e6}, {420000, 7.01e6}};
        const std::vector<LevelLines> lines{{chain, {2, chain.size()}}};
        const std::vector<LevelLines> written = written_lines(lines, positions);
        REQUIRE(written.size() == 1);
        REQUIRE(written[0].count() == 2);
        CHECK(written[0].points.front() == positions.transform(chain.front()));
        CHECK(written[0].points.back() == positions.transform(chain.back()));
        // Every middle of what is drawn, brought back, is on a chord.
        const auto distance_to_chain = [&](Point2 p) {
            double least = 1e9;
            for (const std::size_t i : {0U, 2U, 3U}) {
                const Point2 a = chain[i];
                const Point2 b = chain[i + 1];
                const double length = std::hypot(b.x - a.x, b.y - a.y);
                const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length;
                if (along > -1 && along < length + 1) {
                    least = std::min(
                        least, std::abs((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) / length);
                }
            }
            return least;
        };
        for (std::size_t line = 0; line < 2; ++line) {
            const auto points = written[0].line(line);
            CHECK(points.size() > 50);
            for (std::size_t i = 1; i < points.size(); ++i) {
                const Point2 middle{(points[i - 1].x + points[i].x) / 2, (points[i - 1].y + points[i].y) / 2};
                CHECK(distance_to_chain(utm(zone, middle)) < 1.05 * kChordTolerance);
            }
        }
        const std::vector<Point2> back(chain.rbegin(), chain.rend());
        const std::vector<Band> bands{{0, 1, {{chain}, {back}}}};
        const std::vector<Band> written_back = written_bands(bands, positions);
        std::vector<Point2> turned = written_back[0].polygons[1][0];
        std::reverse(turned.begin(), turned.end());
        CHECK(turned == written_back[0].polygons[0][0]);
        // Short chords are left alone.
        const std::vector<LevelLines> brief{{{{450000, 7e6}, {450100, 7e6}, {450100, 7000100}}, {3}}};
        CHECK(written_lines(brief, positions)[0].points.size() == 3);
    }
}
