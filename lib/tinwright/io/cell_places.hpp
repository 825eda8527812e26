#ifndef TINWRIGHT_IO_CELL_PLACES_HPP
#define TINWRIGHT_IO_CELL_PLACES_HPP

#include "tinwright/io/crs.hpp"
#include "tinwright/io/working_plane.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"

/// Rasters in another system than the plane that a surface lies in: each cell's centre is brought into the
/// plane and read there; no raster is ever warped.
namespace tinwright::io {

/// How far places of cells are off at most, as a part of a cell's size in the plane.
inline constexpr double kCellPlaceError = 1e-5;

/// Where the cells of a raster in `grid_crs` are in `plane`. Blocks of cells are transformed at a few points
/// and polynomials laid through them; where a block's polynomial misses further exact points by more than a
/// tenth of `kCellPlaceError` it is halved, down to single cells, which are exact. Cells outside of the
/// transformation's area get NaN. The result does not depend on threads or on what is asked for in what
/// order; may be called from several threads at a time.
FindCellPlaces make_cell_places(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane);

/// Bounds and spacing of a TIN's terrain in another system, for `choose_grid`: vertices and points along
/// edges transformed exactly; longitudes in one piece (past 180 where the terrain crosses the antimeridian),
/// all around and up to the pole where a pole is on the terrain. The spacing is that of the ground, in units
/// of the system at the terrain's centre.
GridBasis find_grid_basis(const Tin& tin, const Crs& plane, const Crs& grid_crs);

}  // namespace tinwright::io

#endif
