#include "tinwright/io/read_samples.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/sample_ids.hpp"
#include "tinwright/io/transform_points.hpp"

#include "reading.hpp"

using tinwright::InputError;
using tinwright::Point3;
using tinwright::UsageError;
using namespace tinwright::io;
using tinwright_tests::MemoryFile;
using tinwright_tests::message_of;
using tinwright_tests::read;
using tinwright_tests::read_all;

namespace {

ReadOptions working_in(const char* crs) {
    ReadOptions options;
    options.crs = Crs::parse(crs);
    return options;
}

}  // namespace

TEST_SUITE("io/read_samples") {
    TEST_CASE("sources stand one after the other, and samples know theirs") {
        const MemoryFile a("a.xyz", "1 2 3\n4 5 6\n");
        const MemoryFile b("b.csv", "x,y,z\n7,8,9\n");
        const Samples samples = read_all({a.path(), b.path()});
        CHECK(samples.points == std::vector<Point3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
        REQUIRE(samples.slices.size() == 2);
        CHECK(samples.slices[1].first == 2);
        CHECK(samples.slices[1].source == 1);
        CHECK(samples.describe(1) == R"(file "/vsimem/a.xyz", line 2)");
        CHECK(samples.describe(2) == R"(file "/vsimem/b.csv", line 2)");
        CHECK(samples.describe(3) == "sample 3");
        CHECK_FALSE(samples.crs.is_known());
        CHECK(samples.warnings.empty());
        CHECK(samples.seconds > 0);
    }

    TEST_CASE("the CRS that the samples share is the one to work in") {
        const MemoryFile a("a.xyz", "1 2 3\n");
        const Samples samples = read_all({a.path() + ",crs=EPSG:3067", a.path() + ",crs=EPSG:3067"});
        CHECK(samples.crs.code() == "EPSG:3067");
        CHECK(samples.warnings.empty());
    }

    TEST_CASE("two systems without --crs are an error that names both") {
        const MemoryFile a("a.xyz", "1 2 3\n");
        CHECK(message_of<InputError>([&] {
                  read_all({a.path() + ",crs=EPSG:3067", a.path() + ",crs=EPSG:3875"});
              }) ==
              R"(file "/vsimem/a.xyz" is in EPSG:3067 (ETRS89 / TM35FIN(E,N)), file "/vsimem/a.xyz" in )"
              "EPSG:3875 (ETRS89 / GK21FIN); give the system to work in with --crs");
    }

    TEST_CASE("sources without CRS take the working one, with one warning") {
        const MemoryFile a("a.xyz", "1 2 3\n");
        const MemoryFile b("b.xyz", "1 2 3\n");
        const Samples two = read_all({a.path(), a.path() + ",crs=EPSG:3067", b.path()});
        CHECK(two.crs.code() == "EPSG:3067");
        CHECK(two.warnings ==
              std::vector<std::string>{R"(files "/vsimem/a.xyz", "/vsimem/b.xyz": have no CRS; )"
                                       "taken to be in EPSG:3067 (ETRS89 / TM35FIN(E,N))"});
        const Samples one = read(a.path(), working_in("EPSG:3067"));
        CHECK(one.points == std::vector<Point3>{{1, 2, 3}});
        CHECK(one.warnings == std::vector<std::string>{R"(file "/vsimem/a.xyz": has no CRS; taken to be in )"
                                                       "EPSG:3067 (ETRS89 / TM35FIN(E,N))"});
    }

    TEST_CASE("--source-crs is for sources that carry none") {
        const MemoryFile a("a.xyz", "500000 6700000 3\n");
        ReadOptions options;
        options.source_crs = Crs::parse("EPSG:3067");
        CHECK(read(a.path(), options).crs.code() == "EPSG:3067");
        CHECK(read(a.path(), options).warnings.empty());
        CHECK(read(a.path() + ",crs=EPSG:3875", options).crs.code() == "EPSG:3875");
    }

    TEST_CASE("samples in another system are transformed to the working one") {
        const MemoryFile degrees("d.csv", "lon,lat,z\n27,60.5,12.5\n");  // on the central meridian
        const Samples samples = read(degrees.path() + ",crs=EPSG:4326", working_in("EPSG:32635"));
        REQUIRE(samples.points.size() == 1);
        CHECK(std::abs(samples.points[0].x - 500000) < 1e-6);
        CHECK(samples.points[0].y > 6.70e6);
        CHECK(samples.points[0].y < 6.71e6);
        CHECK(samples.points[0].z == 12.5);
        CHECK(samples.crs.code() == "EPSG:32635");
    }

    TEST_CASE("a transformation there and back returns to where it began") {
        std::vector<Point3> points;
        for (int i = 0; i < 100000; ++i) {  // more than one block
            points.push_back({380000.0 + i, 6670000.0 + 2 * i, 0.001 * i});
        }
        const std::vector<Point3> before = points;
        const Crs utm = Crs::parse("EPSG:3067");
        const Crs gauss = Crs::parse("EPSG:3875");
        CHECK(transform_points(points, utm, gauss).empty());
        CHECK(points[0].x > 2e7);
        CHECK(transform_points(points, gauss, utm).empty());
        for (std::size_t i = 0; i < points.size(); ++i) {
            REQUIRE(std::hypot(points[i].x - before[i].x, points[i].y - before[i].y) < 1e-4);
            REQUIRE(points[i].z == before[i].z);
        }
    }

    TEST_CASE("a point that cannot be transformed is named, or skipped") {
        const MemoryFile file("far.csv", "lon,lat,z\n27,60.5,1\n27,95,2\n27,61,3\n");
        ReadOptions options = working_in("EPSG:32635");
        CHECK(message_of<InputError>([&] { read(file.path() + ",crs=EPSG:4326", options); }) ==
              R"(file "/vsimem/far.csv", line 3: (27, 95) is no longitude and latitude; is EPSG:4326 )"
              "(WGS 84) the right CRS?; --skip-bad goes on without it");
        options.skip_bad = true;
        const Samples samples = read(file.path() + ",crs=EPSG:4326", options);
        CHECK(samples.points.size() == 2);
        CHECK(samples.slices[0].skipped == 1);
        CHECK(samples.slices[0].ids == std::vector<std::int64_t>{2, 4});
    }

    TEST_CASE("columns called longitude and latitude are never taken for metres") {
        const MemoryFile file("g.csv", "lon,lat,z\n27,60.5,1\n");
        const std::string refusal =
            R"(file "/vsimem/g.csv": coordinates are longitude and latitude in an unknown system; give theirs, for )"
            "example crs=EPSG:4326";
        CHECK(message_of<InputError>([&] { read(file.path()); }) == refusal);
        CHECK(message_of<InputError>([&] { read(file.path(), working_in("EPSG:32635")); }) == refusal);
        ReadOptions options = working_in("EPSG:32635");
        options.source_crs = Crs::parse("EPSG:4326");
        CHECK(std::abs(read(file.path(), options).points[0].x - 500000) < 1e-6);
    }

    TEST_CASE("the unit of z comes from the vertical part of the CRS") {
        const MemoryFile file("a.xyz", "1 2 3\n");
        CHECK(read(file.path() + ",crs=EPSG:3067+3900").z_unit == "metre");
        CHECK(read(file.path() + ",crs=EPSG:3067").z_unit.empty());
    }

    TEST_CASE("what samples cannot be is refused") {
        const MemoryFile file("a.xyz", "1 2 3\n");
        CHECK(
            message_of<UsageError>([&] { read(file.path() + ",z=drape"); }) ==
            R"(source "/vsimem/a.xyz": samples need elevations of their own; give z=geometry, a field or a number)");
        CHECK(message_of<UsageError>([&] { read(file.path() + ",as=tin"); }) ==
              R"(source "/vsimem/a.xyz": as=tin does not go with other samples)");
        CHECK(message_of<UsageError>([&] {
                  read(file.path() + ",crs=nonsense");
              }).starts_with(R"(CRS "nonsense": not understood)"));
    }

    TEST_CASE("ids are kept by runs and come back whole") {
        SampleIds ids;
        ids.add(5);
        ids.add(6);
        CHECK(ids.is_one_run());
        ids.add(9);
        ids.add_run(20, 3);
        SampleIds more;
        more.add_run(0, 2);
        ids.append(more, 30);
        CHECK(ids.all() == std::vector<std::int64_t>{5, 6, 9, 20, 21, 22, 30, 31});
        CHECK_FALSE(ids.is_one_run());
        ids.erase({0, 3, 7});
        CHECK(ids.all() == std::vector<std::int64_t>{6, 9, 21, 22, 30});
    }
}
