#ifndef TINWRIGHT_TOOLS_SURFACE_INPUT_HPP
#define TINWRIGHT_TOOLS_SURFACE_INPUT_HPP

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/output_positions.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/read_tin.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "console.hpp"
#include "criterion_report.hpp"
#include "flat_faces_report.hpp"
#include "lines_report.hpp"
#include "options_crs.hpp"
#include "options_lines.hpp"
#include "options_sources.hpp"
#include "options_triangulation.hpp"
#include "vertex_origins.hpp"
#include "water_report.hpp"

namespace tinwright::tools {

/// A source in words.
struct SourceName {
    std::string text;     ///< `file "a.gpkg", layer "p"`
    std::string id_word;  ///< what its numbers count: "feature", "line" or "cell"
};

/// A TIN at hand, triangulated just now or read from a file.
struct Surface {
    /// Whether what is written has the positions of the TIN.
    [[nodiscard]] bool is_written_in_plane() const { return output_crs.is_same_horizontally(crs); }
    /// The system that positions on the command line are in: --crs, else the samples' own where it is
    /// geographic, else the plane's.
    [[nodiscard]] io::Crs place_crs(const CrsOptions& options) const;
    /// Of lengths that are told; empty when unknown.
    [[nodiscard]] std::string length_unit() const { return ground.is_geodesic() ? ground.unit : crs.unit(); }
    /// Of samples, or of what is read from a file; in the plane.
    [[nodiscard]] Box bounds() const { return report ? report->bounds : tin.bounds(); }
    /// The way from the plane to what is written. Throws InputError.
    [[nodiscard]] io::OutputPositions output_positions() const { return {crs, output_crs, bounds()}; }

    Tin tin;
    io::Crs crs;             ///< of the TIN's plane; may be unknown
    io::WorkingPlane plane;  ///< how that came about
    io::Crs output_crs;      ///< of what is written: --crs, else the plane's
    GroundMeasures ground;   ///< lengths and areas that are told
    std::string z_unit;      ///< empty when unknown
    /// Horizontal units in a unit of z, so that slopes are true ratios; 1 where either unit is unknown.
    double z_factor = 1;
    std::string reference_options;            ///< `CrsOptions::canonical`
    std::vector<io::SampleSlice> slices;      ///< what was read, without ids; empty for a TIN file
    std::optional<TriangulateReport> report;  ///< only when triangulated
    CriterionReport criterion;
    LinesSummary lines;
    std::optional<FlatFacesSummary> flat_faces;  ///< where it was asked for, or to be told anyway
    TinOrigins origins;                          ///< as a TIN file keeps them; of a TIN file: what it says
    /// What the sources that `origins` number from 1 are called; empty for a TIN file.
    std::vector<SourceName> source_names;
    /// For each line that the TIN's traces number: whether the surface may have a crease along it.
    std::vector<bool> is_line_sharp;
    /// Likewise: whether it is a river.
    std::vector<bool> is_river_line;
    std::vector<bool> is_water_face;    ///< by face slot: on a lake or between banks; empty: none is
    std::optional<WaterSummary> water;  ///< only when triangulated, and with water
    io::TinMetadata metadata;           ///< of the TIN file
    std::string tin_layer;              ///< of the TIN file
    std::size_t void_faces = 0;         ///< dropped by --max-edge from a TIN file
    double read_seconds = 0;
    /// The file of --conflicts, complete but under a temporary name; null: none was asked for.
    std::unique_ptr<io::AtomicOutput> conflicts;
};

/// How sources become a surface. `lines`: null where the command takes none. `progress_end`: the share of the
/// whole job that ends with the TIN.
struct SurfaceRequest {
    const SourceOptions& sources;
    const CrsOptions& crs;
    const TriangulationOptions& triangulation;
    const LineOptions* lines = nullptr;
    bool overwrite_conflicts = false;  ///< the file of --conflicts may be replaced
    bool keep_origins = false;         ///< the surface is to know its vertices' sources
    bool keep_ids = false;             ///< with the ids of text rows and raster cells too
    double progress_end = 1;
};

/// The value of a key, or empty.
std::string metadata_value(const io::TinMetadata& metadata, const std::string& key);

/// TINWRIGHT_Z_UNIT, where the unit of elevations is known and the CRS that is written does not tell it.
io::TinMetadata unit_metadata(const Surface& surface);

/// CRS units in a unit of z of a TIN file that lies in a plane; 1 where either is unknown.
double z_factor_of(const io::TinFile& file, const CrsOptions& options);

/// Whether slopes take z to be in the unit of the CRS because nobody says its own.
bool is_z_unit_assumed(const Surface& surface);

/// "metre", "foot, 0.3048 of the CRS's unit", "metre, assumed", "unknown".
std::string z_unit_text(const Surface& surface);

/// For commands that write lines or faces: warns where degrees tear them, around a pole.
void warn_of_pole(const Surface& surface, Console& console);

/// For commands that tell slopes: warns, once a run, where their units are in doubt.
void warn_of_slopes(const Surface& surface, Console& console);

/// Whether the sources are one existing TIN. Throws UsageError when a TIN stands among several sources, or
/// when an option is given that a TIN's own faces leave no room for.
bool is_existing_tin(const SurfaceRequest& request);

/// Reads samples and lines and triangulates them. Warnings go to the console; errors about samples and lines
/// get the file and line or feature of each added.
Surface triangulate_sources(const SurfaceRequest& request, Console& console);

/// Reads samples and makes the Delaunay triangulation of their locations, for a graph of them: two are
/// enough, and all may lie on one line. The request is without lines. Warnings and errors likewise.
Surface triangulate_locations(const SurfaceRequest& request, Console& console);

/// Reads the one source as a TIN.
Surface read_existing_tin(const SurfaceRequest& request, Console& console);

}  // namespace tinwright::tools

#endif
