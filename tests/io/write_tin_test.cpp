#include "tinwright/io/write_tin.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <set>
#include <string>

#include <cpl_conv.h>
#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <sys/resource.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "io/tin_examples.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::example_tin;
using tinwright_tests::message_of;
using tinwright_tests::read_bytes;
using tinwright_tests::TemporaryFolder;

namespace {

using Geometry = WriteTinOptions::Geometry;

const std::array<const char*, 7> kFiles = {"t.gpkg",   "t.shp", "t.fgb",    "t.gml",
                                           "t.sqlite", "t.csv", "t.geojson"};

WriteTinOptions some_options(Geometry geometry = Geometry::Polygon) {
    WriteTinOptions options;
    options.geometry = geometry;
    options.metadata = {{"TINWRIGHT_VERSION", "0.1.0"}, {"TINWRIGHT_OPTIONS", "a \"b\" <c> = 1"}};
    return options;
}

GDALDatasetUniquePtr open(const std::string& path) {
    register_drivers();
    return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
}

// Limits the size of files for a while, as a full disk does: writing beyond it fails.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        former_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &former_);
        const rlimit limit{bytes, former_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &former_);
        std::signal(SIGXFSZ, former_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit former_{};
    void (*former_handler_)(int);
};

}  // namespace

TEST_SUITE("io/write_tin") {
    TEST_CASE("the faces layer has the fields of the documentation, and their values are those of the face") {
        // z = 2 - x / 2 falls to the east by one half.
        Tin tin;
        tin.lattice = Lattice::decimal(0, {0, 0});
        tin.keys = {{0, 0}, {4, 0}, {0, 2}};
        tin.z = {2, 0, 2};
        tin.sample = {0, 1, 2};
        const std::array<VertexId, 3> corners = {VertexId{1}, VertexId{2}, VertexId{0}};
        tin.mesh = make_mesh(3, corners);
        for (unsigned i = 0; i < 3; ++i) {
            if (tin.mesh.vertex({0}, i) == VertexId{1}) {
                tin.mesh.set_constrained(half_edge({0}, i), true);  // from vertex 1 to vertex 2
            }
        }
        const TemporaryFolder folder;
        write_tin(tin, Crs::parse("EPSG:3067"), folder.file("t.gpkg"), some_options());
        const auto dataset = open(folder.file("t.gpkg"));
        OGRLayer* const layer = dataset->GetLayerByName("faces");
        REQUIRE(layer != nullptr);
        CHECK(layer->GetGeomType() == wkbPolygon25D);
        CHECK(layer->GetFeatureCount() == 1);
        const OGRFeatureUniquePtr face(layer->GetNextFeature());
        CHECK(face->GetFieldAsInteger("id") == 0);
        CHECK(face->GetFieldAsInteger("a") == 0);
        CHECK(face->GetFieldAsInteger("b") == 1);
        CHECK(face->GetFieldAsInteger("c") == 2);
        CHECK(face->GetFieldAsInteger("constr") == 2);
        CHECK(face->GetFieldAsDouble("slope") == doctest::Approx(std::atan(0.5) * 180 / 3.14159265358979));
        CHECK(face->GetFieldAsDouble("aspect") == doctest::Approx(90));
        CHECK(face->GetFieldAsDouble("area") == 4);
        OGRWktOptions iso;
        iso.variant = wkbVariantIso;
        const std::string wkt = face->GetGeometryRef()->exportToWkt(iso);
        CHECK(wkt == "POLYGON Z ((0 0 2,4 0 0,0 2 2,0 0 2))");
        OGRLayer* const edges = dataset->GetLayerByName("constrained_edges");
        REQUIRE(edges != nullptr);
        CHECK(edges->GetFeatureCount() == 1);
        const OGRFeatureUniquePtr edge(edges->GetNextFeature());
        CHECK(edge->GetFieldAsInteger("a") == 1);
        CHECK(edge->GetFieldAsInteger("b") == 2);
        CHECK(edge->GetFieldAsInteger("border") == 1);
        CHECK(dataset->GetLayerByName("vertices")->GetFeatureCount() == 3);
    }

    TEST_CASE("every format keeps positions given in another system, and areas of the ground") {
        const Tin tin = example_tin(7, 60);
        WriteTinOptions options = some_options();
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {  // as degrees have them
            const Point3 p = tin.position({v});
            options.positions.push_back({std::round((p.x / 64000 + 1.0 / 3) * 1e12) / 1e12,
                                         std::round((p.y / 111000) * 1e12) / 1e12});
        }
        options.ground.area_function = [](std::span<const Point2> ring) { return 1e-3 * ring[1].x; };
        for (const char* const name : kFiles) {
            CAPTURE(name);
            const TemporaryFolder folder;
            write_tin(tin, Crs::parse("EPSG:4326"), folder.file(name), options);
            const GDALDatasetUniquePtr dataset = open(folder.file(name));
            REQUIRE(dataset != nullptr);
            std::size_t features = 0;
            for (const auto& feature : *dataset->GetLayer(0)) {
                const OGRLinearRing& ring = *feature->GetGeometryRef()->toPolygon()->getExteriorRing();
                for (int i = 0; i < 3; ++i) {
                    const auto v = static_cast<std::uint32_t>(
                        feature->GetFieldAsInteger(std::array{"a", "b", "c"}[static_cast<std::size_t>(i)]));
                    const bool is_reversed = std::string(name) == "t.shp";  // rings turn the other way there
                    const int corner = is_reversed ? (3 - i) % 3 : i;
                    CHECK(ring.getX(corner) == options.positions[v].x);
                    CHECK(ring.getY(corner) == options.positions[v].y);
                    CHECK(ring.getZ(corner) == tin.z[v]);
                }
                const auto b = static_cast<std::uint32_t>(feature->GetFieldAsInteger("b"));
                CHECK(feature->GetFieldAsDouble("area") ==
                      doctest::Approx(1e-3 * tin.position({b}).x).epsilon(1e-9));
                ++features;
            }
            CHECK(features == tin.mesh.count_terrain());
        }
    }

    TEST_CASE("aspect goes clockwise from north and is empty on level faces") {
        const std::array<std::array<double, 3>, 4> planes = {{{0, 2, 0}, {0, 0, 2}, {2, 2, 0}, {5, 5, 5}}};
        // Elevations at (0,0), (2,0), (0,2); fall lines to the west, south, north and nowhere.
        const std::array<double, 4> expected = {270, 180, 0, -1};
        for (std::size_t i = 0; i < planes.size(); ++i) {
            CAPTURE(i);
            Tin tin;
            tin.lattice = Lattice::decimal(0, {0, 0});
            tin.keys = {{0, 0}, {2, 0}, {0, 2}};
            tin.z.assign(planes[i].begin(), planes[i].end());
            tin.sample = {0, 1, 2};
            const std::array<VertexId, 3> corners = {VertexId{0}, VertexId{1}, VertexId{2}};
            tin.mesh = make_mesh(3, corners);
            const std::string path = "/vsimem/aspect.fgb";
            WriteTinOptions options;
            options.overwrite = true;
            write_tin(tin, Crs(), path, options);
            const auto dataset = open(path);
            const OGRFeatureUniquePtr face(dataset->GetLayer(0)->GetNextFeature());
            if (expected[i] < 0) {
                CHECK_FALSE(face->IsFieldSetAndNotNull(face->GetFieldIndex("aspect")));
                CHECK(face->GetFieldAsDouble("slope") == 0);
            } else {
                CHECK(face->GetFieldAsDouble("aspect") == doctest::Approx(expected[i]));
            }
        }
        VSIUnlink("/vsimem/aspect.fgb");
    }

    TEST_CASE("the same TIN and options give the same bytes, whatever the file is called") {
        const Tin tin = example_tin(5, 60);
        const Crs crs = Crs::parse("EPSG:3067");
        for (const char* const name : kFiles) {
            CAPTURE(std::string(name));
            const TemporaryFolder one;
            const TemporaryFolder two;
            write_tin(tin, crs, one.file(name), some_options());
            // Dates with a resolution of a second or a day are caught by looking for the year below.
            write_tin(tin, crs, two.file(name), some_options());
            CHECK(one.names() == two.names());
            for (const std::string& file : one.names()) {
                CAPTURE(file);
                const std::string bytes = read_bytes(one.file(file));
                CHECK(bytes == read_bytes(two.file(file)));
                CHECK(bytes.find(one.path()) == std::string::npos);
                CHECK(bytes.find(".tinwright-") == std::string::npos);
            }
        }
    }

    TEST_CASE("GeoPackage and Shapefile carry no date of writing") {
        const Tin tin = example_tin(5, 20);
        const TemporaryFolder folder;
        write_tin(tin, Crs(), folder.file("t.gpkg"), some_options());
        const auto dataset = open(folder.file("t.gpkg"));
        for (const char* const sql :
             {"SELECT last_change FROM gpkg_contents", "SELECT timestamp FROM gpkg_metadata_reference"}) {
            OGRLayer* const dates = dataset->ExecuteSQL(sql, nullptr, nullptr);
            REQUIRE(dates != nullptr);
            int count = 0;
            for (const auto& row : *dates) {
                CHECK(std::string(row->GetFieldAsString(0)).starts_with("2000"));
                ++count;
            }
            CHECK(count > 0);
            dataset->ReleaseResultSet(dates);
        }
        write_tin(tin, Crs(), folder.file("t.shp"), some_options());
        const std::string dbf = read_bytes(folder.file("t.dbf"));
        CHECK(dbf.substr(1, 3) == std::string("\x64\x01\x01"));  // year less 1900, month, day
    }

    TEST_CASE("every geometry kind has its layers") {
        const Tin tin = example_tin(8, 40);
        const TemporaryFolder folder;
        const auto layers = [&](const char* name, Geometry geometry) {
            WriteTinOptions options = some_options(geometry);
            options.overwrite = true;
            return write_tin(tin, Crs(), folder.file(name), options).layers;
        };
        using Names = std::vector<std::string>;
        CHECK(layers("t.gpkg", Geometry::Polygon) == Names{"faces", "constrained_edges", "vertices"});
        CHECK(layers("t.gpkg", Geometry::Tin) == Names{"faces", "constrained_edges", "vertices"});
        CHECK(layers("t.gpkg", Geometry::Edges) == Names{"edges"});
        CHECK(layers("t.gpkg", Geometry::Vertices) == Names{"vertices"});
        CHECK(layers("t.fgb", Geometry::Polygon) == Names{"faces"});
        CHECK(layers("t.fgb", Geometry::Edges) == Names{"edges"});
    }

    TEST_CASE("all edges of the surface are written once, with both marks") {
        const Tin tin = example_tin(12, 50);
        WriteTinOptions options = some_options(Geometry::Edges);
        const std::string path = "/vsimem/edges.gpkg";
        const WrittenTin written = write_tin(tin, Crs(), path, options);
        const auto dataset = open(path);
        std::set<std::pair<int, int>> edges;
        std::size_t constrained = 0;
        for (const auto& edge : *dataset->GetLayer(0)) {
            CHECK(edges.emplace(edge->GetFieldAsInteger("a"), edge->GetFieldAsInteger("b")).second);
            constrained += edge->GetFieldAsInteger("constr") == 1 ? 1U : 0U;
            CHECK(edge->GetGeometryRef()->Is3D());
        }
        CHECK(edges.size() == written.features);
        CHECK(constrained == tinwright_tests::constrained_of(tin).size());
        VSIUnlink(path.c_str());
    }

    TEST_CASE("drivers that lose z or geometries are refused, with the way out") {
        const auto refusal = [](const char* target, const char* driver,
                                Geometry geometry = Geometry::Polygon) {
            return message_of<UsageError>([&] {
                WriteTinOptions options = some_options(geometry);
                options.driver = driver;
                check_tin_target(target, options);
            });
        };
        CHECK(refusal("t.tab", "") ==
              "driver \"MapInfo File\" loses the elevations with --geometry polygon; use .gpkg, .shp, .fgb, "
              ".gml, "
              ".sqlite, .csv or .geojson");
        CHECK(refusal("t.dxf", "").starts_with("driver \"DXF\" loses the elevations"));
        CHECK(refusal("t.ods", "").starts_with("driver \"ODS\" does not keep the geometries"));
        CHECK(
            refusal("t.geojson", "", Geometry::Tin) ==
            "driver \"GeoJSON\" does not keep the geometries with --geometry tin; use --geometry polygon, or "
            ".gpkg, .shp, .fgb, .gml, .sqlite or .csv");
        CHECK(refusal("t.sql", "PGDUMP").starts_with("driver \"PGDUMP\" cannot read back what it writes"));
        CHECK(refusal("t.gpkg", "NoSuch") ==
              "GDAL has no driver \"NoSuch\"; `ogrinfo --formats` lists those it has");
        CHECK(refusal("t.gpkg", "GTiff").starts_with("driver \"GTiff\" writes no vector layers; use .gpkg"));
        CHECK(refusal("t.xyzzy", "") ==
              "no vector driver for \"t.xyzzy\": unknown extension .xyzzy; name one with --of, or use .gpkg, "
              ".shp, "
              ".fgb, .gml, .sqlite, .csv or .geojson");
        CHECK(refusal("t", "").starts_with("no vector driver for \"t\": it has no extension"));
        CHECK(refusal("t.kml", "").find("moves the positions with --geometry polygon") != std::string::npos);
        CHECK(refusal("t.geojsonl", "").starts_with("driver \"GeoJSONSeq\" moves the positions"));
    }

    TEST_CASE("a layer option that would lose z is refused before anything is written") {
        WriteTinOptions options;
        options.layer_options = {"SHPT=POLYGON"};
        const TemporaryFolder folder;
        CHECK(message_of<UsageError>([&] {
                  check_tin_target("t.shp", options);
              }).starts_with("driver \"ESRI Shapefile\" loses the elevations"));
        CHECK_THROWS_AS(write_tin(example_tin(1, 10), Crs(), folder.file("t.shp"), options), UsageError);
        CHECK(folder.names().empty());
        options.layer_options = {"SHPT"};
        CHECK(message_of<UsageError>([&] { check_tin_target("t.shp", options); }) ==
              "--lco \"SHPT\": expected KEY=VALUE");
        options.layer_options = {};
        options.layer_name = "vertices";
        CHECK(message_of<UsageError>([&] { check_tin_target("t.gpkg", options); }) ==
              "layer name \"vertices\" is taken by another layer of the TIN; choose another");
    }

    TEST_CASE("the seven formats are accepted, and every one of them keeps one TIN geometry but GeoJSON") {
        for (const char* const name : kFiles) {
            CAPTURE(std::string(name));
            CHECK_NOTHROW(check_tin_target(name, some_options()));
            CHECK_NOTHROW(check_tin_target(name, some_options(Geometry::Edges)));
            CHECK_NOTHROW(check_tin_target(name, some_options(Geometry::Vertices)));
            if (std::string(name) != "t.geojson") {
                CHECK_NOTHROW(check_tin_target(name, some_options(Geometry::Tin)));
            }
        }
        CHECK_NOTHROW(check_tin_target("t.jml", some_options()));  // not in the table: proved by the probe
    }

    TEST_CASE("vertices can be written as columns of a text file") {
        WriteTinOptions options = some_options(Geometry::Vertices);
        options.layer_options = {"GEOMETRY=AS_XYZ"};
        const TemporaryFolder folder;
        const Tin tin = example_tin(2, 20);
        write_tin(tin, Crs(), folder.file("t.csv"), options);
        CHECK(read_bytes(folder.file("t.csv"))
                  .starts_with("X,Y,Z,id,steiner,source,feature,crossing,inserted\n"));
        CHECK(message_of<UsageError>([&] {
                  WriteTinOptions faces = some_options();
                  faces.layer_options = options.layer_options;
                  check_tin_target("t.csv", faces);
              }).starts_with("driver \"CSV\""));
    }

    TEST_CASE("a spatial database keeps faces but no TIN geometry") {
        WriteTinOptions options = some_options();
        options.creation_options = {"SPATIALITE=YES"};
        CHECK_NOTHROW(check_tin_target("t.sqlite", options));
        options.geometry = Geometry::Tin;
        CHECK(message_of<UsageError>([&] {
                  check_tin_target("t.sqlite", options);
              }).starts_with("driver \"SQLite\" cannot write such a TIN: "));
    }

    TEST_CASE("what a format cannot hold is a warning") {
        const TemporaryFolder folder;
        const Tin binary = example_tin(2, 20, true);
        const WrittenTin gml = write_tin(binary, Crs(), folder.file("t.gml"), {});
        REQUIRE(gml.warnings.size() == 1);
        CHECK(gml.warnings[0] ==
              "driver \"GML\" writes coordinates with 15 significant digits; some here have more");
        CHECK(write_tin(binary, Crs(), folder.file("t.csv"), {}).warnings.empty());
        const Crs local = Crs::parse("+proj=tmerc +lat_0=10 +lon_0=21.5 +k=0.9999 +x_0=500000 +datum=WGS84");
        const WrittenTin named = write_tin(example_tin(2, 20), local, folder.file("u.gml"), {});
        REQUIRE(named.warnings.size() == 1);
        CHECK(named.warnings[0].starts_with("driver \"GML\" does not keep the CRS "));
    }

    TEST_CASE("a disk that fills up is one clear error and leaves nothing") {
        const Tin tin = example_tin(3, 3000);
        for (const char* const name : kFiles) {
            for (const rlim_t limit : {rlim_t{100}, rlim_t{60000}, rlim_t{250000}}) {
                CAPTURE(std::string(name));
                CAPTURE(limit);
                const TemporaryFolder folder;
                std::string message;
                {
                    const FileSizeLimit full(limit);
                    message = message_of<IoError>(
                        [&] { write_tin(tin, Crs(), folder.file(name), some_options()); });
                }
                CHECK(message.starts_with("cannot "));
                CHECK(message.find(name) != std::string::npos);
                CHECK(message.find('\n') == std::string::npos);
                CHECK(folder.names().empty());
            }
        }
    }

    TEST_CASE("cancelling leaves nothing, or the older file as it was") {
        const Tin tin = example_tin(3, 4000);
        const TemporaryFolder folder;
        WriteTinOptions options = some_options();
        options.progress = [](double fraction) { return fraction < 0.3; };
        CHECK_THROWS_AS(write_tin(tin, Crs(), folder.file("t.gpkg"), options), Cancelled);
        CHECK(folder.names().empty());
        tinwright_tests::write_bytes(folder.file("t.gpkg"), "older");
        options.overwrite = true;
        CHECK_THROWS_AS(write_tin(tin, Crs(), folder.file("t.gpkg"), options), Cancelled);
        CHECK(read_bytes(folder.file("t.gpkg")) == "older");
    }
}
