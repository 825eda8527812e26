#ifndef TINWRIGHT_TOOLS_LEVELED_WATER_HPP
#define TINWRIGHT_TOOLS_LEVELED_WATER_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/io/raster_cells.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/water/raster_check.hpp"
#include "tinwright/water/water.hpp"

#include "console.hpp"
#include "options_crs.hpp"

namespace tinwright::tools {

/// A raster that was held against the water.
struct CheckedRaster {
    std::string file;
    std::string data_type;
    double tolerance = 0;
    RasterCheckReport report;  ///< locations in the working CRS
};

/// Water as it came in and as it became.
struct LeveledWater {
    std::vector<io::LineSource> line_sources;  ///< of `lines`
    io::Samples samples;
    io::Lines lines;
    io::Crs crs;             ///< of the plane; may be unknown
    io::WorkingPlane plane;  ///< how that came about
    WaterOptions options;
    Water water;
    std::optional<CheckedRaster> raster;
    // Of what is written (`bring_to_output`), in which all that `water` and `raster` hold then is:
    io::Crs output_crs;
    std::vector<double> section_widths;  ///< on the ground; of `water.lines` behind those that came in

    /// Of the raster, where there is one; else of the water as it came.
    [[nodiscard]] std::vector<WaterFinding> findings() const;
    /// The number of the source that a line came from, from 1; those of samples follow.
    [[nodiscard]] std::int64_t source_of_line(std::uint32_t line) const;
    [[nodiscard]] std::int64_t source_of_sample(std::uint32_t sample) const;
};

/// What is read, and how.
struct LevelRequest {
    std::vector<io::Source> samples;
    std::vector<io::LineSource> lines;
    CrsOptions crs;
    bool skip_bad = false;
    int threads = 0;
    WaterOptions options;  ///< without progress
    /// Where there are no samples, water without z takes it from the cells of this raster.
    std::optional<io::Source> raster;
    double progress_end = 1;
};

/// Reads samples and water and gives the water its levels. Warnings go to the console; errors about samples
/// and lines get the file and the feature added.
LeveledWater read_leveled_water(const LevelRequest& request, Console& console);

/// Holds the cells of a raster against the water, which is transformed to the raster's CRS for that.
void check_against_raster(LeveledWater& leveled, const io::Source& raster, const RasterCheckOptions& options);

}  // namespace tinwright::tools

#endif
