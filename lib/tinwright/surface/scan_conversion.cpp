#include "tinwright/surface/scan_conversion.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/band_index.hpp"
#include "tinwright/surface/face_plane.hpp"
#include "tinwright/surface/scan_lattice.hpp"
#include "tinwright/surface/span_queue.hpp"

namespace tinwright {

namespace {

constexpr std::size_t kGrain = 8192;  // faces or vertices a task

using Range = tbb::blocked_range<std::size_t>;

/// A vertex on the scan lattice, and the first row strictly below it.
struct ScanVertex {
    Key2 key{};
    double z = 0;
    std::int32_t row = 0;
};

/// By (y, x). No branches: which corner of a face is lowest cannot be predicted.
bool is_below(const ScanVertex& a, const ScanVertex& b) {
    const bool is_lower = a.key.y < b.key.y;
    const bool is_level = a.key.y == b.key.y;
    const bool is_left = a.key.x < b.key.x;
    return static_cast<bool>(static_cast<unsigned>(is_lower) |
                             (static_cast<unsigned>(is_level) & static_cast<unsigned>(is_left)));
}

/// What the faces and edges of one TIN need to be scanned.
struct Scene {
    const Tin& tin;
    ScanLattice lattice;
    std::vector<std::int32_t> row;  // by vertex

    [[nodiscard]] ScanVertex vertex(VertexId v) const {
        return {lattice.scaled(tin.keys[v.value]), tin.z[v.value], row[v.value]};
    }
};

/// The lower and the upper end of an edge.
std::pair<ScanVertex, ScanVertex> ends(const Scene& scene, HalfEdgeId h) {
    const ScanVertex a = scene.vertex(scene.tin.mesh.origin(h));
    const ScanVertex b = scene.vertex(scene.tin.mesh.destination(h));
    return is_below(a, b) ? std::pair(a, b) : std::pair(b, a);
}

/// Rows whose centres lie on the closed edge.
RowRange rows_of_edge(const Scene& scene, HalfEdgeId h) {
    const auto [lower, upper] = ends(scene, h);
    const bool is_on_top = upper.row > 0 && scene.lattice.row_y(upper.row - 1) == upper.key.y;
    return {upper.row - (is_on_top ? 1 : 0), lower.row - 1};
}

/// Rows that a terrain face covers, half open at its top; none for other faces.
RowRange rows_of_face(const Scene& scene, FaceId f) {
    if (!scene.tin.mesh.is_terrain(f)) {
        return {};
    }
    const auto& v = scene.tin.mesh.face(f).vertex;
    const std::int32_t a = scene.row[v[0].value];
    const std::int32_t b = scene.row[v[1].value];
    const std::int32_t c = scene.row[v[2].value];
    return {std::min(std::min(a, b), c), std::max(std::max(a, b), c) - 1};
}

/// Columns first..end - 1 of a row, or rows.
struct Span {
    std::int32_t first = 0;
    std::int32_t end = 0;
};

/// Writes elevations.
template <class Value>
class ElevationBrush {
  public:
    explicit ElevationBrush(const ScanLattice& lattice) : lattice_(lattice), queue_(lattice.column_x()) {}

    void start(FaceId /*face*/, const std::array<ScanVertex, 3>& corner) {
        plane_.emplace(std::array<SurfaceCorner, 3>{
            {{corner[0].key, corner[0].z}, {corner[1].key, corner[1].z}, {corner[2].key, corner[2].z}}});
        queue_.start(plane_->section());
    }
    void paint(Value* row, double y, Span columns) {
        if (!plane_->is_needle()) {
            queue_.push(row, plane_->row_value(y), columns.first, columns.end);
            return;
        }
        for (std::int32_t column = columns.first; column < columns.end; ++column) {
            row[column] = static_cast<Value>(plane_->needle_value({lattice_.column_x(column), y}));
        }
    }

  private:
    const ScanLattice& lattice_;
    std::optional<FacePlane> plane_;
    SpanQueue<Value> queue_;
};

/// Writes the faces themselves.
class FaceBrush {
  public:
    explicit FaceBrush(const ScanLattice& /*lattice*/) {}

    void start(FaceId face, const std::array<ScanVertex, 3>& /*corner*/) { face_ = face; }
    void paint(FaceId* row, double /*y*/, Span columns) const {
        for (std::int32_t column = columns.first; column < columns.end; ++column) {
            row[column] = face_;
        }
    }

  private:
    FaceId face_{};
};

/// Elevation of a place on an edge.
double elevation_on(const ScanVertex& from, const ScanVertex& to, Key2 at) {
    if (at == to.key) {
        return to.z;
    }
    const bool is_steep = to.key.y - from.key.y > std::abs(to.key.x - from.key.x);
    const double along = is_steep ? (at.y - from.key.y) / (to.key.y - from.key.y)
                                  : (at.x - from.key.x) / (to.key.x - from.key.x);
    return std::clamp(from.z + (to.z - from.z) * along, std::min(from.z, to.z), std::max(from.z, to.z));
}

/// The cells of one band of rows, and which of them a face or an edge covers.
class Band {
  public:
    Band(const Scene& scene, Span rows) : scene_(scene), rows_(rows) {}

    /// Paints the cells whose centres lie in the face, closed at its left and bottom, of an array that holds
    /// the band. Returns how many.
    template <class Brush, class Value>
    std::int64_t paint_face(FaceId f, Brush& brush, Value* values) const;
    /// Hands cells whose centres lie exactly on the edge to `visit(index, centre)`.
    template <class Visit>
    void visit_edge(HalfEdgeId h, const Visit& visit) const;

  private:
    [[nodiscard]] std::size_t index(std::int32_t row, std::int32_t column) const {
        return static_cast<std::size_t>(row - rows_.first) *
                   static_cast<std::size_t>(scene_.lattice.columns()) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] Span within(std::int32_t first, std::int32_t end) const {
        return {std::max(first, rows_.first), std::min(end, rows_.end)};
    }

    const Scene& scene_;
    Span rows_;
};

template <class Brush, class Value>
std::int64_t Band::paint_face(FaceId f, Brush& brush, Value* values) const {
    const auto& v = scene_.tin.mesh.face(f).vertex;
    const unsigned first = smallest_corner(scene_.tin.mesh, f);
    const std::array<ScanVertex, 3> corner{scene_.vertex(v[first]), scene_.vertex(v[next_corner(first)]),
                                           scene_.vertex(v[previous_corner(first)])};
    unsigned low = is_below(corner[1], corner[0]) ? 1 : 0;
    low = is_below(corner[2], corner[low]) ? 2 : low;
    const unsigned right = next_corner(low);  // counter-clockwise
    const unsigned left = previous_corner(low);
    const bool is_left_top = is_below(corner[right], corner[left]);
    const ScanVertex& bottom = corner[low];
    const ScanVertex& middle = corner[is_left_top ? right : left];
    const ScanVertex& top = corner[is_left_top ? left : right];
    const Span rows = within(top.row, bottom.row);
    const ScanLattice& lattice = scene_.lattice;
    const double west = std::min(std::min(bottom.key.x, middle.key.x), top.key.x);
    const double east = std::max(std::max(bottom.key.x, middle.key.x), top.key.x);
    if (rows.first >= rows.end || lattice.is_beside(west, east)) {
        return 0;
    }
    brush.start(f, corner);
    const bool is_inside = lattice.is_inside(west, east);
    const CutEdge whole = lattice.cut(bottom.key, top.key);
    const std::array<CutEdge, 2> part{lattice.cut(middle.key, top.key), lattice.cut(bottom.key, middle.key)};
    std::int64_t cells = 0;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const double y = lattice.row_y(row);
        const auto at = lattice.first_columns(whole, part[row < middle.row ? 0 : 1], y, is_inside);
        const Span columns{is_left_top ? at[0] : at[1], is_left_top ? at[1] : at[0]};
        brush.paint(values + index(row, 0), y, columns);
        cells += columns.end - columns.first;
    }
    return cells;
}

template <class Visit>
void Band::visit_edge(HalfEdgeId h, const Visit& visit) const {
    const ScanLattice& lattice = scene_.lattice;
    const std::pair<ScanVertex, ScanVertex> end = ends(scene_, h);  // lower, upper
    const Key2 from = end.first.key;
    const Key2 to = end.second.key;
    const RowRange touched = rows_of_edge(scene_, h);
    const Span rows = within(touched.first, touched.last + 1);
    if (from.y == to.y) {
        const double* x = lattice.column_x();
        const double* past = std::upper_bound(x, x + lattice.columns(), to.x);
        for (std::int32_t row = rows.first; row < rows.end; ++row) {
            for (const double* at = std::lower_bound(x, past, from.x); at < past; ++at) {
                visit(index(row, static_cast<std::int32_t>(at - x)), Key2{*at, lattice.row_y(row)});
            }
        }
        return;
    }
    const CutEdge edge = lattice.cut(from, to);
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const double y = lattice.row_y(row);
        const std::int32_t column = lattice.first_column(edge, y);
        if (column < lattice.columns() && lattice.is_on(edge, column, y)) {
            visit(index(row, column), Key2{lattice.column_x(column), y});
        }
    }
}

Scene make_scene(const Tin& tin, const GridGeometry& grid) {
    Scene scene{tin, ScanLattice(tin, grid), std::vector<std::int32_t>(tin.vertex_count())};
    tbb::parallel_for(Range(0, tin.vertex_count(), kGrain), [&](const Range& vertices) {
        for (std::size_t v = vertices.begin(); v != vertices.end(); ++v) {
            scene.row[v] = scene.lattice.row_below(scene.lattice.scaled(tin.keys[v]).y);
        }
    });
    return scene;
}

}  // namespace

struct ScanConverter::State {
    Scene scene;
    std::int32_t band_rows;
    std::size_t bands;
    std::vector<HalfEdgeId> border;
    BandIndex faces;  // left empty when there is one band: every face then belongs to it
    BandIndex edges;  // positions in `border`

    State(const Tin& tin, const GridGeometry& grid, std::int64_t rows_of_a_band);

    [[nodiscard]] std::pair<std::int32_t, std::int32_t> rows_of_band(std::size_t band) const {
        const auto first = static_cast<std::int64_t>(band) * band_rows;
        return {static_cast<std::int32_t>(first),
                static_cast<std::int32_t>(std::min<std::int64_t>(first + band_rows, scene.lattice.rows()))};
    }
    /// Clears the cells of a band, then paints them with the faces that cover them. `on_edge(half-edge,
    /// centre)` is what a cell on the border gets. Returns the number of cells with a value.
    template <class Brush, class Value, class OnEdge>
    std::int64_t fill(std::size_t band, std::span<Value> values, Value nodata, Value marker,
                      const OnEdge& on_edge) const;
    template <class Value>
    std::int64_t fill_elevations(std::size_t band, std::span<Value> values, Value nodata) const;

  private:
    template <class Brush, class Value>
    std::int64_t paint_faces(const Band& cells, std::size_t band, Value* values) const;
};

ScanConverter::State::State(const Tin& tin, const GridGeometry& grid, std::int64_t rows_of_a_band)
    : scene(make_scene(tin, grid)),
      band_rows(static_cast<std::int32_t>(std::clamp<std::int64_t>(rows_of_a_band, 1, grid.rows))),
      bands(static_cast<std::size_t>((grid.rows + band_rows - 1) / band_rows)),
      border(find_border(tin.mesh)) {
    if (bands > 1) {
        faces = BandIndex(tin.mesh.slot_count(), bands, band_rows, [&](std::size_t f) {
            return rows_of_face(scene, {static_cast<std::uint32_t>(f)});
        });
    }
    edges = BandIndex(border.size(), bands, band_rows,
                      [&](std::size_t i) { return rows_of_edge(scene, border[i]); });
}

template <class Brush, class Value>
std::int64_t ScanConverter::State::paint_faces(const Band& cells, std::size_t band, Value* values) const {
    std::atomic<std::int64_t> painted = 0;
    const bool is_all = bands == 1;
    const std::span<const std::uint32_t> items = is_all ? std::span<const std::uint32_t>() : faces.band(band);
    const std::size_t count = is_all ? scene.tin.mesh.slot_count() : items.size();
    tbb::parallel_for(Range(0, count, kGrain), [&](const Range& range) {
        Brush brush(scene.lattice);
        std::int64_t of_range = 0;
        if (is_all) {
            for (std::size_t f = range.begin(); f != range.end(); ++f) {
                const FaceId face{static_cast<std::uint32_t>(f)};
                of_range += scene.tin.mesh.is_terrain(face) ? cells.paint_face(face, brush, values) : 0;
            }
        } else {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                of_range += cells.paint_face({items[i]}, brush, values);
            }
        }
        painted += of_range;
    });
    return painted;
}

template <class Brush, class Value, class OnEdge>
std::int64_t ScanConverter::State::fill(std::size_t band, std::span<Value> values, Value nodata, Value marker,
                                        const OnEdge& on_edge) const {
    const auto [first_row, end_row] = rows_of_band(band);
    const std::size_t count =
        static_cast<std::size_t>(end_row - first_row) * static_cast<std::size_t>(scene.lattice.columns());
    assert(values.size() >= count);
    tbb::parallel_for(Range(0, count, std::size_t{1} << 16U), [&](const Range& range) {
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(range.begin()),
                  values.begin() + static_cast<std::ptrdiff_t>(range.end()), nodata);
    });
    const Band cells(scene, {first_row, end_row});

    // Cells on the border take the edge's value. The marker shows whether a face claimed them as well.
    const auto is_marked = [&](Value value) { return std::memcmp(&value, &marker, sizeof(Value)) == 0; };
    std::vector<std::pair<std::size_t, Value>> on_border;
    for (const std::uint32_t i : edges.band(band)) {
        cells.visit_edge(border[i], [&](std::size_t cell, Key2 centre) {
            on_border.emplace_back(cell, on_edge(border[i], centre));
            values[cell] = marker;
        });
    }
    std::int64_t written = paint_faces<Brush>(cells, band, values.data());
    for (const auto& [cell, value] : on_border) {
        if (is_marked(values[cell])) {
            ++written;
        }
        values[cell] = value;
    }
    return written;
}

template <class Value>
std::int64_t ScanConverter::State::fill_elevations(std::size_t band, std::span<Value> values,
                                                   Value nodata) const {
    return fill<ElevationBrush<Value>>(band, values, nodata, std::numeric_limits<Value>::quiet_NaN(),
                                       [&](HalfEdgeId h, Key2 centre) {
                                           const auto [from, to] = ends(scene, h);
                                           return static_cast<Value>(elevation_on(from, to, centre));
                                       });
}

ScanConverter::ScanConverter(const Tin& tin, const GridGeometry& grid, std::int64_t band_rows)
    : state_(std::make_unique<const State>(tin, grid, band_rows)) {}

ScanConverter::~ScanConverter() = default;

std::int64_t ScanConverter::band_count() const { return static_cast<std::int64_t>(state_->bands); }

std::pair<std::int64_t, std::int64_t> ScanConverter::band_rows(std::int64_t band) const {
    return state_->rows_of_band(static_cast<std::size_t>(band));
}

std::int64_t ScanConverter::fill(std::int64_t band, std::span<float> values, float nodata) const {
    return state_->fill_elevations(static_cast<std::size_t>(band), values, nodata);
}

std::int64_t ScanConverter::fill(std::int64_t band, std::span<double> values, double nodata) const {
    return state_->fill_elevations(static_cast<std::size_t>(band), values, nodata);
}

std::int64_t ScanConverter::fill_faces(std::int64_t band, std::span<FaceId> faces) const {
    constexpr FaceId kMarker{kNoFace.value - 1};
    return state_->fill<FaceBrush>(static_cast<std::size_t>(band), faces, kNoFace, kMarker,
                                   [](HalfEdgeId h, Key2 /*centre*/) { return face_of(h); });
}

std::vector<double> ScanConverter::columns_at(const QueryLattice& lattice) const {
    return state_->scene.lattice.columns_at(lattice.scale());
}

std::vector<double> ScanConverter::rows_at(const QueryLattice& lattice) const {
    return state_->scene.lattice.rows_at(lattice.scale());
}

}  // namespace tinwright
