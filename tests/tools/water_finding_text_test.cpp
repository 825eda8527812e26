#include "water_finding_text.hpp"

#include <set>

#include <doctest/doctest.h>

namespace {

using namespace tinwright;
using namespace tinwright::tools;

io::Lines two_layers_of_one_file() {
    io::Lines lines;
    lines.lines.resize(3);
    lines.parts = {{7, 0, true, false}, {7, 1, true, false}, {4, 0, false, false}};
    lines.slices = {{LineRole::Lake, 0, "water.gpkg", "lakes", 0, 2, 0},
                    {LineRole::River, 1, "water.gpkg", "streams", 2, 1, 0}};
    return lines;
}

io::Samples text_samples() {
    io::Samples samples;
    samples.points.resize(2);
    samples.slices.push_back({io::SampleSlice::Kind::Text, 0, "points.csv", "", 0, 2, 0, {}, 2});
    return samples;
}

}  // namespace

TEST_SUITE("tools/water_finding_text") {
    TEST_CASE("every kind has a key and words of its own") {
        std::set<std::string> keys;
        std::set<std::string> words;
        for (std::size_t i = 0; i < WaterFinding::kKinds; ++i) {
            keys.insert(finding_key(static_cast<WaterFinding::Kind>(i)));
            WaterFindingCounts counts{};
            counts[i] = 1;
            words.insert(finding_counts_text(counts));
            counts[i] = 2;
            CHECK(finding_counts_text(counts).starts_with("2 "));
            words.insert(finding_counts_text(counts));
        }
        CHECK(keys.size() == WaterFinding::kKinds);
        CHECK(words.size() == 2 * WaterFinding::kKinds);
        CHECK(finding_key(WaterFinding::Kind::RasterLakeUneven) == "raster_lake_uneven");
        CHECK(finding_counts_text({}).empty());
    }

    TEST_CASE("counts are listed in the order of kinds") {
        WaterFindingCounts counts{};
        counts[static_cast<std::size_t>(WaterFinding::Kind::LakesMeet)] = 1;
        counts[static_cast<std::size_t>(WaterFinding::Kind::RunsUphill)] = 2;
        CHECK(finding_counts_text(counts) == "2 rises, 1 meeting of lakes");
    }

    TEST_CASE("a finding names features, with the layer where a file has several") {
        const io::Lines lines = two_layers_of_one_file();
        const io::Samples samples = text_samples();
        const PartNames names(lines, samples);
        WaterFinding rise;
        rise.line = 2;
        rise.location = {10.00000049, 20};
        rise.z = 9.25;
        rise.other_z = 9;
        rise.amount = 0.25;
        rise.chainage = 30;
        rise.length = 5;
        CHECK(finding_text(rise, names) ==
              "water.gpkg, layer streams: feature 4 runs uphill, by 0.25 along 5 at (10, 20), 30 from its "
              "start, z 9.25 and 9");
        WaterFinding shore;
        shore.kind = WaterFinding::Kind::ShoreUnderWater;
        shore.line = 0;
        shore.sample = 1;
        shore.z = 4;
        shore.other_z = 5;
        shore.amount = 1;
        CHECK(finding_text(shore, names) ==
              "water.gpkg, layer lakes: feature 7 is above points.csv: line 3 beside it, by 1 at (0, 0), z 4 "
              "and 5");
        WaterFinding meeting;
        meeting.kind = WaterFinding::Kind::LakesMeet;
        meeting.line = 0;
        meeting.other_line = 1;
        CHECK(
            finding_text(meeting, names) ==
            "water.gpkg, layer lakes: feature 7 meets water.gpkg, layer lakes: feature 7, part 1 at (0, 0)");
    }
}
