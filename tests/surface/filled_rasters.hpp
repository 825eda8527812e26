#ifndef TINWRIGHT_TESTS_SURFACE_FILLED_RASTERS_HPP
#define TINWRIGHT_TESTS_SURFACE_FILLED_RASTERS_HPP

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tinwright/surface/gridding.hpp"

/// Whole rasters in memory.
namespace tinwright_tests {

/// All bands, one array a product.
inline std::vector<std::vector<double>> fill_all(const tinwright::Tin& tin,
                                                 const tinwright::Interpolator* surface,
                                                 const tinwright::GridGeometry& grid, std::int64_t band_rows,
                                                 const tinwright::GriddingOptions& options,
                                                 std::int64_t* covered = nullptr) {
    tinwright::SurfaceGridder gridder(tin, surface, grid, band_rows, options);
    std::vector<std::vector<double>> all(
        options.products.size(), std::vector<double>(static_cast<std::size_t>(grid.columns * grid.rows)));
    std::int64_t cells = 0;
    for (std::int64_t band = 0; band < gridder.band_count(); ++band) {
        const auto [first, end] = gridder.band_rows(band);
        std::vector<std::span<double>> values;
        for (std::vector<double>& of_product : all) {
            values.push_back(std::span(of_product)
                                 .subspan(static_cast<std::size_t>(first * grid.columns),
                                          static_cast<std::size_t>((end - first) * grid.columns)));
        }
        cells += gridder.fill(band, values, std::numeric_limits<double>::quiet_NaN());
    }
    if (covered != nullptr) {
        *covered = cells;
    }
    return all;
}

inline bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); });
}

}  // namespace tinwright_tests

#endif
