#include "tinwright/surface/scan_lattice.hpp"

#include <algorithm>
#include <cassert>

#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

/// Beyond this, estimated columns and rows are no help and everything is searched.
constexpr double kWorstUncertainty = 0.25;

constexpr double kUncertain = 2;  // more than any estimate's distance from the nearest centre

Key2 largest_key(const Tin& tin) {
    Key2 largest{};
    for (const Key2& key : tin.keys) {
        largest.x = std::max(largest.x, key.x);
        largest.y = std::max(largest.y, key.y);
    }
    return largest;
}

}  // namespace

ScanLattice::ScanLattice(const Tin& tin, const GridGeometry& grid)
    : columns_(static_cast<std::int32_t>(grid.columns)), rows_(static_cast<std::int32_t>(grid.rows)) {
    assert(grid.columns > 0 && grid.rows > 0);
    const Key2 largest = largest_key(tin);
    const Key2 origin = tin.lattice.origin();
    x_ = make_scan_axis(tin.lattice, origin.x, largest.x, AxisDirection::East, grid.x_min, grid.cell_width,
                        grid.columns);
    y_ = make_scan_axis(tin.lattice, origin.y, largest.y, AxisDirection::South, grid.y_max, grid.cell_height,
                        grid.rows);
    last_half_ = static_cast<double>(columns_) - 0.5;
    is_certain_ = x_.uncertainty <= kWorstUncertainty;
    if (!is_certain_) {
        x_.uncertainty = kUncertain;
    }
}

std::int32_t ScanLattice::row_below(double y) const {
    const auto begin = y_.centres.begin();
    if (y_.uncertainty > kWorstUncertainty) {
        const auto below = std::partition_point(begin, y_.centres.end(), [&](double at) { return at >= y; });
        return static_cast<std::int32_t>(below - begin);
    }
    // Row 0 is the highest: coordinates grow southward.
    const double at = (y_.centres[0] - y) * y_.inverse_step;
    if (!(at > -0.5)) {
        return 0;
    }
    if (!(at < static_cast<double>(rows_) - 0.5)) {
        return rows_;
    }
    const auto nearest = static_cast<std::int32_t>(at + 0.5);
    return nearest + (row_y(nearest) >= y ? 1 : 0);
}

bool ScanLattice::is_left(const CutEdge& edge, std::int32_t column, double y) const {
    const double x = column_x(column);
    // Also keeps far centres, which need not be whole numbers in range, away from the predicate.
    const auto [left, right] = std::minmax(edge.lower.x, edge.upper.x);
    if (x < left || x > right) {
        return x < left;
    }
    return orient2d(edge.lower, edge.upper, {x, y}) > 0;
}

bool ScanLattice::is_on(const CutEdge& edge, std::int32_t column, double y) const {
    const double x = column_x(column);
    const auto [left, right] = std::minmax(edge.lower.x, edge.upper.x);
    return x >= left && x <= right && orient2d(edge.lower, edge.upper, {x, y}) == 0;
}

std::int32_t ScanLattice::search_column(const CutEdge& edge, double y) const {
    std::int32_t first = 0;
    std::int32_t end = columns_;
    while (first < end) {
        const std::int32_t middle = first + (end - first) / 2;
        if (is_left(edge, middle, y)) {
            first = middle + 1;
        } else {
            end = middle;
        }
    }
    return first;
}

}  // namespace tinwright
