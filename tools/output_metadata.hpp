#ifndef TINWRIGHT_TOOLS_OUTPUT_METADATA_HPP
#define TINWRIGHT_TOOLS_OUTPUT_METADATA_HPP

#include <string>

#include "surface_input.hpp"

namespace tinwright::tools {

/// What an output read off a surface says about itself: the version, the command, what made the surface (of a
/// TIN file, what the file says), and all options that its contents depend on, those of reading last.
io::TinMetadata output_metadata(const std::string& command, const Surface& surface,
                                const TriangulationOptions& triangulation, const LineOptions& lines,
                                const std::string& reading);

}  // namespace tinwright::tools

#endif
