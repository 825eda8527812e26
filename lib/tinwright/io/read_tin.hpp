#ifndef TINWRIGHT_IO_READ_TIN_HPP
#define TINWRIGHT_IO_READ_TIN_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright::io {

/// The faces of a file as they stand there: nothing checked but that they are triangles with z.
struct TinFile {
    std::vector<Point3> vertices;        ///< distinct (x, y, z), in order of first use
    std::vector<std::uint32_t> corners;  ///< 3 a face, as written
    std::vector<std::int64_t> face_ids;  ///< feature id of each face
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constrained_edges;
    std::string layer;
    Crs crs;
    TinMetadata metadata;
    VertexOrigins origins;
};

/// Whether the source is a TIN: has a `faces` layer with our metadata, a TIN geometry, or only closed 3-D
/// triangles; `as=` overrides. Throws IoError when it cannot be opened.
bool is_tin(const Source& source);

/// Reads the faces of a TIN file. Throws IoError; InputError naming the feature that is not a triangle or
/// has no z.
TinFile read_tin_file(const Source& source, const Progress& progress = {});

/// Puts a file's faces on a lattice as a TIN, vertices in curve order, domain and constrained edges kept.
/// Throws InputError, naming the feature and a coordinate, when the faces are no surface (zero area, two
/// elevations at one location, an edge with more than two faces); `tinwright check` lists all of them.
Tin make_tin(const TinFile& file);

}  // namespace tinwright::io

#endif
