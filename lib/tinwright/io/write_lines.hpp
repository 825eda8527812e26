#ifndef TINWRIGHT_IO_WRITE_LINES_HPP
#define TINWRIGHT_IO_WRITE_LINES_HPP

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"

namespace tinwright::io {

/// A layer of lines or polygons that is to be written again with other geometries.
struct ChangedLines {
    Source source;     ///< that the layer was read from, filters and all
    std::string name;  ///< of the layer that is written
    /// What became of each curve of each feature, by feature id and `LinePart::part`: parts of two points or
    /// more, x and y in the CRS that is written, z NaN where there is none. A curve that is not there, or has
    /// no parts, is left out; a ring has one part, closed.
    std::map<std::pair<std::int64_t, std::uint32_t>, std::vector<std::vector<Point3>>> curves;
};

/// What was written of one layer.
struct WrittenLines {
    std::string layer;
    std::size_t features = 0;
    std::size_t left_out = 0;  ///< features of which nothing remains
};

/// Writes layers into one GeoPackage, as their sources have them but for the geometries: feature ids and
/// attributes stay, a line in several parts becomes a multi-line, a polygon without its outer ring is left
/// out. Layers where no point has z are two-dimensional. Same layers, same bytes.
/// Throws IoError, UsageError; leaves nothing behind then. O(n).
std::vector<WrittenLines> write_changed_lines(std::span<const ChangedLines> layers, const Crs& crs,
                                              const std::string& target, bool overwrite);

}  // namespace tinwright::io

#endif
