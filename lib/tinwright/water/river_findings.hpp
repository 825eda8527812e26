#ifndef TINWRIGHT_WATER_RIVER_FINDINGS_HPP
#define TINWRIGHT_WATER_RIVER_FINDINGS_HPP

#include <span>
#include <vector>

#include "tinwright/water/near_samples.hpp"
#include "tinwright/water/water_finding.hpp"
#include "tinwright/water/water_flow.hpp"
#include "tinwright/water/water_network.hpp"

/// What is wrong with rivers as they came. Private to the room of water.
namespace tinwright {

struct RiverFindingOptions {
    double tolerance = 0;    ///< unit of z
    double shore_width = 0;  ///< CRS units
};

/// RunsUphill, of banks too, and WrongDirection, by the elevations given or measured: `elevations`, one a
/// node.
std::vector<WaterFinding> find_rises(const WaterNetwork& network, const WaterFlow& flow,
                                     std::span<const double> elevations, double tolerance);

/// Loop and Braid.
std::vector<WaterFinding> find_rings(const WaterNetwork& network, const WaterFlow& flow);

/// DanglingReach: a river ends inside the terrain, farther than the shore's width from its border; without
/// samples, within that of other water.
std::vector<WaterFinding> find_dangling(const WaterNetwork& network, const WaterFlow& flow,
                                        NearSamples& samples, const RiverFindingOptions& options);

}  // namespace tinwright

#endif
