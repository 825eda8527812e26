#ifndef TINWRIGHT_SURFACE_SCAN_LATTICE_HPP
#define TINWRIGHT_SURFACE_SCAN_LATTICE_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/scan_axis.hpp"

namespace tinwright {

/// An edge that is not horizontal, ready to be cut by rows.
struct CutEdge {
    Key2 lower{};
    Key2 upper{};
    double column = 0;            ///< of the lower end, in cells from the centre of column 0
    double columns_per_unit = 0;  ///< change of `column` along y
};

/// The lattice that holds a TIN's vertices and a raster's cell centres: decides exactly which centres lie
/// left of an edge and above a vertex.
class ScanLattice {
  public:
    /// O(vertices + columns + rows).
    ScanLattice(const Tin& tin, const GridGeometry& grid);

    [[nodiscard]] std::int32_t columns() const { return columns_; }
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    /// x of every column's centre, ascending.
    [[nodiscard]] const double* column_x() const { return x_.centres.data(); }
    [[nodiscard]] double column_x(std::int32_t column) const {
        return x_.centres[static_cast<std::size_t>(column)];
    }
    /// y of a row's centre, descending with the row.
    [[nodiscard]] double row_y(std::int32_t row) const { return y_.centres[static_cast<std::size_t>(row)]; }
    [[nodiscard]] Key2 scaled(Key2 key) const { return {key.x * x_.scale, key.y * y_.scale}; }

    /// x of the columns' centres, y of the rows', in whole steps of which `scale` make one of the TIN's.
    [[nodiscard]] std::vector<double> columns_at(double scale) const { return x_.centres_at(scale); }
    [[nodiscard]] std::vector<double> rows_at(double scale) const { return y_.centres_at(scale); }

    /// The first row whose centre lies strictly below `y`; rows() if there is none. Exact.
    [[nodiscard]] std::int32_t row_below(double y) const;

    /// `lower.y < upper.y`, or a line that no row cuts.
    [[nodiscard]] CutEdge cut(Key2 lower, Key2 upper) const {
        return {lower, upper, (lower.x - x_.centres[0]) * x_.inverse_step,
                (upper.x - lower.x) * x_.inverse_step / (upper.y - lower.y)};
    }
    /// The first column whose centre in the row at height `y` lies on the edge or right of it; columns() if
    /// there is none. Exact; `y` within the edge's.
    [[nodiscard]] std::int32_t first_column(const CutEdge& edge, double y) const {
        const double at = edge.column + (y - edge.lower.y) * edge.columns_per_unit;
        if (!(at > -0.5)) {
            return is_certain_ ? 0 : search_column(edge, y);
        }
        if (!(at < last_half_)) {
            return is_certain_ ? columns_ : search_column(edge, y);
        }
        const auto nearest = static_cast<std::int32_t>(at + 0.5);
        const double beyond = at - static_cast<double>(nearest);
        if (std::abs(beyond) > x_.uncertainty) {
            return nearest + (beyond > 0 ? 1 : 0);
        }
        return is_certain_ ? nearest + (is_left(edge, nearest, y) ? 1 : 0) : search_column(edge, y);
    }
    /// `first_column` of two edges that both cross the row at height `y`. `is_inside`: both lie within the
    /// columns' centres.
    [[nodiscard]] std::array<std::int32_t, 2> first_columns(const CutEdge& a, const CutEdge& b, double y,
                                                            bool is_inside) const {
        if (!is_inside) {
            return {first_column(a, y), first_column(b, y)};
        }
        const double at_a = a.column + (y - a.lower.y) * a.columns_per_unit;
        const double at_b = b.column + (y - b.lower.y) * b.columns_per_unit;
        const auto nearest_a = static_cast<std::int32_t>(at_a + 0.5);
        const auto nearest_b = static_cast<std::int32_t>(at_b + 0.5);
        const double beyond_a = at_a - static_cast<double>(nearest_a);
        const double beyond_b = at_b - static_cast<double>(nearest_b);
        if (std::min(std::abs(beyond_a), std::abs(beyond_b)) > x_.uncertainty) {
            return {nearest_a + (beyond_a > 0 ? 1 : 0), nearest_b + (beyond_b > 0 ? 1 : 0)};
        }
        return {first_column(a, y), first_column(b, y)};
    }
    /// Whether no column's centre lies within x = west..east.
    [[nodiscard]] bool is_beside(double west, double east) const {
        return east < x_.centres.front() || west > x_.centres.back();
    }
    /// Whether west..east lies within the columns' centres, and estimates of columns can be trusted.
    [[nodiscard]] bool is_inside(double west, double east) const {
        return is_certain_ && west >= x_.centres.front() && east <= x_.centres.back();
    }
    /// Whether the centre of a cell lies exactly on the edge.
    [[nodiscard]] bool is_on(const CutEdge& edge, std::int32_t column, double y) const;

  private:
    [[nodiscard]] bool is_left(const CutEdge& edge, std::int32_t column, double y) const;
    [[nodiscard]] std::int32_t search_column(const CutEdge& edge, double y) const;

    ScanAxis x_;
    ScanAxis y_;
    double last_half_ = 0;  // columns - 1/2
    std::int32_t columns_ = 0;
    std::int32_t rows_ = 0;
    bool is_certain_ = true;  // estimates of columns are good to a fraction of a cell
};

}  // namespace tinwright

#endif
