#ifndef TINWRIGHT_IO_RASTER_VALUES_HPP
#define TINWRIGHT_IO_RASTER_VALUES_HPP

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tinwright/io/raster_driver.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/grid.hpp"

namespace tinwright::io {

/// What the products of a raster can come to.
struct ValueRange {
    double lowest = 0;
    double highest = 0;
    bool is_certain = true;           ///< no cell is beyond
    bool is_count = false;            ///< numbers that must not be rounded
    std::string name = "elevations";  ///< for messages
};

/// The range of what a surface is asked for. `is_quick`: may be wider than it need be. O(n).
ValueRange find_value_range(const Tin& tin, const WriteGridOptions& options, bool is_quick);

/// What a raster's cells may hold, and the value that stands for none.
class RasterValues {
  public:
    /// Chooses nodata where `asked` is empty: -9999, or for integer types the first of -9999, the type's
    /// highest and lowest value that lies outside the range. Throws InputError when there is none, or when
    /// the range is beyond Float32's. `find_range(is_quick)`: the range, asked for again where a quick one
    /// does not settle things.
    RasterValues(const RasterDriver& driver, std::optional<double> asked,
                 const std::function<ValueRange(bool)>& find_range);

    [[nodiscard]] double nodata() const { return nodata_; }
    /// Whether a cell with a value could hold nodata or a number beyond the type, so that `check` is needed.
    [[nodiscard]] bool must_check() const { return must_check_; }
    /// What to fill cells without a value with: NaN where `check` is to turn it into nodata.
    [[nodiscard]] double filler() const;

    /// Rounds to integers where the type asks for them, turns NaN into nodata. `first_row`: of `values`,
    /// which hold whole rows. Throws InputError for a value that is nodata or beyond the type.
    template <class Value>
    void check(std::span<Value> values, const GridGeometry& grid, std::int64_t first_row) const;

  private:
    [[noreturn]] void refuse(double value, std::int64_t cell, const GridGeometry& grid,
                             std::int64_t first_row) const;

    GDALDataType type_;
    std::string name_;
    bool is_integer_;
    IntegerRange range_;
    double nodata_ = -9999;
    bool must_check_ = false;
};

}  // namespace tinwright::io

#endif
