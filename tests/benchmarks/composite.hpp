#ifndef TINWRIGHT_TESTS_BENCHMARKS_COMPOSITE_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_COMPOSITE_HPP

#include <string>

#include "tinwright/surface/grid.hpp"

namespace tinwright_benchmarks {

/// What an able programmer would put together in a day from the best existing parts: bare reading (Arrow
/// stream for .gpkg, std::from_chars for anything else), CGAL's triangulation, textbook scan conversion, an
/// uncompressed GeoTIFF by GDAL. No checks, no decimal lattice, no duplicates' policy. Needs CGAL.
void run_composite(const std::string& input, const tinwright::GridGeometry& grid, const std::string& output);

}  // namespace tinwright_benchmarks

#endif
