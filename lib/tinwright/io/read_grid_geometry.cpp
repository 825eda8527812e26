#include <array>
#include <memory>

#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/write_grid.hpp"

namespace tinwright::io {

GridGeometry read_grid_geometry(const std::string& path, Crs* crs) {
    register_drivers();
    const GdalMessages messages;
    const GDALDatasetUniquePtr dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
    if (dataset == nullptr) {
        throw IoError("cannot read " + quoted(path) + " as a raster" + messages.suffix());
    }
    std::array<double, 6> transform{};
    if (dataset->GetGeoTransform(transform.data()) != CE_None) {
        throw InputError(quoted(path) +
                         " says nothing about where it lies (no geotransform); give --extent and "
                         "--resolution instead of --like");
    }
    if (transform[2] != 0 || transform[4] != 0 || !(transform[1] > 0) || transform[5] == 0) {
        throw InputError(quoted(path) +
                         " is rotated or mirrored, which --like cannot follow; give --extent and "
                         "--resolution");
    }
    if (crs != nullptr) {
        *crs = Crs::from_gdal(dataset->GetSpatialRef());
    }
    const int rows = dataset->GetRasterYSize();
    // A raster with south up covers the same cells as one with north up.
    const bool is_south_up = transform[5] > 0;
    return {transform[0],
            is_south_up ? transform[3] + rows * transform[5] : transform[3],
            transform[1],
            is_south_up ? transform[5] : -transform[5],
            dataset->GetRasterXSize(),
            rows};
}

}  // namespace tinwright::io
