#include "tinwright/io/write_graph.hpp"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using namespace tinwright_tests;

namespace {

const std::vector<GraphLine> kLines{{{600000.1, 5700000.3, 1.7}, {600003.1, 5700004.3, -2.25}, 5},
                                    {{600000.1, 5700000.3, 1.7}, {599999.975, 5700000.3, 103.5}, 0.125},
                                    {{600003.1, 5700004.3, -2.25}, {600003.1, 5700014.4, 0}, 10.1}};

const char* const kFormats[] = {"gpkg", "shp", "fgb", "gml", "sqlite", "csv", "geojson"};

struct OpenFile {
    explicit OpenFile(const std::string& path)
        : dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR)),
          layer(dataset ? dataset->GetLayer(0) : nullptr) {}
    GDALDatasetUniquePtr dataset;
    OGRLayer* layer;
};

void check_point(const OGRLineString& line, int i, const Point3& expected, double tolerance) {
    CHECK(std::abs(line.getX(i) - expected.x) <= tolerance);
    CHECK(std::abs(line.getY(i) - expected.y) <= tolerance);
    CHECK(line.getZ(i) == expected.z);
}

}  // namespace

TEST_SUITE("io/write_graph") {
    TEST_CASE("edges come back from every format, to the bit where it keeps all digits") {
        register_drivers();
        const TemporaryFolder folder;
        for (const std::string format : kFormats) {
            CAPTURE(format);
            const std::string path = folder.file(format + "_graph." + format);
            check_graph_target(path, {});
            const WrittenGraph written = write_graph(kLines, Crs::parse("EPSG:32632"), path, {});
            CHECK(written.features == kLines.size());
            CHECK(written.warnings.empty());
            const OpenFile file(path);
            REQUIRE(file.layer != nullptr);
            std::vector<bool> is_there(kLines.size());
            for (const auto& feature : *file.layer) {
                // FlatGeobuf has features in the order of its index.
                const auto id = static_cast<std::size_t>(feature->GetFieldAsInteger("id"));
                REQUIRE(id < kLines.size());
                CHECK((format == "fgb" || !is_there[id]));
                is_there[id] = true;
                CHECK(feature->GetFieldAsDouble("length") == kLines[id].length);
                REQUIRE(feature->GetGeometryRef() != nullptr);
                const OGRLineString& line = *feature->GetGeometryRef()->toLineString();
                REQUIRE(line.getNumPoints() == 2);
                const double tolerance = format == "gml" ? 1e-7 : 0;
                check_point(line, 0, kLines[id].from, tolerance);
                check_point(line, 1, kLines[id].to, tolerance);
            }
            CHECK(is_there == std::vector<bool>(kLines.size(), true));
        }
    }

    TEST_CASE("edges keep their order") {
        register_drivers();
        const TemporaryFolder folder;
        const std::string path = folder.file("graph.gpkg");
        static_cast<void>(write_graph(kLines, Crs(), path, {}));
        const OpenFile file(path);
        REQUIRE(file.layer != nullptr);
        CHECK(std::string(file.layer->GetName()) == "graph");
        int next = 0;
        for (const auto& feature : *file.layer) {
            CHECK(feature->GetFieldAsInteger("id") == next++);
        }
        CHECK(next == 3);
    }

    TEST_CASE("the same edges make the same bytes, and what is said of them stays with them") {
        register_drivers();
        const TemporaryFolder folder;
        WriteGraphOptions options;
        options.layer_name = "tree";
        options.metadata = {{"TINWRIGHT_OPTIONS", "--graph mst"}};
        const std::string first = folder.file("a.gpkg");
        static_cast<void>(write_graph(kLines, Crs::parse("EPSG:32632"), first, options));
        const std::string bytes = read_bytes(first);
        options.overwrite = true;
        static_cast<void>(write_graph(kLines, Crs::parse("EPSG:32632"), first, options));
        CHECK(read_bytes(first) == bytes);
        const OpenFile file(first);
        REQUIRE(file.layer != nullptr);
        CHECK(std::string(file.layer->GetName()) == "tree");
        REQUIRE(file.layer->GetMetadataItem("TINWRIGHT_OPTIONS") != nullptr);
        CHECK(std::string(file.layer->GetMetadataItem("TINWRIGHT_OPTIONS")) == "--graph mst");
    }

    TEST_CASE("formats that lose elevations or positions are refused before there is anything to write") {
        register_drivers();
        CHECK(
            message_of<UsageError>([] { check_graph_target("a.foo", {}); }) ==
            "no vector driver for \"a.foo\": unknown extension .foo; name one with --of, or use .gpkg, .shp, "
            ".fgb, .gml, .sqlite, .csv or .geojson");
        WriteGraphOptions kml;
        kml.driver = "KML";
        CHECK(message_of<UsageError>([&] { check_graph_target("a.kml", kml); }) ==
              "driver \"KML\" does not keep the positions of graphs; use .gpkg, .shp, .fgb, .gml, .sqlite, "
              ".csv or .geojson");
        WriteGraphOptions mapinfo;
        mapinfo.driver = "MapInfo File";
        CHECK(message_of<UsageError>([&] { check_graph_target("a.tab", mapinfo); }) ==
              "driver \"MapInfo File\" does not keep the positions of graphs; use .gpkg, .shp, .fgb, .gml, "
              ".sqlite, "
              ".csv or .geojson");
        WriteGraphOptions flat;
        flat.layer_options = {"SHPT=ARC"};
        CHECK(
            message_of<UsageError>([&] { check_graph_target("a.shp", flat); }) ==
            "driver \"ESRI Shapefile\" loses the elevations of graphs; use .gpkg, .shp, .fgb, .gml, .sqlite, "
            ".csv or .geojson");
    }

    TEST_CASE("a file that exists is not replaced without being told so, and nothing is left beside it") {
        register_drivers();
        const TemporaryFolder folder;
        const std::string path = folder.file("graph.geojson");
        static_cast<void>(write_graph(kLines, Crs(), path, {}));
        const std::string before = read_bytes(path);
        CHECK_THROWS_AS(write_graph(std::span(kLines).first(1), Crs(), path, {}), IoError);
        CHECK(read_bytes(path) == before);
        WriteGraphOptions options;
        options.overwrite = true;
        CHECK(write_graph(std::span(kLines).first(1), Crs(), path, options).features == 1);
        CHECK(read_bytes(path) != before);
        CHECK(folder.names() == std::set<std::string>{"graph.geojson"});
    }

    TEST_CASE("cancelled writing leaves nothing, and an older file as it was") {
        register_drivers();
        const TemporaryFolder folder;
        const std::string path = folder.file("graph.gpkg");
        const std::vector<GraphLine> many(5000, kLines.front());
        WriteGraphOptions options;
        options.progress = [](double done) { return done == 0; };
        CHECK_THROWS_AS(write_graph(many, Crs(), path, options), Cancelled);
        CHECK(folder.names().empty());
        static_cast<void>(write_graph(kLines, Crs(), path, {}));
        const std::string before = read_bytes(path);
        options.overwrite = true;
        CHECK_THROWS_AS(write_graph(many, Crs(), path, options), Cancelled);
        CHECK(read_bytes(path) == before);
        CHECK(folder.names() == std::set<std::string>{"graph.gpkg"});
    }

    TEST_CASE("a graph without edges is a layer") {
        register_drivers();
        const TemporaryFolder folder;
        const std::string path = folder.file("none.gpkg");
        CHECK(write_graph({}, Crs(), path, {}).features == 0);
        const OpenFile file(path);
        REQUIRE(file.layer != nullptr);
        CHECK(file.layer->GetFeatureCount() == 0);
    }
}
