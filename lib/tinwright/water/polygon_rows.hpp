#ifndef TINWRIGHT_WATER_POLYGON_ROWS_HPP
#define TINWRIGHT_WATER_POLYGON_ROWS_HPP

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/grid.hpp"

/// Private to the check of rasters.
namespace tinwright {

/// Lakes and banks over a raster, kept by rows: which places are inside them. In double precision: whoever
/// asks keeps away from shores.
class PolygonRows {
  public:
    struct Polygon {
        bool is_lake = false;  ///< rather than banks
        std::uint32_t number = 0;
        friend auto operator<=>(const Polygon&, const Polygon&) = default;
    };

    explicit PolygonRows(const GridGeometry& grid) : grid_(grid) {}

    /// Adds a ring, that closes itself by its last point, of the line with this number; lines ascend.
    void add(const Polygon& polygon, std::uint32_t line, std::span<const Point3> ring);
    /// To be called when all rings are there. O((n + rows passed) log n).
    void finish();

    /// Polygons are numbered in the order of their first lines.
    [[nodiscard]] std::size_t size() const { return polygons_.size(); }
    [[nodiscard]] bool is_lake(std::size_t polygon) const { return polygons_[polygon].first.is_lake; }
    [[nodiscard]] std::uint32_t first_line(std::size_t polygon) const { return polygons_[polygon].second; }

    /// Whether any polygon has the place inside; false outside of the raster. O(edges in the row).
    [[nodiscard]] bool hold(Point2 at) const;

    /// Calls `visit(row, first, end)` for the runs of cells whose centre is inside the polygon and, as far as
    /// the four places `margin` cells to the left and right, above and below tell, not near its shore.
    /// O(edges and rows, and runs).
    void visit_inside(std::size_t polygon, double margin,
                      const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& visit) const;

  private:
    struct Edge {
        std::uint32_t polygon;
        Point2 a;
        Point2 b;
    };
    using Run = std::pair<std::int64_t, std::int64_t>;  // of columns, from the first to before the second

    [[nodiscard]] std::int64_t row_of(double y) const;
    /// Columns whose centre is inside at a height, and farther than a distance from where it ends.
    [[nodiscard]] std::vector<Run> columns_inside(std::span<const std::uint32_t> edges, double y,
                                                  double distance) const;

    const GridGeometry grid_;
    std::vector<std::pair<Polygon, std::uint32_t>> polygons_;  // and the first line of each
    std::map<Polygon, std::uint32_t> number_of_;
    std::vector<Edge> edges_;            // polygon by polygon
    std::vector<std::uint32_t> in_row_;  // edges, row by row
    std::vector<std::size_t> row_begin_;
};

}  // namespace tinwright

#endif
