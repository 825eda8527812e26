#ifndef TINWRIGHT_IO_READ_VECTOR_HPP
#define TINWRIGHT_IO_READ_VECTOR_HPP

#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/raw_slice.hpp"

class GDALDataset;

namespace tinwright::io {

/// Appends the samples of one vector layer to `points`, in the layer's order; ids are feature ids.
/// The layer is the one named, the result of sql=, or the only one that has samples.
/// Throws IoError, InputError, UsageError, Cancelled.
RawSlice read_vector(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points);

}  // namespace tinwright::io

#endif
