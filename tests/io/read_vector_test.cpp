#include "tinwright/io/read_vector.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <doctest/doctest.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/vector_arrow.hpp"
#include "tinwright/io/vector_features.hpp"

#include "reading.hpp"
#include "vector_files.hpp"

using tinwright::InputError;
using tinwright::Point3;
using tinwright::UsageError;
using namespace tinwright::io;
using tinwright_tests::add_feature;
using tinwright_tests::MemoryFile;
using tinwright_tests::message_of;
using tinwright_tests::read;
using tinwright_tests::VectorFile;

namespace {

using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

void add_point(OGRLayer& layer, const Point3& p) {
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetGeometryDirectly(new OGRPoint(p.x, p.y, p.z));
    REQUIRE(layer.CreateFeature(&feature) == OGRERR_NONE);
}

std::vector<Point3> random_points(int count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 1e6);
    std::vector<Point3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back({coordinate(random), coordinate(random), coordinate(random)});
    }
    return points;
}

struct Both {
    bool is_fast = false;
    std::vector<Point3> arrow;
    std::vector<Point3> features;
    std::vector<std::int64_t> arrow_ids;
    std::vector<std::int64_t> feature_ids;
};

/// The only layer of a file read both ways.
Both read_both_ways(const std::string& path, VectorPlan plan = {}) {
    const GdalMessages messages;
    const Source source = parse_source(path);
    const ReadOptions options;
    const SliceRequest request{source, path, "file", options, {}};
    const Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    REQUIRE(dataset != nullptr);
    plan.layer = dataset->GetLayer(0);
    plan.where = "layer";
    Both both;
    RawSlice fast(SampleSlice::Kind::Vector, false);
    RawSlice slow(SampleSlice::Kind::Vector, false);
    both.is_fast = read_arrow(plan, request, both.arrow, fast);
    read_features(plan, request, both.features, slow);
    both.arrow_ids = fast.ids.all();
    both.feature_ids = slow.ids.all();
    return both;
}

}  // namespace

TEST_SUITE("io/read_vector") {
    TEST_CASE("points come back bit for bit from every format that keeps z") {
        for (const auto& form : std::vector<std::pair<std::string, std::string>>{{"GPKG", "p.gpkg"},
                                                                                 {"ESRI Shapefile", "p.shp"},
                                                                                 {"FlatGeobuf", "p.fgb"},
                                                                                 {"SQLite", "p.sqlite"}}) {
            const std::string driver = form.first;
            CAPTURE(driver);
            VectorFile file(driver, form.second);
            const std::vector<Point3> points = random_points(1000, 5);
            OGRLayer& layer = file.add_layer("p", wkbPoint25D, "EPSG:3067", {{"h", OFTReal}});
            for (const Point3& p : points) {
                add_point(layer, p);
            }
            const Samples samples = read(file.close());
            CHECK(samples.crs.code() == "EPSG:3067");
            if (driver == "FlatGeobuf") {  // its spatial index changes the order
                CHECK(samples.points.size() == points.size());
                for (const Point3& p : points) {
                    CHECK(std::find(samples.points.begin(), samples.points.end(), p) != samples.points.end());
                }
            } else {
                CHECK(samples.points == points);
            }
        }
    }

    TEST_CASE("GeoJSON points are read with their z and ids") {
        const MemoryFile file(
            "p.geojson",
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":)"
            R"("urn:ogc:def:crs:EPSG::3067"}},"features":[{"type":"Feature","id":7,"properties":{},)"
            R"("geometry":{"type":"Point","coordinates":[1.5,2.5,3.5]}},{"type":"Feature","id":3,)"
            R"("properties":{},"geometry":{"type":"MultiPoint","coordinates":[[4,5,6],[7,8,9]]}}]})");
        const Samples samples = read(file.path());
        CHECK(samples.points == std::vector<Point3>{{1.5, 2.5, 3.5}, {4, 5, 6}, {7, 8, 9}});
        CHECK(samples.slices[0].ids == std::vector<std::int64_t>{7, 3, 3});
        CHECK(samples.describe(2) == R"(file "/vsimem/p.geojson", layer "p", feature 3)");
    }

    TEST_CASE("the Arrow stream and the feature loop give the same samples") {
        for (const int fields : {0, 1, 3}) {
            for (const char* const driver : {"GPKG", "FlatGeobuf"}) {
                CAPTURE(fields);
                CAPTURE(driver);
                VectorFile file(driver, "both");
                std::vector<std::pair<std::string, OGRFieldType>> names;
                for (int f = 0; f < fields; ++f) {
                    names.emplace_back(std::string(1, static_cast<char>('a' + f)),
                                       f == 1 ? OFTReal : OFTString);
                }
                OGRLayer& layer = file.add_layer("both", wkbPoint25D, "EPSG:3067", names);
                for (const Point3& p : random_points(150000 / (fields + 1), 9)) {
                    add_point(layer, p);
                }
                const Both both = read_both_ways(file.close());
                CHECK(both.is_fast);
                CHECK(both.arrow.size() == static_cast<std::size_t>(150000 / (fields + 1)));
                CHECK(both.arrow == both.features);
                CHECK(both.arrow_ids == both.feature_ids);
            }
        }
    }

    TEST_CASE("both ways agree on z from fields of every numeric type, and on deleted features") {
        for (const OGRFieldType type : {OFTReal, OFTInteger, OFTInteger64}) {
            VectorFile file("GPKG", "z.gpkg");
            OGRLayer& layer = file.add_layer("z", wkbPoint, nullptr, {{"name", OFTString}, {"h", type}});
            for (int i = 0; i < 100; ++i) {
                const std::string wkt = std::string("POINT (").append(std::to_string(i)).append(" 2)");
                const std::string h = std::to_string(100 - 3 * i);
                add_feature(layer, wkt.c_str(), {"n", h.c_str()});
            }
            REQUIRE(layer.DeleteFeature(17) == OGRERR_NONE);
            const Both both = [&] {
                VectorPlan plan;
                plan.z_field = 1;
                return read_both_ways(file.close(), plan);
            }();
            CHECK(both.is_fast);
            REQUIRE(both.arrow.size() == 99);
            CHECK(both.arrow.back() == Point3{99, 2, -197});
            CHECK(both.arrow == both.features);
            CHECK(both.arrow_ids == both.feature_ids);
            CHECK(both.arrow_ids[16] == 18);
        }
    }

    TEST_CASE("a missing geometry sends the reader to the feature loop, which names it") {
        VectorFile file("GPKG", "hole.gpkg");
        OGRLayer& layer = file.add_layer("hole", wkbPoint25D);
        add_feature(layer, "POINT Z (1 2 3)");
        add_feature(layer, nullptr);
        add_feature(layer, "POINT Z EMPTY");
        add_feature(layer, "POINT Z (4 5 6)");
        const std::string path = file.close();
        CHECK(
            message_of<InputError>([&] { read(path); }) ==
            R"(file "/vsimem/hole.gpkg", layer "hole", feature 2: has no geometry; --skip-bad goes on without it)");
        ReadOptions options;
        options.skip_bad = true;
        const Samples samples = read(path, options);
        CHECK(samples.points == std::vector<Point3>{{1, 2, 3}, {4, 5, 6}});
        CHECK(samples.slices[0].skipped == 2);
        CHECK(samples.slices[0].ids == std::vector<std::int64_t>{1, 4});
    }

    TEST_CASE("coordinates that are not finite are unusable") {
        VectorFile file("GPKG", "nan.gpkg");
        OGRLayer& layer = file.add_layer("nan", wkbPoint25D);
        add_point(layer, {1, 2, 3});
        add_point(layer, {1, 2, std::numeric_limits<double>::quiet_NaN()});
        CHECK(message_of<InputError>([&] { read(file.close()); }) ==
              R"(file "/vsimem/nan.gpkg", layer "nan", feature 2: has a coordinate that is not finite; )"
              "--skip-bad goes on without it");
    }

    TEST_CASE("points without z ask for it and list the numeric fields") {
        VectorFile file("GPKG", "flat.gpkg");
        OGRLayer& layer = file.add_layer("flat", wkbPoint, nullptr,
                                         {{"name", OFTString}, {"h", OFTReal}, {"n", OFTInteger}});
        add_feature(layer, "POINT (1 2)", {"a", "3.5", "7"});
        add_feature(layer, "POINT (4 5)", {"12.25", "6.5", nullptr});
        const std::string path = file.close();
        CHECK(message_of<InputError>([&] { read(path); }) ==
              R"(file "/vsimem/flat.gpkg", layer "flat": the geometries have no z; give z=FIELD or z=NUMBER )"
              R"((numeric fields: "h", "n"))");
        CHECK(read(path + ",z=h").points == std::vector<Point3>{{1, 2, 3.5}, {4, 5, 6.5}});
        CHECK(read(path + ",z=H").points == std::vector<Point3>{{1, 2, 3.5}, {4, 5, 6.5}});
        CHECK(read(path + ",z=-4.5").points == std::vector<Point3>{{1, 2, -4.5}, {4, 5, -4.5}});
        CHECK(
            message_of<InputError>([&] { read(path + ",z=n"); }) ==
            R"(file "/vsimem/flat.gpkg", layer "flat", feature 2: field "n" is empty; --skip-bad goes on without it)");
        CHECK(message_of<InputError>([&] { read(path + ",z=name"); }) ==
              R"(file "/vsimem/flat.gpkg", layer "flat", feature 1: field "name" is no number: "a"; )"
              "--skip-bad goes on without it");
        CHECK(
            message_of<InputError>([&] { read(path + ",z=height"); }) ==
            R"(file "/vsimem/flat.gpkg", layer "flat": no field "height" for z=; the fields are "name", "h", "n")");
        ReadOptions options;
        options.skip_bad = true;
        CHECK(read(path + ",z=name", options).points == std::vector<Point3>{{4, 5, 12.25}});
    }

    TEST_CASE("lines and polygons give their vertices when asked") {
        VectorFile file("GPKG", "lines.gpkg");
        OGRLayer& layer = file.add_layer("lines", wkbUnknown);
        add_feature(layer, "LINESTRING Z (0 0 1,1 0 2,1 1 3)");
        add_feature(layer, "POLYGON Z ((0 0 1,4 0 1,4 4 1,0 0 1),(1 1 2,2 1 2,2 2 2,1 1 2))");
        add_feature(layer, "LINESTRING ZM (5 5 1 9,6 5 1 9,6 6 1 9,5 5 1 9)");
        add_feature(layer, "LINESTRING Z (7 7 1,8 7 1,7 7 2)");  // closes at another height: kept
        add_feature(layer, "GEOMETRYCOLLECTION Z (POINT Z (9 9 9),MULTILINESTRING Z ((0 9 1,1 9 1)))");
        add_feature(layer, "TIN Z (((20 0 0,21 0 0,20 1 0,20 0 0)))");
        const std::string path = file.close();
        CHECK(
            message_of<InputError>([&] { read(path); }) ==
            R"(file "/vsimem/lines.gpkg", layer "lines", feature 1: is a LINESTRING, no point; vertices=yes takes )"
            "its vertices; --skip-bad goes on without it");
        const Samples samples = read(path + ",vertices=yes");
        CHECK(samples.points == std::vector<Point3>{{0, 0, 1},  {1, 0, 2},  {1, 1, 3},  // 1
                                                    {0, 0, 1},  {4, 0, 1},  {4, 4, 1},
                                                    {1, 1, 2},  {2, 1, 2},  {2, 2, 2},     // 2
                                                    {5, 5, 1},  {6, 5, 1},  {6, 6, 1},     // 3
                                                    {7, 7, 1},  {8, 7, 1},  {7, 7, 2},     // 4
                                                    {9, 9, 9},  {0, 9, 1},  {1, 9, 1},     // 5
                                                    {20, 0, 0}, {21, 0, 0}, {20, 1, 0}});  // 6
        CHECK(samples.slices[0].id(8) == 2);
        CHECK(samples.slices[0].id(9) == 3);
    }

    TEST_CASE("a layer of lines says what to do before anything is read") {
        VectorFile file("GPKG", "contours.gpkg");
        OGRLayer& layer = file.add_layer("contours", wkbMultiLineString, nullptr, {{"ELEV", OFTReal}});
        add_feature(layer, "MULTILINESTRING ((0 0,1 0,1 1))", {"25"});
        const std::string path = file.close();
        CHECK(message_of<InputError>([&] { read(path); }) ==
              R"(file "/vsimem/contours.gpkg", layer "contours": has Multi Line String features, no points; )"
              "vertices=yes takes their vertices");
        CHECK(
            message_of<InputError>([&] { read(path + ",vertices=yes"); }) ==
            R"(file "/vsimem/contours.gpkg", layer "contours": the geometries have no z; give z=FIELD or z=NUMBER )"
            R"((numeric fields: "ELEV"))");
        CHECK(read(path + ",vertices=yes,z=elev").points ==
              std::vector<Point3>{{0, 0, 25}, {1, 0, 25}, {1, 1, 25}});
    }

    TEST_CASE("arcs are taken by points on them") {
        VectorFile file("GPKG", "arc.gpkg");
        OGRLayer& layer = file.add_layer("arc", wkbUnknown);
        add_feature(layer, "CIRCULARSTRING Z (1 0 5,0 1 5,-1 0 5)");
        const Samples samples = read(file.close() + ",vertices=yes");
        CHECK(samples.points.size() > 20);
        for (const Point3& p : samples.points) {
            CHECK(std::abs(std::hypot(p.x, p.y) - 1) < 1e-12);
            CHECK(p.z == 5);
        }
    }

    TEST_CASE("of several layers the one with samples is taken, or one must be named") {
        VectorFile file("GPKG", "several.gpkg");
        add_feature(file.add_layer("lines", wkbLineString25D), "LINESTRING Z (0 0 1,1 0 2)");
        add_feature(file.add_layer("points", wkbPoint25D), "POINT Z (1 2 3)");
        const std::string path = file.close();
        CHECK(read(path).points == std::vector<Point3>{{1, 2, 3}});
        CHECK(read(path + ",layer=points").slices[0].layer == "points");
        CHECK(read(path + ",layer=lines,vertices=yes").points.size() == 2);
        CHECK(
            message_of<InputError>([&] { read(path + ",vertices=yes"); }) ==
            R"(file "/vsimem/several.gpkg": several layers may have samples; choose one of "lines", "points" with )"
            "layer=");
        CHECK(message_of<InputError>([&] { read(path + ",layer=none"); }) ==
              R"(file "/vsimem/several.gpkg": no layer "none"; the layers are "lines", "points")");
    }

    TEST_CASE("where= and sql= select features") {
        VectorFile file("GPKG", "w.gpkg");
        OGRLayer& layer =
            file.add_layer("w", wkbPoint25D, "EPSG:3067", {{"kind", OFTString}, {"h", OFTReal}});
        add_feature(layer, "POINT Z (1 2 3)", {"ground", "30"});
        add_feature(layer, "POINT Z (4 5 6)", {"tree", "60"});
        add_feature(layer, "POINT Z (7 8 9)", {"ground", "90"});
        const std::string path = file.close();
        const std::vector<Point3> ground = {{1, 2, 3}, {7, 8, 9}};
        CHECK(read(path + ",where=kind = 'ground'").points == ground);
        CHECK(read(path + ",where=kind IN ('ground','x')").slices[0].ids == std::vector<std::int64_t>{1, 3});
        CHECK(read(path + ",sql=SELECT * FROM w WHERE kind = 'ground'").points == ground);
        CHECK(read(path + ",where=kind = 'ground',z=h").points[1].z == 90);
        CHECK(message_of<InputError>([&] { read(path + ",where=kind = 'none'"); }) ==
              R"(file "/vsimem/w.gpkg", layer "w": no samples)");
        CHECK(message_of<InputError>([&] { read(path + ",where=nonsense ="); })
                  .starts_with(
                      R"(file "/vsimem/w.gpkg", layer "w": where="nonsense =" cannot be used; GDAL says: )"));
        CHECK(message_of<InputError>([&] {
                  read(path + ",sql=SELECT nothing");
              }).starts_with(R"(file "/vsimem/w.gpkg": sql="SELECT nothing" gives no table; GDAL says: )"));
    }

    TEST_CASE("tables give positions by their fields") {
        VectorFile file("GPKG", "table.gpkg");
        OGRLayer& layer = file.add_layer("table", wkbNone, nullptr,
                                         {{"easting", OFTReal}, {"northing", OFTString}, {"z", OFTReal}});
        add_feature(layer, nullptr, {"1.5", "2.5", "3.5"});
        add_feature(layer, nullptr, {"4", " 5 ", "6"});
        const std::string path = file.close();
        const std::vector<Point3> points = {{1.5, 2.5, 3.5}, {4, 5, 6}};
        CHECK(read(path).points == points);
        CHECK(read(path + ",xfield=easting,yfield=northing,z=z").points == points);
        CHECK(read(path + ",xfield=z,yfield=northing,z=easting").points ==
              std::vector<Point3>{{3.5, 2.5, 1.5}, {6, 5, 4}});
        CHECK(message_of<UsageError>([&] { read(path + ",xfield=easting"); }) ==
              R"(file "/vsimem/table.gpkg": xfield= and yfield= go together)");
        const MemoryFile csv("t.csv", "a,b,c\n1,2,3\n");
        CHECK(read(csv.path() + ",layer=t,xfield=a,yfield=b,z=c").points == std::vector<Point3>{{1, 2, 3}});
        CHECK(message_of<InputError>([&] { read(csv.path() + ",layer=t"); }) ==
              R"(file "/vsimem/t.csv", layer "t": a table without geometries; give xfield=, yfield= and z= )"
              R"((fields: "a", "b", "c"))");
    }

    TEST_CASE("reading is cancelled from the progress callback, by either way") {
        ReadOptions options;
        options.progress = [](double) { return false; };
        VectorFile file("GPKG", "c.gpkg");
        add_feature(file.add_layer("c", wkbPoint25D), "POINT Z (1 2 3)");
        CHECK_THROWS_AS(read(file.close(), options), tinwright::Cancelled);
        VectorFile shapes("ESRI Shapefile", "c.shp");
        OGRLayer& layer = shapes.add_layer("c", wkbPoint25D);
        for (const Point3& p : random_points(20000, 1)) {
            add_point(layer, p);
        }
        CHECK_THROWS_AS(read(shapes.close(), options), tinwright::Cancelled);
    }

    TEST_CASE("GeoPackage's undefined systems are no CRS") {
        VectorFile file("GPKG", "u.gpkg");
        add_feature(file.add_layer("u", wkbPoint25D), "POINT Z (1 2 3)");
        CHECK_FALSE(read(file.close()).crs.is_known());
    }

    TEST_CASE("what GDAL does not know is refused on one line") {
        const MemoryFile file("letter.doc", "Dear Sir,\nplease find\n");
        const std::string text = message_of<tinwright::IoError>([&] { read(file.path()); });
        CHECK(text.starts_with(
            R"(cannot open file "/vsimem/letter.doc": neither a raster nor a vector layer nor )"
            "rows of numbers; GDAL says: "));
        CHECK(text.find('\n') == std::string::npos);
    }
}
