#ifndef TINWRIGHT_TESTS_BENCHMARKS_GEOS_PEER_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_GEOS_PEER_HPP

#include <span>
#include <string>

#include "tinwright/breaklines/breakline.hpp"

#include "benchmarks/measure.hpp"

/// Noding by GEOS, the library behind most free GIS: GEOSNode.
namespace tinwright_benchmarks {

/// Whether the benchmarks were built with GEOS; nothing below may be called if not.
bool has_geos();
/// "GEOS" and its version.
std::string geos_name();

/// Measures the noding alone: the lines are geometries of GEOS already. Notes the number of lines that come
/// out, each from one node to the next. Throws std::runtime_error when GEOS fails.
void measure_geos_noding(std::span<const tinwright::Breakline> lines, Meter& meter);

}  // namespace tinwright_benchmarks

#endif
