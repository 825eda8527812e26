#ifndef TINWRIGHT_IO_WRITE_CONTOURS_HPP
#define TINWRIGHT_IO_WRITE_CONTOURS_HPP

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/surface/contour.hpp"
#include "tinwright/surface/contour_bands.hpp"
#include "tinwright/surface/contour_levels.hpp"

namespace tinwright::io {

struct WriteContoursOptions {
    std::string driver;  ///< GDAL's short name; empty: from the file's extension
    std::string layer_name = "contours";
    std::vector<std::string> creation_options;
    std::vector<std::string> layer_options;
    bool overwrite = false;
    bool has_index = false;  ///< lines get the field `is_index`
    TinMetadata metadata;
    Progress progress;
};

struct WrittenContours {
    std::string driver;
    std::size_t features = 0;
    std::vector<std::string> warnings;
};

/// Checks, before any work is done, that the target's driver exists and keeps positions and elevations.
/// Throws UsageError naming the driver and what to use instead.
void check_contour_target(const std::string& target, const WriteContoursOptions& options, bool is_bands);

/// Writes one `LINESTRING Z` a line, with its level as z and in the field `elev`, levels ascending, under a
/// temporary name. Same lines and options, same bytes. Throws UsageError, IoError, Cancelled.
/// `lines`: one entry a level.
WrittenContours write_contours(std::span<const ContourLevel> levels, std::span<const LevelLines> lines,
                               const Crs& crs, const std::string& target,
                               const WriteContoursOptions& options);

/// Writes one `MULTIPOLYGON` a band, with its limits in the fields `elev_min` and `elev_max`, likewise.
WrittenContours write_bands(std::span<const Band> bands, const Crs& crs, const std::string& target,
                            const WriteContoursOptions& options);

}  // namespace tinwright::io

#endif
