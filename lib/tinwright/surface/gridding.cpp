#include "tinwright/surface/gridding.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/placed_cells.hpp"
#include "tinwright/surface/sample_tree.hpp"
#include "tinwright/surface/scan_conversion.hpp"

namespace tinwright {

namespace {

constexpr std::int64_t kCellsOfTask = 4096;

/// What one thread keeps from cell to cell.
struct Worker {
    std::unique_ptr<SurfaceReader> reader;
    std::optional<VertexId> nearest;
};

/// A gradient as seen from another north, a unit vector.
Point2 turned(Point2 gradient, Point2 north) {
    return {gradient.x * north.y - gradient.y * north.x, gradient.x * north.x + gradient.y * north.y};
}

}  // namespace

struct SurfaceGridder::State {
    const Tin& tin;
    GriddingOptions options;
    std::int64_t columns;
    std::int64_t rows;
    std::int64_t rows_of_band;
    std::optional<ScanConverter> converter;  ///< in the TIN's plane
    std::optional<PlacedCells> placed;       ///< elsewhere
    bool is_scanned;  ///< elevations are those of the faces, which the converter knows best
    bool has_elevation;
    bool has_gradient;
    std::unique_ptr<Interpolator> faces;  ///< where no surface was given
    const Interpolator* surface;
    std::optional<SampleTree> samples;
    std::optional<QueryLattice> places;  ///< with `samples`
    std::vector<std::uint32_t> face_numbers;
    std::vector<double> column_at;
    std::vector<double> row_at;
    LargeVector<FaceId> face_of_cell;
    tbb::enumerable_thread_specific<Worker> workers;

    State(const Tin& of, const Interpolator* read_by, const GridGeometry& grid, std::int64_t band_rows,
          const GriddingOptions& asked);

    [[nodiscard]] std::int64_t band_count() const { return (rows + rows_of_band - 1) / rows_of_band; }
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> band_rows(std::int64_t band) const {
        return {band * rows_of_band, std::min((band + 1) * rows_of_band, rows)};
    }
    template <class Value>
    std::int64_t fill(std::int64_t band, std::span<const std::span<Value>> values, Value nodata);

  private:
    [[nodiscard]] bool asks_for(Product product) const {
        return std::find(options.products.begin(), options.products.end(), product) != options.products.end();
    }
    /// Whether there is nothing to fill in but the elevations of the faces.
    [[nodiscard]] bool is_plain() const {
        return is_scanned && options.products == std::vector{Product::Elevation};
    }
    /// Puts `options.cells` into a band's elevations. `has_faces`: `face_of_cell` is the band's already.
    template <class Value>
    void finish_elevations(std::int64_t band, std::span<const std::span<Value>> values, Value nodata);
    template <class Value>
    void set_cells(std::int64_t band, std::span<Value> values, Value nodata, bool has_faces);
    /// This thread's.
    Worker& worker() {
        Worker& own = workers.local();
        if (own.reader == nullptr) {
            own.reader = surface->make_reader();
        }
        return own;
    }
    template <class Value>
    std::int64_t fill_scanned(std::int64_t band, std::span<const std::span<Value>> values, Value nodata);
    template <class Value>
    std::int64_t fill_placed(std::int64_t band, std::span<const std::span<Value>> values, Value nodata);
    SurfaceReading read(Worker& worker, const SurfacePlace& place) const;
    [[nodiscard]] double distance_to(VertexId v, Key2 at) const;
    template <class Value>
    void set_values(std::span<const std::span<Value>> values, std::size_t cell, Value nodata,
                    const SurfaceReading& reading, const SurfacePlace& place, Worker& worker) const {
        for (std::size_t p = 0; p < values.size(); ++p) {
            const double value = value_of(options.products[p], reading, place, worker);
            values[p][cell] = std::isnan(value) ? nodata : static_cast<Value>(value);
        }
    }
    template <class Value>
    static void set_empty(std::span<const std::span<Value>> values, std::size_t cell, Value nodata) {
        for (const std::span<Value>& of_product : values) {
            of_product[cell] = nodata;
        }
    }
    [[nodiscard]] double value_of(Product product, const SurfaceReading& reading, const SurfacePlace& place,
                                  Worker& worker) const;
};

SurfaceGridder::State::State(const Tin& of, const Interpolator* read_by, const GridGeometry& grid,
                             std::int64_t band_rows, const GriddingOptions& asked)
    : tin(of),
      options(asked),
      columns(grid.columns),
      rows(grid.rows),
      rows_of_band(std::clamp<std::int64_t>(band_rows, 1, grid.rows)),
      is_scanned(read_by == nullptr && !asked.find_places),
      has_elevation(asks_for(Product::Elevation)),
      has_gradient(std::any_of(asked.products.begin(), asked.products.end(), is_from_gradient)),
      surface(read_by) {
    if (options.find_places) {
        placed.emplace(tin, grid, options.find_places);
    } else {
        converter.emplace(tin, grid, band_rows);
    }
    if (is_plain()) {
        return;
    }
    if (surface == nullptr) {
        faces = make_linear(tin);
        surface = faces.get();
    }
    if (converter) {
        const QueryLattice lattice(tin);
        column_at = converter->columns_at(lattice);
        row_at = converter->rows_at(lattice);
    }
    if (asks_for(Product::NearestDistance)) {
        samples.emplace(tin);
        places.emplace(tin);
    }
    if (asks_for(Product::FaceNumber)) {
        face_numbers = number_terrain(tin.mesh);
    }
}

SurfaceReading SurfaceGridder::State::read(Worker& worker, const SurfacePlace& place) const {
    if (has_gradient) {
        SurfaceReading reading = worker.reader->read(place);
        reading.gradient = {reading.gradient.x * options.z_factor, reading.gradient.y * options.z_factor};
        return reading;
    }
    return {has_elevation && !is_scanned ? worker.reader->elevation(place) : 0, {}};
}

double SurfaceGridder::State::distance_to(VertexId v, Key2 at) const {
    if (!options.ground.is_geodesic()) {
        return samples->distance(at, v);
    }
    const Point3 p = tin.position(v);
    return options.ground.length(places->position(at), {p.x, p.y});
}

double SurfaceGridder::State::value_of(Product product, const SurfaceReading& reading,
                                       const SurfacePlace& place, Worker& worker) const {
    switch (product) {
        case Product::Elevation:
            return reading.z;
        case Product::Slope:
            return slope_of(reading.gradient, options.slope_unit);
        case Product::Aspect:
            return aspect_of(reading.gradient);
        case Product::GradientX:
            return reading.gradient.x;
        case Product::GradientY:
            return reading.gradient.y;
        case Product::Hillshade:
            return hillshade_of(reading.gradient, options.light);
        case Product::NearestDistance:
            worker.nearest = samples->nearest(place.at, worker.nearest);
            return distance_to(*worker.nearest, place.at);
        case Product::FaceNumber:
            break;
    }
    return face_numbers[place.face.value];
}

template <class Value>
std::int64_t SurfaceGridder::State::fill(std::int64_t band, std::span<const std::span<Value>> values,
                                         Value nodata) {
    assert(values.size() == options.products.size());
    if (is_plain()) {
        const std::int64_t covered = converter->fill(band, values[0], nodata);
        set_cells(band, values[0], nodata, false);
        return covered;
    }
    const auto [first_row, end_row] = band_rows(band);
    face_of_cell.resize(static_cast<std::size_t>((end_row - first_row) * columns));
    const std::int64_t covered =
        placed ? fill_placed(band, values, nodata) : fill_scanned(band, values, nodata);
    finish_elevations(band, values, nodata);
    return covered;
}

template <class Value>
std::int64_t SurfaceGridder::State::fill_scanned(std::int64_t band, std::span<const std::span<Value>> values,
                                                 Value nodata) {
    const std::int64_t first = band_rows(band).first;
    const std::int64_t covered = converter->fill_faces(band, face_of_cell);
    const auto count = static_cast<std::int64_t>(face_of_cell.size());
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, kCellsOfTask), [&](const auto& range) {
        Worker& own = worker();
        // Divided once, not for every cell: two divisions take as long as a short reading.
        auto column = static_cast<std::size_t>(range.begin() % columns);
        auto row = static_cast<std::size_t>(first + range.begin() / columns);
        for (std::int64_t cell = range.begin(); cell != range.end(); ++cell, ++column) {
            if (column == column_at.size()) {
                column = 0;
                ++row;
            }
            const auto i = static_cast<std::size_t>(cell);
            const FaceId face = face_of_cell[i];
            if (face == kNoFace) {
                set_empty(values, i, nodata);
                continue;
            }
            const SurfacePlace place{face, {column_at[column], row_at[row]}};
            set_values(values, i, nodata, read(own, place), place, own);
        }
    });
    return covered;
}

template <class Value>
std::int64_t SurfaceGridder::State::fill_placed(std::int64_t band, std::span<const std::span<Value>> values,
                                                Value nodata) {
    const auto [first_row, end_row] = band_rows(band);
    const std::int64_t above = first_row;
    std::atomic<std::int64_t> covered = 0;
    placed->visit(first_row, end_row,
                  [&](std::int64_t row, std::int64_t first, std::span<const PlacedCell> cells) {
                      Worker& own = worker();
                      auto i = static_cast<std::size_t>((row - above) * columns + first);
                      std::int64_t count = 0;
                      for (const PlacedCell& cell : cells) {
                          face_of_cell[i] = cell.place.face;
                          if (cell.place.face == kNoFace) {
                              set_empty(values, i++, nodata);
                              continue;
                          }
                          SurfaceReading reading = read(own, cell.place);
                          reading.gradient = turned(reading.gradient, cell.north);
                          set_values(values, i++, nodata, reading, cell.place, own);
                          ++count;
                      }
                      covered += count;
                  });
    return covered;
}

/// Elevations of facets by the quicker way, and those of cells that have their own.
template <class Value>
void SurfaceGridder::State::finish_elevations(std::int64_t band, std::span<const std::span<Value>> values,
                                              Value nodata) {
    for (std::size_t p = 0; p < values.size(); ++p) {
        if (options.products[p] != Product::Elevation) {
            continue;
        }
        if (is_scanned) {
            converter->fill(band, values[p], nodata);
        }
        set_cells(band, values[p], nodata, true);
    }
}

template <class Value>
void SurfaceGridder::State::set_cells(std::int64_t band, std::span<Value> values, Value nodata,
                                      bool has_faces) {
    const auto [first_row, end_row] = band_rows(band);
    const std::int64_t first = first_row * columns;
    const std::int64_t end = end_row * columns;
    const auto begin =
        std::lower_bound(options.cells.begin(), options.cells.end(), first,
                         [](const CellElevation& cell, std::int64_t sought) { return cell.cell < sought; });
    for (auto cell = begin; cell != options.cells.end() && cell->cell < end; ++cell) {
        const auto i = static_cast<std::size_t>(cell->cell - first);
        const bool may_be_empty = values[i] == nodata || std::isnan(values[i]);
        if (may_be_empty && !has_faces) {
            // Or does the terrain have just that elevation?
            face_of_cell.resize(static_cast<std::size_t>(end - first));
            converter->fill_faces(band, face_of_cell);
            has_faces = true;
        }
        if (!may_be_empty || face_of_cell[i] != kNoFace) {
            values[i] = static_cast<Value>(cell->z);
        }
    }
}

std::string_view product_name(Product product) {
    const auto* const found = std::find_if(kProducts.begin(), kProducts.end(),
                                           [&](const auto& entry) { return entry.second == product; });
    assert(found != kProducts.end());
    return found->first;
}

bool is_from_gradient(Product product) {
    return product != Product::Elevation && product != Product::NearestDistance &&
           product != Product::FaceNumber;
}

SurfaceGridder::SurfaceGridder(const Tin& tin, const Interpolator* surface, const GridGeometry& grid,
                               std::int64_t band_rows, const GriddingOptions& options)
    : state_(std::make_unique<State>(tin, surface, grid, band_rows, options)) {}

SurfaceGridder::~SurfaceGridder() = default;

std::int64_t SurfaceGridder::band_count() const { return state_->band_count(); }

std::pair<std::int64_t, std::int64_t> SurfaceGridder::band_rows(std::int64_t band) const {
    return state_->band_rows(band);
}

std::int64_t SurfaceGridder::fill(std::int64_t band, std::span<const std::span<float>> values, float nodata) {
    return state_->fill(band, values, nodata);
}

std::int64_t SurfaceGridder::fill(std::int64_t band, std::span<const std::span<double>> values,
                                  double nodata) {
    return state_->fill(band, values, nodata);
}

}  // namespace tinwright
