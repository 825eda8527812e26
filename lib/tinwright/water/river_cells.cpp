#include "tinwright/water/river_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/face_tree.hpp"

namespace tinwright {

namespace {

/// A segment's way along one axis of the raster, cell by cell, in units of cells. Cells outside are one
/// number on either side: -1 and `count`.
class AxisWalk {
  public:
    AxisWalk(double from, double to, std::int64_t count)
        : from_(from), length_(to - from), at_(cell_of(from, count)), last_(cell_of(to, count)) {}

    [[nodiscard]] std::int64_t at() const { return at_; }
    [[nodiscard]] bool is_ascending() const { return last_ > at_; }
    /// Where the segment leaves the cell, as a part of it; infinity where it ends in the cell.
    [[nodiscard]] double end() const {
        if (at_ == last_) {
            return std::numeric_limits<double>::infinity();
        }
        const auto edge = static_cast<double>(is_ascending() ? at_ + 1 : at_);
        return std::clamp((edge - from_) / length_, 0.0, 1.0);
    }
    void step() { at_ += is_ascending() ? 1 : -1; }

  private:
    static std::int64_t cell_of(double at, std::int64_t count) {
        const double clamped = std::clamp(at, -1.0, static_cast<double>(count));
        return static_cast<std::int64_t>(std::floor(clamped));
    }

    double from_;
    double length_;
    std::int64_t at_;
    std::int64_t last_;
};

/// An edge that a river runs along, downstream.
struct RiverEdge {
    VertexId upper;
    VertexId lower;
    bool is_level;
};

std::vector<RiverEdge> find_river_edges(const Tin& tin, const std::vector<bool>& is_river_line) {
    std::vector<RiverEdge> edges;
    std::optional<std::pair<VertexId, VertexId>> last;
    for (const LineTrace& trace : tin.traces) {
        const bool is_river = trace.line < is_river_line.size() && is_river_line[trace.line];
        if (!is_river || last == std::pair(trace.a, trace.b)) {
            continue;
        }
        last.emplace(trace.a, trace.b);
        const double z_a = tin.z[trace.a.value];
        const double z_b = tin.z[trace.b.value];
        const bool is_down = z_a >= z_b;
        edges.push_back({is_down ? trace.a : trace.b, is_down ? trace.b : trace.a, z_a == z_b});
    }
    return edges;
}

/// The upper and the lower end of each edge, in the raster's system.
std::vector<Point2> find_ends(const Tin& tin, const std::vector<RiverEdge>& edges,
                              const RasterPlacing& placed) {
    std::vector<Point2> ends;
    ends.reserve(2 * edges.size());
    for (const RiverEdge& edge : edges) {
        for (const VertexId v : {edge.upper, edge.lower}) {
            const Point3 position = tin.position(v);
            ends.push_back({position.x, position.y});
        }
    }
    if (placed.to_raster) {
        placed.to_raster(ends);
    }
    return ends;
}

/// That a river passes a cell.
struct RiverPass {
    std::int64_t cell = 0;  // row times columns plus column
    std::uint32_t edge = 0;
    double z = 0;  // the river's lowest in it
};

/// `visit_cells` for a segment in a raster whose x is periodic: of the ways to the other end the short one,
/// and wherever that is in the raster.
void visit_periodic(Point2 a, Point2 b, const GridGeometry& grid, double period,
                    const std::function<void(const CellPassage&)>& visit) {
    if (!(period > 0)) {
        visit_cells(a, b, grid, visit);
        return;
    }
    const double dx = std::remainder(b.x - a.x, period);
    const double width = static_cast<double>(grid.columns) * grid.cell_width;
    // Turns that bring the segment's beginning in front of the raster, or its end behind it, and those
    // between.
    const double first = -std::floor((a.x - grid.x_min) / period) - 1;
    const double last = std::floor((grid.x_min + width - (a.x + std::min(dx, 0.0))) / period);
    // What leaves the raster on one side comes in again on the other.
    for (double i = 0; i <= last - first; ++i) {
        const double x = a.x + (dx > 0 ? last - i : first + i) * period;
        visit_cells({x, a.y}, {x + dx, b.y}, grid, visit);
    }
}

/// The passes of all edges, one edge after the other, downstream.
std::vector<RiverPass> find_passes(const Tin& tin, const std::vector<RiverEdge>& edges,
                                   const GridGeometry& grid, const RasterPlacing& placed) {
    const std::vector<Point2> ends = find_ends(tin, edges, placed);
    std::vector<RiverPass> passes;
    passes.reserve(2 * edges.size());
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const Point2 upper = ends[2 * std::size_t{e}];
        const Point2 lower = ends[2 * std::size_t{e} + 1];
        if (!std::isfinite(upper.x + upper.y + lower.x + lower.y)) {
            continue;
        }
        const double upper_z = tin.z[edges[e].upper.value];
        const double lower_z = tin.z[edges[e].lower.value];
        const auto elevation_at = [&](double part) {
            const double z = upper_z + part * (lower_z - upper_z);
            return part == 1 ? lower_z : std::clamp(z, lower_z, upper_z);
        };
        visit_periodic(upper, lower, grid, placed.period, [&](const CellPassage& passage) {
            // What is only touched in a point, a corner say, the river does not pass.
            if (passage.begin < passage.end) {
                passes.push_back({passage.row * grid.columns + passage.column, e, elevation_at(passage.end)});
            }
        });
    }
    return passes;
}

/// Tells of positions whether they are on water, shores included.
class WaterFaces {
  public:
    WaterFaces(const Tin& tin, const std::vector<bool>& is_water_face) : faces_(tin, chosen(is_water_face)) {}

    [[nodiscard]] bool is_empty() const { return faces_.is_empty(); }
    [[nodiscard]] bool hold(Point2 position) const {
        const Key2 at = faces_.lattice.at(position);
        if (!QueryLattice::is_near(at)) {
            return false;
        }
        bool is_held = false;
        faces_.visit_meeting(
            {at, at}, [](const KeyBox&) { return false; },
            [&](FaceId face) {
                const Key2 a = faces_.corner(face, 0);
                const Key2 b = faces_.corner(face, 1);
                const Key2 c = faces_.corner(face, 2);
                is_held = orient2d(a, b, at) >= 0 && orient2d(b, c, at) >= 0 && orient2d(c, a, at) >= 0;
                return !is_held;
            });
        return is_held;
    }

  private:
    static std::vector<FaceId> chosen(const std::vector<bool>& is_chosen) {
        std::vector<FaceId> faces;
        for (std::uint32_t f = 0; f < is_chosen.size(); ++f) {
            if (is_chosen[f]) {
                faces.push_back({f});
            }
        }
        return faces;
    }

    FaceTree faces_;
};

/// The cells of passes, ascending; of each pass the number of its cell among them.
struct PassedCells {
    std::vector<std::int64_t> cells;
    std::vector<std::uint32_t> of_pass;
};

PassedCells number_cells(const std::vector<RiverPass>& passes) {
    std::vector<std::pair<std::int64_t, std::uint32_t>> sorted;
    sorted.reserve(passes.size());
    for (std::uint32_t i = 0; i < passes.size(); ++i) {
        sorted.emplace_back(passes[i].cell, i);
    }
    std::sort(sorted.begin(), sorted.end());
    PassedCells passed{{}, std::vector<std::uint32_t>(passes.size())};
    for (const auto& [cell, pass] : sorted) {
        if (passed.cells.empty() || passed.cells.back() != cell) {
            passed.cells.push_back(cell);
        }
        passed.of_pass[pass] = static_cast<std::uint32_t>(passed.cells.size() - 1);
    }
    return passed;
}

/// Where the centre of a cell is in the TIN's plane; NaN: nowhere.
Point2 place_of_cell(std::int64_t cell, const GridGeometry& grid, const RasterPlacing& placed) {
    const std::int64_t row = cell / grid.columns;
    const std::int64_t column = cell % grid.columns;
    if (!placed.find_places) {
        return grid.centre(column, row);
    }
    CellPlace place;
    placed.find_places(row, column, {&place, 1});
    return place.position;
}

/// Cells that rivers pass, and the vertices between their edges, joined in the direction of flow. A place is
/// a cell, or after all cells a vertex.
class FlowPlaces {
  public:
    /// `is_water`: of each cell, whether it is left alone: the way leads on behind it.
    FlowPlaces(const Tin& tin, const std::vector<RiverEdge>& edges, const std::vector<RiverPass>& passes,
               const PassedCells& passed, const std::vector<bool>& is_water)
        : cell_count_(passed.cells.size()), z_(cell_count_, std::numeric_limits<double>::infinity()) {
        for (const RiverEdge& edge : edges) {
            vertices_.insert(vertices_.end(), {edge.upper, edge.lower});
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        for (const VertexId v : vertices_) {
            z_.push_back(tin.z[v.value]);
        }
        for (std::size_t i = 0; i < passes.size(); ++i) {
            double& z = z_[passed.of_pass[i]];
            z = std::min(z, passes[i].z);
        }
        join(edges, passes, passed, is_water);
    }

    /// The lowest elevation of each place and all that is upstream of it.
    const std::vector<double>& run_down() {
        // Nearly everywhere it runs down already. From where it does not, the lowest first, so that what a
        // place gets is its last.
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> todo;
        for (std::uint32_t place = 0; place < z_.size(); ++place) {
            const auto [begin, end] = downstream_of(place);
            if (std::any_of(begin, end, [&](std::uint32_t next) { return z_[next] > z_[place]; })) {
                todo.emplace(z_[place], place);
            }
        }
        while (!todo.empty()) {
            const auto [z, place] = todo.top();
            todo.pop();
            if (z > z_[place]) {
                continue;
            }
            const auto [begin, end] = downstream_of(place);
            for (auto next = begin; next != end; ++next) {
                if (z_[*next] > z) {
                    z_[*next] = z;
                    todo.emplace(z, *next);
                }
            }
        }
        return z_;
    }

  private:
    using Iterator = std::vector<std::uint32_t>::const_iterator;

    [[nodiscard]] std::pair<Iterator, Iterator> downstream_of(std::uint32_t place) const {
        return {downstream_.begin() + begin_[place], downstream_.begin() + begin_[place + 1]};
    }

    void join(const std::vector<RiverEdge>& edges, const std::vector<RiverPass>& passes,
              const PassedCells& passed, const std::vector<bool>& is_water) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> joints;
        joints.reserve(passes.size() + edges.size());
        std::size_t pass = 0;
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            std::uint32_t before = place_of(edges[e].upper);
            const auto go_to = [&](std::uint32_t place) {
                joints.emplace_back(before, place);
                if (edges[e].is_level) {
                    joints.emplace_back(place, before);
                }
                before = place;
            };
            for (; pass < passes.size() && passes[pass].edge == e; ++pass) {
                if (!is_water[passed.of_pass[pass]]) {
                    go_to(passed.of_pass[pass]);
                }
            }
            go_to(place_of(edges[e].lower));
        }
        begin_.assign(z_.size() + 1, 0);
        for (const auto& joint : joints) {
            ++begin_[joint.first + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        downstream_.resize(joints.size());
        std::vector<std::ptrdiff_t> at(begin_.begin(), begin_.end() - 1);
        for (const auto& [from, to] : joints) {
            downstream_[static_cast<std::size_t>(at[from]++)] = to;
        }
    }

    [[nodiscard]] std::uint32_t place_of(VertexId v) const {
        const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), v);
        return static_cast<std::uint32_t>(cell_count_) +
               static_cast<std::uint32_t>(found - vertices_.begin());
    }

    std::size_t cell_count_;
    std::vector<VertexId> vertices_;  // ascending
    std::vector<double> z_;           // by place: the lowest there
    std::vector<std::uint32_t> downstream_;
    std::vector<std::ptrdiff_t> begin_;  // by place, into `downstream_`
};

}  // namespace

void visit_cells(Point2 a, Point2 b, const GridGeometry& grid,
                 const std::function<void(const CellPassage&)>& visit) {
    AxisWalk columns((a.x - grid.x_min) / grid.cell_width, (b.x - grid.x_min) / grid.cell_width,
                     grid.columns);
    AxisWalk rows((grid.y_max - a.y) / grid.cell_height, (grid.y_max - b.y) / grid.cell_height, grid.rows);
    double begin = 0;
    for (bool is_last = false; !is_last;) {
        const double end_x = columns.end();
        const double end_y = rows.end();
        const double end = std::min({end_x, end_y, 1.0});
        is_last = std::min(end_x, end_y) > 1;
        if (columns.at() >= 0 && columns.at() < grid.columns && rows.at() >= 0 && rows.at() < grid.rows) {
            visit({columns.at(), rows.at(), begin, end});
        }
        begin = end;
        // At a corner the cell that the point belongs to comes in between, where that is a third one: one
        // enters to the right and below at the point, and leaves to the left and above after it.
        const bool is_corner = end_x == end_y;
        const bool is_x_first = columns.is_ascending() || !rows.is_ascending();
        const bool is_y_first = rows.is_ascending() || !columns.is_ascending();
        if (!is_last && (is_corner ? is_x_first : end_x < end_y)) {
            columns.step();
        }
        if (!is_last && (is_corner ? is_y_first : end_y < end_x)) {
            rows.step();
        }
    }
}

std::vector<CellElevation> find_river_cells(const Tin& tin, const std::vector<bool>& is_river_line,
                                            const std::vector<bool>& is_water_face, const GridGeometry& grid,
                                            const RasterPlacing& placed) {
    const std::vector<RiverEdge> edges = find_river_edges(tin, is_river_line);
    const std::vector<RiverPass> passes = find_passes(tin, edges, grid, placed);
    const PassedCells passed = number_cells(passes);
    std::vector<bool> is_water(passed.cells.size());
    if (const WaterFaces water(tin, is_water_face); !water.is_empty()) {
        for (std::size_t i = 0; i < is_water.size(); ++i) {
            const std::int64_t cell = passed.cells[i];
            is_water[i] = water.hold(place_of_cell(cell, grid, placed));
        }
    }
    FlowPlaces places(tin, edges, passes, passed, is_water);
    const std::vector<double>& z = places.run_down();
    std::vector<CellElevation> elevations;
    elevations.reserve(passed.cells.size());
    for (std::size_t i = 0; i < passed.cells.size(); ++i) {
        if (!is_water[i]) {
            elevations.push_back({passed.cells[i], z[i]});
        }
    }
    return elevations;
}

}  // namespace tinwright
