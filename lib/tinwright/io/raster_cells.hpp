#ifndef TINWRIGHT_IO_RASTER_CELLS_HPP
#define TINWRIGHT_IO_RASTER_CELLS_HPP

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/surface/grid.hpp"

namespace tinwright::io {

/// One band of an existing raster, read a piece of a row at a time, in any order.
class RasterCells {
  public:
    /// Opens it: `source` is a path, with band=, crs= and oo= where wanted. Throws IoError when it cannot be
    /// read; InputError where it has no such band or no position, is rotated or mirrored, or has south up;
    /// UsageError for other keys.
    explicit RasterCells(const Source& source);
    ~RasterCells();
    RasterCells(const RasterCells&) = delete;
    RasterCells& operator=(const RasterCells&) = delete;

    [[nodiscard]] const GridGeometry& geometry() const;
    /// Unknown where neither the file nor crs= tells.
    [[nodiscard]] const Crs& crs() const;
    /// GDAL's name of the cells' type: "Float32".
    [[nodiscard]] const std::string& data_type() const;

    /// Reads cells [first, first + values.size()) of a row, with the band's scale and offset; NaN where there
    /// is no value. They lie inside the raster. Throws IoError. One call at a time.
    void read(std::int64_t row, std::int64_t first, std::span<double> values);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tinwright::io

#endif
