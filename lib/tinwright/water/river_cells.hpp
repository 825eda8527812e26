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

/// Calls `visit` for the cells of the raster that a segment passes, from a to b; a point on the edge between
/// cells belongs to the one to the right of it, or below. Each passage has its
/// ends at the crossings of the edges, both of them the same number for the cells on both sides.
void visit_cells(Point2 a, Point2 b, const GridGeometry& grid,
                 const std::function<void(const CellPassage&)>& visit);

/// The elevations of cells that rivers pass, by cell: the lowest that a river has in the cell, and never
/// above any cell upstream of it (a bend that leaves a cell and comes back makes all cells between equal).
/// Rivers: edges of `tin` that a line of role River runs along, `is_river_line` telling which lines those are
/// by the numbers of `tin.traces`; water runs from their higher to their lower end. Cells whose centre is on
/// water (`is_water_face`, by face; may be empty) are left as they are. Cells whose centre is off the terrain
/// are listed too. O(cells + edges log edges).
std::vector<CellElevation> find_river_cells(const Tin& tin, const std::vector<bool>& is_river_line,
                                            const std::vector<bool>& is_water_face, const GridGeometry& grid);

}  // namespace tinwright

#endif
