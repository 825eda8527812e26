#ifndef TINWRIGHT_SURFACE_GRIDDING_HPP
#define TINWRIGHT_SURFACE_GRIDDING_HPP

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/products.hpp"

namespace tinwright {

/// What a raster's cells tell of the surface at their centres.
enum class Product : std::uint8_t {
    Elevation,
    Slope,
    Aspect,           ///< no value where the surface is level
    GradientX,        ///< rise of z along x, a ratio
    GradientY,        ///< rise of z along y
    Hillshade,        ///< 1 to 255
    NearestDistance,  ///< to the closest sample, CRS units of the TIN
    FaceNumber        ///< number of the face in a TIN file of the surface, from 0
};

/// Names of products, as of bands. `--product` calls both gradients together `gradient`.
inline constexpr auto kProducts = std::to_array<std::pair<std::string_view, Product>>({
    {"elevation", Product::Elevation},
    {"slope", Product::Slope},
    {"aspect", Product::Aspect},
    {"gradient_x", Product::GradientX},
    {"gradient_y", Product::GradientY},
    {"hillshade", Product::Hillshade},
    {"nearest-distance", Product::NearestDistance},
    {"face-id", Product::FaceNumber},
});

/// Whether a product is made from the surface's gradient.
bool is_from_gradient(Product product);

/// The product's name in `kProducts`.
std::string_view product_name(Product product);

/// A cell that gets an elevation of its own, whatever the surface says at its centre.
struct CellElevation {
    std::int64_t cell = 0;  ///< row times columns plus column
    double z = 0;
    friend bool operator==(const CellElevation&, const CellElevation&) = default;
};

/// Where a cell of a raster is in the TIN's plane.
struct CellPlace {
    Point2 position{};   ///< of its centre; not finite: nowhere
    Point2 north{0, 1};  ///< unit vector along the raster's columns upward, as the plane has it
};

/// The places of a row's cells from column `first` on, for a raster in another system than the TIN's plane.
/// May be called from several threads at a time, in any order.
using FindCellPlaces = std::function<void(std::int64_t row, std::int64_t first, std::span<CellPlace> places)>;

struct GriddingOptions {
    std::vector<Product> products{Product::Elevation};
    SlopeUnit slope_unit = SlopeUnit::Degree;
    double z_factor = 1;  ///< heights count times this in slopes and gradients
    Light light{};
    /// Ascending by cell, distinct. Only for the product Elevation, and only where the centre is on the
    /// terrain.
    std::vector<CellElevation> cells{};
    /// Empty: the raster lies in the TIN's plane. Else gradients, aspects and light are told by the raster's
    /// own north and the direction at a right angle east of it.
    FindCellPlaces find_places{};
    GroundMeasures ground{};  ///< of the distance to the nearest sample, nearest in the plane
};

/// Fills a raster with what a surface says at its cell centres, band of rows by band of rows.
///
/// Which face a cell is on is decided exactly: by scan conversion, or where cells have places in another
/// plane by those as rounded to the lattice that surfaces are read by (`QueryLattice`). Gradients are the
/// surface's own, not differences of cells. Every product has a value in the same cells, those on the
/// terrain, but for the aspect of level ones.
class SurfaceGridder {
  public:
    /// `surface`: how elevations and gradients are read; null: the faces themselves, by the quicker way there
    /// is for them. `tin` and `surface` must outlive the gridder. Parallel inside the caller's task arena.
    SurfaceGridder(const Tin& tin, const Interpolator* surface, const GridGeometry& grid,
                   std::int64_t band_rows, const GriddingOptions& options);
    ~SurfaceGridder();
    SurfaceGridder(const SurfaceGridder&) = delete;
    SurfaceGridder& operator=(const SurfaceGridder&) = delete;

    [[nodiscard]] std::int64_t band_count() const;
    /// Rows [first, second) of a band.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> band_rows(std::int64_t band) const;

    /// Writes the cells of a band: one array a product, row-major, `columns` wide. Cells without a value get
    /// `nodata`, which may be NaN. Returns the number of cells on the terrain. Same values for any number of
    /// threads and any height of bands. One call at a time.
    std::int64_t fill(std::int64_t band, std::span<const std::span<float>> values, float nodata);
    std::int64_t fill(std::int64_t band, std::span<const std::span<double>> values, double nodata);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tinwright

#endif
