#ifndef TINWRIGHT_TOOLS_OPTIONS_RASTER_HPP
#define TINWRIGHT_TOOLS_OPTIONS_RASTER_HPP

#include <optional>
#include <string>
#include <vector>

#include "tinwright/surface/grid.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// Where a raster's cells lie and what they hold.
struct RasterOptions {
    std::vector<std::string> extent_texts;
    std::string resolution_text;
    std::vector<std::string> size_texts;
    std::string like;
    bool tap = false;
    std::string nodata_text;
    std::string data_type;
    std::string preview;

    // After `finish`:
    GridRequest request;
    std::optional<double> nodata;

    void add_geometry_to(CLI::App& parser);
    void add_values_to(CLI::App& parser);
    /// Reads the texts. Throws UsageError for bad numbers and for options that exclude each other.
    void finish();
};

}  // namespace tinwright::tools

#endif
