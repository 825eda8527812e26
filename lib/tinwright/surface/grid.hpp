#ifndef TINWRIGHT_SURFACE_GRID_HPP
#define TINWRIGHT_SURFACE_GRID_HPP

#include <cstdint>
#include <optional>
#include <string>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// A north-up raster: pixel-is-area, columns eastward from `x_min`, rows southward from `y_max`.
struct GridGeometry {
    double x_min = 0;  ///< west edge of column 0, CRS units
    double y_max = 0;  ///< north edge of row 0, CRS units
    double cell_width = 1;
    double cell_height = 1;  ///< positive
    std::int64_t columns = 0;
    std::int64_t rows = 0;

    /// Centre of a cell, CRS units.
    [[nodiscard]] Point2 centre(std::int64_t column, std::int64_t row) const {
        return {x_min + (static_cast<double>(column) + 0.5) * cell_width,
                y_max - (static_cast<double>(row) + 0.5) * cell_height};
    }
    [[nodiscard]] Box extent() const;
    friend bool operator==(const GridGeometry&, const GridGeometry&) = default;
};

/// What the user said about the raster; the rest is chosen.
struct GridRequest {
    std::optional<Box> extent = std::nullopt;         ///< CRS units
    std::optional<Point2> resolution = std::nullopt;  ///< cell width and height, CRS units, > 0
    struct Size {
        std::int64_t columns = 0;
        std::int64_t rows = 0;
    };
    std::optional<Size> size = std::nullopt;
    bool align_to_resolution = false;  ///< --tap: edges at multiples of the resolution
};

/// What a raster's default geometry is made from, in the units of the raster's CRS.
struct GridBasis {
    Box bounds;          ///< of the terrain
    double spacing = 0;  ///< median distance from a vertex to its nearest neighbour
};

/// Fills in what the request leaves open: extent = bounds of the terrain grown to whole cells from its
/// (x_min, y_max) corner; resolution = extent / size, or without a size half the median distance from a
/// vertex to its nearest neighbour, rounded to 1, 2 or 5 times a power of ten; size = ceil(extent /
/// resolution), decided on the decimal numbers that the doubles mean, so that rounding adds no cell.
/// A size and a resolution without an extent start at the terrain's (x_min, y_max).
/// Throws UsageError for contradictory requests (size with resolution and extent that disagree, alignment
/// without a resolution), empty extents, resolutions that are not positive, and rasters beyond 2^31 - 1
/// columns or rows; InputError where bounds or spacing of a TIN without faces are needed. O(n).
GridGeometry choose_grid(const Tin& tin, const GridRequest& request);

/// The same for a terrain of which just that is known, one in another system say.
GridGeometry choose_grid(const GridBasis& basis, const GridRequest& request);

/// Median over the terrain's vertices of the length of their shortest edge (the distance to the nearest
/// neighbour, on a Delaunay TIN), CRS units. O(n).
double median_spacing(const Tin& tin);

}  // namespace tinwright

#endif
