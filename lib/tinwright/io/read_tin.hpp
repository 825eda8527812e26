#ifndef TINWRIGHT_IO_READ_TIN_HPP
#define TINWRIGHT_IO_READ_TIN_HPP

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/working_plane.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright::io {

/// The faces of a file as they stand there: nothing checked but that they are triangles with z.
struct TinFile {
    /// Distinct (x, y, z) in order of first use by a face; then those of a `vertices` layer that no face
    /// uses.
    std::vector<Point3> vertices;
    std::vector<std::uint32_t> corners;  ///< 3 a face, as written
    std::vector<std::int64_t> face_ids;  ///< feature id of each face
    std::vector<bool> is_water;          ///< one a face where the file says it; else empty
    /// Vertex pairs, the smaller first, sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constrained_edges;
    std::vector<bool> is_steiner;   ///< one a vertex where the file says it; else empty
    std::vector<bool> is_crossing;  ///< of lines; likewise
    std::vector<bool> is_inserted;  ///< into flat faces; likewise
    /// A line along an edge between two vertices, the smaller first.
    struct LineEdge {
        std::uint32_t a;
        std::uint32_t b;
        std::uint32_t line;  ///< index into `lines`
        friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
    };
    std::vector<LineEdge> line_edges;  ///< constrained edges of which the file says so; sorted
    std::vector<LineOrigin> lines;     ///< the distinct ones that the file tells apart
    std::string layer;
    Crs crs;
    TinMetadata metadata;
    VertexOrigins origins;
    bool is_north_first = false;        ///< vertices are northing or latitude first
    std::vector<std::string> warnings;  ///< one line each
};

/// Whether the source is a TIN: has a `faces` layer with our metadata, a TIN geometry, or only closed 3-D
/// triangles (in the one layer there is, or the one that `layer=` names; the first 1000 features are looked
/// at); `as=` overrides. Keys that only samples have (`vertices`, `xfield`, `format`, ...) say no, and so
/// does /vsistdin/, which is not touched. Throws IoError when it cannot be opened.
bool is_tin(const Source& source);

/// Reads the faces of a TIN file, and what docs/formats.md says goes with them. Throws IoError; InputError
/// naming the feature that is not a triangle or has no z; UsageError for a filter that cannot be; Cancelled.
/// O(n).
TinFile read_tin_file(const Source& source, const Progress& progress = {});

/// Makes sure that the vertices are in a plane: those in degrees are brought to the one that the file was
/// made in (metadata key TINWRIGHT_WORKING_CRS), to a projected `options.crs`, or to one chosen for them;
/// `file.crs` is then that plane's. Vertices in a plane stay where they are, those without a CRS are taken to
/// be in `options.source_crs`, else in `options.crs`. Throws InputError.
WorkingPlane place_tin(TinFile& file, const Source& source, const ReadOptions& options);

/// Puts a file's faces on a lattice as a TIN, vertices in curve order, domain and constrained edges kept.
/// `sample[v]` is the index in `file.vertices` that vertex v has there, or kNoSample for a Steiner vertex,
/// kCrossing for one made where lines cross and kInserted for one put into a flat face; `traces` number
/// `file.lines`. Faces may turn either way in the file and are all counter-clockwise in the TIN. Throws
/// InputError, naming the feature and a coordinate, when the faces are no surface (zero area, two elevations
/// at one location, an edge with more than two faces); `tinwright check` lists all of them.
Tin make_tin(const TinFile& file);

/// Which face slots of `tin`, made of `file`, are on a lake or between banks; empty where the file does not
/// say.
std::vector<bool> water_faces_of(const TinFile& file, const Tin& tin);

}  // namespace tinwright::io

#endif
