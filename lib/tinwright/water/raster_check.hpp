#ifndef TINWRIGHT_WATER_RASTER_CHECK_HPP
#define TINWRIGHT_WATER_RASTER_CHECK_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/water/water.hpp"
#include "tinwright/water/water_finding.hpp"

/// Whether a finished raster, by whatever program, keeps what was promised of water.
namespace tinwright {

/// Reads cells [first, first + values.size()) of one row; NaN where there is no value.
using ReadCells = std::function<void(std::int64_t row, std::int64_t first, std::span<double> values)>;

struct RasterCheckOptions {
    double tolerance = 0.001;  ///< cells that rise or differ by at most this (unit of z, >= 0) do not count
    Progress progress;
};

struct RasterCheckReport {
    std::vector<WaterFinding> findings;  ///< RasterRises, RasterLakeUneven; by kind, line, chainage
    std::size_t rivers = 0;              ///< reaches that cells were compared along
    std::size_t river_cells = 0;
    std::size_t lakes = 0;
    std::size_t lake_cells = 0;
    std::size_t empty_cells = 0;  ///< without a value: passed over
    double highest_rise = 0;      ///< along any river, unit of z
    double widest_range = 0;      ///< in any lake
};

/// Along each reach, from its upper end: a cell is not above the lowest one before it by more than the
/// tolerance; one finding a rise, from where the cells leave the lowest to where they come back to it or the
/// reach ends, `z` the highest of them. What
/// is passed for less than a hundredth of a cell, cells whose centre is in a lake or between banks or less
/// than a hundredth of a cell beside them, and parts
/// of reaches there, are passed over. In each lake: all cells whose centre is inside, and not that near to
/// the shore, are equal; `location` is the centre of the highest.
/// `lines`: those that `water.origin` numbers; `water`: what `level_water` made of them, in the raster's CRS.
/// Throws UsageError for a tolerance below zero, Cancelled, and what `read` throws.
/// O(cells of lakes and rivers, and edges of shores next to them).
RasterCheckReport check_raster(const GridGeometry& grid, const ReadCells& read,
                               std::span<const Breakline> lines, const Water& water,
                               const RasterCheckOptions& options = {});

}  // namespace tinwright

#endif
