#ifndef TINWRIGHT_IO_RASTER_DRIVER_HPP
#define TINWRIGHT_IO_RASTER_DRIVER_HPP

#include <string>

#include <gdal_priv.h>

#include "tinwright/io/write_grid.hpp"

namespace tinwright::io {

/// The driver and data type that a raster is written with. Includes GDAL: not for public headers.
struct RasterDriver {
    GDALDriver* driver = nullptr;
    GDALDataType type = GDT_Float32;
    bool can_create = false;  ///< writes rows as they come; else copies a finished dataset

    [[nodiscard]] std::string name() const { return driver->GetDescription(); }
    [[nodiscard]] std::string type_name() const { return GDALGetDataTypeName(type); }
    [[nodiscard]] bool is_integer() const { return GDALDataTypeIsInteger(type) != 0; }
};

/// Smallest and largest value of an integer type that a double holds.
struct IntegerRange {
    double lowest = 0;
    double highest = 0;
};
IntegerRange integer_range(GDALDataType type);

/// Finds driver and type by the options, else by the target's extension; checks the creation options and
/// that the nodata asked for is a value of the type. Throws UsageError.
RasterDriver find_raster_driver(const std::string& target, const WriteGridOptions& options);

}  // namespace tinwright::io

#endif
