#ifndef TINWRIGHT_TOOLS_VERTEX_ORIGINS_HPP
#define TINWRIGHT_TOOLS_VERTEX_ORIGINS_HPP

#include <span>

#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright::tools {

/// The source and feature of each vertex. Sources are numbered from 1 in the order in which they first own
/// a vertex, so that the numbers do not depend on the order of the command line. Features are kept for
/// vector layers, and with `keep_ids` for text rows and raster cells too. O(n log slices).
io::VertexOrigins make_vertex_origins(const Tin& tin, std::span<const io::SampleSlice> slices, bool keep_ids);

}  // namespace tinwright::tools

#endif
