#ifndef TINWRIGHT_SURFACE_PLACED_CELLS_HPP
#define TINWRIGHT_SURFACE_PLACED_CELLS_HPP

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/scan_conversion.hpp"

/// Private to gridding.
namespace tinwright {

/// A cell of a raster, and where its centre is on a surface in another plane.
struct PlacedCell {
    SurfacePlace place{kNoFace, {}};  ///< `kNoFace`: not on the terrain
    Point2 north{0, 1};               ///< of the raster, in the surface's plane
};

/// Finds the faces that the cells of a raster are on which does not lie in the TIN's plane.
class PlacedCells {
  public:
    /// The face and the place of cells of one row, from column `first` on.
    using Visit = std::function<void(std::int64_t row, std::int64_t first, std::span<const PlacedCell>)>;

    /// `tin` and `find_places` must outlive it. O(slots log slots).
    PlacedCells(const Tin& tin, const GridGeometry& grid, const FindCellPlaces& find_places);

    /// Calls `visit` for parts of rows [first_row, end_row) that together are all of them, from several
    /// threads at a time. A cell's face is the terrain face of smallest id whose closure holds its place: it
    /// depends on nothing else. Parallel inside the caller's task arena.
    void visit(std::int64_t first_row, std::int64_t end_row, const Visit& visit) const;

  private:
    /// What one thread keeps from row to row.
    struct Worker {
        std::vector<CellPlace> places;
        std::vector<PlacedCell> cells;
    };

    /// Fills in `worker.cells`, `hint` being a face near the first; returns one near the first of the next
    /// row.
    FaceId find(std::int64_t row, std::int64_t first, FaceId hint, Worker& worker) const;
    /// The face that strictly holds the place, by a short walk from another; `kNoFace` if that does not find
    /// one.
    [[nodiscard]] FaceId walk(FaceId from, Key2 at) const;

    const Tin& tin_;
    const FindCellPlaces& find_places_;
    std::int64_t columns_;
    SurfaceLocator locator_;
};

}  // namespace tinwright

#endif
