#ifndef TINWRIGHT_TESTS_WATER_RASTERS_HPP
#define TINWRIGHT_TESTS_WATER_RASTERS_HPP

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/gridding.hpp"
#include "tinwright/water/raster_check.hpp"

/// Rasters in memory.
namespace tinwright_tests {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Raster {
    tinwright::GridGeometry grid;
    std::vector<double> values;

    [[nodiscard]] tinwright::RasterCheckReport check(const std::vector<tinwright::Breakline>& lines,
                                                     const tinwright::Water& water,
                                                     double tolerance = 0) const {
        const tinwright::ReadCells read = [this](std::int64_t row, std::int64_t first,
                                                 std::span<double> cells) {
            REQUIRE(row >= 0);
            REQUIRE(row < grid.rows);
            REQUIRE(first >= 0);
            REQUIRE(first + static_cast<std::int64_t>(cells.size()) <= grid.columns);
            std::copy_n(values.begin() + row * grid.columns + first, cells.size(), cells.begin());
        };
        return tinwright::check_raster(grid, read, lines, water, {.tolerance = tolerance, .progress = {}});
    }
};

/// The surface of a TIN under a method, as a raster; single precision where `is_float`.
inline Raster grid_of(const tinwright::Tin& tin, const tinwright::Interpolator* surface,
                      const tinwright::GridGeometry& grid, const std::vector<tinwright::CellElevation>& cells,
                      bool is_float, const tinwright::FindCellPlaces& find_places = {}) {
    tinwright::GriddingOptions options;
    options.find_places = find_places;
    options.cells = cells;
    tinwright::SurfaceGridder gridder(tin, surface, grid, grid.rows, options);
    const auto count = static_cast<std::size_t>(grid.columns * grid.rows);
    Raster raster{grid, std::vector<double>(count)};
    if (is_float) {
        std::vector<float> values(count);
        const std::array<std::span<float>, 1> spans{values};
        gridder.fill(0, spans, std::numeric_limits<float>::quiet_NaN());
        raster.values.assign(values.begin(), values.end());
    } else {
        const std::array<std::span<double>, 1> spans{raster.values};
        gridder.fill(0, spans, kNone);
    }
    return raster;
}

}  // namespace tinwright_tests

#endif
