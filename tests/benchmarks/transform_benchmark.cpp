#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <proj.h>
#include <tbb/task_arena.h>

#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/crs.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

namespace {

using Samples = std::vector<tinwright::Point3>;

/// Points in a rectangle of the system that they come from.
struct Transformation {
    std::string name;
    const char* from;
    const char* to;
    double x0, y0, x1, y1;
};

Samples random_points(const Transformation& transformation, std::size_t count) {
    tinwright_tests::Random random(1);
    Samples points(count);
    for (tinwright::Point3& point : points) {
        point.x = std::lerp(transformation.x0, transformation.x1, random.real());
        point.y = std::lerp(transformation.y0, transformation.y1, random.real());
        point.z = 100 * random.real();
    }
    return points;
}

double sum_of(const Samples& points) {
    double sum = 0;
    for (const tinwright::Point3& point : points) {
        sum += point.x + 2 * point.y + 3 * point.z;
    }
    return sum;
}

/// From the definitions of two systems to points in place.
Work transforming(const Transformation& transformation, const Samples& points, int threads) {
    return [&transformation, &points, threads](Meter& meter) {
        Samples moved = points;
        meter.start();
        tbb::task_arena(threads).execute([&] {
            const tinwright::io::CoordinateTransform way(tinwright::io::Crs::parse(transformation.from),
                                                         tinwright::io::Crs::parse(transformation.to));
            if (!way.forward(moved).empty()) {
                throw std::runtime_error("points cannot be transformed");
            }
        });
        meter.stop();
        meter.note(sum_of(moved));
    };
}

/// PROJ's own call for arrays, and nothing around it.
Work transforming_barely(const Transformation& transformation, const Samples& points) {
    return [&transformation, &points](Meter& meter) {
        Samples moved = points;
        meter.start();
        PJ_CONTEXT* const context = proj_context_create();
        PJ* const plain = proj_create_crs_to_crs(context, transformation.from, transformation.to, nullptr);
        PJ* const way = proj_normalize_for_visualization(context, plain);
        const std::size_t count = moved.size();
        constexpr std::size_t kStride = sizeof(tinwright::Point3);
        proj_trans_generic(way, PJ_FWD, &moved.front().x, kStride, count, &moved.front().y, kStride, count,
                           nullptr, 0, 0, nullptr, 0, 0);
        proj_destroy(way);
        proj_destroy(plain);
        proj_context_destroy(context);
        meter.stop();
        meter.note(sum_of(moved));
    };
}

void measure(const Transformation& transformation, std::size_t count, int rounds, ResultTable& table) {
    const Samples points = random_points(transformation, count);
    const std::array<std::function<Measured()>, 3> contenders{
        [&] { return measure_in_child(transforming(transformation, points, 1)); },
        [&] { return measure_in_child(transforming_barely(transformation, points)); },
        [&] { return measure_in_child(transforming(transformation, points, 2)); }};
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    if (results[0].note != results[1].note || results[0].note != results[2].note) {
        throw std::runtime_error(transformation.name + ": the results differ");
    }
    table.add(transformation.name, in_seconds(results[0].cpu_seconds), in_seconds(results[1].cpu_seconds),
              results[0].cpu_seconds / results[1].cpu_seconds, at_most(1.3));
    table.add(transformation.name + ": two threads, wall time", in_seconds(results[2].wall_seconds),
              "one: " + in_seconds(results[0].wall_seconds),
              results[0].wall_seconds / results[2].wall_seconds, std::nullopt, "x");
}

}  // namespace

void run_transform(const Settings& settings) {
    ResultTable table("Coordinates of 10^7 points", "tinwright", "PROJ alone");
    const std::array<Transformation, 3> transformations{
        Transformation{"WGS 84 to UTM zone 32", "EPSG:4326", "EPSG:32632", 6, 40, 12, 60},
        Transformation{"WGS 84 to Lambert-93", "EPSG:4326", "EPSG:2154", -4, 42, 8, 51},
        Transformation{"Lambert II to Lambert-93 by a grid of datum shifts", "EPSG:27572", "EPSG:2154",
                       150000, 1800000, 950000, 2500000}};
    for (const Transformation& transformation : transformations) {
        measure(transformation, settings.count(1e7), std::min(settings.rounds, 3), table);
    }
}

}  // namespace tinwright_benchmarks
