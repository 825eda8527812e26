#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/scan_conversion.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

constexpr float kNodata = -9999;

/// As many rows as keep a band in the second-level cache's neighbourhood: 4 MiB.
std::int64_t band_rows(const tinwright::GridGeometry& grid) {
    return std::max<std::int64_t>(1, (std::int64_t{1} << 20) / grid.columns);
}

tinwright::Tin make_tin(const Points& points) { return tinwright::triangulate(points).tin; }

tinwright::GridGeometry grid_over(const tinwright::Tin& tin, int side) {
    const tinwright::Box bounds = tin.bounds();
    return {bounds.x_min,
            bounds.y_max,
            (bounds.x_max - bounds.x_min) / side,
            (bounds.y_max - bounds.y_min) / side,
            side,
            side};
}

/// Prepares rows and fills all bands, each in the buffer of the thread that fills it: what a raster written
/// band by band costs. Notes the faces.
Work scan_conversion(const Points& points, int side, int threads) {
    return [&points, side, threads](Meter& meter) {
        const tinwright::Tin tin = make_tin(points);
        const tinwright::GridGeometry grid = grid_over(tin, side);
        const std::int64_t rows = band_rows(grid);
        const auto band_cells = static_cast<std::size_t>(rows * grid.columns);
        tbb::task_arena arena(threads);
        tbb::enumerable_thread_specific<std::vector<float>> buffers;
        meter.start();
        arena.execute([&] {
            const tinwright::ScanConverter converter(tin, grid, rows);
            tbb::parallel_for(std::int64_t{0}, converter.band_count(), [&](std::int64_t band) {
                std::vector<float>& values = buffers.local();
                values.resize(band_cells);
                const auto [first, last] = converter.band_rows(band);
                converter.fill(
                    band, std::span(values).first(static_cast<std::size_t>((last - first) * grid.columns)),
                    kNodata);
            });
        });
        meter.stop();
        meter.note(static_cast<double>(tin.mesh.count_terrain()));
    };
}

/// The floor: as many bytes set, band by band.
Work filling(int side) {
    return [side](Meter& meter) {
        const std::int64_t rows = std::max<std::int64_t>(1, (std::int64_t{1} << 20) / side);
        std::vector<float> values(static_cast<std::size_t>(rows * side));
        meter.start();
        for (std::int64_t row = 0; row < side; row += rows) {
            const auto cells = static_cast<std::size_t>(std::min<std::int64_t>(rows, side - row) * side);
            std::memset(values.data(), static_cast<int>(row & 0x7F), cells * sizeof(float));
            asm volatile("" : : "r"(values.data()) : "memory");  // nothing is left out
        }
        meter.stop();
    };
}

}  // namespace

void run_raster(const Settings& settings) {
    const Points points = uniform_points(settings.count(1e6));
    ResultTable table("Scan conversion of 2 x 10^6 faces", "tinwright", "compared with");
    for (const double full_side : {4000.0, 20000.0}) {
        const int side = settings.side(full_side);
        const std::array<std::function<Measured()>, 3> contenders{
            [&] { return measure_in_child(scan_conversion(points, side, 1)); },
            [&] { return measure_in_child(scan_conversion(points, side, 2)); },
            [&] { return measure_in_child(filling(side)); }};
        const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
        const double cells = static_cast<double>(side) * side;
        const double nanoseconds = 1e9 * results[0].cpu_seconds;
        const bool is_small = full_side == 4000.0;
        const std::string name = is_small ? "4000 x 4000" : "20000 x 20000";
        const std::string floor = "memset: " + number(1e9 * results[2].cpu_seconds / cells) + " ns a cell";
        table.add(name + ": a face", in_seconds(results[0].cpu_seconds), "", nanoseconds / results[0].note,
                  is_small ? at_most(150) : std::nullopt, " ns");
        table.add(name + ": a cell", in_seconds(results[0].cpu_seconds), floor, nanoseconds / cells,
                  is_small ? std::nullopt : at_most(4), " ns");
        table.add(name + ": two threads", in_seconds(results[1].wall_seconds),
                  "one: " + in_seconds(results[0].wall_seconds),
                  results[0].wall_seconds / results[1].wall_seconds, is_small ? at_least(1.8) : std::nullopt,
                  "x");
    }
}

}  // namespace tinwright_benchmarks
