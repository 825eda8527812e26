#ifndef TINWRIGHT_IO_PREVIEW_HPP
#define TINWRIGHT_IO_PREVIEW_HPP

#include <string>

#include "tinwright/mesh/tin.hpp"

namespace tinwright::io {

/// By how much to exaggerate heights so that a hillshade shows the relief: brings the slope that a tenth of
/// the faces exceeds to about one half; 1, 2 or 5 times a power of ten from 0.001 to 1000. O(n).
double choose_z_factor(const Tin& tin);

/// Throws UsageError unless `preview` names a .png file.
void check_preview_target(const std::string& preview);

/// Shades the raster `elevations` (a file, closed) with GDAL's hillshade and writes it as PNG, at most 4096
/// cells a side. Cells without a value are transparent. Throws IoError. `target`: for messages.
void write_preview(const std::string& elevations, const std::string& path, const std::string& target,
                   double z_factor);

}  // namespace tinwright::io

#endif
