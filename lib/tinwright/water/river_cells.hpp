#ifndef TINWRIGHT_WATER_RIVER_CELLS_HPP
#define TINWRIGHT_WATER_RIVER_CELLS_HPP

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"

/// Rivers in rasters. A cell's value is the surface's at its centre, which is beside the river, up its bank;
/// water would not run along such cells. So cells that a river passes get the river's own elevation.
namespace tinwright {

/// The part of a segment inside one cell.
struct CellPassage {
    std::int64_t column = 0;
    std::int64_t row = 0;
    double begin = 0;  ///< as parts of the segment, 0 to 1
    double end = 0;
};

/// Calls `visit` for the cells of the raster that a segment passes, from a to b. A point on the edge between
/// cells belongs to the one to the right of it, or below, so that each point of the segment is in one passage
/// but for their ends; where only one point of the segment belongs to a cell, `begin` and `end` are the same.
/// Ends are at the crossings of the edges, the same number in the passages before and after. Nothing is
/// visited outside of the raster. O(columns and rows passed).
void visit_cells(Point2 a, Point2 b, const GridGeometry& grid,
                 const std::function<void(const CellPassage&)>& visit);

/// Where a raster is that does not lie in the TIN's plane; as it is made: it does.
struct RasterPlacing {
    /// Brings positions of the TIN's plane into the raster's system; NaN for those that are not in it.
    std::function<void(std::span<Point2> positions)> to_raster{};
    /// The way back, for cells, as the raster is filled by.
    FindCellPlaces find_places{};
    /// What x is the same place after: a turn of longitude; 0: nothing.
    double period = 0;
};

/// The elevations of cells that rivers pass for more than a point, by cell: the lowest that a river has in
/// the cell or in any cell upstream of it. So cells never rise along any way downstream, be they rounded to a
/// narrower type or not; a bend that leaves a cell and comes back makes all cells between equal; and none is
/// above the rivers in it.
/// Rivers: edges of `tin` that a line of role River runs along, `is_river_line` telling which lines those are
/// by the numbers of `tin.traces`; water runs from their higher to their lower end, and along level ones
/// either way, so that all cells of a level reach are equal. Cells whose centre is on
/// water (`is_water_face`, by face; may be empty) are left as they are. Cells whose centre is off the terrain
/// are listed too. In a raster that is `placed` elsewhere edges are straight as well, between vertices
/// brought there, the short way where x is periodic; edges to vertices that cannot be are left out. O(c log
/// c), c: the cells passed and edges, and the water's faces.
std::vector<CellElevation> find_river_cells(const Tin& tin, const std::vector<bool>& is_river_line,
                                            const std::vector<bool>& is_water_face, const GridGeometry& grid,
                                            const RasterPlacing& placed = {});

}  // namespace tinwright

#endif
