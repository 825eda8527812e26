#include "tinwright/io/write_lines.hpp"

#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::message_of;
using tinwright_tests::read_bytes;
using tinwright_tests::TemporaryFolder;

namespace {

constexpr double kNoZ = std::numeric_limits<double>::quiet_NaN();

/// A GeoJSON file of features with the attributes `n` (1, 2, ...), `fid` (a text), and `rate` (empty in the
/// second).
std::string write_source(const TemporaryFolder& folder, const std::vector<std::string>& geometries) {
    const std::string path = folder.file("source.geojson");
    std::ofstream file(path);
    file << R"({"type":"FeatureCollection","features":[)";
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        file << (i == 0 ? "" : ",") << R"({"type":"Feature","id":)" << 10 * (i + 1)
             << R"(,"properties":{"n":)" << i + 1 << R"(,"fid":"text","rate":)" << (i == 1 ? "null" : "0.5")
             << R"(},"geometry":)" << geometries[i] << "}";
    }
    file << "]}";
    return path;
}

const std::string kLine = R"({"type":"LineString","coordinates":[[0,0],[9,9]]})";
const std::string kTwoLines = R"({"type":"MultiLineString","coordinates":[[[0,0],[9,9]],[[20,0],[29,9]]]})";
const std::string kRing =
    R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]],[[5,1],[6,1],[6,2],[5,1]]]})";

ChangedLines changes(const std::string& path) {
    ChangedLines lines;
    lines.source.path = path;
    lines.name = "repaired";
    return lines;
}

std::vector<WrittenLines> write(const ChangedLines& lines, const std::string& target) {
    return write_changed_lines(std::vector{lines}, Crs(), target, false);
}

/// Each feature as "id: WKT".
std::vector<std::string> geometries_in(const std::string& path) {
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    REQUIRE(dataset);
    OGRWktOptions options;
    options.variant = wkbVariantIso;
    std::vector<std::string> texts;
    for (const auto& feature : *dataset->GetLayer(0)) {
        texts.push_back(std::to_string(feature->GetFID()) + ": " +
                        feature->GetGeometryRef()->exportToWkt(options));
    }
    return texts;
}

}  // namespace

TEST_SUITE("io/write_lines") {
    TEST_CASE("feature ids and attributes stay, empty ones too, whatever they are called") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kLine, kLine}));
        lines.curves[{10, 0}] = {{{0, 0, 1}, {5, 5, 2}, {9, 9, 3}}};
        lines.curves[{20, 0}] = {{{0, 0, 1}, {9, 9, 3}}};
        const std::string target = folder.file("out.gpkg");
        const auto written = write(lines, target);
        REQUIRE(written.size() == 1);
        CHECK(written[0].layer == "repaired");
        CHECK(written[0].features == 2);
        CHECK(written[0].left_out == 0);
        CHECK(geometries_in(target) == std::vector<std::string>{"10: LINESTRING Z (0 0 1,5 5 2,9 9 3)",
                                                                "20: LINESTRING Z (0 0 1,9 9 3)"});
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(target.c_str(), GDAL_OF_VECTOR));
        OGRLayer& layer = *dataset->GetLayerByName("repaired");
        CHECK(layer.GetGeomType() == wkbLineString25D);
        CHECK(layer.GetSpatialRef() != nullptr);
        const OGRFeatureUniquePtr first(layer.GetFeature(10));
        CHECK(first->GetFieldAsInteger("n") == 1);
        CHECK(std::string(first->GetFieldAsString("fid")) == "text");
        CHECK(first->GetFieldAsDouble("rate") == 0.5);
        const OGRFeatureUniquePtr second(layer.GetFeature(20));
        CHECK_FALSE(second->IsFieldSetAndNotNull(second->GetFieldIndex("rate")));
    }

    TEST_CASE("a line in several parts makes all of the layer multi-lines") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kLine, kTwoLines, kLine}));
        lines.curves[{10, 0}] = {{{0, 0, 1}, {1, 1, 1}}, {{5, 5, 1}, {9, 9, 1}}};
        lines.curves[{20, 1}] = {{{20, 0, 1}, {29, 9, 1}}};
        const std::string target = folder.file("out.gpkg");
        const auto written = write(lines, target);
        CHECK(written[0].features == 2);
        CHECK(written[0].left_out == 1);
        CHECK(geometries_in(target) ==
              std::vector<std::string>{"10: MULTILINESTRING Z ((0 0 1,1 1 1),(5 5 1,9 9 1))",
                                       "20: MULTILINESTRING Z ((20 0 1,29 9 1))"});
    }

    TEST_CASE("a polygon loses inner rings, and goes with its outer one") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kRing, kRing}));
        lines.curves[{10, 0}] = {{{0, 0, kNoZ}, {9, 0, kNoZ}, {9, 9, kNoZ}, {0, 0, kNoZ}}};
        lines.curves[{20, 1}] = {{{5, 1, kNoZ}, {6, 1, kNoZ}, {6, 2, kNoZ}, {5, 1, kNoZ}}};
        const std::string target = folder.file("out.gpkg");
        CHECK(write(lines, target)[0].left_out == 1);
        CHECK(geometries_in(target) == std::vector<std::string>{"10: POLYGON ((0 0,9 0,9 9,0 0))"});
    }

    TEST_CASE("lines and polygons in one layer stay what they are") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kLine, kRing}));
        lines.curves[{10, 0}] = {{{0, 0, 1}, {1, 1, 1}}};
        lines.curves[{20, 0}] = {{{0, 0, 2}, {9, 0, 2}, {9, 9, 2}, {0, 0, 2}}};
        const std::string target = folder.file("out.gpkg");
        write(lines, target);
        CHECK(geometries_in(target) == std::vector<std::string>{"10: LINESTRING Z (0 0 1,1 1 1)",
                                                                "20: POLYGON Z ((0 0 2,9 0 2,9 9 2,0 0 2))"});
    }

    TEST_CASE("only what the source selects is written") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kLine, kLine}));
        lines.source.where = "n = 2";
        lines.curves[{20, 0}] = {{{0, 0, 1}, {1, 1, 1}}};
        const auto written = write(lines, folder.file("out.gpkg"));
        CHECK(written[0].features == 1);
        CHECK(written[0].left_out == 0);
    }

    TEST_CASE("the same lines give the same bytes, and nothing is replaced unasked") {
        const TemporaryFolder folder;
        ChangedLines lines = changes(write_source(folder, {kLine}));
        lines.curves[{10, 0}] = {{{0, 0, 1}, {1, 1, 1}}};
        write(lines, folder.file("a.gpkg"));
        write(lines, folder.file("b.gpkg"));
        CHECK(read_bytes(folder.file("a.gpkg")) == read_bytes(folder.file("b.gpkg")));
        CHECK(message_of<IoError>([&] { write(lines, folder.file("a.gpkg")); }).find("--overwrite") !=
              std::string::npos);
        CHECK(folder.names() == std::set<std::string>{"a.gpkg", "b.gpkg", "source.geojson"});
    }

    TEST_CASE("a source that cannot be read leaves nothing") {
        const TemporaryFolder folder;
        const ChangedLines lines = changes(folder.file("missing.gpkg"));
        CHECK_THROWS_AS(write(lines, folder.file("out.gpkg")), IoError);
        CHECK(folder.names().empty());
    }
}
