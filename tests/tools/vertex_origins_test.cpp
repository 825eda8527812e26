#include "vertex_origins.hpp"

#include <doctest/doctest.h>

using namespace tinwright;
using tinwright::tools::make_tin_origins;
using tinwright::tools::TinOrigins;

namespace {

io::SampleSlice slice(io::SampleSlice::Kind kind, std::size_t source, std::size_t first, std::size_t count,
                      std::int64_t first_id) {
    io::SampleSlice made;
    made.kind = kind;
    made.source = source;
    made.first = first;
    made.count = count;
    made.first_id = first_id;
    return made;
}

/// A TIN of which only the samples matter.
Tin tin_of(const std::vector<std::uint32_t>& samples) {
    Tin tin;
    tin.keys.resize(samples.size());
    tin.sample.assign(samples.begin(), samples.end());
    return tin;
}

io::VertexOrigins origins_of(const Tin& tin, const std::vector<io::SampleSlice>& slices, bool keep_ids) {
    return make_tin_origins(tin, slices, {}, keep_ids).vertices;
}

/// Lines of so many points each, one a source, with features from 70 on.
io::Lines lines_of(const std::vector<std::size_t>& points) {
    io::Lines lines;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Breakline line;
        line.points.resize(points[i]);
        lines.lines.push_back(line);
        lines.parts.push_back({70 + static_cast<std::int64_t>(i), 0, false, false});
        io::LineSlice slice;
        slice.source = i;
        slice.first = i;
        slice.count = 1;
        lines.slices.push_back(slice);
    }
    return lines;
}

}  // namespace

TEST_SUITE("tools/vertex_origins") {
    using Kind = io::SampleSlice::Kind;

    TEST_CASE("sources are numbered by the first vertex they own") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Vector, 0, 0, 2, 100),
                                                  slice(Kind::Vector, 1, 2, 2, 7)};
        const auto origins = origins_of(tin_of({3, 0, 2, 1}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{1, 2, 1, 2});
        CHECK(origins.feature == std::vector<std::int64_t>{8, 100, 7, 101});
    }

    TEST_CASE("ids of text rows are kept on request only") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Text, 0, 0, 3, 2)};
        const auto without = origins_of(tin_of({2, 0, 1}), slices, false);
        CHECK(without.source == std::vector<std::int32_t>{1, 1, 1});
        CHECK(without.feature.empty());
        const auto with = origins_of(tin_of({2, 0, 1}), slices, true);
        CHECK(with.feature == std::vector<std::int64_t>{4, 2, 3});
    }

    TEST_CASE("text beside a vector layer has no feature ids") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Text, 0, 0, 1, 2),
                                                  slice(Kind::Vector, 1, 1, 1, 5)};
        const auto origins = origins_of(tin_of({0, 1}), slices, false);
        CHECK(origins.feature == std::vector<std::int64_t>{-1, 5});
    }

    TEST_CASE("slices of one source share its number, and empty slices own nothing") {
        const std::vector<io::SampleSlice> slices{
            slice(Kind::Vector, 0, 0, 1, 1), slice(Kind::Vector, 0, 1, 0, 1), slice(Kind::Vector, 0, 1, 1, 1),
            slice(Kind::Vector, 1, 2, 1, 9)};
        const auto origins = origins_of(tin_of({1, 2, 0}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{1, 2, 1});
        CHECK(origins.feature == std::vector<std::int64_t>{1, 9, 1});
    }

    TEST_CASE("a vertex without a sample has no source") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Vector, 0, 0, 1, 1)};
        const auto origins = origins_of(tin_of({Tin::kNoSample, 0}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{0, 1});
        CHECK(origins.feature == std::vector<std::int64_t>{-1, 1});
    }

    TEST_CASE("a vertex of a line has the line's source and feature, and one where lines cross has none") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Vector, 0, 0, 2, 5)};
        const Tin tin = tin_of({3, 0, 5, Tin::kCrossing, 1, Tin::kNoSample});
        const TinOrigins origins = make_tin_origins(tin, slices, lines_of({2, 3}), false);
        // points 2 and 3 are the first line's, 4 to 6 the second's
        CHECK(origins.vertices.source == std::vector<std::int32_t>{1, 2, 3, 0, 2, 0});
        CHECK(origins.vertices.feature == std::vector<std::int64_t>{70, 5, 71, -1, 6, -1});
        REQUIRE(origins.lines.size() == 2);
        CHECK(origins.lines[0] == io::LineOrigin{LineRole::Breakline, true, 1, 70});
        CHECK(origins.lines[1] == io::LineOrigin{LineRole::Breakline, true, 3, 71});
    }

    TEST_CASE("sources of lines that own no vertex are numbered by their edges") {
        Tin tin = tin_of({0, 1, 2});
        tin.traces = {{{0}, {1}, 2, 1}, {{1}, {2}, 0, 1}};
        const std::vector<io::SampleSlice> slices{slice(Kind::Text, 0, 0, 3, 2)};
        const TinOrigins origins = make_tin_origins(tin, slices, lines_of({2, 2, 2}), false);
        REQUIRE(origins.lines.size() == 3);
        CHECK(origins.lines[2].source == 2);
        CHECK(origins.lines[0].source == 3);
        CHECK(origins.lines[1].source == 4);
    }

    TEST_CASE("lines alone have origins too") {
        const TinOrigins origins = make_tin_origins(tin_of({1, 0, 2}), {}, lines_of({3}), false);
        CHECK(origins.vertices.source == std::vector<std::int32_t>{1, 1, 1});
        CHECK(origins.vertices.feature == std::vector<std::int64_t>{70, 70, 70});
    }
}
