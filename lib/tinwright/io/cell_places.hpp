#ifndef TINWRIGHT_IO_CELL_PLACES_HPP
#define TINWRIGHT_IO_CELL_PLACES_HPP

#include "tinwright/io/crs.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/water/river_cells.hpp"

/// Rasters in another system than the plane that a surface lies in: each cell's centre is brought into the
/// plane and read there; no raster is ever warped.
namespace tinwright::io {

/// How far places of cells are off at most, as a part of a cell's shorter side in the plane (of a hundredth
/// of the longer, where that is more: towards poles), beside four units in the last place of the plane's
/// coordinates.
inline constexpr double kCellPlaceError = 1e-5;

/// Where the cells of a raster in `grid_crs` are in `plane`. Blocks of cells, aligned to the raster's rows
/// and columns, are transformed at a few points and polynomials laid through them; where a block's polynomial
/// misses further exact points by more than a tenth of `kCellPlaceError` it is quartered, down to few cells,
/// which are exact. Cells outside of the transformation's area get NaN. The result does not depend on threads
/// or on what is asked for in what order; may be called from several threads at a time. The polynomials of
/// the rows asked for last are kept. 4 ns a cell, where it must be exact three times what PROJ takes.
/// Throws InputError when there is no way between the systems.
FindCellPlaces make_cell_places(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane);

/// The same with the way from the plane to the raster, for rivers in it.
RasterPlacing make_raster_placing(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane);

/// Bounds and spacing of a TIN's terrain in another system, for `choose_grid`: vertices and points along
/// the terrain's border transformed exactly, bounds rounded outward to a decimal of at most a thousandth of
/// the spacing (but for noise); longitudes in one piece (past 180 where the terrain crosses the
/// antimeridian), from -180 to 180 where it goes round a pole, latitudes up to the pole where that is on the
/// terrain. The spacing is that of the ground, in units of the system, typical of the terrain (a median); of
/// latitude in geographic systems. Throws InputError for a terrain without faces or outside of what the
/// system can show. O(n).
GridBasis find_grid_basis(const Tin& tin, const Crs& plane, const Crs& grid_crs);

/// Metres that a cell in the middle of a raster in a geographic system measures on the ellipsoid, along the
/// parallel and along the meridian.
Point2 cell_size_on_ground(const GridGeometry& grid, const Crs& grid_crs);

}  // namespace tinwright::io

#endif
