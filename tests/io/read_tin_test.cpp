#include "tinwright/io/read_tin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include <cpl_vsi.h>
#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_check.hpp"

#include "io/tin_examples.hpp"
#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::constrained_of;
using tinwright_tests::example_tin;
using tinwright_tests::message_of;
using tinwright_tests::TemporaryFolder;
using tinwright_tests::terrain_of;
using tinwright_tests::write_bytes;

namespace {

using Geometry = WriteTinOptions::Geometry;

struct Form {
    const char* name;
    bool has_vertices;  ///< a layer of them, with origins
    bool has_metadata;
    bool is_exact;  ///< keeps all digits of any double
};

const std::array<Form, 7> kForms = {{{"t.gpkg", true, true, true},
                                     {"t.shp", false, false, true},
                                     {"t.fgb", false, false, true},
                                     {"t.gml", true, true, false},
                                     {"t.sqlite", true, true, true},
                                     {"t.csv", false, false, true},
                                     {"t.geojson", false, true, true}}};

WriteTinOptions options_for(const Tin& tin, Geometry geometry = Geometry::Polygon) {
    WriteTinOptions options;
    options.geometry = geometry;
    options.metadata = {{"TINWRIGHT_CRITERION", "delaunay"},
                        {"TINWRIGHT_OPTIONS", "--domain \"convex\" \\ <&> ä"},
                        {"TINWRIGHT_VERSION", "0.1.0"}};
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        options.origins.source.push_back(v % 3 == 0 ? 0 : static_cast<int>(v % 3));
        options.origins.feature.push_back(
            v % 5 == 0 ? -1 : static_cast<std::int64_t>(v) + (std::int64_t{1} << 33));
    }
    return options;
}

Source source_of(const std::string& text) { return parse_source(text); }

std::string csv_of(const std::vector<std::string>& geometries) {
    std::string text = "WKT,id\n";
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        text += "\"" + geometries[i] + "\"," + std::to_string(i) + "\n";
    }
    return text;
}

}  // namespace

TEST_SUITE("io/read_tin") {
    TEST_CASE("a TIN comes back from every format bit for bit, holes and constrained edges included") {
        const int seeds = tinwright_tests::cases(3);
        for (int seed = 1; seed <= seeds; ++seed) {
            for (const Form& form : kForms) {
                CAPTURE(seed);
                CAPTURE(std::string(form.name));
                const TemporaryFolder folder;
                const Tin tin = example_tin(static_cast<std::uint64_t>(seed), 10 + 40 * seed);
                const Crs crs = Crs::parse("EPSG:3067");
                const WrittenTin written = write_tin(tin, crs, folder.file(form.name), options_for(tin));
                CHECK(written.features == tin.mesh.count_terrain());
                CHECK(written.warnings.empty());

                const Source source = source_of(folder.file(form.name));
                CHECK(is_tin(source));
                const TinFile file = read_tin_file(source);
                const Tin back = make_tin(file);
                CHECK(check_mesh(back.mesh, {.turns = 0}).is_clean());
                CHECK(terrain_of(back) == terrain_of(tin));
                CHECK(constrained_of(back) == constrained_of(tin));
                CHECK(file.crs.is_same(crs));
                CHECK(std::is_sorted(file.constrained_edges.begin(), file.constrained_edges.end()));
            }
        }
    }

    TEST_CASE("any double comes back bit for bit from the formats that keep all digits") {
        const Tin tin = example_tin(7, 80, true);
        for (const Form& form : kForms) {
            CAPTURE(std::string(form.name));
            const TemporaryFolder folder;
            write_tin(tin, Crs(), folder.file(form.name), options_for(tin));
            const Tin back = make_tin(read_tin_file(source_of(folder.file(form.name))));
            CHECK((terrain_of(back) == terrain_of(tin)) == form.is_exact);
            CHECK(terrain_of(back).size() == terrain_of(tin).size());
        }
    }

    TEST_CASE("decimals close to a rounder number are not rounded by GeoJSON") {
        for (int decimals = 1; decimals <= 9; ++decimals) {
            CAPTURE(decimals);
            const double one = std::pow(10.0, decimals);
            Tin tin;
            tin.lattice = Lattice::decimal(decimals, {0, 0});
            tin.keys = {{one + 1, one - 1}, {3 * one + 3, one / 2}, {2 * one - 1, 4 * one + 4}};
            tin.z = {1 - 1 / one, 1 + 1 / one, (10000 * one + 9) / one};
            tin.sample = {0, 1, 2};
            const std::array<VertexId, 3> corners = {VertexId{0}, VertexId{1}, VertexId{2}};
            tin.mesh = make_mesh(3, corners);
            const TemporaryFolder folder;
            write_tin(tin, Crs(), folder.file("t.geojson"), {});
            CHECK(terrain_of(make_tin(read_tin_file(source_of(folder.file("t.geojson"))))) ==
                  terrain_of(tin));
        }
    }

    TEST_CASE("a format that is a folder is written, read back and not overwritten") {
        const Tin tin = example_tin(4, 40);
        const TemporaryFolder folder;
        const Crs crs = Crs::parse("EPSG:3067");
        const WrittenTin written = write_tin(tin, crs, folder.file("t.gdb"), {});
        CHECK(written.warnings == std::vector<std::string>{"driver \"OpenFileGDB\" rounds coordinates"});
        CHECK(folder.names().size() == 1);
        CHECK(is_tin(source_of(folder.file("t.gdb"))));
        CHECK(make_tin(read_tin_file(source_of(folder.file("t.gdb")))).mesh.count_terrain() ==
              tin.mesh.count_terrain());
        WriteTinOptions options;
        options.overwrite = true;
        CHECK(message_of<IoError>([&] { write_tin(tin, crs, folder.file("t.gdb"), options); }) ==
              "cannot write \"" + folder.file("t.gdb") + "\": it is a folder; name a file");
    }

    TEST_CASE("formats with layers keep vertices without faces, vertex numbers, origins and Steiner marks") {
        const Tin tin = example_tin(4, 60);
        for (const Form& form : kForms) {
            for (const Geometry geometry : {Geometry::Polygon, Geometry::Tin}) {
                if (!form.has_vertices) {
                    continue;
                }
                CAPTURE(std::string(form.name));
                const TemporaryFolder folder;
                const WriteTinOptions options = options_for(tin, geometry);
                write_tin(tin, Crs(), folder.file(form.name), options);
                const TinFile file = read_tin_file(source_of(folder.file(form.name)));
                const Tin back = make_tin(file);
                REQUIRE(back.vertex_count() == tin.vertex_count());
                CHECK(terrain_of(back) == terrain_of(tin));
                CHECK(constrained_of(back) == constrained_of(tin));
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    CHECK(back.position({v}) == tin.position({v}));
                    const bool is_steiner = tin.sample[v] == Tin::kNoSample;
                    REQUIRE((back.sample[v] == Tin::kNoSample) == is_steiner);
                    if (!is_steiner) {
                        const std::uint32_t i = back.sample[v];
                        CHECK(file.origins.source[i] == options.origins.source[v]);
                        CHECK(file.origins.feature[i] == options.origins.feature[v]);
                    }
                }
            }
        }
    }

    TEST_CASE("metadata come back from the formats that hold them") {
        const Tin tin = example_tin(4, 20);
        for (const Form& form : kForms) {
            CAPTURE(std::string(form.name));
            const TemporaryFolder folder;
            const WriteTinOptions options = options_for(tin);
            write_tin(tin, Crs(), folder.file(form.name), options);
            TinMetadata metadata = read_tin_file(source_of(folder.file(form.name))).metadata;
            std::sort(metadata.begin(), metadata.end());
            TinMetadata expected = options.metadata;
            expected.emplace_back("TINWRIGHT_FACES", std::to_string(tin.mesh.count_terrain()));
            expected.emplace_back("TINWRIGHT_VERTICES", std::to_string(tin.vertex_count()));
            std::sort(expected.begin(), expected.end());
            CHECK(metadata == (form.has_metadata ? expected : TinMetadata{}));
        }
    }

    TEST_CASE("no CRS stays no CRS, and systems without a code survive but in GML") {
        const Tin tin = example_tin(4, 20);
        const Crs local = Crs::parse("+proj=tmerc +lat_0=10 +lon_0=21.5 +k=0.9999 +x_0=500000 +datum=WGS84");
        for (const Form& form : kForms) {
            CAPTURE(std::string(form.name));
            const TemporaryFolder folder;
            write_tin(tin, Crs(), folder.file(form.name), options_for(tin));
            CHECK_FALSE(read_tin_file(source_of(folder.file(form.name))).crs.is_known());
            WriteTinOptions options = options_for(tin);
            options.overwrite = true;
            write_tin(tin, local, folder.file(form.name), options);
            const Crs back = read_tin_file(source_of(folder.file(form.name))).crs;
            CHECK(back.is_same(local) == (std::string(form.name) != "t.gml"));
            CHECK(read_tin_file(source_of(folder.file(form.name) + ",crs=EPSG:3067")).crs.code() ==
                  "EPSG:3067");
        }
    }

    TEST_CASE("one TIN geometry comes back from every format that has it") {
        const Tin tin = example_tin(9, 50);
        for (const Form& form : kForms) {
            if (std::string(form.name) == "t.geojson") {
                continue;
            }
            CAPTURE(std::string(form.name));
            const TemporaryFolder folder;
            const WrittenTin written =
                write_tin(tin, Crs(), folder.file(form.name), options_for(tin, Geometry::Tin));
            CHECK(written.features == 1);
            const Source source = source_of(folder.file(form.name));
            CHECK(is_tin(source));
            CHECK(terrain_of(make_tin(read_tin_file(source))) == terrain_of(tin));
        }
    }

    TEST_CASE("edges and vertices alone are no TIN") {
        const Tin tin = example_tin(9, 50);
        for (const Form& form : kForms) {
            for (const Geometry geometry : {Geometry::Edges, Geometry::Vertices}) {
                CAPTURE(std::string(form.name));
                const TemporaryFolder folder;
                write_tin(tin, Crs(), folder.file(form.name), options_for(tin, geometry));
                CHECK_FALSE(is_tin(source_of(folder.file(form.name))));
            }
        }
        const TemporaryFolder folder;
        write_tin(tin, Crs(), folder.file("t.gpkg"), options_for(tin));
        CHECK(is_tin(source_of(folder.file("t.gpkg") + ",layer=faces")));
        CHECK_FALSE(is_tin(source_of(folder.file("t.gpkg") + ",layer=vertices")));
        CHECK_FALSE(is_tin(source_of(folder.file("t.gpkg") + ",layer=constrained_edges")));
    }

    TEST_CASE("what the user says overrides what the file looks like") {
        const Tin tin = example_tin(9, 50);
        const TemporaryFolder folder;
        write_tin(tin, Crs(), folder.file("t.gpkg"), options_for(tin));
        const std::string path = folder.file("t.gpkg");
        CHECK_FALSE(is_tin(source_of(path + ",as=samples")));
        CHECK_FALSE(is_tin(source_of(path + ",vertices=yes")));
        CHECK_FALSE(is_tin(source_of(path + ",layer=faces,z=slope")));
        CHECK(is_tin(source_of("/vsistdin/,as=tin")));
        CHECK_FALSE(is_tin(source_of("/vsistdin/")));
        write_bytes(folder.file("points.xyz"), "1 2 3\n4 5 6\n7 8 8\n");
        CHECK_FALSE(is_tin(source_of(folder.file("points.xyz"))));
        CHECK(message_of<IoError>([&] {
                  is_tin(source_of(folder.file("none.gpkg")));
              }).starts_with("cannot open \"" + folder.file("none.gpkg") + "\""));
        CHECK(message_of<IoError>([&] { is_tin(source_of(path + ",layer=nope")); }) ==
              "\"" + path +
                  "\" has no layer \"nope\"; it has \"faces\", \"constrained_edges\", \"vertices\"");
    }

    TEST_CASE("a filter takes a part of the faces") {
        const Tin tin = example_tin(9, 50);
        const TemporaryFolder folder;
        write_tin(tin, Crs(), folder.file("t.gpkg"), options_for(tin));
        const std::string path = folder.file("t.gpkg");
        CHECK(read_tin_file(source_of(path + ",where=id < 7")).face_ids.size() == 7);
        CHECK(make_tin(read_tin_file(source_of(path + ",sql=SELECT * FROM faces WHERE id < 5")))
                  .mesh.count_terrain() == 5);
        CHECK(message_of<UsageError>([&] {
                  read_tin_file(source_of(path + ",where=no such thing"));
              }).starts_with("\"" + path + "\", layer \"faces\": where \"no such thing\" is not understood"));
    }

    TEST_CASE("foreign triangles are a TIN: polygons, multipolygons, surfaces, whichever way they turn") {
        const TemporaryFolder folder;
        const std::string path = folder.file("foreign.csv");
        write_bytes(
            path, csv_of({"POLYGON Z ((0 0 1,2 0 2,0 2 3,0 0 1))",         // counter-clockwise
                          "POLYGON Z ((2 0 2,0 2 3,2 2 4,2 0 2))",         // clockwise
                          "MULTIPOLYGON Z (((2 0 2,4 0 5,2 2 4,2 0 2)))",  //
                          "POLYHEDRALSURFACE Z (((4 0 5,4 2 6,2 2 4,4 0 5)),((0 2 3,2 2 4,0 4 1,0 2 3)))"}));
        CHECK(is_tin(source_of(path)));
        const TinFile file = read_tin_file(source_of(path));
        CHECK(file.vertices.size() == 7);
        CHECK(file.face_ids.size() == 5);
        CHECK(file.face_ids[3] == file.face_ids[4]);
        const Tin tin = make_tin(file);
        CHECK(tin.mesh.count_terrain() == 5);
        CHECK(check_mesh(tin.mesh, {.turns = 0}).is_clean());
    }

    TEST_CASE("what is no triangle with z is named") {
        const TemporaryFolder folder;
        const std::string path = folder.file("t.csv");
        const std::string good = "POLYGON Z ((0 0 1,2 0 2,0 2 3,0 0 1))";
        const auto problem = [&](const std::string& wkt) {
            // Beyond the features that are looked at beforehand.
            std::vector<std::string> all(1000, good);
            all.push_back(wkt);
            write_bytes(path, csv_of(all));
            return message_of<InputError>([&] { read_tin_file(source_of(path)); });
        };
        const std::string where = "\"" + path + "\", layer \"t\", feature 1001: ";
        const std::string end =
            "; a TIN has closed triangles with z only (read something else with as=samples)";
        CHECK(problem("POLYGON ((0 0,2 0,0 2,0 0))") == where + "a triangle without z" + end);
        CHECK(problem("POLYGON Z ((0 0 1,2 0 2,2 2 1,0 2 3,0 0 1))") ==
              where + "a polygon with 4 corners" + end);
        CHECK(problem("POLYGON Z ((0 0 1,9 0 2,0 9 3,0 0 1),(1 1 1,2 1 1,1 2 1,1 1 1))") ==
              where + "a polygon with a hole" + end);
        CHECK(problem("POINT Z (1 2 3)") == where + "a 3D Point" + end);
        write_bytes(path, csv_of({"POLYGON ((0 0,2 0,0 2,0 0))"}));
        CHECK_FALSE(is_tin(source_of(path)));
        CHECK(message_of<InputError>([&] { read_tin_file(source_of(path + ",as=tin")); }) ==
              "\"" + path + "\" is no TIN: there is no layer of closed triangles with z; its layers: \"t\"");
    }

    TEST_CASE("faces that are no surface are named") {
        const TemporaryFolder folder;
        const std::string path = folder.file("t.csv");
        const auto problem = [&](const std::vector<std::string>& all) {
            write_bytes(path, csv_of(all));
            return message_of<InputError>([&] { make_tin(read_tin_file(source_of(path))); });
        };
        const std::string end = "; `tinwright check` lists every such place";
        CHECK(problem({"POLYGON Z ((0 0 1,2 2 2,4 4 3,0 0 1))"}) ==
              "layer \"t\", feature 1: a face without area at (0, 0)" + end);
        CHECK(problem({"POLYGON Z ((0 0 1,2 0 2,0 2 3,0 0 1))", "POLYGON Z ((2 0 2,2 2 4,0 2 3.5,2 0 2))"}) ==
              "layer \"t\": two elevations at (0, 2), 3 and 3.5" + end);
        CHECK(problem({"POLYGON Z ((0 0 1,2 0 2,0 2 3,0 0 1))", "POLYGON Z ((0 0 1,2 0 2,1 3 3,0 0 1))"}) ==
              "layer \"t\", feature 2: overlaps feature 1, on the same side of an edge at (0, 0)" + end);
    }

    TEST_CASE("reading can be cancelled") {
        const Tin tin = example_tin(9, 4000);
        const TemporaryFolder folder;
        write_tin(tin, Crs(), folder.file("t.fgb"), options_for(tin));
        CHECK_THROWS_AS(read_tin_file(source_of(folder.file("t.fgb")), [](double) { return false; }),
                        Cancelled);
    }
}
