#include "conflict_layer.hpp"

#include <set>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::tools;
using tinwright_tests::message_of;
using tinwright_tests::read_bytes;
using tinwright_tests::TemporaryFolder;

namespace {

/// A source `ditches.gpkg` of two lines, features 7 and 9.
io::Lines two_lines() {
    io::Lines lines;
    lines.lines.resize(2);
    lines.parts = {{7, 0, false, false}, {9, 0, false, false}};
    io::LineSlice slice;
    slice.file = "ditches.gpkg";
    slice.layer = "main";
    slice.count = 2;
    lines.slices = {slice};
    return lines;
}

/// A text of two samples, on lines 2 and 3.
io::Samples two_samples() {
    io::Samples samples;
    samples.points.resize(2);
    io::SampleSlice slice;
    slice.file = "survey.csv";
    slice.count = 2;
    slice.first_id = 2;
    samples.slices = {slice};
    return samples;
}

std::vector<LineConflict> three_conflicts() {
    LineConflict crossing;
    crossing.action = LineConflict::Action::Noded;
    crossing.line_a = 0;
    crossing.line_b = 1;
    crossing.location = {3, 4.5};
    crossing.z_a = 10;
    crossing.z_b = 11.25;
    LineConflict sample = crossing;
    sample.kind = LineConflict::Kind::SampleOnLine;
    sample.action = LineConflict::Action::Chosen;
    sample.line_a = 1;
    sample.line_b = LineConflict::kNone;
    sample.sample = 1;
    LineConflict spike;
    spike.kind = LineConflict::Kind::Spike;
    spike.line_a = 0;
    spike.location = {1, 2};
    return {crossing, sample, spike};
}

}  // namespace

TEST_SUITE("tools/conflict_layer") {
    TEST_CASE("every kind and action has a name of its own") {
        std::set<std::string> names;
        for (std::size_t i = 0; i < LineConflict::kKinds; ++i) {
            names.insert(conflict_key(static_cast<LineConflict::Kind>(i)));
        }
        CHECK(names.size() == LineConflict::kKinds);
        CHECK(names.count("") == 0);
        CHECK(conflict_key(LineConflict::Kind::SelfCrossing) == "self_crossing");
        CHECK(conflict_key(LineConflict::Kind::OpenRing) == "open_ring");
        CHECK(action_key(LineConflict::Action::Noded) == "noded");
        CHECK(action_key(LineConflict::Action::Reported) == "reported");
    }

    TEST_CASE("counts are told in words, one by one and many") {
        ConflictCounts counts{};
        CHECK(conflict_counts_text(counts).empty());
        counts[static_cast<std::size_t>(LineConflict::Kind::Crossing)] = 2;
        counts[static_cast<std::size_t>(LineConflict::Kind::SampleOnLine)] = 1;
        CHECK(conflict_counts_text(counts) == "2 crossings, 1 sample on a line");
    }

    TEST_CASE("a conflict is told with its place, elevations, features and what was done") {
        const io::Lines lines = two_lines();
        const io::Samples samples = two_samples();
        const std::vector<LineConflict> conflicts = three_conflicts();
        CHECK(conflict_text(conflicts[0], {lines, samples}) ==
              R"(crossing at (3, 4.5), z 10 and 11.25: noded (file "ditches.gpkg", layer "main", feature 7; )"
              R"(file "ditches.gpkg", layer "main", feature 9))");
        CHECK(conflict_text(conflicts[1], {lines, samples}) ==
              R"(sample on a line at (3, 4.5), z 10 and 11.25: chosen (file "ditches.gpkg", layer "main", )"
              R"(feature 9; file "survey.csv", line 3))");
        CHECK(conflict_text(conflicts[2], {lines, samples}) ==
              R"(spike at (1, 2): reported (file "ditches.gpkg", layer "main", feature 7))");
    }

    TEST_CASE("the layer has one row a conflict, and appears when it is moved into place") {
        const io::Lines lines = two_lines();
        const io::Samples samples = two_samples();
        const TemporaryFolder folder;
        const std::string file = folder.file("c.csv");
        const auto output = write_conflicts(three_conflicts(), {lines, samples}, {}, file, false);
        CHECK(read_bytes(file).empty());
        output->commit();
        CHECK(
            read_bytes(file) ==
            "WKT,kind,source_a,feature_a,source_b,feature_b,x,y,z_a,z_b,action\n"
            "POINT Z (3 4.5 10),crossing,\"ditches.gpkg,layer=main\",\"7\",\"ditches.gpkg,layer=main\",\"9\","
            "3,4.5,10,11.25,noded\n"
            "POINT Z (3 4.5 10),sample_on_line,\"ditches.gpkg,layer=main\",\"9\",survey.csv,\"3\","
            "3,4.5,10,11.25,chosen\n"
            "POINT Z (1 2 0),spike,\"ditches.gpkg,layer=main\",\"7\",,,1,2,,,reported\n");
    }

    TEST_CASE("without conflicts the layer is there and empty") {
        const io::Lines lines = two_lines();
        const io::Samples samples = two_samples();
        const TemporaryFolder folder;
        for (const char* const name : {"c.gpkg", "c.shp", "c.geojson", "c.csv", "c.fgb"}) {
            CAPTURE(std::string(name));
            write_conflicts({}, {lines, samples}, {}, folder.file(name), false)->commit();
            CHECK_FALSE(read_bytes(folder.file(name)).empty());
        }
    }

    TEST_CASE("a target without a driver is refused") {
        CHECK(message_of<UsageError>([] {
                  check_conflict_target("c.foo");
              }).starts_with(R"(no vector driver for "c.foo": unknown extension .foo)"));
    }
}
