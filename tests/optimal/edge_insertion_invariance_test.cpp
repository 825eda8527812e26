#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tinwright/optimal/triangulate.hpp"

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// What an optimal TIN does not depend on: the order of samples, threads, and where the axes are.

namespace {

Triangulated triangulate_to(Scope scope, Criterion criterion, const std::vector<Point3>& samples,
                            int threads = 1) {
    TriangulateOptions options;
    options.optimize.emplace();
    options.optimize->criterion = criterion;
    options.optimize->scope = scope;
    options.threads = threads;
    options.duplicates.policy = DuplicatePolicy::Mean;  // some families repeat a location
    return triangulate(samples, options);
}

/// Sorted measures, worst first, in the criterion's unit; slopes and eccentricities as multiples of `unit`.
std::vector<long double> reports_of(const Tin& tin, Criterion criterion, double unit = 1) {
    std::vector<long double> reports;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            reports.push_back(measure_face(tin, {f}, criterion) / unit);
        }
    }
    std::sort(reports.begin(), reports.end(), std::greater<>());
    if (criterion_traits(criterion).is_greater_better) {
        std::reverse(reports.begin(), reports.end());
    }
    return reports;
}

/// Coordinates in quarters and elevations in sixteenths, so that turning, scaling by powers of two and moving
/// z are exact.
std::vector<Point3> binary_samples(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    std::vector<Point3> samples(count);
    for (Point3& p : samples) {
        p = {random.key(0x1p22) / 4, random.key(0x1p22) / 4, random.key(0x1p24) / 16};
    }
    return samples;
}

struct Transformation {
    const char* name;
    Point3 (*apply)(Point3 p);
    double scale = 1;        ///< of x and y
    bool is_for_all = true;  ///< else for slope only
};

constexpr std::array kTransformations{
    Transformation{"quarter turn",
                   [](Point3 p) {
                       return Point3{-p.y, p.x, p.z};
                   }},
    Transformation{"half turn",
                   [](Point3 p) {
                       return Point3{-p.x, -p.y, p.z};
                   }},
    Transformation{"three quarter turns",
                   [](Point3 p) {
                       return Point3{p.y, -p.x, p.z};
                   }},
    Transformation{"mirror in x",
                   [](Point3 p) {
                       return Point3{-p.x, p.y, p.z};
                   }},
    Transformation{"mirror in the diagonal",
                   [](Point3 p) {
                       return Point3{p.y, p.x, p.z};
                   }},
    Transformation{"half as large",
                   [](Point3 p) {
                       return Point3{p.x / 2, p.y / 2, p.z};
                   },
                   0.5},
    Transformation{"a thousand times as large",
                   [](Point3 p) {
                       return Point3{1024 * p.x, 1024 * p.y, p.z};
                   },
                   1024},
    Transformation{"elsewhere",
                   [](Point3 p) {
                       return Point3{p.x + 500000, p.y - 4000000, p.z};
                   }},
    Transformation{"raised",
                   [](Point3 p) {
                       return Point3{p.x, p.y, p.z + 4096};
                   }},
    Transformation{"upside down",
                   [](Point3 p) {
                       return Point3{p.x, p.y, -p.z};
                   }},
};

/// How a criterion's unit grows with x and y: lengths do, ratios of z to them shrink, angles stay.
double unit_of(Criterion criterion, double scale) {
    switch (criterion_traits(criterion).unit) {
        case MeasureUnit::Length:
            return scale;
        case MeasureUnit::Ratio:
            return 1 / scale;
        case MeasureUnit::Degree:
            break;
    }
    return 1;
}

std::vector<std::pair<std::string, std::vector<Point3>>> sample_sets(std::uint64_t seed) {
    Random random(seed);
    std::vector<Point3> grid;
    for (const Key2 key : grid_keys(20, 15)) {
        grid.push_back({key.x, key.y, static_cast<double>(random.integer(0, 3))});
    }
    std::vector<Point3> contours;
    for (const Point3& p : decimal_samples(random, 300, 1, 1000, 2000, 50)) {
        contours.push_back({p.x, p.y, 10 * std::floor(p.x / 8)});
    }
    return {{"decimal", decimal_samples(random, 400, 2, 400000, 5000000, 100)},
            {"scan rows", scan_samples(random, 400)},
            {"grid", shuffled(random, grid)},
            {"contours", contours}};
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_invariance") {
    TEST_CASE(
        "the same samples give the same bytes in any order, with one thread or two, with ties or without") {
        // Let two threads run even where the machine has one processor.
        const tbb::global_control allow_two(tbb::global_control::max_allowed_parallelism, 2);
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            for (const auto& set : sample_sets(static_cast<std::uint64_t>(seed))) {
                CAPTURE(set.first);
                const std::vector<Point3>& samples = set.second;
                Random random(static_cast<std::uint64_t>(seed));
                const auto other = shuffled(random, samples);
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    for (const Scope scope : {kVectorScope, kMaxScope, Scope{}}) {
                        CAPTURE(static_cast<int>(scope.kind));
                        const auto expected = words_of(triangulate_to(scope, criterion, samples).tin);
                        REQUIRE(words_of(triangulate_to(scope, criterion, other).tin) == expected);
                        REQUIRE(words_of(triangulate_to(scope, criterion, samples, 2).tin) == expected);
                        REQUIRE(words_of(triangulate_to(scope, criterion, other, 2).tin) == expected);
                    }
                }
            }
        }
    }

    TEST_CASE(
        "in general position the sorted vector is that of the turned, mirrored, scaled and moved samples") {
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            const std::vector<Point3> samples = binary_samples(static_cast<std::uint64_t>(seed), 300);
            for (const Criterion criterion : kInsertionCriteria) {
                CAPTURE(name_of(criterion));
                const auto expected =
                    reports_of(triangulate_to(kVectorScope, criterion, samples).tin, criterion);
                const double worst = triangulate_to(kMaxScope, criterion, samples).report.optimize->after.all;
                REQUIRE(are_close(worst, expected.front()));
                for (const Transformation& transformation : kTransformations) {
                    CAPTURE(std::string(transformation.name));
                    std::vector<Point3> moved(samples.size());
                    std::transform(samples.begin(), samples.end(), moved.begin(), transformation.apply);
                    const double unit = unit_of(criterion, transformation.scale);
                    const Tin tin = triangulate_to(kVectorScope, criterion, moved).tin;
                    REQUIRE(are_close(reports_of(tin, criterion, unit), expected));
                    const auto max = triangulate_to(kMaxScope, criterion, moved).report.optimize->after.all;
                    REQUIRE(are_close(max / unit, worst));
                }
            }
        }
    }
}
