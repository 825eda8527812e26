#include <array>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/smooth_reader.hpp"
#include "tinwright/surface/spline_store.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/terrain_points.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::SplineBlock;
using tinwright::SplineStore;
using tinwright::VertexId;

double cpu_clock() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

tinwright::GridGeometry grid_over(const tinwright::Tin& tin, int side) {
    const tinwright::Box bounds = tin.bounds();
    return {bounds.x_min,
            bounds.y_max,
            (bounds.x_max - bounds.x_min) / side,
            (bounds.y_max - bounds.y_min) / side,
            side,
            side};
}

void prepare_all(const tinwright::SplineSources& sources, SplineStore& store) {
    const auto count = static_cast<std::uint32_t>(sources.tin.vertex_count());
    constexpr std::uint32_t kBlock = SplineBlock::kBlock;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, (count + kBlock - 1) / kBlock, 16),
                      [&](const tbb::blocked_range<std::uint32_t>& blocks) {
                          tinwright::SplineFitter fitter(sources);
                          for (std::uint32_t block = blocks.begin(); block < blocks.end(); ++block) {
                              store.block_of({block * kBlock}, fitter);
                          }
                      });
}

/// The middle of each cell, row by row.
std::vector<tinwright::SurfacePlace> places_of(const tinwright::Tin& tin, int side) {
    const tinwright::SurfaceLocator locator(tin);
    const tinwright::GridGeometry grid = grid_over(tin, side);
    std::vector<tinwright::SurfacePlace> places;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const auto place = locator.find(tinwright::Point2{grid.x_min + (column + 0.5) * grid.cell_width,
                                                              grid.y_max - (row + 0.5) * grid.cell_height});
            if (place) {
                places.push_back(*place);
            }
        }
    }
    return places;
}

/// Fits the splines of all vertices and keeps them; notes the seconds that a cell takes then.
Work preparing(const Points& points, int side, int threads) {
    return [&points, side, threads](Meter& meter) {
        const tinwright::Tin tin = tinwright::triangulate(points).tin;
        const tinwright::SharpEdges sharp;
        const tinwright::SmoothOptions options;
        const tinwright::QueryLattice lattice(tin);
        const std::vector<tinwright::SurfacePlace> places =
            threads == 1 ? places_of(tin, side) : std::vector<tinwright::SurfacePlace>{};
        tbb::task_arena arena(threads);
        meter.start();
        const std::vector<tinwright::HalfEdgeId> starts = tinwright::find_spline_starts(tin.mesh);
        const tinwright::SplineSources sources{tin, sharp, starts, options};
        SplineStore store(sources, std::numeric_limits<std::size_t>::max());
        arena.execute([&] { prepare_all(sources, store); });
        meter.stop();
        tinwright::SmoothReader reader(sources, lattice, store);
        double sum = 0;
        const double start = cpu_clock();
        for (const tinwright::SurfacePlace& place : places) {
            sum += reader.elevation(place);
        }
        const double seconds = cpu_clock() - start;
        meter.note(sum == 0 ? 0 : seconds / static_cast<double>(places.size()));
    };
}

/// From the finished TIN to the filled raster, splines being fitted where rows come by.
Work gridding(const Points& points, int side, int threads) {
    return [&points, side, threads](Meter& meter) {
        const tinwright::Tin tin = tinwright::triangulate(points).tin;
        const tinwright::GridGeometry grid = grid_over(tin, side);
        constexpr std::int64_t kRows = 64;
        std::vector<float> values(static_cast<std::size_t>(kRows * grid.columns), 0.0F);
        tbb::task_arena arena(threads);
        meter.start();
        arena.execute([&] {
            const auto surface = tinwright::make_smooth(tin, {});
            tinwright::SurfaceGridder gridder(tin, surface.get(), grid, kRows, {});
            for (std::int64_t band = 0; band < gridder.band_count(); ++band) {
                const auto [first, last] = gridder.band_rows(band);
                const std::span<float> rows =
                    std::span(values).first(static_cast<std::size_t>((last - first) * grid.columns));
                gridder.fill(band, std::span(&rows, 1), -9999.0F);
            }
        });
        meter.stop();
    };
}

}  // namespace

void run_smooth(const Settings& settings) {
    const Points points = fractal_points(settings.count(1e6));
    const int side = settings.side(2000);
    const auto vertices = static_cast<double>(points.size());
    const std::array<std::function<Measured()>, 4> contenders{
        [&] { return measure_in_child(preparing(points, side, 1)); },
        [&] { return measure_in_child(preparing(points, side, 2)); },
        [&] { return measure_in_child(gridding(points, side, 1)); },
        [&] { return measure_in_child(gridding(points, side, 2)); }};
    const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
    ResultTable table("Smooth surface of 10^6 samples, 2000 x 2000 cells", "tinwright", "compared with");
    const Measured& one = results[0];
    table.add("preparation, a vertex", in_seconds(one.cpu_seconds), "", 1e6 * one.cpu_seconds / vertices,
              at_most(150), " us");
    table.add("preparation, two threads to one", in_seconds(results[1].wall_seconds),
              in_seconds(one.wall_seconds), one.wall_seconds / results[1].wall_seconds, at_least(1.8), "x");
    table.add("memory, all prepared, a vertex", in_megabytes(one.peak_bytes), "", one.peak_bytes / vertices,
              at_most(500), " bytes");
    table.add("a cell, all prepared", in_seconds(one.note * side * side), "", 1e9 * one.note, at_most(1500),
              " ns");
    const Measured& raster = results[2];
    table.add("raster in bands of 64 rows: a vertex, all in all", in_seconds(raster.cpu_seconds), "",
              1e6 * raster.cpu_seconds / vertices, std::nullopt, " us");
    table.add("the same, two threads to one", in_seconds(results[3].wall_seconds),
              in_seconds(raster.wall_seconds), raster.wall_seconds / results[3].wall_seconds, std::nullopt,
              "x");
    table.add("the same: memory, a vertex", in_megabytes(raster.peak_bytes),
              "all prepared: " + in_megabytes(one.peak_bytes), raster.peak_bytes / vertices, std::nullopt,
              " bytes");
    table.add("the same with two threads: memory, a vertex", in_megabytes(results[3].peak_bytes),
              "all prepared: " + in_megabytes(one.peak_bytes), results[3].peak_bytes / vertices, std::nullopt,
              " bytes");
}

}  // namespace tinwright_benchmarks
