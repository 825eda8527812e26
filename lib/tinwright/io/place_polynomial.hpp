#ifndef TINWRIGHT_IO_PLACE_POLYNOMIAL_HPP
#define TINWRIGHT_IO_PLACE_POLYNOMIAL_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"

/// Private to those who place cells.
namespace tinwright::io {

/// Where places of a raster are in another system, by the transformation itself.
class ExactPlaces {
  public:
    ExactPlaces(const GridGeometry& grid, CoordinateTransform transform)
        : grid_(grid), transform_(std::move(transform)) {}

    /// Column and row, counted from the centre of the first cell, to positions; NaN where there is none.
    void find(std::span<Point2> cells) const;
    /// Cells of a row, with the direction of the raster's north by a small difference either way.
    void find(std::int64_t row, std::int64_t first, std::span<CellPlace> places) const;

    [[nodiscard]] const GridGeometry& grid() const { return grid_; }
    [[nodiscard]] const CoordinateTransform& transform() const { return transform_; }

  private:
    GridGeometry grid_;
    CoordinateTransform transform_;
};

/// A rectangle of cells.
struct CellBlock {
    std::int64_t row = 0;
    std::int64_t column = 0;
    std::int64_t rows = 0;
    std::int64_t columns = 0;
};

/// The places of a block of cells by a polynomial in column and row.
class PlacePolynomial {
  public:
    /// Points that `fit` transforms.
    static constexpr std::int64_t kExactPoints = 8 * 8 + 9 * 9;

    /// The polynomial of degree 7 in either direction through the places at the block's Chebyshev points,
    /// without the terms that do not matter. Empty when it misses the exact places halfway between those
    /// points, ends and corners of the block included, which is where the first term left out is greatest, by
    /// more than `tolerance` of a cell, or when any of them is nowhere.
    static std::optional<PlacePolynomial> fit(const CellBlock& block, const ExactPlaces& exact,
                                              double tolerance);

    /// Places of cells of the block, from column `first` of a row on.
    void find(std::int64_t row, std::int64_t first, std::span<CellPlace> places) const;

  private:
    PlacePolynomial() = default;

    [[nodiscard]] Point2 at(double u, double v) const;

    Point2 origin_{};
    // Columns and rows to -1..1.
    Point2 middle_{};
    Point2 scale_{};
    std::size_t columns_ = 1;           // coefficients along a row, 1 to 8
    std::vector<Point2> coefficients_;  // of powers, row-major, `columns_` wide
};

}  // namespace tinwright::io

#endif
