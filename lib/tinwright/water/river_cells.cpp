#include "tinwright/water/river_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"
#include "tinwright/surface/surface_place.hpp"

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

/// That a river passes a cell.
struct RiverPass {
    std::int64_t cell = 0;  // row times columns plus column
    std::uint32_t edge = 0;
    double z = 0;  // the river's lowest in it
};

/// The passes of all edges, one edge after the other, downstream.
std::vector<RiverPass> find_passes(const Tin& tin, const std::vector<RiverEdge>& edges,
                                   const GridGeometry& grid) {
    std::vector<RiverPass> passes;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const Point3 upper = tin.position(edges[e].upper);
        const Point3 lower = tin.position(edges[e].lower);
        const auto elevation_at = [&](double part) {
            const double z = upper.z + part * (lower.z - upper.z);
            return part == 1 ? lower.z : std::clamp(z, lower.z, upper.z);
        };
        visit_cells({upper.x, upper.y}, {lower.x, lower.y}, grid, [&](const CellPassage& passage) {
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
    WaterFaces(const Tin& tin, const std::vector<bool>& is_water_face)
        : tin_(tin), lattice_(tin), faces_(chosen(is_water_face)), tree_(boxes()) {}

    [[nodiscard]] bool is_empty() const { return faces_.empty(); }
    [[nodiscard]] bool hold(Point2 position) const {
        const Key2 at = lattice_.at(position);
        if (!QueryLattice::is_near(at)) {
            return false;
        }
        bool is_held = false;
        const Key2 key{at.x / lattice_.scale(), at.y / lattice_.scale()};
        tree_.visit_meeting(
            {key, key}, [](const KeyBox&) { return false; },
            [&](std::uint32_t item) {
                const auto& v = tin_.mesh.face(faces_[item]).vertex;
                const Key2 a = lattice_.scaled(tin_.key(v[0]));
                const Key2 b = lattice_.scaled(tin_.key(v[1]));
                const Key2 c = lattice_.scaled(tin_.key(v[2]));
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
    [[nodiscard]] std::vector<KeyBox> boxes() const {
        std::vector<KeyBox> boxes;
        boxes.reserve(faces_.size());
        for (const FaceId f : faces_) {
            const auto& v = tin_.mesh.face(f).vertex;
            boxes.push_back(KeyBox::of(std::array{tin_.key(v[0]), tin_.key(v[1]), tin_.key(v[2])}));
        }
        return boxes;
    }

    const Tin& tin_;
    QueryLattice lattice_;
    std::vector<FaceId> faces_;
    BoxTree tree_;
};

/// Cells that rivers pass, and the vertices between their edges, joined in the direction of flow.
class FlowPlaces {
  public:
    FlowPlaces(const Tin& tin, const std::vector<RiverEdge>& edges, const std::vector<RiverPass>& passes,
               std::vector<std::int64_t> cells)
        : cells_(std::move(cells)) {
        for (const RiverEdge& edge : edges) {
            vertices_.insert(vertices_.end(), {edge.upper, edge.lower});
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        z_.assign(cells_.size(), std::numeric_limits<double>::infinity());
        for (const VertexId v : vertices_) {
            z_.push_back(tin.z[v.value]);
        }
        join(edges, passes);
    }

    /// The lowest elevation of each cell and all that is upstream of it.
    std::vector<CellElevation> run_down() {
        std::vector<std::uint32_t> order(z_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
            return std::pair(z_[a], a) < std::pair(z_[b], b);
        });
        std::vector<bool> is_reached(z_.size());
        std::vector<std::uint32_t> todo;
        for (const std::uint32_t lowest : order) {
            const double z = z_[lowest];
            todo.assign(1, lowest);
            while (!todo.empty()) {
                const std::uint32_t place = todo.back();
                todo.pop_back();
                if (is_reached[place]) {
                    continue;
                }
                is_reached[place] = true;
                z_[place] = z;
                todo.insert(todo.end(), downstream_.begin() + begin_[place],
                            downstream_.begin() + begin_[place + 1]);
            }
        }
        std::vector<CellElevation> elevations;
        elevations.reserve(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            elevations.push_back({cells_[i], z_[i]});
        }
        return elevations;
    }

  private:
    using Joint = std::pair<std::uint32_t, std::uint32_t>;

    void join(const std::vector<RiverEdge>& edges, const std::vector<RiverPass>& passes) {
        std::vector<Joint> joints;
        joints.reserve(passes.size() + edges.size());
        auto pass = passes.begin();
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            std::uint32_t before = place_of(edges[e].upper);
            const auto go_to = [&](std::uint32_t place) {
                joints.emplace_back(before, place);
                if (edges[e].is_level) {
                    joints.emplace_back(place, before);
                }
                before = place;
            };
            for (; pass != passes.end() && pass->edge == e; ++pass) {
                const auto found = std::lower_bound(cells_.begin(), cells_.end(), pass->cell);
                if (found != cells_.end() && *found == pass->cell) {
                    const auto place = static_cast<std::uint32_t>(found - cells_.begin());
                    z_[place] = std::min(z_[place], pass->z);
                    go_to(place);
                }
            }
            go_to(place_of(edges[e].lower));
        }
        std::sort(joints.begin(), joints.end());
        begin_.assign(z_.size() + 1, 0);
        downstream_.reserve(joints.size());
        for (const auto& [from, to] : joints) {
            ++begin_[from + 1];
            downstream_.push_back(to);
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    }

    [[nodiscard]] std::uint32_t place_of(VertexId v) const {
        const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), v);
        return static_cast<std::uint32_t>(cells_.size()) +
               static_cast<std::uint32_t>(found - vertices_.begin());
    }

    // A place is a cell, or after all cells a vertex.
    std::vector<std::int64_t> cells_;  // ascending
    std::vector<VertexId> vertices_;   // ascending
    std::vector<double> z_;            // by place: the lowest there
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
                                            const std::vector<bool>& is_water_face,
                                            const GridGeometry& grid) {
    const std::vector<RiverEdge> edges = find_river_edges(tin, is_river_line);
    const std::vector<RiverPass> passes = find_passes(tin, edges, grid);
    std::vector<std::int64_t> cells;
    cells.reserve(passes.size());
    for (const RiverPass& pass : passes) {
        cells.push_back(pass.cell);
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    if (const WaterFaces water(tin, is_water_face); !water.is_empty()) {
        std::erase_if(cells, [&](std::int64_t cell) {
            return water.hold(grid.centre(cell % grid.columns, cell / grid.columns));
        });
    }
    return FlowPlaces(tin, edges, passes, std::move(cells)).run_down();
}

}  // namespace tinwright
