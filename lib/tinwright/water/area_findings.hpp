#ifndef TINWRIGHT_WATER_AREA_FINDINGS_HPP
#define TINWRIGHT_WATER_AREA_FINDINGS_HPP

#include <span>
#include <vector>

#include "tinwright/water/isotonic_regression.hpp"
#include "tinwright/water/water_finding.hpp"
#include "tinwright/water/water_flow.hpp"
#include "tinwright/water/water_network.hpp"

/// What is wrong with lakes and banks as they came. Private to the room of water.
namespace tinwright {

/// RiverThroughLake: where rivers with z of their own meet lakes, and how they differ. `levels`: one a node.
std::vector<WaterFinding> find_passages(const WaterNetwork& network, std::span<const double> levels,
                                        double tolerance);

/// From each lake to the lakes that water from it comes to next: nodes, ascending. O(n log n), and the lakes
/// below each place where ways to different ones part.
std::vector<Fall> find_lake_falls(const WaterNetwork& network, const WaterFlow& flow);

/// LakesOutOfOrder, by the falls. `levels`: those that lakes were given, one a node.
std::vector<WaterFinding> find_disorder(const WaterNetwork& network, const WaterFlow& flow,
                                        std::span<const double> levels, double tolerance);

/// BanksNotLevel, one a section.
std::vector<WaterFinding> find_unlevel_sections(const WaterNetwork& network, double tolerance);

/// WaterOverlaps: banks that reach into a lake or other banks, and lakes that reach into banks; one a
/// polygon.
std::vector<WaterFinding> find_overlaps(const WaterNetwork& network);

}  // namespace tinwright

#endif
