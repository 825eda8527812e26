#include "tinwright/io/geoid.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <GeographicLib/Geoid.hpp>
#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/threads.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using tinwright::Cancelled;
using tinwright::IoError;
using tinwright::Point3;
using tinwright::run_with_threads;
using tinwright::io::GeographicExtent;
using tinwright::io::Geoid;
using tinwright::io::shift_by_geoid;
using tinwright_tests::message_of;
using tinwright_tests::TemporaryFolder;

namespace {

/// Metres at a latitude and longitude in degrees.
using Heights = std::function<double(double, double)>;

constexpr double kOffset = -200;
constexpr double kScale = 0.01;

/// A geoid in GeographicLib's format: 16 bits a value, north first, eastward from Greenwich.
std::string geoid_file(int columns, int rows, const Heights& heights, const std::string& description) {
    std::ostringstream file;
    file << "P5\n";
    if (!description.empty()) {
        file << "# Description " << description << "\n";
    }
    file << "# Offset " << kOffset << "\n# Scale " << kScale << "\n# Origin 90N 0E\n"
         << columns << " " << rows << "\n65535\n";
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double latitude = 90 - 180.0 * row / (rows - 1);
            const double longitude = 360.0 * column / columns;
            const auto value =
                static_cast<std::uint16_t>(std::lround((heights(latitude, longitude) - kOffset) / kScale));
            file.put(static_cast<char>(value >> 8U));
            file.put(static_cast<char>(value & 255U));
        }
    }
    return file.str();
}

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// Smooth on the sphere, poles and all.
double wave(double latitude, double longitude) {
    return 10 + 30 * cosine(latitude) * cosine(longitude) - 20 * cosine(2 * latitude);
}

/// What a grid of 2 degrees leaves of it: 1e-4 for the fourth derivative, 320 at most, times the step's
/// fourth power; and the roundings of twelve values, whose coefficients sum up to less than 2 in size.
constexpr double kTolerance = 0.5 * kScale * 2 + 1e-4;

/// Of second degree about the antimeridian, where each value on a grid of 2 degrees is one that the file
/// holds without rounding; not smooth at Greenwich.
double bowl(double latitude, double longitude) {
    const double d = std::remainder(longitude - 180, 360);
    return 20 + 0.0025 * (d * d + d * latitude - latitude * latitude);
}

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
    std::string path = folder.file(name);
    tinwright_tests::write_bytes(path, content);
    return path;
}

GeographicExtent extent(double west, double east, double south, double north) {
    GeographicExtent made;
    made.west = west;
    made.east = east;
    made.south = south;
    made.north = north;
    made.is_empty = false;
    return made;
}

std::vector<Point3> random_places(std::uint64_t seed, std::size_t count) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> longitude(-180, 180);
    std::uniform_real_distribution<double> latitude(-90, 90);
    std::vector<Point3> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back({longitude(random), latitude(random), 0});
    }
    return places;
}

}  // namespace

TEST_SUITE("io/geoid") {
    TEST_CASE("a geoid of second degree is met exactly, also across the antimeridian") {
        const TemporaryFolder folder;
        const Geoid geoid(write(folder, "bowl.pgm", geoid_file(180, 91, bowl, "bowl")));
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> east_of_it(-170, 170);
        std::uniform_real_distribution<double> latitude(-84, 84);
        for (int i = 0; i < tinwright_tests::cases(300); ++i) {
            const double at = latitude(random);
            const double d = east_of_it(random);
            CAPTURE(at);
            CAPTURE(d);
            const double expected = bowl(at, 180 + d);
            CHECK(geoid.height(at, 180 + d) == doctest::Approx(expected).epsilon(1e-11));
            CHECK(geoid.height(at, d - 180) == doctest::Approx(expected).epsilon(1e-11));
        }
        CHECK(geoid.height(12, 180) == doctest::Approx(bowl(12, 180)).epsilon(1e-12));
        CHECK(geoid.height(12, -180) == geoid.height(12, 180));
    }

    TEST_CASE("a smooth geoid is met to its rounding everywhere, poles included") {
        const TemporaryFolder folder;
        const Geoid geoid(write(folder, "wave.pgm", geoid_file(180, 91, wave, "")));
        for (const Point3& at : random_places(2, 500)) {
            CAPTURE(at.x);
            CAPTURE(at.y);
            CHECK(std::abs(geoid.height(at.y, at.x) - wave(at.y, at.x)) <= kTolerance);
        }
        for (const double pole : {90.0, -90.0}) {
            for (const double longitude : {0.0, 1.3, 90.0, 179.9, -180.0, -77.7}) {
                CAPTURE(longitude);
                CHECK(std::abs(geoid.height(pole, longitude) - wave(pole, longitude)) <= kTolerance);
                const double near = std::copysign(89.7, pole);
                CHECK(std::abs(geoid.height(near, longitude) - wave(near, longitude)) <= kTolerance);
            }
        }
    }

    TEST_CASE("what is no place has no height") {
        const TemporaryFolder folder;
        const Geoid geoid(write(folder, "wave.pgm", geoid_file(180, 91, wave, "")));
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        CHECK(std::isnan(geoid.height(std::numeric_limits<double>::quiet_NaN(), 0)));
        CHECK(std::isnan(geoid.height(0, kInfinity)));
        CHECK(std::isnan(geoid.height(91, 0)));
        CHECK(geoid.height(10, 370) == geoid.height(10, 10));
    }

    TEST_CASE("heights do not depend on what is in memory, nor on threads") {
        const TemporaryFolder folder;
        const std::string path = write(folder, "wave.pgm", geoid_file(180, 91, wave, ""));
        const std::vector<Point3> at = random_places(3, 20000);
        const auto shifted = [&](int threads, const GeographicExtent* area) {
            std::vector<Point3> points = at;
            run_with_threads(threads, [&] {
                Geoid geoid(path);
                if (area != nullptr) {
                    geoid.prepare(*area);
                }
                shift_by_geoid(geoid, at, points, 1, 1);
            });
            return points;
        };
        const std::vector<Point3> expected = shifted(1, nullptr);
        GeographicExtent pole = extent(-180, 180, 80, 90);
        pole.has_pole = true;
        const std::array<GeographicExtent, 7> areas{
            extent(-180, 180, -90, 90), extent(170, 195, -10, 10),  extent(5, 7, 50, 52), pole,
            extent(5, 5, 50, 50),       extent(-180, -170, -90, 0), GeographicExtent()};
        for (const int threads : {1, 4}) {
            CAPTURE(threads);
            CHECK(std::memcmp(shifted(threads, nullptr).data(), expected.data(),
                              expected.size() * sizeof(Point3)) == 0);
            for (const GeographicExtent& area : areas) {
                CAPTURE(area.west);
                CHECK(std::memcmp(shifted(threads, &area).data(), expected.data(),
                                  expected.size() * sizeof(Point3)) == 0);
            }
        }
    }

    TEST_CASE("heights go to the ellipsoid and back, in their unit") {
        const TemporaryFolder folder;
        Geoid geoid(write(folder, "wave.pgm", geoid_file(180, 91, wave, "")));
        geoid.prepare(extent(-180, 180, -90, 90));
        const std::vector<Point3> at = random_places(4, 1000);
        for (const double metres : {1.0, 0.3048, 1200.0 / 3937.0}) {
            CAPTURE(metres);
            std::vector<Point3> points(at.size(), Point3{1, 2, 100});
            shift_by_geoid(geoid, at, points, 1, metres);
            for (std::size_t i = 0; i < at.size(); ++i) {
                CHECK(points[i].x == 1);
                CHECK(points[i].y == 2);
                CHECK(points[i].z == 100 + geoid.height(at[i].y, at[i].x) / metres);
            }
            shift_by_geoid(geoid, at, points, -1, metres);
            for (const Point3& point : points) {
                CHECK(std::abs(point.z - 100) <= 1e-13 * 300);
            }
        }
    }

    TEST_CASE("a shift can be stopped, and one of nothing is none") {
        const TemporaryFolder folder;
        const Geoid geoid(write(folder, "wave.pgm", geoid_file(180, 91, wave, "")));
        std::vector<Point3> points(3);
        CHECK_THROWS_AS(shift_by_geoid(geoid, points, points, 1, 1, [](double) { return false; }), Cancelled);
        shift_by_geoid(geoid, {}, {}, 1, 1);
    }

    TEST_CASE("a geoid is found without its ending") {
        const TemporaryFolder folder;
        const std::string path = write(folder, "egm84-test.pgm", geoid_file(8, 5, wave, ""));
        CHECK(Geoid(path).path() == path);
        CHECK(Geoid(folder.file("egm84-test")).path() == path);
        CHECK(Geoid(path).description().empty());
        CHECK(Geoid(path).vertical_code() == "EPSG:5798");
    }

    TEST_CASE("what a file says it is tells the system of heights") {
        const TemporaryFolder folder;
        const auto code = [&](const std::string& description) {
            return Geoid(write(folder, "g.pgm", geoid_file(8, 5, wave, description))).vertical_code();
        };
        CHECK(code("WGS84 EGM84, 30-minute grid") == "EPSG:5798");
        CHECK(code("WGS84 EGM96, 15-minute grid") == "EPSG:5773");
        CHECK(code("WGS84 EGM2008, 1-minute grid") == "EPSG:3855");
        CHECK(code("a geoid of our own").empty());
        CHECK(Geoid(folder.file("g.pgm")).description() == "a geoid of our own");
    }

    TEST_CASE("a file that is not there is looked for in places that are named") {
        const std::string home = GeographicLib::Geoid::DefaultGeoidPath();
        CHECK(message_of<IoError>([] { const Geoid geoid("no-such-geoid"); }) ==
              R"(geoid "no-such-geoid": no such file; looked for "no-such-geoid", "no-such-geoid.pgm", ")" +
                  home +
                  R"(/no-such-geoid.pgm"; give its path, or its folder in the environment variable )"
                  "GEOGRAPHICLIB_GEOID_PATH");
        const TemporaryFolder folder;
        const std::string path = folder.file("none.pgm");
        CHECK(message_of<IoError>([&] { const Geoid geoid(path); })
                  .starts_with("geoid \"" + path + "\": no such file; looked for \"" + path +
                               "\"; give its path"));
        CHECK(message_of<IoError>([&] { const Geoid geoid(folder.path()); }).find("no such file") !=
              std::string::npos);
        CHECK(message_of<IoError>([] { const Geoid geoid(""); }).starts_with(R"(geoid "": no such file)"));
    }

    TEST_CASE("a file that is no geoid is refused on one line") {
        const TemporaryFolder folder;
        const std::string good = geoid_file(8, 5, wave, "x");
        const auto message = [&](const std::string& content) {
            const std::string path = write(folder, "g.pgm", content);
            const std::string text = message_of<IoError>([&] { const Geoid geoid(path); });
            CHECK(text.starts_with("geoid \"" + path + "\": cannot be read as a geoid: "));
            CHECK(text.ends_with("; give one of GeographicLib's, for example egm2008-1.pgm"));
            CHECK(text.find('\n') == std::string::npos);
            return text;
        };
        CHECK(message(good.substr(0, good.size() - 3)).find("wrong length") != std::string::npos);
        CHECK(message("P6" + good.substr(2)).find("not in PGM format") != std::string::npos);
        message("");
        message("P5\n");
        message("P5\n# Offset -200\n# Scale 0.01\n");
        message(geoid_file(7, 5, wave, "odd width"));
        message(geoid_file(8, 4, wave, "even height"));
        std::string eight_bits = good;
        eight_bits.replace(eight_bits.find("65535"), 5, "00255");
        message(eight_bits);
        CHECK(message_of<IoError>([&] {
                  const Geoid geoid(write(folder, "g.tif", good));
              }).ends_with(R"(: a geoid's file is named ".pgm"; give one of GeographicLib's)"));
    }

    TEST_CASE("a file that goes away while it is read is an error") {
        const TemporaryFolder folder;
        const std::string path = write(folder, "g.pgm", geoid_file(8, 5, wave, ""));
        Geoid geoid(path);
        CHECK(geoid.height(0, 0) > 0);
        std::filesystem::remove(path);
        CHECK(message_of<IoError>([&] {
                  geoid.prepare(extent(0, 10, 0, 10));
              }).starts_with("geoid \"" + path + "\": cannot be read as a geoid: "));
    }
}
