#ifndef TINWRIGHT_IO_CELL_CENTERS_HPP
#define TINWRIGHT_IO_CELL_CENTERS_HPP

#include <array>

#include "tinwright/geometry/point.hpp"

namespace tinwright::io {

/// Centres of a raster's cells, rotated or not, by GDAL's six-number geotransform.
///
/// Where all six numbers are decimals (at most 9 places, of moderate size) a centre is computed as an integer
/// divided by twice a power of ten: the correctly rounded decimal, so that rows of cells stay exactly
/// straight on a decimal lattice. Otherwise in floating point: two roundings an axis, four when rotated.
class CellCenters {
  public:
    /// `cells`: the larger of columns and rows.
    CellCenters(const std::array<double, 6>& transform, int cells);

    [[nodiscard]] Point2 center(int column, int row) const {
        const double i = 2.0 * column + 1;
        const double j = 2.0 * row + 1;
        return {(scaled_[0] + (i * scaled_[1] + j * scaled_[2])) / divisor_,
                (scaled_[3] + (i * scaled_[4] + j * scaled_[5])) / divisor_};
    }
    /// Whether centres are decimals, correctly rounded.
    [[nodiscard]] bool are_decimal() const { return are_decimal_; }

  private:
    std::array<double, 6> scaled_{};  // twice the origin, the steps of half a cell; integers when decimal
    double divisor_ = 2;
    bool are_decimal_ = false;
};

}  // namespace tinwright::io

#endif
