#ifndef TINWRIGHT_IO_READ_RASTER_HPP
#define TINWRIGHT_IO_READ_RASTER_HPP

#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/raw_slice.hpp"

class GDALDataset;

namespace tinwright::io {

/// Appends the centres of a band's valid cells to `points`, row by row from the top; with stride= n only of
/// columns and rows 0, n, 2n, ... Not valid: nodata, masked, NaN. Elevation = cell x scale + offset of the
/// band. Ids are cell numbers, row-major from 0. Throws IoError, InputError, UsageError, Cancelled.
RawSlice read_raster(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points);

}  // namespace tinwright::io

#endif
