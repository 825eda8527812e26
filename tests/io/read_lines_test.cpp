#include "tinwright/io/read_lines.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "reading.hpp"
#include "vector_files.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::add_feature;
using tinwright_tests::MemoryFile;
using tinwright_tests::message_of;
using tinwright_tests::VectorFile;

namespace {

Lines read_one(const std::string& source, LineRole role = LineRole::Breakline,
               const ReadLinesOptions& options = {}) {
    const LineSource parsed{parse_source(source), role};
    return read_lines({&parsed, 1}, options);
}

/// A row of a CSV file: a geometry as WKT, and further columns.
std::string row(const std::string& wkt, const std::string& rest = "") { return '"' + wkt + '"' + rest; }

/// Lines of WKT in a CSV file; each row has an id of its own, and what `rows` adds in the columns h and kind.
Lines read_wkt(const std::vector<std::string>& rows, LineRole role = LineRole::Breakline,
               const std::string& keys = "", const ReadLinesOptions& options = {}) {
    std::string text = "WKT,h,kind\n";
    for (const std::string& row : rows) {
        text += row + "\n";
    }
    const MemoryFile file("lines.csv", text);
    return read_one(file.path() + keys, role, options);
}

ReadLinesOptions skipping() {
    ReadLinesOptions options;
    options.skip_bad = true;
    return options;
}

ReadLinesOptions auditing() {
    ReadLinesOptions options;
    options.keep_faults = true;
    return options;
}

ReadLinesOptions snapping(double distance) {
    ReadLinesOptions options;
    options.snap = distance;
    return options;
}

ReadLinesOptions working_in(const std::string& crs) {
    ReadLinesOptions options;
    options.crs = Crs::parse(crs);
    return options;
}

std::vector<std::int64_t> features_of(const Lines& lines) {
    std::vector<std::int64_t> features;
    for (const LinePart& part : lines.parts) {
        features.push_back(part.feature);
    }
    return features;
}

std::string refusal(const std::vector<std::string>& rows, LineRole role = LineRole::Breakline,
                    const std::string& keys = "", const ReadLinesOptions& options = {}) {
    return message_of<InputError>([&] { read_wkt(rows, role, keys, options); });
}

bool same(const std::vector<Point3>& a, const std::vector<Point3>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Point3& p, const Point3& q) {
        return p.x == q.x && p.y == q.y && (p.z == q.z || (std::isnan(p.z) && std::isnan(q.z)));
    });
}

constexpr const char* square = R"("POLYGON Z ((0 0 1,4 0 2,4 4 3,0 4 4,0 0 1)))";

}  // namespace

TEST_SUITE("io/read_lines") {
    TEST_CASE("lines come with their points, ids and names") {
        const Lines lines =
            read_wkt({row("LINESTRING Z (0.1 0.2 3,4 5 6.5,7 8 9)"), row("LINESTRING Z (1 1 1,2 2 2)")});
        REQUIRE(lines.lines.size() == 2);
        CHECK(same(lines.lines[0].points, {{0.1, 0.2, 3}, {4, 5, 6.5}, {7, 8, 9}}));
        CHECK(same(lines.lines[1].points, {{1, 1, 1}, {2, 2, 2}}));
        CHECK(lines.lines[0].role == LineRole::Breakline);
        CHECK(lines.lines[0].is_sharp);
        CHECK(features_of(lines) == std::vector<std::int64_t>{1, 2});
        CHECK(lines.describe(1) == R"(file "/vsimem/lines.csv", layer "lines", feature 2)");
        REQUIRE(lines.slices.size() == 1);
        CHECK(lines.slices[0].count == 2);
        CHECK(lines.warnings.empty());
        CHECK(lines.conflicts.empty());
    }

    TEST_CASE("parts and rings are lines of their own") {
        const Lines lines = read_wkt({row("MULTILINESTRING Z ((0 0 0,1 0 0),(2 0 0,3 0 0))"),
                                      row("GEOMETRYCOLLECTION Z (LINESTRING Z (0 1 0,1 1 0),POLYGON Z ((0 0 "
                                          "5,9 0 5,0 9 5,0 0 5),(1 1 5,2 1 5,1 2 5,1 1 5)))")});
        REQUIRE(lines.lines.size() == 5);
        CHECK(features_of(lines) == std::vector<std::int64_t>{1, 1, 2, 2, 2});
        CHECK(same(lines.lines[4].points, {{1, 1, 5}, {2, 1, 5}, {1, 2, 5}, {1, 1, 5}}));
    }

    TEST_CASE("a polygon's rings share a number, and polygons have different ones through all sources") {
        const std::string polygons =
            row("MULTIPOLYGON Z (((0 0 1,9 0 1,0 9 1,0 0 1),(1 1 1,2 1 1,1 2 1,1 1 1)),((20 0 1,29 0 1,20 9 "
                "1,20 0 1)))");
        const MemoryFile a("a.csv", "WKT,h\n" + polygons + ",1\n");
        const MemoryFile b("b.csv", "WKT,h\n" + polygons + ",1\n");
        const std::vector<LineSource> sources{{parse_source(a.path()), LineRole::Boundary},
                                              {parse_source(b.path()), LineRole::Hole}};
        const Lines lines = read_lines(sources);
        REQUIRE(lines.lines.size() == 6);
        std::vector<std::uint32_t> numbers;
        for (const Breakline& line : lines.lines) {
            numbers.push_back(line.polygon);
        }
        CHECK(numbers == std::vector<std::uint32_t>{0, 0, 1, 2, 2, 3});
        CHECK(lines.lines[0].role == LineRole::Boundary);
        CHECK(lines.lines[5].role == LineRole::Hole);
        CHECK(lines.slice_of(3).file == "/vsimem/b.csv");
        CHECK(lines.slice_of(3).source == 1);
    }

    TEST_CASE("closed lines are rings: those of one feature of one polygon") {
        const Lines lines = read_wkt({row("MULTILINESTRING ((0 0,9 0,0 9,0 0),(1 1,2 1,1 2,1 1))"),
                                      row("LINESTRING (20 0,29 0,20 9,20 0)")},
                                     LineRole::Boundary);
        REQUIRE(lines.lines.size() == 3);
        CHECK(lines.lines[0].polygon == lines.lines[1].polygon);
        CHECK(lines.lines[0].polygon != lines.lines[2].polygon);
    }

    TEST_CASE("z comes from the geometry, a field, a number, or not at all") {
        const std::string both = row("LINESTRING Z (0 0 1,4 0 2)", ",7.5,");
        CHECK(read_wkt({both}).lines[0].points[1].z == 2);
        CHECK(read_wkt({both}, LineRole::Breakline, ",z=geometry").lines[0].points[1].z == 2);
        CHECK(read_wkt({both}, LineRole::Breakline, ",z=h").lines[0].points[1].z == 7.5);
        CHECK(read_wkt({both}, LineRole::Breakline, ",z=-3").lines[0].points[1].z == -3);
        CHECK(std::isnan(read_wkt({both}, LineRole::Breakline, ",z=drape").lines[0].points[1].z));
        CHECK(read_wkt({row("LINESTRING (0 0,4 0)", ",7.5,")}, LineRole::Breakline, ",z=h")
                  .lines[0]
                  .points[0]
                  .z == 7.5);
    }

    TEST_CASE("a breakline without z is refused with what to try") {
        CHECK(refusal({row("LINESTRING (0 0,4 0)", ",1,")}) ==
              R"(file "/vsimem/lines.csv", layer "lines", feature 1: has no z; give z=FIELD, z=NUMBER, or )"
              R"(z=drape to take it from the samples; --skip-bad goes on without it)");
        VectorFile file("GPKG", "flat.gpkg");
        OGRLayer& layer =
            file.add_layer("ditch", wkbLineString, nullptr, {{"depth", OFTReal}, {"n", OFTString}});
        add_feature(layer, "LINESTRING (0 0,4 0)", {"3"});
        CHECK(message_of<InputError>([&] { read_one(file.close()); }) ==
              R"(file "/vsimem/flat.gpkg", layer "ditch": the geometries have no z; give z=FIELD, z=NUMBER, )"
              R"(or z=drape to take it from the samples (numeric fields: "depth"))");
        CHECK(read_one(file.close() + ",z=depth").lines[0].points[0].z == 3);
    }

    TEST_CASE("boundaries and holes without z are draped without a word") {
        for (const LineRole role : {LineRole::Boundary, LineRole::Hole}) {
            const Lines lines = read_wkt({row("POLYGON ((0 0,4 0,4 4,0 0))")}, role);
            CHECK(same(lines.lines[0].points,
                       {{0, 0, kDraped}, {4, 0, kDraped}, {4, 4, kDraped}, {0, 0, kDraped}}));
            CHECK(lines.warnings.empty());
            CHECK(read_wkt({row("POLYGON Z ((0 0 1,4 0 2,4 4 3,0 0 1))")}, role).lines[0].points[2].z == 3);
        }
        CHECK(refusal({row("POLYGON ((0 0,4 0,4 4,0 0))")}, LineRole::Hole, ",z=geometry").find("has no z") !=
              std::string::npos);
    }

    TEST_CASE("what is not finite is refused with its place, or skipped") {
        VectorFile file("GPKG", "odd.gpkg");
        OGRLayer& layer = file.add_layer("odd", wkbLineString25D, nullptr);
        const auto add = [&](double x, double z) {
            OGRFeature feature(layer.GetLayerDefn());
            auto* const line = new OGRLineString;
            line->addPoint(1, 2, 3);
            line->addPoint(x, 5, z);
            feature.SetGeometryDirectly(line);
            REQUIRE(layer.CreateFeature(&feature) == OGRERR_NONE);
        };
        add(4, 6);
        add(4, std::numeric_limits<double>::quiet_NaN());
        add(std::numeric_limits<double>::infinity(), 6);
        const std::string path = file.close();
        CHECK(
            message_of<InputError>([&] { read_one(path); }) ==
            R"(file "/vsimem/odd.gpkg", layer "odd", feature 2: has an elevation that is not finite at (4, 5); )"
            R"(give z=FIELD, z=NUMBER, or z=drape to take it from the samples; --skip-bad goes on without it)");
        CHECK(message_of<InputError>([&] { read_one(path + ",where=fid = 3"); }) ==
              R"(file "/vsimem/odd.gpkg", layer "odd", feature 3: has a coordinate that is not finite; )"
              R"(--skip-bad goes on without it)");
        const Lines lines = read_one(path, LineRole::Breakline, skipping());
        CHECK(features_of(lines) == std::vector<std::int64_t>{1});
        CHECK(lines.slices[0].skipped == 2);
        REQUIRE(lines.warnings.size() == 1);
        CHECK(lines.warnings[0].starts_with(
            R"(file "/vsimem/odd.gpkg": 2 unusable features among the breaklines skipped, the first is file)"));
        CHECK(read_one(path + ",z=drape,where=fid < 3").lines.size() == 2);
    }

    TEST_CASE("a ring that is not closed is refused with its gap, or closed within the snapping distance") {
        const std::vector<std::string> rows{row("LINESTRING (10 0,19 0,10 9,10 0)"),
                                            row("LINESTRING (0 0,9 0,0 9,0 0.25)")};
        CHECK(
            refusal(rows, LineRole::Boundary) ==
            R"(file "/vsimem/lines.csv", layer "lines", feature 2: a ring is not closed: it begins at (0, 0) )"
            R"(and ends at (0, 0.25); close it, or allow for the gap with --snap DISTANCE; --skip-bad goes on )"
            R"(without it)");
        CHECK(refusal(rows, LineRole::Hole, "", snapping(0.24)).find("not closed") != std::string::npos);
        CHECK(read_wkt(rows, LineRole::Breakline, ",z=1").lines.size() ==
              2);  // breaklines may end where they like

        const Lines closed = read_wkt(rows, LineRole::Boundary, "", snapping(0.25));
        CHECK(same(closed.lines[1].points,
                   {{0, 0, kDraped}, {9, 0, kDraped}, {0, 9, kDraped}, {0, 0, kDraped}}));
        REQUIRE(closed.conflicts.size() == 1);
        CHECK(closed.conflicts[0].kind == LineConflict::Kind::OpenRing);
        CHECK(closed.conflicts[0].action == LineConflict::Action::Snapped);
        CHECK(closed.conflicts[0].line_a == 1);
        CHECK(closed.conflicts[0].location == Point2{0, 0.25});

        const Lines skipped = read_wkt(rows, LineRole::Boundary, "", skipping());
        CHECK(features_of(skipped) == std::vector<std::int64_t>{1});
        CHECK(skipped.slices[0].skipped == 1);
    }

    TEST_CASE("an audit gets the lines with their faults listed") {
        const Lines lines = read_wkt({row("LINESTRING (5 6,9 0)"), row("LINESTRING Z (0 0 1,9 0 1)"),
                                      row("LINESTRING (7 8)"), row("POINT Z (1 2 3)"), ","},
                                     LineRole::Breakline, "", auditing());
        REQUIRE(lines.lines.size() == 3);
        CHECK(features_of(lines) == std::vector<std::int64_t>{1, 2, 3});
        CHECK(lines.parts[0].lacks_z);
        CHECK_FALSE(lines.parts[1].lacks_z);
        CHECK(lines.lines[2].points.size() == 1);
        REQUIRE(lines.conflicts.size() == 2);
        CHECK(lines.conflicts[0].kind == LineConflict::Kind::MissingZ);
        CHECK(lines.conflicts[0].action == LineConflict::Action::Reported);
        CHECK(lines.conflicts[0].line_a == 0);
        CHECK(lines.conflicts[0].location == Point2{5, 6});
        CHECK(lines.conflicts[1].line_a == 2);
        REQUIRE(lines.faults.size() == 2);
        CHECK(lines.faults[0].feature == 4);
        CHECK(lines.faults[0].layer == "lines");
        CHECK(lines.faults[0].what == "is a POINT, neither line nor polygon");
        CHECK(lines.faults[1].what == "has no geometry");
        CHECK(lines.warnings.empty());

        const Lines draped =
            read_wkt({row("LINESTRING (5 6,9 0)")}, LineRole::Breakline, ",z=drape", auditing());
        CHECK(draped.conflicts.empty());
        CHECK_FALSE(draped.parts[0].lacks_z);
        CHECK(read_wkt({","}, LineRole::Breakline, "", auditing()).lines.empty());
    }

    TEST_CASE("an audit gets open rings as they are, polygons' too") {
        for (const char* const wkt : {"LINESTRING (0 0,9 0,0 9)", "POLYGON ((0 0,9 0,0 9))"}) {
            CAPTURE(wkt);
            const bool is_polygon = wkt[0] == 'P';
            const Lines rings = read_wkt({row(wkt)}, LineRole::Hole, "", auditing());
            REQUIRE(rings.lines.size() == 1);
            CHECK(rings.lines[0].points.size() == 3);
            CHECK(rings.parts[0].is_ring == is_polygon);
            REQUIRE(rings.conflicts.size() == 1);
            CHECK(rings.conflicts[0].kind == LineConflict::Kind::OpenRing);
            CHECK(rings.conflicts[0].action == LineConflict::Action::Reported);
            if (is_polygon) {
                CHECK(read_wkt({row(wkt)}, LineRole::Hole).lines[0].points.size() == 4);
                CHECK(read_wkt({row(wkt)}, LineRole::Breakline, ",z=1", auditing()).conflicts.size() == 1);
            }
        }
    }

    TEST_CASE("parts are numbered through a feature's geometry") {
        const Lines lines = read_wkt(
            {row("GEOMETRYCOLLECTION Z (LINESTRING Z (0 1 0,1 1 0),POLYGON Z ((0 0 5,9 0 5,0 9 5,0 0 5),"
                 "(1 1 5,2 1 5,1 2 5,1 1 5)),MULTILINESTRING Z ((0 0 0,1 0 0),(2 0 0,3 0 0)))"),
             row("LINESTRING Z (7 1 0,8 1 0)")});
        std::vector<std::uint32_t> parts;
        std::vector<bool> rings;
        for (const LinePart& part : lines.parts) {
            parts.push_back(part.part);
            rings.push_back(part.is_ring);
        }
        CHECK(parts == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 0});
        CHECK(rings == std::vector<bool>{false, true, true, false, false, false});
    }

    TEST_CASE("a source can be asked whether it is lines") {
        VectorFile file("GPKG", "asked.gpkg");
        add_feature(file.add_layer("any", wkbUnknown), "LINESTRING (0 0,1 1)");
        file.add_layer("lakes", wkbMultiPolygon);
        SUBCASE("all layers are") { CHECK(has_lines(parse_source(file.close()))); }
        SUBCASE("some layers are") {
            file.add_layer("points", wkbPoint25D);
            const std::string path = file.close();
            CHECK_FALSE(has_lines(parse_source(path)));
            CHECK(has_lines(parse_source(path + ",layer=any")));
            CHECK(has_lines(parse_source(path + ",layer=lakes")));
            CHECK_FALSE(has_lines(parse_source(path + ",layer=points")));
            CHECK_FALSE(has_lines(parse_source(path + ",layer=lakes,vertices=yes")));
        }
        SUBCASE("text is not") {
            const MemoryFile text("t.csv", "x,y,z\n1,2,3\n");
            CHECK_FALSE(has_lines(parse_source(text.path())));
        }
    }

    TEST_CASE("sharpness is one for all or a field's") {
        const std::string sharp = row("LINESTRING Z (0 0 1,1 0 1)", ",1,Sharp");
        const std::string smooth = row("LINESTRING Z (0 1 1,1 1 1)", ",1,smooth");
        CHECK_FALSE(read_wkt({sharp}, LineRole::Breakline, ",across=smooth").lines[0].is_sharp);
        CHECK(read_wkt({smooth}, LineRole::Breakline, ",across=sharp").lines[0].is_sharp);
        const Lines both = read_wkt({sharp, smooth}, LineRole::Breakline, ",across=kind");
        CHECK(both.lines[0].is_sharp);
        CHECK_FALSE(both.lines[1].is_sharp);
        CHECK(
            refusal({sharp, row("LINESTRING Z (0 1 1,1 1 1)", ",1,soft")}, LineRole::Breakline,
                    ",across=kind") ==
            R"(file "/vsimem/lines.csv", layer "lines", feature 2: field "kind" is neither sharp nor smooth: )"
            R"("soft"; --skip-bad goes on without it)");
        CHECK(
            refusal({sharp}, LineRole::Breakline, ",across=king") ==
            R"(file "/vsimem/lines.csv", layer "lines": no field "king" for across=; the fields are "WKT", )"
            R"("h", "kind")");
    }

    TEST_CASE("what is no line is refused by name") {
        CHECK(refusal({row("POINT Z (0 0 1)")}) ==
              R"(file "/vsimem/lines.csv", layer "lines", feature 1: is a POINT, neither line nor polygon; )"
              R"(--skip-bad goes on without it)");
        CHECK(refusal({row("GEOMETRYCOLLECTION Z (LINESTRING Z (0 0 0,1 1 1),POINT Z (0 0 1))")})
                  .find("is a POINT") != std::string::npos);
        CHECK(refusal({row("LINESTRING Z EMPTY")}).find("has an empty geometry") != std::string::npos);
        CHECK(refusal({","}).find("feature 1: has no geometry") != std::string::npos);
        CHECK(refusal({}).find(R"(layer "lines": no lines)") != std::string::npos);
        CHECK(refusal({","}, LineRole::Breakline, "", skipping()) ==
              R"(file "/vsimem/lines.csv", layer "lines": nothing usable; 1 skipped, the first is file )"
              R"("/vsimem/lines.csv", layer "lines", feature 1: has no geometry)");
        const MemoryFile table("table.csv", "a,b\n1,2\n");
        CHECK(
            message_of<InputError>([&] { read_one(table.path()); }) ==
            R"(file "/vsimem/table.csv", layer "table": a table without geometries; for text with a column of )"
            R"(WKT name it with oo=GEOM_POSSIBLE_NAMES=COLUMN)");
        CHECK(message_of<IoError>([&] { read_one("/vsimem/missing.gpkg"); }) ==
              R"(cannot open file "/vsimem/missing.gpkg": no such file)");
    }

    TEST_CASE("a column of WKT may have any name") {
        const MemoryFile table("named.csv",
                               "id,shape\n1,\"LINESTRING Z (0 0 1,2 2 "
                               "2)\"\n");
        CHECK(read_one(table.path() + ",oo=GEOM_POSSIBLE_NAMES=shape").lines.size() == 1);
    }

    TEST_CASE("keys for samples are refused") {
        for (const char* const key :
             {"band=1", "stride=2", "vertices=yes", "xfield=x", "yfield=y", "format=csv", "as=samples"}) {
            CAPTURE(key);
            const std::string name(key, std::string(key).find('=') + 1);
            CHECK(message_of<UsageError>([&] { read_one(std::string("a.gpkg,") + key); }) ==
                  "source \"a.gpkg\": " + name + " is for samples, not for lines");
        }
        const MemoryFile samples("s.csv", "x,y,z\n1,2,3\n");
        CHECK(message_of<UsageError>([&] { tinwright_tests::read(samples.path() + ",across=sharp"); }) ==
              R"(source "/vsimem/s.csv": across= is for lines, not for samples)");
    }

    TEST_CASE("of several layers those with lines come into question") {
        VectorFile file("GPKG", "several.gpkg");
        file.add_layer("points", wkbPoint25D);
        OGRLayer& ditches = file.add_layer("ditches", wkbMultiLineString25D);
        add_feature(ditches, "MULTILINESTRING Z ((0 0 1,1 0 1))");
        SUBCASE("one of them") { CHECK(read_one(file.close()).slices[0].layer == "ditches"); }
        SUBCASE("more of them") {
            file.add_layer("lakes", wkbPolygon25D);
            CHECK(message_of<InputError>([&] { read_one(file.close()); }) ==
                  R"(file "/vsimem/several.gpkg": several layers may have lines; choose one of "ditches", )"
                  R"("lakes" with layer=)");
            CHECK(read_one(file.close() + ",layer=ditches").lines.size() == 1);
            CHECK(message_of<InputError>([&] { read_one(file.close() + ",layer=points"); }) ==
                  R"(file "/vsimem/several.gpkg", layer "points": has Point features, no lines or polygons)");
        }
    }

    TEST_CASE("curves are made of straight parts that follow them") {
        VectorFile file("GPKG", "arc.gpkg");
        OGRLayer& layer = file.add_layer("arc", wkbCompoundCurveZ);
        add_feature(layer,
                    "COMPOUNDCURVE Z (CIRCULARSTRING Z (10 0 "
                    "1,0 10 1,-10 0 1),(-10 0 1,-10 -5 2))");
        const Lines lines = read_one(file.close());
        REQUIRE(lines.lines.size() == 1);
        const std::vector<Point3>& points = lines.lines[0].points;
        CHECK(points.size() > 20);
        for (const Point3& p : points) {
            if (p.y >= 0) {
                CHECK(std::hypot(p.x, p.y) == doctest::Approx(10));
            }
        }
        CHECK(same({points.back()}, {{-10, -5, 2}}));
    }

    TEST_CASE("lines go to the samples' system, elevations that are draped too") {
        VectorFile file("GPKG", "crs.gpkg");
        OGRLayer& layer = file.add_layer("l", wkbLineString25D, "EPSG:25832");
        add_feature(layer,
                    "LINESTRING Z (500000 5400000 "
                    "1,500100 5400000 2)");
        const std::string path = file.close();
        CHECK(read_one(path).crs.code() == "EPSG:25832");
        const Lines there = read_one(path, LineRole::Breakline, working_in("EPSG:25833"));
        CHECK(there.crs.code() == "EPSG:25833");
        // zone 33 has its middle six degrees further
        // east
        CHECK(there.lines[0].points[0].x < 100000);
        CHECK(there.lines[0].points[1].z == doctest::Approx(2));
        const Lines draped = read_one(path + ",z=drape", LineRole::Breakline, working_in("EPSG:25833"));
        CHECK(draped.lines[0].points[0].x == there.lines[0].points[0].x);
        CHECK(std::isnan(draped.lines[0].points[0].z));

        const MemoryFile plain("plain.csv", "WKT,h\n\"LINESTRING Z (0 0 1,4 4 4)\",1\n");
        const std::vector<LineSource> sources{{parse_source(path), LineRole::Breakline},
                                              {parse_source(plain.path()), LineRole::Breakline}};
        const Lines both = read_lines(sources);
        CHECK(both.warnings ==
              std::vector<std::string>{R"(file "/vsimem/plain.csv": has no CRS; taken to be in EPSG:25832 )"
                                       R"((ETRS89 / UTM zone 32N))"});
    }

    TEST_CASE("features that cannot be transformed are refused by name, or skipped") {
        VectorFile file("GPKG", "far.gpkg");
        OGRLayer& layer = file.add_layer("l", wkbLineString25D, "EPSG:4326");
        add_feature(layer, "LINESTRING Z (9 48 1,9.1 48 2)");
        add_feature(layer, "LINESTRING Z (9 48 1,9.1 480 2)");
        const std::string path = file.close();
        ReadLinesOptions options;
        options.crs = Crs::parse("EPSG:25832");
        CHECK(
            message_of<InputError>([&] { read_one(path, LineRole::Breakline, options); })
                .starts_with(
                    R"(file "/vsimem/far.gpkg", layer "l", feature 2: (9.1, 480) is no longitude and latitude)"));
        options.skip_bad = true;
        CHECK(features_of(read_one(path, LineRole::Breakline, options)) == std::vector<std::int64_t>{1});
        // Without a system asked for, the lines that are somewhere choose the plane.
        CHECK(message_of<InputError>([&] {
                  read_one(path);
              }).find("feature 2: (9.1, 480) is no longitude and latitude") != std::string::npos);
    }

    TEST_CASE("ten thousand lines of twenty-one points are read in a fraction of a second") {
        VectorFile file("GPKG", "many.gpkg");
        OGRLayer& layer = file.add_layer("l", wkbLineString25D);
        REQUIRE(layer.StartTransaction() == OGRERR_NONE);
        for (int i = 0; i < 10000; ++i) {
            OGRFeature feature(layer.GetLayerDefn());
            auto* const line = new OGRLineString;
            line->setNumPoints(21);
            for (int k = 0; k < 21; ++k) {
                line->setPoint(k, k, i, 0.5);
            }
            feature.SetGeometryDirectly(line);
            REQUIRE(layer.CreateFeature(&feature) == OGRERR_NONE);
        }
        REQUIRE(layer.CommitTransaction() == OGRERR_NONE);
        const std::string path = file.close();
        const auto start = std::chrono::steady_clock::now();
        const Lines lines = read_one(path);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        CHECK(lines.lines.size() == 10000);
        CHECK(seconds < 2);  // 0.03 on the machine it was
                             // written on; sanitizers are slow
    }

    TEST_CASE("every line of the square is closed whatever its role") {
        CHECK(read_wkt({square}).lines[0].points.size() == 5);
    }
}
