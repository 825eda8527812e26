#ifndef TINWRIGHT_SURFACE_SCAN_CONVERSION_HPP
#define TINWRIGHT_SURFACE_SCAN_CONVERSION_HPP

#include <cstdint>
#include <memory>
#include <span>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"

namespace tinwright {

/// Linear interpolation of a TIN at the cell centres of a raster, band of rows by band of rows.
///
/// Coverage is exact: a cell gets a value if and only if its centre lies inside the terrain or on its
/// border (holes' borders included), and from exactly one face, or, on the border, from the border edge.
/// Both faces of an edge compute where a row crosses it by one expression from the edge's lower end, so
/// they agree to the bit; at border edges, where rounding would show, exact orientation decides.
/// The value is that of the face's plane, clamped to the elevations of its corners.
class ScanConverter {
  public:
    /// Prepares rows for `tin`, which must outlive the converter. `band_rows`: rows a call of `fill` covers
    /// at most. O(n), parallel inside the caller's task arena. Memory: about 4 bytes a face and band it
    /// meets.
    ScanConverter(const Tin& tin, const GridGeometry& grid, std::int64_t band_rows);
    ~ScanConverter();
    ScanConverter(const ScanConverter&) = delete;
    ScanConverter& operator=(const ScanConverter&) = delete;

    [[nodiscard]] std::int64_t band_count() const;
    /// Rows [first, second) of a band.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> band_rows(std::int64_t band) const;

    /// Writes the values of a band's cells, row-major, `columns` wide; cells outside the terrain get
    /// `nodata`. Returns the number of cells with a value. Same values for any number of threads.
    std::int64_t fill(std::int64_t band, std::span<float> values, float nodata) const;
    std::int64_t fill(std::int64_t band, std::span<double> values, double nodata) const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
