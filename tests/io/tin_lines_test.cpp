#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/io/read_tin.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "io/tin_examples.hpp"
#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::constrained_of;
using tinwright_tests::Corner;
using tinwright_tests::Random;
using tinwright_tests::TemporaryFolder;
using tinwright_tests::terrain_of;

namespace {

struct Made {
    Tin tin;
    std::vector<LineOrigin> lines;
};

/// Samples to the centimetre, a boundary, a hole, and lines that cross each other and run along each other.
Made tin_with_lines(std::uint64_t seed, bool is_conforming) {
    Random random(seed);
    const auto coordinate = [&random] { return 0.01 * static_cast<double>(random.integer(0, 10000)); };
    std::vector<Point3> samples;
    for (int i = 0; i < 60; ++i) {
        samples.push_back({coordinate(), coordinate(), coordinate()});
    }
    std::vector<Breakline> lines;
    lines.push_back(
        {{{5, 5, kDraped}, {95, 5, kDraped}, {95, 95, kDraped}, {5, 95, kDraped}, {5, 5, kDraped}},
         LineRole::Boundary,
         true,
         0});
    lines.push_back({{{40, 40, kDraped}, {60, 40, kDraped}, {50, 60, kDraped}, {40, 40, kDraped}},
                     LineRole::Hole,
                     true,
                     1});
    for (int i = 0; i < 5; ++i) {
        Breakline line;
        line.is_sharp = i % 2 == 0;
        for (int k = 0; k < 3; ++k) {
            line.points.push_back({coordinate(), coordinate(), coordinate()});
        }
        lines.push_back(line);
    }
    lines.push_back({{lines[2].points[1], lines[2].points[0]}, LineRole::Breakline, false, 0});
    TriangulateOptions options;
    options.duplicates.policy = DuplicatePolicy::Mean;
    options.noding.crossing_z = CrossingPolicy::Mean;
    if (is_conforming) {
        options.conforming.emplace();
    }
    Made made{triangulate(samples, lines, options).tin, {}};
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto number = static_cast<std::int32_t>(i);
        made.lines.push_back({lines[i].role, lines[i].is_sharp, i == 3 ? 0 : 9 - number,
                              i == 4 ? -1 : (std::int64_t{1} << 40) + number});
    }
    return made;
}

using EdgeKey = std::pair<Corner, Corner>;

EdgeKey key_of(const Tin& tin, VertexId a, VertexId b) {
    const Point3 p = tin.position(a);
    const Point3 q = tin.position(b);
    const Corner first = {p.x, p.y, p.z};
    const Corner second = {q.x, q.y, q.z};
    return {std::min(first, second), std::max(first, second)};
}

/// Of each edge of a terrain face that lines run along, the first of them by source and feature.
std::map<EdgeKey, LineOrigin> lines_of(const Tin& tin, const std::vector<LineOrigin>& lines) {
    const auto constrained = constrained_of(tin);
    std::map<EdgeKey, LineOrigin> found;
    for (const LineTrace& trace : tin.traces) {
        const EdgeKey key = key_of(tin, trace.a, trace.b);
        if (!std::binary_search(constrained.begin(), constrained.end(), key)) {
            continue;
        }
        const LineOrigin& line = lines[trace.line];
        const auto [place, is_new] = found.try_emplace(key, line);
        if (!is_new &&
            std::tie(line.source, line.feature) < std::tie(place->second.source, place->second.feature)) {
            place->second = line;
        }
    }
    return found;
}

/// A lake with an island and a breakline all along its shore, banks with a section, a river, a breakline that
/// the river follows halfway.
const std::vector<Breakline>& water_lines() {
    static const std::vector<Breakline> lines = [] {
        const std::vector<Point3> shore = {{20, 20, 5}, {45, 22, 5}, {40, 45, 5}, {22, 40, 5}, {20, 20, 5}};
        return std::vector<Breakline>{
            {shore, LineRole::Breakline},
            {shore, LineRole::Lake, true, 3},
            {{{28, 28, 5}, {34, 28, 5}, {31, 35, 5}, {28, 28, 5}}, LineRole::Lake, true, 3},
            {{{60, 10, 8}, {70, 10, 8}, {72, 90, 2}, {60, 90, 2}, {60, 10, 8}}, LineRole::Bank, true, 4},
            {{{70, 10, 8}, {60, 90, 2}}, LineRole::Section, true, 4},
            {{{5, 80, 9}, {30, 60, 7}, {60, 90, 2}}, LineRole::River},
            {{{10, 50, 8}, {30, 60, 7}, {60, 90, 2}}, LineRole::Breakline}};
    }();
    return lines;
}

Made tin_with_water(std::uint64_t seed) {
    Random random(seed);
    std::vector<Point3> samples = {{0, 0, 20}, {100, 0, 20}, {100, 100, 20}, {0, 100, 20}};
    for (int i = 0; i < 60; ++i) {
        const double x = 0.01 * static_cast<double>(random.integer(0, 10000));
        samples.push_back({x, 0.01 * static_cast<double>(random.integer(0, 10000)),
                           10 + 0.01 * static_cast<double>(random.integer(0, 500))});
    }
    TriangulateOptions options;
    options.duplicates.policy = DuplicatePolicy::Mean;
    Made made{triangulate(samples, water_lines(), options).tin, {}};
    for (std::size_t i = 0; i < water_lines().size(); ++i) {
        made.lines.push_back({water_lines()[i].role, true, 1, static_cast<std::int64_t>(i)});
    }
    return made;
}

/// The faces that are chosen, as positions, sorted.
std::vector<std::array<Corner, 3>> faces_of(const Tin& tin, const std::vector<bool>& is_chosen) {
    Tin some = tin;
    for (std::uint32_t f = 0; f < some.mesh.slot_count(); ++f) {
        if (!is_chosen[f] && !some.mesh.is_ghost({f})) {
            some.mesh.set_terrain({f}, false);
        }
    }
    return terrain_of(some);
}

WriteTinOptions options_for(const Made& made) {
    WriteTinOptions options;
    options.metadata = {{"TINWRIGHT_VERSION", "0.1.0"}};
    options.lines = made.lines;
    return options;
}

}  // namespace

TEST_SUITE("io/tin_lines") {
    TEST_CASE("vertices put into flat faces are known again") {
        for (const char* const name : {"t.gpkg", "t.sqlite"}) {
            Made made = tin_with_lines(7, true);
            for (std::uint32_t v = 0; v < made.tin.vertex_count(); v += 3) {
                if (made.tin.sample[v] < Tin::kInserted) {
                    made.tin.sample[v] = Tin::kInserted;
                }
            }
            const TemporaryFolder folder;
            write_tin(made.tin, Crs(), folder.file(name), options_for(made));
            const Tin back = make_tin(read_tin_file(parse_source(folder.file(name))));
            REQUIRE(back.vertex_count() == made.tin.vertex_count());
            std::size_t count = 0;
            for (std::uint32_t v = 0; v < back.vertex_count(); ++v) {
                CHECK(back.position({v}) == made.tin.position({v}));
                CHECK((back.sample[v] == Tin::kInserted) == (made.tin.sample[v] == Tin::kInserted));
                CHECK((back.sample[v] == Tin::kNoSample) == (made.tin.sample[v] == Tin::kNoSample));
                count += back.sample[v] == Tin::kInserted ? 1U : 0U;
            }
            CHECK(count > 5);
        }
    }

    TEST_CASE("edges come back with their lines, and vertices with what made them") {
        const int seeds = tinwright_tests::cases(4);
        for (int seed = 1; seed <= seeds; ++seed) {
            for (const char* const name : {"t.gpkg", "t.sqlite", "t.gml"}) {
                CAPTURE(seed);
                CAPTURE(std::string(name));
                const Made made = tin_with_lines(static_cast<std::uint64_t>(seed), seed % 2 == 0);
                const TemporaryFolder folder;
                write_tin(made.tin, Crs(), folder.file(name), options_for(made));
                const TinFile file = read_tin_file(parse_source(folder.file(name)));
                CHECK(std::is_sorted(file.line_edges.begin(), file.line_edges.end()));
                const Tin back = make_tin(file);
                if (std::string(name) == "t.gml") {
                    // its coordinates are rounded, so that only numbers of things can be compared
                    CHECK(back.traces.size() == lines_of(made.tin, made.lines).size());
                    continue;
                }
                CHECK(terrain_of(back) == terrain_of(made.tin));
                CHECK(constrained_of(back) == constrained_of(made.tin));
                const auto expected = lines_of(made.tin, made.lines);
                CHECK(expected.size() > 20);
                CHECK(lines_of(back, file.lines) == expected);
                CHECK(back.traces.size() == expected.size());
                CHECK(std::is_sorted(back.traces.begin(), back.traces.end()));
                REQUIRE(back.vertex_count() == made.tin.vertex_count());
                std::size_t crossings = 0;
                std::size_t steiner = 0;
                for (std::uint32_t v = 0; v < back.vertex_count(); ++v) {
                    const auto is_made = [&](std::uint32_t what) {
                        REQUIRE((back.sample[v] == what) == (made.tin.sample[v] == what));
                        return back.sample[v] == what ? 1U : 0U;
                    };
                    crossings += is_made(Tin::kCrossing);
                    steiner += is_made(Tin::kNoSample);
                }
                CHECK(crossings > 0);
                CHECK((steiner > 0) == (seed % 2 == 0));
            }
        }
    }

    TEST_CASE("a written TIN that is read and written again has the same edges") {
        const Made made = tin_with_lines(3, true);
        const TemporaryFolder folder;
        write_tin(made.tin, Crs(), folder.file("a.gpkg"), options_for(made));
        const TinFile file = read_tin_file(parse_source(folder.file("a.gpkg")));
        const Made again{make_tin(file), file.lines};
        write_tin(again.tin, Crs(), folder.file("b.gpkg"), options_for(again));
        const TinFile second = read_tin_file(parse_source(folder.file("b.gpkg")));
        CHECK(lines_of(make_tin(second), second.lines) == lines_of(made.tin, made.lines));
    }

    TEST_CASE("formats with one layer keep which edges are constrained") {
        const Made made = tin_with_lines(5, false);
        for (const char* const name : {"t.shp", "t.fgb", "t.csv", "t.geojson"}) {
            CAPTURE(std::string(name));
            const TemporaryFolder folder;
            write_tin(made.tin, Crs(), folder.file(name), options_for(made));
            const TinFile file = read_tin_file(parse_source(folder.file(name)));
            const Tin back = make_tin(file);
            if (std::string(name) == "t.geojson") {
                // GDAL takes some last digits of made points for noise
                CHECK(constrained_of(back).size() == constrained_of(made.tin).size());
            } else {
                CHECK(constrained_of(back) == constrained_of(made.tin));
            }
            CHECK(back.traces.empty());
            CHECK(file.lines.empty());
        }
    }

    TEST_CASE("the layer of constrained edges has the fields of the documentation") {
        const Made made = tin_with_lines(1, false);
        const auto expected = lines_of(made.tin, made.lines);
        const TemporaryFolder folder;
        write_tin(made.tin, Crs(), folder.file("t.gpkg"), options_for(made));
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(folder.file("t.gpkg").c_str(), GDAL_OF_VECTOR));
        REQUIRE(dataset);
        OGRLayer* const layer = dataset->GetLayerByName("constrained_edges");
        REQUIRE(layer != nullptr);
        std::size_t of_lines = 0;
        std::map<std::string, std::size_t> roles;
        for (const auto& edge : *layer) {
            const std::string role = edge->GetFieldAsString("role");
            ++roles[role];
            const VertexId a{static_cast<std::uint32_t>(edge->GetFieldAsInteger("a"))};
            const VertexId b{static_cast<std::uint32_t>(edge->GetFieldAsInteger("b"))};
            const auto line = expected.find(key_of(made.tin, a, b));
            if (line == expected.end()) {
                CHECK(role == "border");
                CHECK(edge->GetFieldAsInteger("border") == 1);
                for (const char* const field : {"source", "feature", "sharp"}) {
                    CHECK_FALSE(edge->IsFieldSetAndNotNull(edge->GetFieldIndex(field)));
                }
                continue;
            }
            ++of_lines;
            const LineOrigin& origin = line->second;
            const bool is_outline = origin.role != LineRole::Breakline;
            CHECK(role == (origin.role == LineRole::Hole ? "hole" : is_outline ? "boundary" : "breakline"));
            CHECK(edge->GetFieldAsInteger("border") == (is_outline ? 1 : 0));
            CHECK(edge->GetFieldAsInteger("source") == origin.source);
            CHECK(edge->IsFieldSetAndNotNull(edge->GetFieldIndex("source")) == (origin.source > 0));
            CHECK(edge->IsFieldSetAndNotNull(edge->GetFieldIndex("feature")) == (origin.feature >= 0));
            CHECK(edge->GetFieldAsInteger("sharp") == (origin.is_sharp ? 1 : 0));
        }
        CHECK(of_lines == expected.size());
        CHECK(roles["hole"] > 2);
        CHECK(roles["breakline"] > 10);
        CHECK(roles.size() <= 4);
    }

    TEST_CASE("all edges tell their lines too") {
        const Made made = tin_with_lines(2, false);
        WriteTinOptions options = options_for(made);
        options.geometry = WriteTinOptions::Geometry::Edges;
        const TemporaryFolder folder;
        write_tin(made.tin, Crs(), folder.file("e.shp"), options);
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(folder.file("e.shp").c_str(), GDAL_OF_VECTOR));
        REQUIRE(dataset);
        std::size_t of_lines = 0;
        for (const auto& edge : *dataset->GetLayer(0)) {
            const std::string role = edge->GetFieldAsString("role");
            CHECK((role.empty() || edge->GetFieldAsInteger("constr") == 1));
            of_lines += role.empty() || role == "border" ? 0U : 1U;
        }
        CHECK(of_lines == lines_of(made.tin, made.lines).size());
    }

    TEST_CASE("lines that nothing is known of leave their edges constrained without a role") {
        Made made = tin_with_lines(4, false);
        made.lines.clear();
        const TemporaryFolder folder;
        write_tin(made.tin, Crs(), folder.file("t.gpkg"), options_for(made));
        const TinFile file = read_tin_file(parse_source(folder.file("t.gpkg")));
        CHECK(constrained_of(make_tin(file)) == constrained_of(made.tin));
        CHECK(file.lines.empty());
    }

    TEST_CASE("water comes back: which faces it is, and the roles of its lines before all others") {
        for (int seed = 1; seed <= tinwright_tests::cases(3); ++seed) {
            for (const char* const name :
                 {"t.gpkg", "t.sqlite", "t.gml", "t.shp", "t.fgb", "t.csv", "t.geojson"}) {
                CAPTURE(seed);
                CAPTURE(std::string(name));
                const Made made = tin_with_water(static_cast<std::uint64_t>(seed));
                const std::vector<bool> is_water = find_water_faces(made.tin, water_lines());
                const std::vector<std::array<Corner, 3>> expected = faces_of(made.tin, is_water);
                REQUIRE(expected.size() > 6);
                WriteTinOptions options = options_for(made);
                options.is_water_face = is_water;
                const TemporaryFolder folder;
                const WrittenTin written = write_tin(made.tin, Crs(), folder.file(name), options);
                const TinFile file = read_tin_file(parse_source(folder.file(name)));
                const Tin back = make_tin(file);
                const std::vector<bool> is_water_back = water_faces_of(file, back);
                REQUIRE(is_water_back.size() == back.mesh.slot_count());
                if (std::string(name) == "t.gml" || std::string(name) == "t.geojson") {
                    CHECK(faces_of(back, is_water_back).size() ==
                          expected.size());  // coordinates are rounded
                } else {
                    CHECK(faces_of(back, is_water_back) == expected);
                }
                const bool has_layers = written.layers.size() == 3;
                CHECK(written.warnings.empty() == (has_layers && std::string(name) != "t.gml"));
                std::map<LineRole, std::size_t> roles;
                for (const LineTrace& trace : back.traces) {
                    ++roles[file.lines[trace.line].role];
                }
                CHECK(roles.size() == (has_layers ? 5 : 0));
                CHECK(roles[LineRole::Section] == (has_layers ? 1 : 0));
                // The breakline along the whole of the lake's shore is told of nowhere.
                CHECK(roles[LineRole::Breakline] == (has_layers ? 1 : 0));
                WriteTinOptions again;
                again.metadata = options.metadata;
                again.lines = file.lines;
                again.is_water_face = is_water_back;
                write_tin(back, Crs(), folder.file(std::string("again_") + name), again);
                const TinFile second = read_tin_file(parse_source(folder.file(std::string("again_") + name)));
                CHECK(second.is_water == file.is_water);
                CHECK(second.lines.size() == file.lines.size());
            }
        }
    }

    TEST_CASE("there is a field water only where there is water, and one geometry for all faces loses it") {
        const Made made = tin_with_water(1);
        const TemporaryFolder folder;
        WriteTinOptions options = options_for(made);
        options.is_water_face.assign(made.tin.mesh.slot_count(), false);
        write_tin(made.tin, Crs(), folder.file("dry.gpkg"), options);
        const TinFile dry = read_tin_file(parse_source(folder.file("dry.gpkg")));
        CHECK(dry.is_water.empty());
        CHECK(water_faces_of(dry, make_tin(dry)).empty());
        const auto has_field = [&](const char* name) {
            const GDALDatasetUniquePtr dataset(GDALDataset::Open(folder.file(name).c_str(), GDAL_OF_VECTOR));
            REQUIRE(dataset);
            return dataset->GetLayerByName("faces")->GetLayerDefn()->GetFieldIndex("water") >= 0;
        };
        CHECK_FALSE(has_field("dry.gpkg"));
        options.is_water_face = find_water_faces(made.tin, water_lines());
        CHECK(write_tin(made.tin, Crs(), folder.file("wet.gpkg"), options).warnings.empty());
        CHECK(has_field("wet.gpkg"));
        CHECK(write_tin(made.tin, Crs(), folder.file("wet.fgb"), options).warnings ==
              std::vector<std::string>{
                  "driver \"FlatGeobuf\" does not keep which edges are rivers: rasters of the "
                  "file do not follow them"});
        options.geometry = WriteTinOptions::Geometry::Tin;
        CHECK(
            write_tin(made.tin, Crs(), folder.file("one.gpkg"), options).warnings ==
            std::vector<std::string>{"with --geometry tin the file does not keep which faces are water: read "
                                     "back, smooth methods take them for terrain"});
        CHECK(read_tin_file(parse_source(folder.file("one.gpkg"))).is_water.empty());
    }
}
