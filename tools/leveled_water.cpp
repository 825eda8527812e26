#include "leveled_water.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/geodesic_measures.hpp"
#include "tinwright/io/transform_points.hpp"

#include "located_errors.hpp"

namespace tinwright::tools {

namespace {

/// Transforms locations; elevations stay as they are.
class Mover {
  public:
    Mover(io::Crs from, io::Crs to) : from_(std::move(from)), to_(std::move(to)) {}

    template <class Point>
    void move(std::vector<Point*>& points) const {
        std::vector<Point3> moved;
        moved.reserve(points.size());
        for (const Point* const point : points) {
            moved.push_back({point->x, point->y, 0});
        }
        if (!io::transform_points(moved, from_, to_).empty()) {
            throw InputError("some of the water cannot be transformed to the raster's CRS, " + to_.name());
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i]->x = moved[i].x;
            points[i]->y = moved[i].y;
        }
    }

    void move(std::vector<Breakline>& lines, Water& water) const {
        std::vector<Point3*> points;
        const auto add = [&points](std::vector<Point3>& of_line) {
            for (Point3& point : of_line) {
                points.push_back(&point);
            }
        };
        for (Breakline& line : lines) {
            add(line.points);
        }
        for (Breakline& line : water.lines) {
            add(line.points);
        }
        for (Reach& reach : water.report.reaches) {
            add(reach.points);
        }
        move(points);
    }

  private:
    io::Crs from_;
    io::Crs to_;
};

RasterCheckReport check_transformed(const LeveledWater& leveled, io::RasterCells& cells,
                                    const ReadCells& read, const RasterCheckOptions& options) {
    std::vector<Breakline> lines = leveled.lines.lines;
    Water water = leveled.water;
    Mover(leveled.crs, cells.crs()).move(lines, water);
    RasterCheckReport report = check_raster(cells.geometry(), read, lines, water, options);
    std::vector<Point2*> locations;
    for (WaterFinding& finding : report.findings) {
        locations.push_back(&finding.location);
    }
    Mover(cells.crs(), leveled.crs).move(locations);
    return report;
}

/// The cell of a raster at a place; NaN where there is none, or no value.
double cell_at(io::RasterCells& cells, const Point3& place) {
    const GridGeometry& grid = cells.geometry();
    const double column = std::floor((place.x - grid.x_min) / grid.cell_width);
    const double row = std::floor((grid.y_max - place.y) / grid.cell_height);
    double value = kDraped;
    if (column >= 0 && row >= 0 && column < static_cast<double>(grid.columns) &&
        row < static_cast<double>(grid.rows)) {
        cells.read(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column), {&value, 1});
    }
    return value;
}

/// Gives points without z that of the raster there, or of the nearest point along the line that has one.
void take_elevations(Breakline& line, const std::vector<Point3>& places, io::RasterCells& cells) {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (std::isnan(line.points[i].z)) {
            line.points[i].z = cell_at(cells, places[i]);
        }
        if (!std::isnan(line.points[i].z)) {
            known.push_back(i);
        }
    }
    for (std::size_t i = 0; i < places.size() && !known.empty(); ++i) {
        if (std::isnan(line.points[i].z)) {
            const auto after = std::lower_bound(known.begin(), known.end(), i);
            const bool is_last = after == known.end();
            const bool is_before = is_last || (after != known.begin() && i - *std::prev(after) <= *after - i);
            line.points[i].z = line.points[is_before ? *std::prev(after) : *after].z;
        }
    }
}

void take_elevations(io::Lines& lines, const io::Source& raster) {
    io::RasterCells cells(raster);
    const bool is_same = !cells.crs().is_known() || !lines.crs.is_known() || cells.crs().is_same(lines.crs);
    for (Breakline& line : lines.lines) {
        std::vector<Point3> places = line.points;
        for (Point3& place : places) {
            place.z = 0;
        }
        if (!is_same) {
            io::transform_points(places, lines.crs, cells.crs());
        }
        take_elevations(line, places, cells);
    }
}

void warn_all(Console& console, const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        console.warn(warning);
    }
}

}  // namespace

std::vector<WaterFinding> LeveledWater::findings() const {
    return raster ? raster->report.findings : water.report.findings;
}

std::int64_t LeveledWater::source_of_line(std::uint32_t line) const {
    return static_cast<std::int64_t>(lines.slice_of(line).source) + 1;
}

std::int64_t LeveledWater::source_of_sample(std::uint32_t sample) const {
    const io::SampleSlice* const slice = samples.find_slice(sample);
    return static_cast<std::int64_t>(line_sources.size() + (slice == nullptr ? 0 : slice->source)) + 1;
}

LeveledWater read_leveled_water(const LevelRequest& request, Console& console) {
    const auto stage = [&](double begin, double end) {
        return console.progress().stage(begin * request.progress_end, end * request.progress_end);
    };
    LeveledWater leveled;
    leveled.line_sources = request.lines;
    leveled.options = request.options;
    if (!request.samples.empty()) {
        io::ReadOptions options;
        options.skip_bad = request.skip_bad;
        request.crs.apply_to(options);
        options.threads = request.threads;
        options.progress = stage(0, 0.5);
        leveled.samples = io::read_samples(request.samples, options);
    }
    io::ReadLinesOptions options;
    options.skip_bad = request.skip_bad;
    request.crs.apply_to(options, leveled.samples);
    options.progress = stage(0.5, 0.6);
    leveled.lines = io::read_lines(request.lines, options);
    if (request.samples.empty() && request.raster) {
        take_elevations(leveled.lines, *request.raster);
    }
    leveled.plane = leveled.samples.crs.is_known() ? leveled.samples.plane : leveled.lines.plane;
    leveled.crs = leveled.plane.crs;
    leveled.options.ground = io::make_ground_measures(leveled.plane);
    warn_all(console, leveled.samples.warnings);
    warn_all(console, leveled.lines.warnings);
    WaterOptions levels = leveled.options;
    levels.progress = stage(0.6, 1);
    run_located(leveled.samples, leveled.lines, [&] {
        run_with_threads(request.threads, [&] {
            leveled.water = level_water(leveled.samples.points, leveled.lines.lines, levels);
        });
    });
    return leveled;
}

void check_against_raster(LeveledWater& leveled, const io::Source& raster,
                          const RasterCheckOptions& options) {
    io::RasterCells cells(raster);
    const ReadCells read = [&cells](std::int64_t row, std::int64_t first, std::span<double> values) {
        cells.read(row, first, values);
    };
    const bool is_same =
        !cells.crs().is_known() || !leveled.crs.is_known() || cells.crs().is_same(leveled.crs);
    leveled.raster = {raster.path, cells.data_type(), options.tolerance,
                      is_same
                          ? check_raster(cells.geometry(), read, leveled.lines.lines, leveled.water, options)
                          : check_transformed(leveled, cells, read, options)};
}

}  // namespace tinwright::tools
