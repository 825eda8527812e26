#include "vertex_origins.hpp"

#include <doctest/doctest.h>

using namespace tinwright;
using tinwright::tools::make_vertex_origins;

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

}  // namespace

TEST_SUITE("tools/vertex_origins") {
    using Kind = io::SampleSlice::Kind;

    TEST_CASE("sources are numbered by the first vertex they own") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Vector, 0, 0, 2, 100),
                                                  slice(Kind::Vector, 1, 2, 2, 7)};
        const auto origins = make_vertex_origins(tin_of({3, 0, 2, 1}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{1, 2, 1, 2});
        CHECK(origins.feature == std::vector<std::int64_t>{8, 100, 7, 101});
    }

    TEST_CASE("ids of text rows are kept on request only") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Text, 0, 0, 3, 2)};
        const auto without = make_vertex_origins(tin_of({2, 0, 1}), slices, false);
        CHECK(without.source == std::vector<std::int32_t>{1, 1, 1});
        CHECK(without.feature.empty());
        const auto with = make_vertex_origins(tin_of({2, 0, 1}), slices, true);
        CHECK(with.feature == std::vector<std::int64_t>{4, 2, 3});
    }

    TEST_CASE("text beside a vector layer has no feature ids") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Text, 0, 0, 1, 2),
                                                  slice(Kind::Vector, 1, 1, 1, 5)};
        const auto origins = make_vertex_origins(tin_of({0, 1}), slices, false);
        CHECK(origins.feature == std::vector<std::int64_t>{-1, 5});
    }

    TEST_CASE("slices of one source share its number, and empty slices own nothing") {
        const std::vector<io::SampleSlice> slices{
            slice(Kind::Vector, 0, 0, 1, 1), slice(Kind::Vector, 0, 1, 0, 1), slice(Kind::Vector, 0, 1, 1, 1),
            slice(Kind::Vector, 1, 2, 1, 9)};
        const auto origins = make_vertex_origins(tin_of({1, 2, 0}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{1, 2, 1});
        CHECK(origins.feature == std::vector<std::int64_t>{1, 9, 1});
    }

    TEST_CASE("a vertex without a sample has no source") {
        const std::vector<io::SampleSlice> slices{slice(Kind::Vector, 0, 0, 1, 1)};
        const auto origins = make_vertex_origins(tin_of({Tin::kNoSample, 0}), slices, false);
        CHECK(origins.source == std::vector<std::int32_t>{0, 1});
        CHECK(origins.feature == std::vector<std::int64_t>{-1, 1});
    }
}
