#ifndef TINWRIGHT_TOOLS_VERTEX_ORIGINS_HPP
#define TINWRIGHT_TOOLS_VERTEX_ORIGINS_HPP

#include <span>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright::tools {

/// Where the vertices and constrained edges of a TIN came from, as a TIN file keeps it.
struct TinOrigins {
    io::VertexOrigins vertices;
    std::vector<io::LineOrigin> lines;  ///< of each line
};

/// The source and feature of each vertex and line. Sources are numbered from 1 in the order in which they
/// first own a vertex, then those of lines that own none in the order of their first edge, so that the
/// numbers do not depend on the order of the command line. Features are kept for vector layers, and with
/// `keep_ids` for text rows and raster cells too. O(n log slices).
TinOrigins make_tin_origins(const Tin& tin, std::span<const io::SampleSlice> slices, const io::Lines& lines,
                            bool keep_ids);

}  // namespace tinwright::tools

#endif
