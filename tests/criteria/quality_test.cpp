#include "tinwright/criteria/quality.hpp"

#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

namespace {

using namespace tinwright;

/// A TIN on unit keys; faces as corner triples.
Tin make_small_tin(const std::vector<Key2>& keys, const std::vector<double>& z,
                   const std::vector<VertexId>& corners) {
    Tin tin;
    tin.lattice = Lattice::decimal(0, {0, 0});
    tin.mesh = make_mesh(keys.size(), corners);
    tin.keys.assign(keys.begin(), keys.end());
    tin.z.assign(z.begin(), z.end());
    tin.sample.assign(tin.keys.size(), Tin::kNoSample);
    return tin;
}

/// A square of side 10 in two right triangles, tilted so that z = x.
Tin tilted_square() {
    return make_small_tin({{0, 0}, {10, 0}, {0, 10}, {10, 10}}, {0, 10, 0, 10},
                          {{0}, {1}, {3}, {0}, {3}, {2}});
}

const MeasureSummary& summary_of(const QualityReport& report, FaceMeasure measure) {
    return report.summaries.at(static_cast<std::size_t>(measure));
}

}  // namespace

TEST_SUITE("criteria/quality") {
    TEST_CASE("a right triangle on a plane of slope 1 has the measures of the textbook") {
        const Tin tin = tilted_square();
        CHECK(measure_face(tin, {0}, FaceMeasure::LargestAngle) == doctest::Approx(90));
        CHECK(measure_face(tin, {0}, FaceMeasure::Slope) == doctest::Approx(45));
        CHECK(measure_face(tin, {0}, FaceMeasure::LongestEdge) == doctest::Approx(10 * std::sqrt(2.0)));
        CHECK(measure_face(tin, {0}, FaceMeasure::Area) == doctest::Approx(50));
        CHECK(slope_ratio(tin, {0}) == doctest::Approx(1));
    }

    TEST_CASE("slopes count the unit of z, and nothing else does") {
        const Tin tin = tilted_square();
        const double factor = std::sqrt(3.0);
        CHECK(measure_face(tin, {0}, FaceMeasure::Slope, factor) == doctest::Approx(60));
        CHECK(slope_ratio(tin, {0}, factor) == doctest::Approx(factor));
        CHECK(measure_face(tin, {0}, FaceMeasure::LongestEdge, factor) ==
              measure_face(tin, {0}, FaceMeasure::LongestEdge));
        const QualityReport report = assess_quality(tin, 5, {}, factor);
        CHECK(summary_of(report, FaceMeasure::Slope).maximum == doctest::Approx(60));
        CHECK(summary_of(report, FaceMeasure::Slope).worst.front().value == doctest::Approx(60));
        CHECK(report.area == doctest::Approx(100));
    }

    TEST_CASE("the angle of a needle is as good as that of any face") {
        // The apex stands 1 above the middle of an edge of 2 000 000: the angle lacks 2 atan(1e-6).
        const Tin tin = make_small_tin({{0, 0}, {2000000, 0}, {1000000, 1}}, {0, 0, 0}, {{0}, {1}, {2}});
        const double missing = 2 * std::atan(1e-6) * 180 / 3.14159265358979323846;
        CHECK(180 - measure_face(tin, {0}, FaceMeasure::LargestAngle) ==
              doctest::Approx(missing).epsilon(1e-6));
    }

    TEST_CASE("every face is counted once in every histogram") {
        const QualityReport report = assess_quality(tilted_square());
        REQUIRE(report.faces == 2);
        CHECK(report.area == doctest::Approx(100));
        REQUIRE(report.summaries.size() == kFaceMeasures.size());
        for (const MeasureSummary& summary : report.summaries) {
            const auto& histogram = summary.histogram;
            REQUIRE(histogram.bounds.size() == histogram.counts.size() + 1);
            CHECK(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}) == 2);
            CHECK(histogram.bounds.front() <= summary.minimum);
            CHECK(summary.maximum <= histogram.bounds.back());
            CHECK(summary.worst.size() == 2);
        }
    }

    TEST_CASE("the worst faces come greatest first and know whether they are on the border") {
        // A fan around (10, 10): a long flat face in the south, small ones elsewhere.
        const Tin tin = make_small_tin({{0, 0}, {100, 0}, {10, 10}, {0, 20}}, {0, 0, 0, 50},
                                       {{0}, {1}, {2}, {2}, {1}, {3}, {0}, {2}, {3}});
        const QualityReport report = assess_quality(tin, 2);
        const auto& edges = summary_of(report, FaceMeasure::LongestEdge).worst;
        REQUIRE(edges.size() == 2);
        CHECK(edges[0].face == FaceId{1});
        CHECK(edges[0].value == doctest::Approx(std::hypot(100, 20)));
        CHECK(edges[1].face == FaceId{0});
        CHECK(edges[0].is_on_border);
        CHECK(summary_of(report, FaceMeasure::Slope).minimum == 0);
    }

    TEST_CASE("lengths over many decades are counted by powers of ten") {
        const Tin tin = make_small_tin({{0, 0}, {1, 0}, {0, 1}, {1e9, 1e9}}, {0, 0, 0, 0},
                                       {{0}, {1}, {2}, {1}, {3}, {2}});
        const QualityReport report = assess_quality(tin);
        const Histogram& histogram = summary_of(report, FaceMeasure::LongestEdge).histogram;
        CHECK(histogram.counts.size() == 10);
        CHECK(histogram.counts.front() == 1);
        CHECK(histogram.counts.back() == 1);
    }

    TEST_CASE("a power of ten that all values share makes one bin") {
        // Two right triangles with legs of 2 and 1: every area is 1.
        const Tin tin =
            make_small_tin({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {0, 0, 0, 0}, {{0}, {1}, {2}, {0}, {2}, {3}});
        const QualityReport report = assess_quality(tin);
        const Histogram& histogram = summary_of(report, FaceMeasure::Area).histogram;
        CHECK(histogram.bounds == std::vector<double>{1, 2});
        CHECK(histogram.counts == std::vector<std::size_t>{2});
    }

    TEST_CASE("a TIN without faces has no summaries") {
        Tin tin;
        CHECK(assess_quality(tin).faces == 0);
        CHECK(assess_quality(tin).summaries.empty());
    }
}
