#ifndef TINWRIGHT_IO_READ_TEXT_HPP
#define TINWRIGHT_IO_READ_TEXT_HPP

#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/raw_slice.hpp"

namespace tinwright::io {

/// Appends the samples of a text file's rows to `points`, in file order; ids are line numbers from 1.
/// Throws IoError, InputError, UsageError, Cancelled. O(bytes); a few megabytes a thread beside the points.
RawSlice read_text(const SliceRequest& request, std::vector<Point3>& points);

/// The first bytes of a file, at most `size`; empty when it cannot be read. Standard input stays readable.
std::string read_head(const std::string& path, std::size_t size);

}  // namespace tinwright::io

#endif
