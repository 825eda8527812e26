#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/io/cell_places.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/natural_neighbor.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

namespace {

using namespace tinwright;

struct RasterPair {
    std::string name;
    const char* grid_crs;
    const char* plane;
    GridGeometry grid;
};

/// The places of all cells, a row at a time.
Work placing(const RasterPair& pair) {
    return [&pair](Meter& meter) {
        const io::Crs grid_crs = io::Crs::parse(pair.grid_crs);
        const io::Crs plane = io::Crs::parse(pair.plane);
        std::vector<CellPlace> places(static_cast<std::size_t>(pair.grid.columns));
        meter.start();
        const FindCellPlaces find = io::make_cell_places(pair.grid, grid_crs, plane);
        for (std::int64_t row = 0; row < pair.grid.rows; ++row) {
            find(row, 0, places);
        }
        meter.stop();
    };
}

/// Each cell by PROJ.
Work placing_exactly(const RasterPair& pair) {
    return [&pair](Meter& meter) {
        const io::Crs grid_crs = io::Crs::parse(pair.grid_crs);
        const io::Crs plane = io::Crs::parse(pair.plane);
        std::vector<Point2> places(static_cast<std::size_t>(pair.grid.columns));
        meter.start();
        const io::CoordinateTransform transform(grid_crs, plane);
        for (std::int64_t row = 0; row < pair.grid.rows; ++row) {
            for (std::int64_t column = 0; column < pair.grid.columns; ++column) {
                places[static_cast<std::size_t>(column)] = pair.grid.centre(column, row);
            }
            transform.forward(places);
        }
        meter.stop();
    };
}

void measure_places(const RasterPair& pair, int rounds, ResultTable& table) {
    const std::array<std::function<Measured()>, 2> contenders{
        [&] { return measure_in_child(placing(pair)); },
        [&] { return measure_in_child(placing_exactly(pair)); }};
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    table.add("places, " + pair.name, in_seconds(results[0].cpu_seconds), in_seconds(results[1].cpu_seconds),
              results[0].cpu_seconds / results[1].cpu_seconds, at_most(0.1));
}

Tin make_terrain(std::size_t count) {
    tinwright_tests::Random random(1);
    std::vector<Point3> samples(count);
    for (Point3& sample : samples) {
        sample.x = 500000 + std::round(2e5 * random.real()) / 100;
        sample.y = 5300000 + std::round(2e5 * random.real()) / 100;
        sample.z = 20 * std::sin(sample.x / 90) + 10 * std::cos(sample.y / 70);
    }
    TriangulateOptions options;
    options.duplicates.policy = DuplicatePolicy::Mean;
    return triangulate(samples, {}, options).tin;
}

/// From the TIN to all cells; in degrees or in the TIN's plane.
Work filling(std::size_t samples, std::int64_t side, bool is_natural, bool is_geographic) {
    return [=](Meter& meter) {
        tbb::task_arena(1).execute([&] {
            const Tin tin = make_terrain(samples);
            const auto surface =
                is_natural ? make_natural_neighbor(tin, SharpEdges(tin, {})) : make_linear(tin);
            const io::Crs plane = io::Crs::parse("EPSG:32632");
            const io::Crs degrees = io::Crs::parse("EPSG:4326");
            GridRequest request;
            request.size = GridRequest::Size{side, side};
            meter.start();
            const GridGeometry grid = is_geographic
                                          ? choose_grid(io::find_grid_basis(tin, plane, degrees), request)
                                          : choose_grid(tin, request);
            GriddingOptions options;
            if (is_geographic) {
                options.find_places = io::make_cell_places(grid, degrees, plane);
            }
            SurfaceGridder gridder(tin, surface.get(), grid, 256, options);
            std::vector<float> values(static_cast<std::size_t>(256 * grid.columns));
            std::int64_t cells = 0;
            for (std::int64_t band = 0; band < gridder.band_count(); ++band) {
                const auto [first, end] = gridder.band_rows(band);
                const std::array<std::span<float>, 1> rows{
                    std::span(values).first(static_cast<std::size_t>((end - first) * grid.columns))};
                cells += gridder.fill(band, rows, std::numeric_limits<float>::quiet_NaN());
            }
            meter.stop();
            meter.note(static_cast<double>(cells));
        });
    };
}

void measure_filling(const Settings& settings, bool is_natural, ResultTable& table) {
    const std::size_t samples = settings.count(1e6);
    const std::int64_t side = settings.side(2000);
    const std::array<std::function<Measured()>, 2> contenders{
        [&] { return measure_in_child(filling(samples, side, is_natural, true)); },
        [&] { return measure_in_child(filling(samples, side, is_natural, false)); }};
    const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
    table.add(std::string("10^6 samples in UTM, read ") + (is_natural ? "by natural neighbours" : "linearly"),
              in_seconds(results[0].cpu_seconds), in_seconds(results[1].cpu_seconds),
              results[0].cpu_seconds / results[1].cpu_seconds);
}

}  // namespace

void run_grid_crs(const Settings& settings) {
    const std::int64_t side = settings.side(2000);
    {
        ResultTable table("Places of 4 000 000 cells in another system", "polynomials", "PROJ a cell");
        const std::array<RasterPair, 4> pairs{
            RasterPair{
                "degrees to UTM zone 31, 1 m", "EPSG:4326", "EPSG:32631", {2, 48, 1e-5, 1e-5, side, side}},
            RasterPair{"degrees to polar stereographic, 100 m",
                       "EPSG:4326",
                       "EPSG:3413",
                       {-45, 80, 1e-3, 1e-3, side, side}},
            RasterPair{
                "Lambert-93 to UTM zone 31, 1 m", "EPSG:2154", "EPSG:32631", {6e5, 6.7e6, 1, 1, side, side}},
            RasterPair{"Lambert II to Lambert-93 by a grid of datum shifts, 1 m",
                       "EPSG:27572",
                       "EPSG:2154",
                       {6e5, 2.4e6, 1, 1, side, side}}};
        for (const RasterPair& pair : pairs) {
            measure_places(pair, settings.rounds, table);
        }
    }
    ResultTable table("Rasters of 2000 x 2000 cells, one thread", "in degrees", "in the plane");
    measure_filling(settings, false, table);
    measure_filling(settings, true, table);
}

}  // namespace tinwright_benchmarks
