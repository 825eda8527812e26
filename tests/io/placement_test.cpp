#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <GeographicLib/UTMUPS.hpp>
#include <doctest/doctest.h>
#include <unistd.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

#include "io/reading.hpp"
#include "support/messages.hpp"

using namespace tinwright_tests;
using tinwright::InputError;
using tinwright::Point3;
using tinwright::UsageError;
using tinwright::io::Crs;
using tinwright::io::parse_plane_request;
using tinwright::io::ReadOptions;
using tinwright::io::Samples;
using tinwright::io::WorkingPlane;

namespace {

/// A synthetic geoid file: `value` metres everywhere, on cells of ten degrees.
class GeoidFile {
  public:
    explicit GeoidFile(double value, const std::string& description = "a flat geoid") {
        constexpr int kWidth = 36;
        constexpr int kHeight = 19;
        std::string content =
            "P5\n# Geoid file in PGM format for the GeographicLib::Geoid class\n# Description " +
            description + "\n# Offset -108\n# Scale 0.003\n# Origin 90N 0E\n" + "# AREA_OR_POINT Point\n" +
            std::to_string(kWidth) + " " + std::to_string(kHeight) + "\n65535\n";
        const int raw = static_cast<int>(std::lround((value + 108) / 0.003));
        for (int i = 0; i < kWidth * kHeight; ++i) {
            content += static_cast<char>(raw / 256);
            content += static_cast<char>(raw % 256);
        }
        path_ = (std::filesystem::temp_directory_path() / ("flat" + std::to_string(::getpid()) + ".pgm"))
                    .string();
        std::ofstream(path_, std::ios::binary) << content;
    }
    GeoidFile(const GeoidFile&) = delete;
    GeoidFile& operator=(const GeoidFile&) = delete;
    ~GeoidFile() { std::filesystem::remove(path_); }

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

Samples read_lon_lat(const std::string& rows, const ReadOptions& options = {},
                     const std::string& crs = "EPSG:4326") {
    const MemoryFile file("p.csv", "lon,lat,z\n" + rows);
    return read(file.path() + ",crs=" + crs, options);
}

}  // namespace

TEST_SUITE("io/placement") {
    TEST_CASE("longitudes and latitudes are worked on in their UTM zone") {
        const Samples samples = read_lon_lat("27,60.5,1\n28,61,2\n");
        CHECK(samples.crs.code() == "EPSG:32635");
        CHECK(samples.plane.origin == WorkingPlane::Origin::Utm);
        CHECK(samples.plane.source_crs.code() == "EPSG:4326");
        int zone = 0;
        bool is_north = false;
        double x = 0;
        double y = 0;
        GeographicLib::UTMUPS::Forward(61, 28, zone, is_north, x, y);
        CHECK(zone == 35);
        CHECK(std::abs(samples.points[1].x - x) < 6e-7);  // rounded to micrometres
        CHECK(std::abs(samples.points[1].y - y) < 6e-7);
        CHECK(samples.points[1].z == 2);
        CHECK(samples.points[1].x == std::nearbyint(samples.points[1].x * 1e6) / 1e6);
        CHECK(read_lon_lat("359,-10,1\n").crs.code() == "EPSG:32730");
        CHECK(read_lon_lat("27,60.5,1\n", {}, "EPSG:4258").crs.code() == "EPSG:25835");
    }

    TEST_CASE("data on both sides of the antimeridian are in one piece") {
        const Samples east = read_lon_lat("179.9,-17,1\n180.1,-17.1,2\n");
        const Samples west = read_lon_lat("179.9,-17,1\n-179.9,-17.1,2\n");
        CHECK(east.points == west.points);
        CHECK(std::abs(west.points[0].x - west.points[1].x) < 3e4);
    }

    TEST_CASE("data around a pole are in one piece") {
        const Samples samples = read_lon_lat("0,89.5,1\n90,89.5,2\n180,89.5,3\n-90,89.5,4\n");
        CHECK(samples.plane.origin == WorkingPlane::Origin::Local);
        CHECK(samples.plane.extent.has_pole);
        for (const Point3& point : samples.points) {
            CHECK(std::hypot(point.x, point.y) == doctest::Approx(55847).epsilon(0.001));
        }
    }

    TEST_CASE("a geographic --crs is for what is made, the plane is chosen") {
        ReadOptions options;
        options.crs = Crs::parse("EPSG:4326");
        CHECK(read_lon_lat("27,60.5,1\n28,61,2\n", options).crs.code() == "EPSG:32635");
        const MemoryFile plain("p.csv", "lon,lat,z\n27,60.5,1\n");
        const Samples samples = read(plain.path(), options);  // no CRS of its own
        CHECK(samples.crs.code() == "EPSG:32635");
        CHECK(samples.warnings ==
              std::vector<std::string>{
                  R"(file "/vsimem/p.csv": has no CRS; taken to be in EPSG:4326 (WGS 84))"});
    }

    TEST_CASE("--working-crs names the plane, or the rule for it") {
        ReadOptions options;
        options.plane = parse_plane_request("EPSG:3067");
        CHECK(read_lon_lat("27,60.5,1\n", options).crs.code() == "EPSG:3067");
        options.plane = parse_plane_request("local");
        CHECK(read_lon_lat("27,60.5,1\n", options).plane.origin == WorkingPlane::Origin::Local);
        options.plane = parse_plane_request("utm");
        const MemoryFile mercator("m.csv", "x,y,z\n3005626,8524000,1\n");
        const Samples samples = read(mercator.path() + ",crs=EPSG:3857", options);
        CHECK(samples.crs.code() == "EPSG:32635");
        CHECK_FALSE(samples.plane.is_source_geographic());
        CHECK(message_of<InputError>([&] { read(mercator.path(), options); }) ==
              "--working-crs needs to know where on the earth the sources are, and none carries a CRS; "
              "assign one "
              "with --source-crs");
    }

    TEST_CASE("a projection that is far from true to scale is told of, or refused") {
        const MemoryFile mercator("m.csv", "x,y,z\n3005626,8524000,1\n3005726,8524000,1\n");
        const Samples samples = read(mercator.path() + ",crs=EPSG:3857");
        REQUIRE(samples.warnings.size() == 1);
        CHECK(samples.warnings[0].starts_with("EPSG:3857 (WGS 84 / Pseudo-Mercator) stretches lengths by "));
        CHECK(samples.warnings[0].find("--working-crs local") != std::string::npos);
        ReadOptions options;
        options.plane.max_distortion = 0.01;
        options.plane.is_limit_given = true;
        CHECK_THROWS_AS(read(mercator.path() + ",crs=EPSG:3857", options), InputError);
    }

    TEST_CASE("elevations of different units are brought to one") {
        const MemoryFile file("a.csv", "x,y,z\n500000,4000000,100\n");
        const std::string metres = file.path() + ",crs=EPSG:26910+5703";
        const std::string feet = file.path() + ",crs=EPSG:26910+6360";
        const Samples samples = read_all({metres, feet});
        CHECK(samples.z_unit == "metre");
        CHECK(samples.points[0].z == 100);
        CHECK(samples.points[1].z == doctest::Approx(100 * 1200.0 / 3937).epsilon(1e-15));
        CHECK(samples.warnings.empty());
        const Samples reversed = read_all({feet, metres});
        CHECK(reversed.z_unit == "US survey foot");
        CHECK(reversed.points[0].z == 100);
        CHECK(reversed.points[1].z == doctest::Approx(100 * 3937.0 / 1200).epsilon(1e-15));
    }

    TEST_CASE("--z-unit, --z-scale and --target-z-unit") {
        const MemoryFile file("a.csv", "x,y,z\n500000,4000000,100\n");
        ReadOptions options;
        options.heights.source_unit = "foot";
        CHECK(read(file.path() + ",crs=EPSG:26910", options).z_unit == "foot");
        options.heights.unit = "metre";
        CHECK(read(file.path() + ",crs=EPSG:26910", options).points[0].z ==
              doctest::Approx(30.48).epsilon(1e-15));
        options.heights.scale = 0.1;
        const Samples samples = read(file.path() + ",crs=EPSG:26910", options);
        CHECK(samples.points[0].z == doctest::Approx(3.048).epsilon(1e-15));
        CHECK(samples.z_unit == "metre");
        // Of a source that says its own unit it is not asked.
        options.heights.scale = 1;
        CHECK(read(file.path() + ",crs=EPSG:26910+5703", options).points[0].z == 100);
    }

    TEST_CASE("a geoid is taken off ellipsoidal heights, or put on") {
        const GeoidFile geoid(30);
        const MemoryFile file("g.csv", "lon,lat,z\n27,60.5,100\n");
        ReadOptions options;
        options.heights.geoid = geoid.path();
        const Samples down = read(file.path() + ",crs=EPSG:4979", options);
        CHECK(down.points[0].z == doctest::Approx(70).epsilon(1e-9));
        CHECK(down.warnings.empty());
        const Samples guessed = read(file.path() + ",crs=EPSG:4326", options);
        CHECK(guessed.points[0].z == doctest::Approx(70).epsilon(1e-9));
        REQUIRE(guessed.warnings.size() == 1);
        CHECK(
            guessed.warnings[0] ==
            R"(file "/vsimem/g.csv": does not say what elevations are measured from; taken to be above the )"
            "ellipsoid and shifted by --geoid");
        options.heights.is_to_ellipsoid = true;
        CHECK(read(file.path() + ",crs=EPSG:4326+5773", options).points[0].z ==
              doctest::Approx(130).epsilon(1e-9));
        CHECK(read(file.path() + ",crs=EPSG:4979", options).points[0].z == 100);
    }

    TEST_CASE("vertical systems that differ are transformed, and never by nothing") {
        const MemoryFile file("h.csv", "lon,lat,z\n27,60.5,100\n");
        ReadOptions options;
        options.crs = Crs::parse("EPSG:32635+5773");
        const Samples samples = read(file.path() + ",crs=EPSG:4979", options);
        CHECK(samples.points[0].z == doctest::Approx(100 - 16.9).epsilon(0.02));  // EGM96 there
        options.crs = Crs::parse("EPSG:32635+3855");
        const std::string message =
            message_of<InputError>([&] { read(file.path() + ",crs=EPSG:4979", options); });
        CHECK(message.find("us_nga_egm08_25.tif") != std::string::npos);
    }

    TEST_CASE("a unit that is asked for does not make datums the same") {
        const MemoryFile file("h.csv", "lon,lat,z\n27,60.5,100\n");
        ReadOptions options;
        options.crs = Crs::parse("EPSG:32635+5773");
        const double metres = read(file.path() + ",crs=EPSG:4979", options).points[0].z;
        CHECK(metres < 90);
        options.heights.unit = "foot";
        const Samples feet = read(file.path() + ",crs=EPSG:4979", options);
        CHECK(feet.z_unit == "foot");
        CHECK(feet.points[0].z == doctest::Approx(metres / 0.3048).epsilon(1e-12));
    }

    TEST_CASE("geocentric coordinates are refused") {
        const MemoryFile file("x.csv", "x,y,z\n2800000,1400000,5500000\n");
        CHECK(
            message_of<InputError>([&] { read(file.path() + ",crs=EPSG:4978"); }) ==
            R"(file "/vsimem/x.csv": coordinates are geocentric, EPSG:4978 (WGS 84), without elevations; transform )"
            "them first, for example to EPSG:4979");
    }

    TEST_CASE("what is no longitude and latitude is refused by its row, or skipped") {
        const std::string typo = "27,60.5,1\n1009,60.5,2\n28,61,3\n";
        const std::string message =
            R"(file "/vsimem/p.csv", line 3: (1009, 60.5) is no longitude and latitude; is )"
            "EPSG:4326 (WGS 84) the right CRS?; --skip-bad goes on without it";
        CHECK(message_of<InputError>([&] { read_lon_lat(typo); }) == message);
        ReadOptions options;
        options.skip_bad = true;
        const Samples samples = read_lon_lat(typo, options);
        CHECK(samples.points.size() == 2);
        CHECK(samples.slices[0].skipped == 1);
        CHECK(samples.crs.code() == "EPSG:32635");
        CHECK(message_of<InputError>([&] {
                  read_lon_lat("348942,5397905,1\n");
              }).find("(348942, 5397905) is no longitude and latitude") != std::string::npos);
    }

    TEST_CASE("vertical systems alone are refused") {
        CHECK(message_of<UsageError>([&] {
                  read_lon_lat("27,60.5,1\n", {}, "EPSG:5773");
              }).find("is for elevations alone") != std::string::npos);
        ReadOptions options;
        options.crs = Crs::parse("EPSG:5773");
        CHECK(
            message_of<UsageError>([&] { read_lon_lat("27,60.5,1\n", options); }) ==
            "--crs EPSG:5773 (EGM96 height) is for elevations alone; put one for positions before it, as in "
            "EPSG:4326+5773");
    }

    TEST_CASE("heights that nobody knows the reference of are told of when one is asked for") {
        ReadOptions options;
        options.crs = Crs::parse("EPSG:32635+5773");
        const Samples samples = read_lon_lat("27,60.5,1\n", options);
        CHECK(samples.points[0].z == 1);
        REQUIRE(samples.warnings.size() == 1);
        CHECK(samples.warnings[0].starts_with(
            R"(file "/vsimem/p.csv": does not say what elevations are measured from)"));
    }

    TEST_CASE("axes in the authority's order are put right") {
        std::string features;
        for (const char* const position : {"60.5 27 5", "61 28 6"}) {
            features += std::string("<gml:featureMember><ogr:p><ogr:geom><gml:Point ") +
                        "srsName=\"urn:ogc:def:crs:EPSG::4326\" srsDimension=\"3\"><gml:pos>" + position +
                        "</gml:pos></gml:Point></ogr:geom></ogr:p></gml:featureMember>";
        }
        const MemoryFile file("ne.gml",
                              "<ogr:FeatureCollection xmlns:ogr=\"http://ogr.maptools.org/\" "
                              "xmlns:gml=\"http://www.opengis.net/gml\">" +
                                  features + "</ogr:FeatureCollection>");
        const Samples samples = read(file.path() + ",oo=INVERT_AXIS_ORDER_IF_LAT_LONG=NO");
        CHECK(samples.points == read_lon_lat("27,60.5,5\n28,61,6\n").points);
    }

    TEST_CASE("points are the same for any number of threads and order of sources") {
        std::string rows;
        for (int i = 0; i < 200000; ++i) {
            rows += std::to_string(10 + i * 1e-5) + "," + std::to_string(50 + (i % 1000) * 1e-4) + ",1\n";
        }
        ReadOptions one;
        one.threads = 1;
        ReadOptions four;
        four.threads = 4;
        CHECK(read_lon_lat(rows, one).points == read_lon_lat(rows, four).points);
        const MemoryFile a("a.csv", "lon,lat,z\n8,50,1\n");
        const MemoryFile b("b.csv", "lon,lat,z\n11,50,1\n");
        const std::string crs = ",crs=EPSG:4326";
        CHECK(read_all({a.path() + crs, b.path() + crs}).crs.wkt() ==
              read_all({b.path() + crs, a.path() + crs}).crs.wkt());
    }
}
