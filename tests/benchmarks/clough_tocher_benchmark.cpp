#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/clough_tocher.hpp"
#include "tinwright/surface/gridding.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/held_out_sets.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::GradientMethod;
using tinwright::Point2;
using tinwright::Tin;

/// Reads x, y, z as 64-bit numbers; with a side evaluates the surface at the cells of a raster over the
/// points, without one writes the gradients at the points.
constexpr const char* kScript = R"(import sys
import numpy
from scipy.interpolate import CloughTocher2DInterpolator
points = numpy.fromfile(sys.argv[1]).reshape(-1, 3)
surface = CloughTocher2DInterpolator(points[:, :2], points[:, 2])
if len(sys.argv) == 4:
    surface.grad.reshape(-1, 2).tofile(sys.argv[3])
else:
    side = int(sys.argv[2])
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    centers = (numpy.arange(side) + 0.5) / side
    x = low[0] + centers * (high[0] - low[0])
    y = high[1] - centers * (high[1] - low[1])
    for rows in range(0, side, 256):
        surface(*numpy.meshgrid(x, y[rows:rows + 256]))
)";

/// A Python that has scipy.
std::optional<std::string> find_python() {
    for (const char* python : {"python3", "/usr/bin/python3"}) {
        try {
            measure_program({python, "-c", "import scipy.interpolate"});
            return python;
        } catch (const std::runtime_error&) {
            continue;
        }
    }
    return std::nullopt;
}

void write_numbers(const std::string& path, const Points& points) {
    std::ofstream file(path, std::ios::binary);
    for (const tinwright::Point3& p : points) {
        const std::array<double, 3> numbers{p.x, p.y, p.z};
        file.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    }
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}

/// From points in memory to the last band of cells.
Work gridding(const Points& points, int side, int threads) {
    return [&points, side, threads](Meter& meter) {
        tbb::task_arena arena(threads);
        meter.start();
        arena.execute([&] {
            tinwright::TriangulateOptions options;
            options.threads = threads;
            const Tin tin = tinwright::triangulate(points, options).tin;
            const auto surface = tinwright::make_clough_tocher(tin, {});
            const auto grid = choose_grid(tin, {.size = tinwright::GridRequest::Size{side, side}});
            constexpr std::int64_t kRows = 256;
            tinwright::SurfaceGridder gridder(tin, surface.get(), grid, kRows, {});
            std::vector<float> values(static_cast<std::size_t>(kRows * side));
            const std::span<float> cells(values);
            for (std::int64_t band = 0; band < gridder.band_count(); ++band) {
                const auto [first, last] = gridder.band_rows(band);
                const std::span<float> used = cells.first(static_cast<std::size_t>((last - first) * side));
                gridder.fill(band, std::span(&used, 1), -9999.0F);
            }
        });
        meter.stop();
    };
}

/// Samples of a function on the unit square, to nine decimals.
Points function_points(int number, int count) {
    Points points = uniform_points(static_cast<std::size_t>(count));
    for (tinwright::Point3& p : points) {
        p.x = std::round(p.x / 4000 * 1e9) / 1e9;
        p.y = std::round(p.y / 4000 * 1e9) / 1e9;
        p.z = franke(number, p.x, p.y);
    }
    return points;
}

/// Root of the mean squared error of gradients at points.
double gradient_error(int number, const Points& points, const std::vector<Point2>& gradients) {
    constexpr double kStep = 1e-6;
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [x, y, z] = points[i];
        const double along_x = (franke(number, x + kStep, y) - franke(number, x - kStep, y)) / (2 * kStep);
        const double along_y = (franke(number, x, y + kStep) - franke(number, x, y - kStep)) / (2 * kStep);
        sum += std::pow(gradients[i].x - along_x, 2) + std::pow(gradients[i].y - along_y, 2);
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

std::vector<Point2> our_gradients(const Points& points) {
    const Tin tin = tinwright::triangulate(points).tin;
    const tinwright::CornerGradients corner(tin, {}, GradientMethod::Octant);
    std::vector<Point2> gradients(points.size());
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            gradients[tin.sample[tin.mesh.vertex({f}, i).value]] = corner.at(tinwright::half_edge({f}, i));
        }
    }
    return gradients;
}

std::vector<Point2> their_gradients(const std::string& path, std::size_t count) {
    std::vector<Point2> gradients(count);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(gradients.data()),
                   static_cast<std::streamsize>(count * sizeof(Point2)))) {
        throw std::runtime_error("no gradients in " + path);
    }
    return gradients;
}

}  // namespace

void run_clough_tocher(const Settings& settings) {
    const std::optional<std::string> python = find_python();
    const std::string script = settings.scratch + "/clough_tocher.py";
    const std::string numbers = settings.scratch + "/clough_tocher.raw";
    const std::string answer = settings.scratch + "/gradients.raw";
    std::ofstream(script) << kScript;
    ResultTable table("Clough-Tocher surfaces", "tinwright", "scipy's CloughTocher2DInterpolator");

    const Points points = uniform_points(settings.count(1e6));
    const int side = settings.side(4000);
    write_numbers(numbers, points);
    std::vector<std::function<Measured()>> contenders{
        [&] { return measure_in_child(gridding(points, side, 1)); },
        [&] { return measure_in_child(gridding(points, side, 2)); }};
    if (python) {
        contenders.emplace_back([&] {
            return measure_program({*python, script, numbers, std::to_string(side)});
        });
    }
    const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
    const std::string job = "10^6 sites to 4000 x 4000 cells, triangulation included";
    const double ours = results[0].cpu_seconds;
    table.add(job + ": one thread", in_seconds(ours),
              python ? in_seconds(results[2].cpu_seconds) : "not installed",
              python ? std::optional(results[2].cpu_seconds / ours) : std::nullopt, std::nullopt, "x");
    if (python) {
        table.add(job + ": two threads, by the clock", in_seconds(results[1].wall_seconds),
                  in_seconds(results[2].wall_seconds), results[2].wall_seconds / results[1].wall_seconds,
                  at_least(10), "x");
    }
    table.add(job + ": two threads", in_seconds(results[1].wall_seconds),
              "one: " + in_seconds(results[0].wall_seconds),
              results[0].wall_seconds / results[1].wall_seconds, std::nullopt, "x");

    for (const int count : {100, 1000}) {
        double product = 1;
        for (int number = 1; number <= 6; ++number) {
            const Points samples = function_points(number, count);
            const double error = gradient_error(number, samples, our_gradients(samples));
            std::optional<double> other;
            if (python) {
                write_numbers(numbers, samples);
                measure_program({*python, script, numbers, "0", answer});
                other = gradient_error(number, samples, their_gradients(answer, samples.size()));
            }
            table.add("error of gradients, Franke's function " + std::to_string(number) + ", " +
                          std::to_string(count) + " samples",
                      tinwright_benchmarks::number(error),
                      other ? tinwright_benchmarks::number(*other) : "not installed",
                      other ? std::optional(error / *other) : std::nullopt);
            product *= other ? error / *other : 1;
        }
        if (python) {
            table.add("error of gradients, geometric mean of the six, " + std::to_string(count) + " samples",
                      "", "", std::pow(product, 1.0 / 6), at_most(1));
        }
    }
}

}  // namespace tinwright_benchmarks
