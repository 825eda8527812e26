#ifndef TINWRIGHT_IO_WRITE_GRID_HPP
#define TINWRIGHT_IO_WRITE_GRID_HPP

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/gridding.hpp"

namespace tinwright::io {

struct WriteGridOptions {
    std::string driver = {};  ///< GDAL's short name; empty: from the file's extension
    std::string data_type =
        {};  ///< GDAL's name (Float32, Int16, ...); empty: what suits the products and the driver
    std::optional<double> nodata =
        std::nullopt;  ///< default: -9999, or a value outside the data for integer types
    std::vector<std::string> creation_options = {};
    bool overwrite = false;
    std::string preview = {};  ///< PNG hillshade of the first product to write beside it; empty: none
    GriddingOptions gridding = {};
    const Interpolator* surface = nullptr;  ///< how elevations are read; null: the faces
    bool is_surface_bounded = false;        ///< `surface` stays within the elevations of the vertices
    std::vector<std::pair<std::string, std::string>> metadata = {};
    int threads = 1;                                   ///< 0: all processors; the bytes do not depend on it
    std::int64_t band_bytes = std::int64_t{4} << 20U;  ///< of one band of rows; two are in use at a time
    Progress progress = {};
};

struct WrittenGrid {
    std::string driver;
    std::string data_type;
    double nodata = -9999;
    std::vector<std::string> bands;  ///< names of the products
    std::int64_t cells_with_value = 0;
    double interpolate_seconds = 0;
    double write_seconds = 0;
    std::vector<std::string> warnings;
};

/// Geometry of an existing raster, for --like. Throws IoError; InputError for a rotated raster.
GridGeometry read_grid_geometry(const std::string& path, Crs* crs = nullptr);

/// Checks, before any work is done, that the target's driver can write such a raster. Throws UsageError.
void check_grid_target(const std::string& target, const WriteGridOptions& options);

/// Reads the surface of the TIN at the cell centres and writes the raster by bands of rows, under a temporary
/// name: one of GDAL's bands a product, named after it. Throws UsageError, IoError (not enough space, driver
/// failed), InputError (a value does not fit the data type, nodata collides with the data), Cancelled.
/// Memory: two bands of rows, plus a copy of the raster in memory (up to 256 MiB; beyond, a temporary file)
/// for drivers that only copy, and what the surface takes.
WrittenGrid write_grid(const Tin& tin, const Crs& crs, const GridGeometry& grid, const std::string& target,
                       const WriteGridOptions& options);

/// The same with a file for each product: `targets` as many as products, in their order. All appear, or none.
/// What it returns tells of all of them together.
WrittenGrid write_grids(const Tin& tin, const Crs& crs, const GridGeometry& grid,
                        std::span<const std::string> targets, const WriteGridOptions& options);

}  // namespace tinwright::io

#endif
