#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <GeographicLib/UTMUPS.hpp>
#include <doctest/doctest.h>

#include "tinwright/io/length_unit.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/read_places.hpp"

#include "io/reading.hpp"
#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright_tests;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::SurfacePlace;
using tinwright::SurfaceReading;
using tinwright::io::Crs;
using tinwright::io::ReadOptions;
using tinwright::io::Samples;

namespace {

constexpr double kSurveyFoot = 1200.0 / 3937.0;

std::string row(double x, double y, double z, int places) {
    char text[128];  // NOLINT(modernize-avoid-c-arrays)
    std::snprintf(text, sizeof text, "%.*f,%.*f,%.9f\n", places, x, places, y, z);
    return text;
}

/// The same samples, of a rough terrain at the border of zone 32, in metres, in degrees and in feet.
struct Terrain {
    std::string metres = "x,y,z\n";
    std::string degrees = "lon,lat,z\n";
    std::string feet = "x,y,z\n";

    explicit Terrain(std::uint64_t seed) {
        Random random(seed);
        for (int i = 0; i < 300; ++i) {
            const double x = 719000 + static_cast<double>(random.integer(0, 4000000)) / 1000;
            const double y = 5400000 + static_cast<double>(random.integer(0, 4000000)) / 1000;
            const double z = static_cast<double>(random.integer(0, 200000)) / 1000;
            double latitude = 0;
            double longitude = 0;
            GeographicLib::UTMUPS::Reverse(32, true, x, y, latitude, longitude);
            metres += row(x, y, z, 3);
            degrees += row(longitude, latitude, z, 12);
            feet += row(x / kSurveyFoot, y / kSurveyFoot, z / kSurveyFoot, 7);
        }
    }
};

/// Elevations and true slopes in metres at places of the plane; NaN outside.
std::vector<SurfaceReading> read_surface(const Samples& samples, const std::vector<Point2>& at) {
    const tinwright::Tin tin = tinwright::triangulate(samples.points, {}, {}).tin;
    const tinwright::SurfaceLocator locator(tin);
    const auto surface = tinwright::make_linear(tin);
    const auto reader = surface->make_reader();
    const double unit = tinwright::io::unit_factor(samples.z_unit, "metre");
    std::vector<SurfaceReading> readings;
    for (const Point2& position : at) {
        const std::optional<SurfacePlace> place = locator.find(position);
        SurfaceReading reading{std::nan(""), {}};
        if (place) {
            reading = reader->read(*place);
            reading.z *= unit;
            reading.gradient = {reading.gradient.x * unit, reading.gradient.y * unit};
        }
        readings.push_back(reading);
    }
    return readings;
}

}  // namespace

TEST_SUITE("io/same_terrain") {
    // Positions agree to the micrometre that they are rounded to; the steepest faces here fall by some tens
    // of metres a metre.
    constexpr double kBound = 1e-4;

    TEST_CASE("metres, degrees and feet give the same surface") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(5)); ++seed) {
            CAPTURE(seed);
            const Terrain terrain(seed);
            const Samples metres = read_text(terrain.metres, ",crs=EPSG:32632");
            // On the border of two zones: named, as the middle may be in the other one.
            ReadOptions options;
            options.plane = tinwright::io::parse_plane_request("EPSG:32632");
            const Samples degrees = read_text(terrain.degrees, ",crs=EPSG:4326", options);
            CHECK(degrees.plane.is_source_geographic());
            options.heights.source_unit = "US survey foot";
            const Samples feet = read_text(
                terrain.feet, ",crs=+proj=utm +zone=32 +datum=WGS84 +units=us-ft +type=crs", options);
            CHECK(feet.z_unit == "US survey foot");
            std::vector<Point2> at;
            Random random(seed + 1000);
            for (int i = 0; i < 400; ++i) {
                at.push_back({719300 + static_cast<double>(random.integer(0, 3400)),
                              5400300 + static_cast<double>(random.integer(0, 3400))});
            }
            const std::vector<SurfaceReading> expected = read_surface(metres, at);
            for (const Samples* const other : {&degrees, &feet}) {
                const std::vector<SurfaceReading> readings = read_surface(*other, at);
                for (std::size_t i = 0; i < at.size(); ++i) {
                    CHECK(std::abs(readings[i].z - expected[i].z) < kBound);
                    CHECK(std::hypot(readings[i].gradient.x - expected[i].gradient.x,
                                     readings[i].gradient.y - expected[i].gradient.y) < kBound);
                }
            }
        }
    }
}
