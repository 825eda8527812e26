// What breaklines do to a DEM. The sample terrain is gridded three times: from the points that are on no
// line, with the vertices of the lines of its stream and its road embankment as points, and with these lines
// enforced. The terrain is invented, so the truth is known: along the lines the errors shrink.
//   breaklines TERRAIN.gpkg OUTPUT.tif
// e.g. breaklines samples/data/terrain.gpkg dem.tif
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/write_grid.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/scan_conversion.hpp"

#include "invented_terrain.hpp"

namespace {

using tinwright::Point2;
using tinwright::Point3;

constexpr double kCell = 1;   // metres
constexpr double kReach = 3;  // cells this near to a line count as along it
// Where the sample survey puts the invented valley.
constexpr Point2 kSouthWest{598000, 5402000};

using Dem = std::vector<double>;

Dem make_dem(const tinwright::Tin& tin, const tinwright::GridGeometry& grid) {
    Dem dem(static_cast<std::size_t>(grid.columns * grid.rows));
    const tinwright::ScanConverter converter(tin, grid, grid.rows);
    converter.fill(0, std::span(dem), std::numeric_limits<double>::quiet_NaN());
    return dem;
}

double squared_distance(Point2 p, const Point3& a, const Point3& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double way = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
    const double t = std::clamp(way, 0.0, 1.0);
    const double x = p.x - (a.x + t * dx);
    const double y = p.y - (a.y + t * dy);
    return x * x + y * y;
}

/// Calls `visit(column, row)` for the cells whose centre is near the segment; neighbours share some.
template <class Visit>
void visit_cells(const tinwright::GridGeometry& grid, const Point3& a, const Point3& b, const Visit& visit) {
    const auto column = [&](double x) { return static_cast<std::int64_t>((x - grid.x_min) / kCell); };
    const auto row = [&](double y) { return static_cast<std::int64_t>((grid.y_max - y) / kCell); };
    const std::int64_t last_row = std::min(row(std::min(a.y, b.y) - kReach), grid.rows - 1);
    const std::int64_t last_column = std::min(column(std::max(a.x, b.x) + kReach), grid.columns - 1);
    for (std::int64_t r = std::max<std::int64_t>(row(std::max(a.y, b.y) + kReach), 0); r <= last_row; ++r) {
        for (std::int64_t c = std::max<std::int64_t>(column(std::min(a.x, b.x) - kReach), 0);
             c <= last_column; ++c) {
            if (squared_distance(grid.centre(c, r), a, b) <= kReach * kReach) {
                visit(c, r);
            }
        }
    }
}

double true_elevation(Point2 p) { return invented::elevation({p.x - kSouthWest.x, p.y - kSouthWest.y}); }

/// Cells of which all DEMs have a value.
class Comparison {
  public:
    Comparison(const tinwright::GridGeometry& grid, const std::array<Dem, 3>& dems)
        : grid_(grid), dems_(dems), is_counted_(dems[0].size()) {}

    void count(std::int64_t column, std::int64_t row) {
        const auto cell = static_cast<std::size_t>(row * grid_.columns + column);
        const auto has_none = [cell](const Dem& dem) { return std::isnan(dem[cell]); };
        if (is_counted_[cell] || std::any_of(dems_.begin(), dems_.end(), has_none)) {
            return;
        }
        is_counted_[cell] = true;
        ++cells_;
        const double change = std::abs(dems_[2][cell] - dems_[1][cell]);
        changes_ += change;
        largest_ = std::max(largest_, change);
        for (std::size_t i = 0; i < dems_.size(); ++i) {
            const double error = dems_[i][cell] - true_elevation(grid_.centre(column, row));
            squares_[i] += error * error;
        }
    }

    void print(const char* where) const {
        std::printf("| %s | %.0f | %.3f m | %.3f m | %.3f m | %.3f m | %.2f m |\n", where, cells_, error(0),
                    error(1), error(2), changes_ / cells_, largest_);
    }
    /// Whether each step brought the DEM nearer to the truth.
    [[nodiscard]] bool is_better() const { return error(1) < error(0) && error(2) < error(1); }

  private:
    /// Root mean square.
    [[nodiscard]] double error(std::size_t dem) const { return std::sqrt(squares_[dem] / cells_); }

    const tinwright::GridGeometry& grid_;
    const std::array<Dem, 3>& dems_;
    std::vector<bool> is_counted_;
    double cells_ = 0;
    double changes_ = 0;
    double largest_ = 0;
    std::array<double, 3> squares_{};
};

int run(const std::string& terrain, const std::string& output) {
    namespace io = tinwright::io;

    // Codes of points on lines: stream bed and bank, road edge, toe of the embankment.
    const std::array off_lines{
        io::parse_source(terrain + ",layer=points,where=code NOT IN ('SB', 'SK', 'RE', 'TO')")};
    const std::array all_points{io::parse_source(terrain + ",layer=points")};
    const std::string layer = terrain + ",layer=breaklines,where=kind ";
    const std::array line_sources{
        io::LineSource{io::parse_source(layer + "IN ('stream bed', 'stream bank')")},
        io::LineSource{io::parse_source(layer + "IN ('road edge', 'toe')")}};
    const io::Samples ground = io::read_samples(off_lines);
    const io::Samples samples = io::read_samples(all_points);
    const io::Lines lines = io::read_lines(line_sources);

    tinwright::TriangulateOptions how;
    how.domain.kind = tinwright::DomainRule::Kind::Trimmed;
    // A bank of the stream crosses the toe of the embankment, at another elevation.
    how.noding.crossing_z = tinwright::CrossingPolicy::Mean;
    const tinwright::Triangulated enforced = tinwright::triangulate(samples.points, lines.lines, how);
    std::printf("%zu points, %zu lines, %zu constrained edges, %zu conflicts\n\n", samples.points.size(),
                lines.lines.size(), enforced.tin.traces.size(), enforced.report.lines.conflicts.size());

    const tinwright::GridGeometry grid =
        tinwright::choose_grid(enforced.tin, {.resolution = Point2{kCell, kCell}});
    const std::array dems{make_dem(tinwright::triangulate(ground.points, how).tin, grid),
                          make_dem(tinwright::triangulate(samples.points, how).tin, grid),
                          make_dem(enforced.tin, grid)};

    std::printf(
        "| cells within 3 m of | number | error without the lines | lines' vertices as points | lines "
        "enforced "
        "| mean change by enforcing | largest |\n|---|---|---|---|---|---|---|\n");
    bool is_better = true;
    const std::array names{"the stream's bed and banks", "the road's edges and toes"};
    for (std::size_t source = 0; source < names.size(); ++source) {
        Comparison along(grid, dems);
        for (std::size_t i = 0; i < lines.lines.size(); ++i) {
            const std::vector<Point3>& vertices = lines.lines[i].points;
            for (std::size_t j = 1; j < vertices.size() && lines.slice_of(i).source == source; ++j) {
                visit_cells(grid, vertices[j - 1], vertices[j],
                            [&](std::int64_t column, std::int64_t row) { along.count(column, row); });
            }
        }
        along.print(names[source]);
        is_better = is_better && along.is_better();
    }

    io::write_grid(enforced.tin, samples.crs, grid, output, {.overwrite = true});
    std::printf("\n%s\n", is_better ? "nearer to the truth with every step" : "no gain");
    return is_better ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() != 2) {
        std::cerr << "usage: breaklines TERRAIN.gpkg OUTPUT.tif\n";
        return 2;
    }
    try {
        return run(arguments[0], arguments[1]);
    } catch (const std::exception& error) {
        std::cerr << "breaklines: " << error.what() << '\n';
        return 1;
    }
}
