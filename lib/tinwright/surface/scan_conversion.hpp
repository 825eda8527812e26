#ifndef TINWRIGHT_SURFACE_SCAN_CONVERSION_HPP
#define TINWRIGHT_SURFACE_SCAN_CONVERSION_HPP

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// Stands for no face, in a raster of faces.
inline constexpr FaceId kNoFace{0xFFFFFFFFU};

/// Linear interpolation of a TIN at the cell centres of a raster, or the faces they lie on, band of rows by
/// band of rows.
///
/// Coverage is exact: a cell gets a value if and only if its centre lies inside the terrain or on its
/// border (holes' borders included), and from exactly one face, or, on the border, from the border edge.
/// Both faces of an edge compute where a row crosses it by one expression from the edge's lower end, so
/// they agree to the bit; at border edges, where rounding would show, exact orientation decides.
/// The value is that of the face's plane, clamped to the elevations of its corners; on the border it is
/// linear along the border edge, and a border vertex's own at the vertex.
///
/// Centres are the decimal numbers that x_min, y_max and the cell's width and height mean, wherever those
/// and the TIN's lattice are decimal and fit a common lattice of 2^52 steps; else they are rounded to a
/// fraction of the TIN's quantum. What lies on an edge is then a fact, not a matter of rounding.
class ScanConverter {
  public:
    /// Prepares rows for `tin`, which must outlive the converter. `band_rows`: rows a call of `fill` covers
    /// at most. Columns and rows from 1 to 2^31 - 1. O(n), parallel inside the caller's task arena.
    /// Memory: 4 bytes a vertex, 8 a column and row, and, unless one band holds all rows, 4 a face and band
    /// it meets.
    ScanConverter(const Tin& tin, const GridGeometry& grid, std::int64_t band_rows);
    ~ScanConverter();
    ScanConverter(const ScanConverter&) = delete;
    ScanConverter& operator=(const ScanConverter&) = delete;

    [[nodiscard]] std::int64_t band_count() const;
    /// Rows [first, second) of a band.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> band_rows(std::int64_t band) const;

    /// Writes the values of a band's cells, row-major, `columns` wide; cells outside the terrain get
    /// `nodata`, which may be NaN. Returns the number of cells with a value. Same values for any number of
    /// threads and any height of bands. O(faces of the band + cells), parallel inside the caller's task
    /// arena.
    std::int64_t fill(std::int64_t band, std::span<float> values, float nodata) const;
    std::int64_t fill(std::int64_t band, std::span<double> values, double nodata) const;

    /// Writes the face that each cell's centre lies on instead, `kNoFace` outside the terrain. On an edge
    /// between two faces it is always the same one of them.
    std::int64_t fill_faces(std::int64_t band, std::span<FaceId> faces) const;
    /// x of every column's centre in steps of the lattice that surfaces are read by, rounded to whole ones.
    [[nodiscard]] std::vector<double> columns_at(const QueryLattice& lattice) const;
    /// y of every row's centre, likewise.
    [[nodiscard]] std::vector<double> rows_at(const QueryLattice& lattice) const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
