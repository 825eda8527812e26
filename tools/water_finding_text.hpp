#ifndef TINWRIGHT_TOOLS_WATER_FINDING_TEXT_HPP
#define TINWRIGHT_TOOLS_WATER_FINDING_TEXT_HPP

#include <string>

#include "tinwright/water/water_finding.hpp"

#include "part_names.hpp"

/// Findings about water in words.
namespace tinwright::tools {

/// Stable name of a kind, as in the layer's field `kind` and in JSON: "runs_uphill".
std::string finding_key(WaterFinding::Kind kind);
/// "2 rises, 1 lake that is not level"; empty when there are none.
std::string finding_counts_text(const WaterFindingCounts& counts);
/// One finding for people: "streams.gpkg: feature 3 rises by 0.25 along 12.5 at (x, y), ...".
std::string finding_text(const WaterFinding& finding, const PartNames& names);

}  // namespace tinwright::tools

#endif
