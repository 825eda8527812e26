#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/natural_neighbor.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/cgal_neighbor_peer.hpp"
#include "benchmarks/cgal_peer.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

using Kind = tinwright::NaturalNeighborOptions::Kind;

tinwright::GridGeometry grid_over(const Points& points, int side) {
    const auto [x_low, x_high] =
        std::minmax_element(points.begin(), points.end(), [](auto& p, auto& q) { return p.x < q.x; });
    const auto [y_low, y_high] =
        std::minmax_element(points.begin(), points.end(), [](auto& p, auto& q) { return p.y < q.y; });
    return {x_low->x, y_high->y, (x_high->x - x_low->x) / side, (y_high->y - y_low->y) / side, side, side};
}

/// From the finished TIN to the filled raster; notes the sum of the values.
Work gridding(const Points& points, const tinwright::GridGeometry& grid, Kind kind, int threads) {
    return [&points, grid, kind, threads](Meter& meter) {
        const tinwright::Tin tin = tinwright::triangulate(points).tin;
        std::vector<double> values(static_cast<std::size_t>(grid.columns * grid.rows));
        tbb::task_arena arena(threads);
        meter.start();
        arena.execute([&] {
            const std::unique_ptr<tinwright::Interpolator> surface =
                tinwright::make_natural_neighbor(tin, {}, {.kind = kind});
            tinwright::SurfaceGridder gridder(tin, surface.get(), grid, grid.rows, {});
            const std::span<double> band(values);
            gridder.fill(0, std::span(&band, 1), 0.0);
        });
        meter.stop();
        double sum = 0;
        for (const double value : values) {
            sum += value;
        }
        meter.note(sum);
    };
}

}  // namespace

void run_natural_neighbor(const Settings& settings) {
    const int side = settings.side(2000);
    const double cells = static_cast<double>(side) * side;
    ResultTable table("Natural neighbours of 10^6 samples, 2000 x 2000 cells", "tinwright", cgal_name());
    const auto measure = [&](const std::string& name, const Points& points) {
        const tinwright::GridGeometry grid = grid_over(points, side);
        std::vector<std::function<Measured()>> contenders;
        for (const Kind kind : {Kind::Sibson, Kind::Laplace, Kind::C1}) {
            contenders.emplace_back([&, kind] { return measure_in_child(gridding(points, grid, kind, 1)); });
        }
        contenders.emplace_back([&] { return measure_in_child(gridding(points, grid, Kind::Sibson, 2)); });
        if (has_cgal()) {
            contenders.emplace_back([&] {
                return measure_in_child(
                    [&](Meter& meter) { measure_cgal_natural_neighbors(points, grid, meter); });
            });
        }
        const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
        const Measured& sibson = results[0];
        const auto add_cells = [&](const std::string& what, const Measured& ours,
                                   std::optional<Target> target) {
            table.add(name + ": " + what + ", a cell", in_seconds(ours.cpu_seconds), "",
                      1e9 * ours.cpu_seconds / cells, target, " ns");
        };
        add_cells("Sibson", sibson, at_most(350));
        add_cells("Laplace", results[1], at_most(350));
        add_cells("C1, gradients included", results[2], std::nullopt);
        if (has_cgal()) {
            const Measured& peer = results[4];
            table.add(name + ": Sibson", in_seconds(sibson.cpu_seconds), in_seconds(peer.cpu_seconds),
                      sibson.cpu_seconds / peer.cpu_seconds, at_most(0.4));
        }
        table.add(name + ": Sibson, two threads to one", in_seconds(results[3].wall_seconds),
                  in_seconds(sibson.wall_seconds), sibson.wall_seconds / results[3].wall_seconds,
                  at_least(1.8), "x");
    };
    measure("uniform", uniform_points(settings.count(1e6)));
    measure("scan rows", scan_points(settings.count(1e6)));
}

}  // namespace tinwright_benchmarks
