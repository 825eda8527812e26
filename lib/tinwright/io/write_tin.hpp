#ifndef TINWRIGHT_IO_WRITE_TIN_HPP
#define TINWRIGHT_IO_WRITE_TIN_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright::io {

/// Where each vertex came from, as the file keeps it.
struct VertexOrigins {
    std::vector<std::int32_t> source;   ///< one a vertex, from 1; empty: not kept
    std::vector<std::int64_t> feature;  ///< one a vertex, -1: not kept; empty: not kept
};

/// A line that constrained edges are part of, as the file keeps it.
struct LineOrigin {
    LineRole role = LineRole::Breakline;
    bool is_sharp = true;
    std::int32_t source = 0;    ///< from 1, numbered with the vertices' sources; 0: not kept
    std::int64_t feature = -1;  ///< -1: not kept
    friend bool operator==(const LineOrigin&, const LineOrigin&) = default;
};

/// What a TIN file says about itself. Keys are fixed in docs/formats.md; TINWRIGHT_VERTICES and
/// TINWRIGHT_FACES are added by the writer.
using TinMetadata = std::vector<std::pair<std::string, std::string>>;

struct WriteTinOptions {
    enum class Geometry { Polygon, Tin, Edges, Vertices };
    std::string driver;      ///< GDAL's short name; empty: from the file's extension
    std::string layer_name;  ///< of single-layer formats; empty: the driver's habit
    Geometry geometry = Geometry::Polygon;
    std::vector<std::string> creation_options;
    std::vector<std::string> layer_options;
    bool overwrite = false;
    TinMetadata metadata;
    VertexOrigins origins;
    /// Of each line that `Tin::traces` number; nothing is written of lines beyond its end.
    std::vector<LineOrigin> lines;
    /// By face slot: on a lake or between banks. Empty, or nowhere true: the file does not speak of water.
    std::vector<bool> is_water_face;
    /// By vertex: where it is in the CRS that is written. Empty: where the TIN has it.
    std::vector<Point2> positions;
    GroundMeasures ground;  ///< of the field `area`
    double z_factor = 1;  ///< heights count times this in the field `slope`: horizontal units in a unit of z
    Progress progress;
};

struct WrittenTin {
    std::string driver;
    std::size_t features = 0;
    std::vector<std::string> layers;
    std::vector<std::string> warnings;
};

/// Checks, before any work is done, that the target's driver exists and keeps what is asked for.
/// Throws UsageError naming the driver and what to use instead.
void check_tin_target(const std::string& target, const WriteTinOptions& options);

/// Writes the terrain faces (rotated so that the smallest vertex comes first, in slot order), constrained
/// edges and vertices that the format can hold, under a temporary name. Same TIN and options, same bytes.
/// Throws UsageError, IoError, Cancelled.
WrittenTin write_tin(const Tin& tin, const Crs& crs, const std::string& target,
                     const WriteTinOptions& options);

}  // namespace tinwright::io

#endif
