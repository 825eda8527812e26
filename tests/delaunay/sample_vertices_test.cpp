#include "tinwright/delaunay/sample_vertices.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/curve.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr DuplicatePolicy kPolicies[] = {
    DuplicatePolicy::Error, DuplicatePolicy::First, DuplicatePolicy::Last,  DuplicatePolicy::Min,
    DuplicatePolicy::Max,   DuplicatePolicy::Mean,  DuplicatePolicy::Median};

/// Elevation of a location's samples, in the order handed in, as the policy's name says.
double expected_z(DuplicatePolicy policy, std::vector<double> z) {
    const double first = z.at(0);
    const double last = z.back();
    std::sort(z.begin(), z.end());
    const std::size_t half = z.size() / 2;
    switch (policy) {
        case DuplicatePolicy::First:
            return first;
        case DuplicatePolicy::Last:
            return last;
        case DuplicatePolicy::Min:
            return z.front();
        case DuplicatePolicy::Max:
            return z.back();
        case DuplicatePolicy::Median:
            return z.size() % 2 == 1 ? z[half] : (z[half - 1] + z[half]) / 2;
        default:
            return std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size());
    }
}

/// Samples with quarter elevations, whose means are exact, on few locations.
std::vector<Point3> crowded_samples(Random& random, std::size_t count) {
    std::vector<Point3> samples(count);
    for (Point3& sample : samples) {
        sample = {oracle::decimal_value(random.integer(0, 9), 1),
                  oracle::decimal_value(random.integer(0, 9), 1), static_cast<double>(random.integer(0, 7))};
    }
    return samples;
}

struct Outcome {
    std::string text;
    std::vector<std::size_t> samples;
};

Outcome refusal_of(const std::vector<Point3>& samples, const DuplicateOptions& options = {}) {
    try {
        make_sample_vertices(samples, options);
    } catch (const InputError& error) {
        return {error.what(), error.samples()};
    }
    return {};
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_vertices(const SampleVertices& a, const SampleVertices& b) {
    return a.lattice == b.lattice && a.bounds == b.bounds &&
           std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end()) &&
           std::equal(a.z.begin(), a.z.end(), b.z.begin(), b.z.end(), same_bits);
}

}  // namespace

TEST_SUITE("delaunay/sample_vertices") {
    TEST_CASE("distinct samples become vertices in curve order and keep their place and elevation") {
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::vector<Point3> samples = seed % 2 == 0
                                                    ? scan_samples(random, 3000)
                                                    : decimal_samples(random, 3000, 6, 400000, 6000000, 2000);
            const SampleVertices vertices = make_sample_vertices(samples, {.policy = DuplicatePolicy::First});
            REQUIRE(vertices.keys.size() == vertices.z.size());
            REQUIRE(vertices.keys.size() == vertices.sample.size());
            for (std::size_t v = 0; v < vertices.keys.size(); ++v) {
                REQUIRE((v == 0 || precedes_on_curve(vertices.keys[v - 1], vertices.keys[v])));
                const Point3& sample = samples[vertices.sample[v]];
                REQUIRE(vertices.lattice.position(vertices.keys[v]) == Point2{sample.x, sample.y});
                REQUIRE(same_bits(vertices.z[v], sample.z));
            }
            REQUIRE(vertices.keys.size() + vertices.duplicates.equal + vertices.duplicates.conflicting ==
                    samples.size());
        }
    }

    TEST_CASE("every policy gives each location the elevation that its name says") {
        for (const DuplicatePolicy policy : kPolicies) {
            for (int seed = 0; seed < cases(30); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Point3> samples =
                    crowded_samples(random, static_cast<std::size_t>(random.integer(1, 400)));
                const double tolerance = policy == DuplicatePolicy::Error ? 8 : static_cast<double>(seed % 3);
                std::map<std::pair<double, double>, std::vector<std::uint32_t>> at;
                for (std::uint32_t i = 0; i < samples.size(); ++i) {
                    at[{samples[i].x, samples[i].y}].push_back(i);
                }
                const SampleVertices vertices =
                    make_sample_vertices(samples, {.policy = policy, .tolerance = tolerance});
                REQUIRE(vertices.keys.size() == at.size());
                std::size_t equal = 0;
                std::size_t conflicting = 0;
                for (std::size_t v = 0; v < vertices.keys.size(); ++v) {
                    const Point2 p = vertices.lattice.position(vertices.keys[v]);
                    const std::vector<std::uint32_t>& group = at.at({p.x, p.y});
                    std::vector<double> z;
                    for (const std::uint32_t i : group) {
                        z.push_back(samples[i].z);
                    }
                    // Means may differ in the last place, by the order of summation.
                    REQUIRE(std::abs(vertices.z[v] - expected_z(policy, z)) <= 1e-14);
                    REQUIRE(vertices.sample[v] ==
                            (policy == DuplicatePolicy::Last ? group.back() : group.front()));
                    const auto [low, high] = std::minmax_element(z.begin(), z.end());
                    (*high - *low > tolerance ? conflicting : equal) += group.size() - 1;
                }
                REQUIRE(vertices.duplicates.equal == equal);
                REQUIRE(vertices.duplicates.conflicting == conflicting);
                REQUIRE(vertices.duplicates.first.size() <= 10);
                REQUIRE((conflicting == 0) == vertices.duplicates.first.empty());
            }
        }
    }

    TEST_CASE("equal duplicates merge without a word, and keep their elevation to the bit") {
        const double z = 0.1;
        const SampleVertices vertices =
            make_sample_vertices(std::vector<Point3>{{1, 1, z}, {2, 2, 5}, {1, 1, z}, {1, 1, z}});
        CHECK(vertices.duplicates.equal == 2);
        CHECK(vertices.duplicates.conflicting == 0);
        CHECK(same_bits(vertices.z[0], z));
    }

    TEST_CASE("conflicting duplicates are refused with the number of places and the first of them") {
        const std::vector<Point3> samples{{5, 5, 1},   {0.25, 0.5, 7}, {9, 9, 2},     {5, 5, 1.5},
                                          {3, 1, 0.5}, {5, 5, 4},      {0.25, 0.5, 9}};
        try {
            make_sample_vertices(samples);
            FAIL("accepted");
        } catch (const DuplicateError& error) {
            CHECK(std::string(error.what()) ==
                  "2 locations have samples with different elevations, the first at (0.25, 0.5) with z from "
                  "7 to 9; "
                  "say which to take with --duplicates first|last|min|max|mean|median, or allow for the "
                  "difference "
                  "with --duplicate-tolerance");
            CHECK(error.count() == 2);
            REQUIRE(error.first().size() == 2);
            CHECK(error.first()[0].location == Point2{0.25, 0.5});
            CHECK(error.first()[0].samples == std::vector<std::size_t>{1, 6});
            CHECK(error.first()[1].samples == std::vector<std::size_t>{0, 3, 5});
            CHECK(error.first()[1].z_min == 1);
            CHECK(error.first()[1].z_max == 4);
        }
        CHECK(refusal_of({{5, 5, 1}, {5, 5, 1.5}}).text ==
              "1 location has samples with different elevations, at (5, 5) with z from 1 to 1.5; say which "
              "to take "
              "with --duplicates first|last|min|max|mean|median, or allow for the difference with "
              "--duplicate-tolerance");
    }

    TEST_CASE("a difference of exactly the tolerance is none") {
        const std::vector<Point3> samples{{5, 5, 1}, {5, 5, 1.5}, {0, 0, 0}};
        const SampleVertices vertices = make_sample_vertices(samples, {.tolerance = 0.5});
        CHECK(vertices.duplicates.equal == 1);
        CHECK(vertices.z[1] == 1.25);
        CHECK_FALSE(refusal_of(samples, {.tolerance = 0.499}).text.empty());
    }

    TEST_CASE("no more than ten conflicts are described, all are counted") {
        std::vector<Point3> samples;
        for (int i = 0; i < 25; ++i) {
            samples.push_back({static_cast<double>(i), 0, 1});
            samples.push_back({static_cast<double>(i), 0, 2});
        }
        try {
            make_sample_vertices(samples);
            FAIL("accepted");
        } catch (const DuplicateError& error) {
            CHECK(error.first().size() == 10);
            CHECK(error.count() == 25);
        }
    }

    TEST_CASE("the vertices depend on the set of samples alone, not on their order") {
        for (const DuplicatePolicy policy :
             {DuplicatePolicy::Error, DuplicatePolicy::Min, DuplicatePolicy::Max, DuplicatePolicy::Mean,
              DuplicatePolicy::Median}) {
            for (int seed = 0; seed < cases(20); ++seed) {
                CAPTURE(seed);
                CAPTURE(static_cast<int>(policy));
                Random random(static_cast<std::uint64_t>(seed));
                std::vector<Point3> samples = crowded_samples(random, 500);
                for (Point3& sample : samples) {
                    sample.z = random.real() - 0.5;
                }
                // Zeros of both signs are equal elevations, yet differ in their bits.
                samples.insert(samples.end(),
                               {{50, 50, 0.0}, {50, 50, -0.0}, {51, 51, -0.0}, {51, 51, -0.0}});
                const DuplicateOptions options{.policy = policy, .tolerance = 1};
                const SampleVertices vertices = make_sample_vertices(samples, options);
                REQUIRE(same_vertices(make_sample_vertices(shuffled(random, samples), options), vertices));
            }
        }
    }

    TEST_CASE("the vertices are the same for any number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        Random random(7);
        std::vector<Point3> samples = scan_samples(random, 150000);
        samples.insert(samples.end(), samples.begin(), samples.begin() + 30000);
        for (Point3& sample : samples) {
            sample.z = 100 * random.real();
        }
        const DuplicateOptions options{.policy = DuplicatePolicy::Mean};
        SampleVertices one;
        tbb::task_arena(1).execute([&] { one = make_sample_vertices(samples, options); });
        CHECK(one.duplicates.conflicting >= 30000);
        for (const int threads : {2, 4}) {
            tbb::task_arena(threads).execute([&] {
                const SampleVertices several = make_sample_vertices(samples, options);
                CHECK(same_vertices(several, one));
                CHECK(std::equal(several.sample.begin(), several.sample.end(), one.sample.begin(),
                                 one.sample.end()));
            });
        }
    }

    TEST_CASE("no sample gives no vertex") {
        const SampleVertices vertices = make_sample_vertices({});
        CHECK(vertices.keys.empty());
        CHECK(vertices.bounds.is_empty());
    }

    TEST_CASE("an elevation that is not finite is refused by its sample's number") {
        for (const double bad :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            const Outcome outcome = refusal_of({{0, 0, 0}, {1.5, 2, bad}, {3, 3, bad}});
            CHECK(outcome.text ==
                  "the elevation of the sample at (1.5, 2) is not a finite number; remove the sample or give "
                  "its z");
            CHECK(outcome.samples == std::vector<std::size_t>{1});
        }
    }

    TEST_CASE("a lattice coarser than the data merges rounding noise only") {
        // Digits by the dozen make the lattice binary and not exact.
        std::vector<Point3> samples{
            {0.123456789012345, 0.333333333333333, 1}, {1000 / 3.0, 1000 / 7.0, 2}, {50, 900, 3}};
        const double noisy = std::nextafter(samples[1].x, 1e9);
        samples.push_back({noisy, samples[1].y, 2});
        const SampleVertices vertices = make_sample_vertices(samples);
        CHECK_FALSE(vertices.lattice.is_exact());
        CHECK(vertices.keys.size() == 3);
        CHECK(vertices.duplicates.equal == 1);
        // Two places that somebody wrote down as different are not one.
        samples.back() = {50.000000000001, 900, 3};
        CHECK(
            refusal_of(samples).text.starts_with("the extent of the samples is too large for their detail: "
                                                 "(50, 900) and (50.000000000001, 900) are "
                                                 "closer than "));
    }
}
