#ifndef TINWRIGHT_TOOLS_COMMAND_GRID_HPP
#define TINWRIGHT_TOOLS_COMMAND_GRID_HPP

#include <span>
#include <string>
#include <vector>

#include "tinwright/io/write_grid.hpp"
#include "tinwright/water/river_cells.hpp"

#include "command.hpp"
#include "options_crs.hpp"
#include "options_interpolation.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_products.hpp"
#include "options_raster.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

struct JobReport;
struct Surface;
class Console;

/// `tinwright grid`: sources, or one existing TIN, to a raster.
class CommandGrid : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    RasterOptions raster;
    InterpolationChoice interpolation;
    ProductOptions products;
    OutputOptions output;
    TalkOptions talk;
    std::string river_cells_text;
    bool are_river_cells = true;  ///< after `setup`: cells that rivers pass get the rivers' elevations

  private:
    /// The options that say how the surface is read.
    [[nodiscard]] std::string reading_options(const Surface& surface) const;
    void set_river_cells(Surface& surface, const GridGeometry& grid, const RasterPlacing& placing,
                         GriddingOptions& gridding) const;
    [[nodiscard]] io::WriteGridOptions write_options() const;
    /// Throws before any work is done where something cannot be written, or would be over a source.
    void check_targets(std::span<const std::string> targets, const io::WriteGridOptions& options) const;
    /// Makes slopes ratios, unless --z-factor was given; warns where units are in doubt.
    void set_slopes(const Surface& surface, GriddingOptions& options, Console& console) const;
    /// Prepares the surface and writes the raster; `options` gets the surface.
    io::WrittenGrid write(const Surface& surface, const GridGeometry& grid,
                          std::span<const std::string> targets, io::WriteGridOptions& options) const;
    /// Throws UsageError when --like and --crs contradict each other.
    void check_like(const io::Crs& like_crs) const;
    /// --crs, else that of --like, else the plane's, with the surface's heights.
    [[nodiscard]] io::Crs output_crs(const Surface& surface, const io::Crs& like_crs) const;
    /// The raster's geometry in the surface's output CRS, without --like.
    /// Throws UsageError for an extent that is none of degrees.
    void check_degrees(const Surface& surface, const GridGeometry& grid) const;
    [[nodiscard]] GridGeometry grid_for(const Surface& surface) const;
    /// Where that is in the surface's plane; as made where they are the same.
    [[nodiscard]] RasterPlacing placing_for(const Surface& surface, const GridGeometry& grid) const;
    /// But for its domain and outputs.
    [[nodiscard]] JobReport make_report(const Surface& surface, const GridGeometry& grid,
                                        const io::WrittenGrid& written) const;
    [[nodiscard]] std::vector<std::string> outputs(std::span<const std::string> targets,
                                                   const Surface& surface) const;
};

}  // namespace tinwright::tools

#endif
