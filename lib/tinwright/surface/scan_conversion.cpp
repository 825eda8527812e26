#include "tinwright/surface/scan_conversion.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"
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

/// Writes one band of rows.
template <class Value>
class BandWriter {
  public:
    BandWriter(const Scene& scene, std::int32_t first_row, std::int32_t end_row, Value* values)
        : scene_(scene), first_row_(first_row), end_row_(end_row), values_(values) {}

    /// Cells whose centres lie in the face, closed at its left and bottom. Returns how many.
    std::int64_t write_face(FaceId f, SpanQueue<Value>& queue) const;
    /// Hands cells whose centres lie exactly on the edge, and their values, to `visit(index, value)`.
    template <class Visit>
    void visit_edge(HalfEdgeId h, const Visit& visit) const;

  private:
    struct Span {
        std::int32_t first = 0;
        std::int32_t end = 0;
    };

    void write_needle(const FacePlane& plane, double y, Value* row, Span columns) const;
    [[nodiscard]] std::size_t index(std::int32_t row, std::int32_t column) const {
        return static_cast<std::size_t>(row - first_row_) *
                   static_cast<std::size_t>(scene_.lattice.columns()) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] Span within_band(std::int32_t first, std::int32_t end) const {
        return {std::max(first, first_row_), std::min(end, end_row_)};
    }

    const Scene& scene_;
    std::int32_t first_row_;
    std::int32_t end_row_;
    Value* values_;
};

template <class Value>
std::int64_t BandWriter<Value>::write_face(FaceId f, SpanQueue<Value>& queue) const {
    const auto& v = scene_.tin.mesh.face(f).vertex;
    // The corner with the smallest id first, so that the plane does not depend on where the face starts.
    unsigned first = v[1] < v[0] ? 1 : 0;
    first = v[2] < v[first] ? 2 : first;
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
    const Span rows = within_band(top.row, bottom.row);
    const ScanLattice& lattice = scene_.lattice;
    const double west = std::min(std::min(bottom.key.x, middle.key.x), top.key.x);
    const double east = std::max(std::max(bottom.key.x, middle.key.x), top.key.x);
    if (rows.first >= rows.end || lattice.is_beside(west, east)) {
        return 0;
    }
    const FacePlane plane(
        {{{corner[0].key, corner[0].z}, {corner[1].key, corner[1].z}, {corner[2].key, corner[2].z}}});
    const bool is_inside = lattice.is_inside(west, east);
    const CutEdge whole = lattice.cut(bottom.key, top.key);
    const std::array<CutEdge, 2> part{lattice.cut(middle.key, top.key), lattice.cut(bottom.key, middle.key)};
    queue.start(plane.section());
    std::int64_t cells = 0;
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const double y = lattice.row_y(row);
        const auto at = lattice.first_columns(whole, part[row < middle.row ? 0 : 1], y, is_inside);
        const Span columns{is_left_top ? at[0] : at[1], is_left_top ? at[1] : at[0]};
        Value* const values = values_ + index(row, 0);
        if (plane.is_needle()) {
            write_needle(plane, y, values, columns);
        } else {
            queue.push(values, plane.row_value(y), columns.first, columns.end);
        }
        cells += columns.end - columns.first;
    }
    return cells;
}

template <class Value>
void BandWriter<Value>::write_needle(const FacePlane& plane, double y, Value* row, Span columns) const {
    for (std::int32_t column = columns.first; column < columns.end; ++column) {
        row[column] = static_cast<Value>(plane.needle_value({scene_.lattice.column_x(column), y}));
    }
}

template <class Value>
template <class Visit>
void BandWriter<Value>::visit_edge(HalfEdgeId h, const Visit& visit) const {
    const ScanLattice& lattice = scene_.lattice;
    const std::pair<ScanVertex, ScanVertex> end = ends(scene_, h);  // lower, upper
    const Key2 from = end.first.key;
    const Key2 to = end.second.key;
    const double from_z = end.first.z;
    const double to_z = end.second.z;
    const RowRange touched = rows_of_edge(scene_, h);
    const Span rows = within_band(touched.first, touched.last + 1);
    const bool is_steep = to.y - from.y > std::abs(to.x - from.x);
    const auto visit_cell = [&](std::int32_t row, std::int32_t column) {
        const Key2 at{lattice.column_x(column), lattice.row_y(row)};
        if (at == to) {
            visit(index(row, column), to_z);
            return;
        }
        const double along = is_steep ? (at.y - from.y) / (to.y - from.y) : (at.x - from.x) / (to.x - from.x);
        const double z = from_z + (to_z - from_z) * along;
        visit(index(row, column), std::clamp(z, std::min(from_z, to_z), std::max(from_z, to_z)));
    };
    if (from.y == to.y) {
        const double* x = lattice.column_x();
        const double* past = std::upper_bound(x, x + lattice.columns(), to.x);
        for (std::int32_t row = rows.first; row < rows.end; ++row) {
            for (const double* at = std::lower_bound(x, past, from.x); at < past; ++at) {
                visit_cell(row, static_cast<std::int32_t>(at - x));
            }
        }
        return;
    }
    const CutEdge edge = lattice.cut(from, to);
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const double y = lattice.row_y(row);
        const std::int32_t column = lattice.first_column(edge, y);
        if (column < lattice.columns() && lattice.is_on(edge, column, y)) {
            visit_cell(row, column);
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
    template <class Value>
    std::int64_t write_faces(const BandWriter<Value>& writer, std::size_t band) const;
    template <class Value>
    std::int64_t fill(std::size_t band, std::span<Value> values, Value nodata) const;
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

template <class Value>
std::int64_t ScanConverter::State::write_faces(const BandWriter<Value>& writer, std::size_t band) const {
    std::atomic<std::int64_t> cells = 0;
    if (bands == 1) {
        tbb::parallel_for(Range(0, scene.tin.mesh.slot_count(), kGrain), [&](const Range& range) {
            SpanQueue<Value> queue(scene.lattice.column_x());
            std::int64_t written = 0;
            for (std::size_t f = range.begin(); f != range.end(); ++f) {
                const FaceId face{static_cast<std::uint32_t>(f)};
                written += scene.tin.mesh.is_terrain(face) ? writer.write_face(face, queue) : 0;
            }
            cells += written;
        });
    } else {
        const std::span<const std::uint32_t> items = faces.band(band);
        tbb::parallel_for(Range(0, items.size(), kGrain), [&](const Range& range) {
            SpanQueue<Value> queue(scene.lattice.column_x());
            std::int64_t written = 0;
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                written += writer.write_face({items[i]}, queue);
            }
            cells += written;
        });
    }
    return cells;
}

template <class Value>
std::int64_t ScanConverter::State::fill(std::size_t band, std::span<Value> values, Value nodata) const {
    const auto [first_row, end_row] = rows_of_band(band);
    const std::size_t cells =
        static_cast<std::size_t>(end_row - first_row) * static_cast<std::size_t>(scene.lattice.columns());
    assert(values.size() >= cells);
    tbb::parallel_for(Range(0, cells, std::size_t{1} << 16U), [&](const Range& range) {
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(range.begin()),
                  values.begin() + static_cast<std::ptrdiff_t>(range.end()), nodata);
    });
    const BandWriter<Value> writer(scene, first_row, end_row, values.data());

    // Cells on the border take the edge's value. Their NaN shows whether a face claimed them as well.
    std::vector<std::pair<std::size_t, double>> on_border;
    for (const std::uint32_t i : edges.band(band)) {
        writer.visit_edge(border[i], [&](std::size_t cell, double z) {
            on_border.emplace_back(cell, z);
            values[cell] = std::numeric_limits<Value>::quiet_NaN();
        });
    }
    std::int64_t written = write_faces(writer, band);
    for (const auto& [cell, z] : on_border) {
        if (std::isnan(values[cell])) {
            ++written;
        }
        values[cell] = static_cast<Value>(z);
    }
    return written;
}

ScanConverter::ScanConverter(const Tin& tin, const GridGeometry& grid, std::int64_t band_rows)
    : state_(std::make_unique<const State>(tin, grid, band_rows)) {}

ScanConverter::~ScanConverter() = default;

std::int64_t ScanConverter::band_count() const { return static_cast<std::int64_t>(state_->bands); }

std::pair<std::int64_t, std::int64_t> ScanConverter::band_rows(std::int64_t band) const {
    return state_->rows_of_band(static_cast<std::size_t>(band));
}

std::int64_t ScanConverter::fill(std::int64_t band, std::span<float> values, float nodata) const {
    return state_->fill(static_cast<std::size_t>(band), values, nodata);
}

std::int64_t ScanConverter::fill(std::int64_t band, std::span<double> values, double nodata) const {
    return state_->fill(static_cast<std::size_t>(band), values, nodata);
}

}  // namespace tinwright
