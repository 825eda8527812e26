#include "tinwright/water/raster_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "tinwright/water/polygon_rows.hpp"
#include "tinwright/water/river_cells.hpp"

namespace tinwright {

namespace {

/// What is passed for less, in cells, is passed over, and so are centres that are closer to a shore: programs
/// round positions, each in its own way.
constexpr double kHair = 0.01;

/// A cell along a reach, and from where to where, CRS units from the reach's upper end.
struct CellOnReach {
    std::int64_t cell = 0;
    double begin = 0;
    double end = 0;
};

Point2 flat(const Point3& p) { return {p.x, p.y}; }

/// Distances of a line's points from its beginning.
std::vector<double> chainages_of(std::span<const Point3> points) {
    std::vector<double> chainages(points.size(), 0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        chainages[i] =
            chainages[i - 1] + std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
    }
    return chainages;
}

Point2 point_at(std::span<const Point3> points, const std::vector<double>& chainages, double at) {
    std::size_t i = 1;
    while (i + 1 < points.size() && chainages[i] < at) {
        ++i;
    }
    const double length = chainages[i] - chainages[i - 1];
    const double part = length > 0 ? std::clamp((at - chainages[i - 1]) / length, 0.0, 1.0) : 0;
    return {points[i - 1].x + part * (points[i].x - points[i - 1].x),
            points[i - 1].y + part * (points[i].y - points[i - 1].y)};
}

/// Where in a line its part between two neighbouring points begins that a reach begins with, in the reach's
/// direction: the index of that point.
std::size_t find_start(std::span<const Point3> line, const Reach& reach) {
    const Point2 first = flat(reach.points[0]);
    const Point2 second = flat(reach.points[1]);
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::size_t next = reach.is_reversed ? i - 1 : i + 1;  // wraps around below 0
        if (next < line.size() && flat(line[i]) == first && flat(line[next]) == second) {
            return i;
        }
        if (const double distance = std::hypot(line[i].x - first.x, line[i].y - first.y); distance < least) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

class RasterChecker {
  public:
    RasterChecker(const GridGeometry& grid, const ReadCells& read, std::span<const Breakline> lines,
                  const Water& water, const RasterCheckOptions& options)
        : grid_(grid), read_(read), water_(water), options_(options), polygons_(grid) {
        for (std::uint32_t line = 0; line < lines.size(); ++line) {
            if (is_cleared_role(lines[line].role)) {
                const PolygonRows::Polygon polygon{lines[line].role == LineRole::Lake, lines[line].polygon};
                polygons_.add(polygon, line, water.lines[line].points);
            }
        }
        polygons_.finish();
    }

    RasterCheckReport run() {
        check_reaches();
        check_lakes();
        std::sort(report_.findings.begin(), report_.findings.end(),
                  [](const WaterFinding& a, const WaterFinding& b) {
                      return std::tie(a.kind, a.line, a.chainage, a.location.x, a.location.y) <
                             std::tie(b.kind, b.line, b.chainage, b.location.x, b.location.y);
                  });
        report_progress(options_.progress, 1);
        return std::move(report_);
    }

  private:
    [[nodiscard]] Point2 centre(std::int64_t cell) const {
        return grid_.centre(cell % grid_.columns, cell / grid_.columns);
    }
    [[nodiscard]] bool is_near_water(Point2 at) const;
    [[nodiscard]] std::vector<CellOnReach> cells_along(const Reach& reach) const;
    void read_cells();
    [[nodiscard]] double value_of(std::int64_t cell) const {
        const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell);
        return found != cells_.end() && *found == cell
                   ? values_[static_cast<std::size_t>(found - cells_.begin())]
                   : std::numeric_limits<double>::quiet_NaN();
    }
    void check_reaches();
    void check_reach(const Reach& reach, const std::vector<CellOnReach>& way);
    void add_rise(const Reach& reach, double begin, double end, double high, double low);
    void check_lakes();
    void check_lake(std::size_t polygon);

    const GridGeometry& grid_;
    const ReadCells& read_;
    const Water& water_;
    const RasterCheckOptions& options_;
    PolygonRows polygons_;
    std::vector<std::int64_t> cells_;  // of rivers, but for those on water; ascending
    std::vector<double> values_;       // of these
    RasterCheckReport report_;
};

bool RasterChecker::is_near_water(Point2 at) const {
    const double x = kHair * grid_.cell_width;
    const double y = kHair * grid_.cell_height;
    const std::array<Point2, 5> places{
        at, {at.x - x, at.y}, {at.x + x, at.y}, {at.x, at.y - y}, {at.x, at.y + y}};
    return std::any_of(places.begin(), places.end(), [this](Point2 place) { return polygons_.hold(place); });
}

std::vector<CellOnReach> RasterChecker::cells_along(const Reach& reach) const {
    std::vector<CellOnReach> way;
    if (reach.is_between_banks || reach.points.size() < 2) {
        return way;
    }
    const std::vector<double> chainages = chainages_of(reach.points);
    CellOnReach last{-1, 0, 0};
    double size = 0;  // of what was passed of it, in cells
    const auto leave = [&] {
        if (last.cell >= 0 && size >= kHair) {
            way.push_back(last);
        }
        last.cell = -1;
    };
    for (std::size_t i = 1; i < reach.points.size(); ++i) {
        const Point2 a = flat(reach.points[i - 1]);
        const Point2 b = flat(reach.points[i]);
        if (polygons_.hold({(a.x + b.x) / 2, (a.y + b.y) / 2})) {
            leave();
            continue;
        }
        const double length = chainages[i] - chainages[i - 1];
        const double in_cells = std::hypot((b.x - a.x) / grid_.cell_width, (b.y - a.y) / grid_.cell_height);
        visit_cells(a, b, grid_, [&](const CellPassage& passage) {
            const std::int64_t cell = passage.row * grid_.columns + passage.column;
            const double begin = chainages[i - 1] + passage.begin * length;
            if (cell != last.cell) {
                leave();
                last = {cell, begin, begin};
                size = 0;
            }
            last.end = chainages[i - 1] + passage.end * length;
            size += (passage.end - passage.begin) * in_cells;
        });
    }
    leave();
    return way;
}

/// Reads the values of `cells_`, row by row, in pieces that small gaps do not end.
void RasterChecker::read_cells() {
    constexpr std::int64_t kGap = 16;
    values_.resize(cells_.size());
    std::vector<double> piece;
    for (std::size_t first = 0; first < cells_.size();) {
        const std::int64_t row = cells_[first] / grid_.columns;
        std::size_t end = first + 1;
        while (end < cells_.size() && cells_[end] / grid_.columns == row &&
               cells_[end] - cells_[end - 1] <= kGap) {
            ++end;
        }
        piece.resize(static_cast<std::size_t>(cells_[end - 1] - cells_[first] + 1));
        read_(row, cells_[first] % grid_.columns, piece);
        for (std::size_t i = first; i < end; ++i) {
            values_[i] = piece[static_cast<std::size_t>(cells_[i] - cells_[first])];
            ++(std::isnan(values_[i]) ? report_.empty_cells : report_.river_cells);
        }
        first = end;
        report_progress(options_.progress,
                        0.5 * static_cast<double>(end) / static_cast<double>(cells_.size()));
    }
}

void RasterChecker::check_reaches() {
    std::vector<std::vector<CellOnReach>> ways;
    for (const Reach& reach : water_.report.reaches) {
        ways.push_back(cells_along(reach));
        for (const CellOnReach& on : ways.back()) {
            cells_.push_back(on.cell);
        }
    }
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    std::erase_if(cells_, [this](std::int64_t cell) { return is_near_water(centre(cell)); });
    read_cells();
    for (std::size_t r = 0; r < ways.size(); ++r) {
        check_reach(water_.report.reaches[r], ways[r]);
    }
}

void RasterChecker::check_reach(const Reach& reach, const std::vector<CellOnReach>& way) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = 0;  // of a rise
    std::optional<double> rise;
    std::size_t compared = 0;
    for (const CellOnReach& on : way) {
        const double z = value_of(on.cell);
        if (std::isnan(z)) {
            continue;
        }
        ++compared;
        if (compared > 1) {
            report_.highest_rise = std::max(report_.highest_rise, z - lowest);
        }
        const bool is_above = z - lowest > options_.tolerance;
        if (rise && !is_above) {
            add_rise(reach, *rise, on.begin, highest, lowest);
            rise.reset();
        } else if (is_above) {
            highest = rise ? std::max(highest, z) : z;
            rise = rise.value_or(on.begin);
        }
        lowest = std::min(lowest, z);
    }
    if (rise) {
        add_rise(reach, *rise, way.back().end, highest, lowest);
    }
    report_.rivers += compared > 1 ? 1U : 0U;
}

void RasterChecker::add_rise(const Reach& reach, double begin, double end, double high, double low) {
    WaterFinding finding;
    finding.kind = WaterFinding::Kind::RasterRises;
    finding.line = reach.line;
    finding.location = point_at(reach.points, chainages_of(reach.points), end);
    finding.z = high;
    finding.other_z = low;
    finding.amount = high - low;
    finding.length = end - begin;
    const std::span<const Point3> line = water_.lines[reach.line].points;
    const double start = chainages_of(line)[find_start(line, reach)];
    finding.chainage = reach.is_reversed ? start - end : start + end;
    report_.findings.push_back(finding);
}

void RasterChecker::check_lakes() {
    for (std::size_t polygon = 0; polygon < polygons_.size(); ++polygon) {
        report_progress(options_.progress,
                        0.5 + 0.5 * static_cast<double>(polygon) / static_cast<double>(polygons_.size()));
        if (polygons_.is_lake(polygon)) {
            check_lake(polygon);
        }
    }
}

void RasterChecker::check_lake(std::size_t polygon) {
    std::vector<double> values;
    std::size_t cells = 0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    std::int64_t highest = 0;
    polygons_.visit_inside(polygon, kHair, [&](std::int64_t row, std::int64_t first, std::int64_t end) {
        values.resize(static_cast<std::size_t>(end - first));
        read_(row, first, values);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isnan(values[i])) {
                ++report_.empty_cells;
                continue;
            }
            ++cells;
            low = std::min(low, values[i]);
            if (values[i] > high) {
                high = values[i];
                highest = row * grid_.columns + first + static_cast<std::int64_t>(i);
            }
        }
    });
    if (cells == 0) {
        return;
    }
    ++report_.lakes;
    report_.lake_cells += cells;
    report_.widest_range = std::max(report_.widest_range, high - low);
    if (high - low > options_.tolerance) {
        WaterFinding finding;
        finding.kind = WaterFinding::Kind::RasterLakeUneven;
        finding.line = polygons_.first_line(polygon);
        finding.location = centre(highest);
        finding.z = high;
        finding.other_z = low;
        finding.amount = high - low;
        report_.findings.push_back(finding);
    }
}

}  // namespace

RasterCheckReport check_raster(const GridGeometry& grid, const ReadCells& read,
                               std::span<const Breakline> lines, const Water& water,
                               const RasterCheckOptions& options) {
    if (!(options.tolerance >= 0)) {
        throw UsageError("the tolerance of the raster must be zero or more");
    }
    return RasterChecker(grid, read, lines, water, options).run();
}

}  // namespace tinwright
