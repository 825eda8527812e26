#ifndef TINWRIGHT_WATER_WATER_ELEVATIONS_HPP
#define TINWRIGHT_WATER_WATER_ELEVATIONS_HPP

#include <span>
#include <vector>

#include "tinwright/water/isotonic_regression.hpp"
#include "tinwright/water/near_samples.hpp"
#include "tinwright/water/water_flow.hpp"
#include "tinwright/water/water_network.hpp"

/// What elevation each place of the water has before it is made to run downhill. Private to the room of
/// water.
namespace tinwright {

/// One a node. Lakes: `lake_levels`. Vertices of rivers: their own z, of several lines that meet the lowest,
/// or the lowest sample within `river_width` (CRS units) and the terrain. Sections: the z of a river that
/// crosses them, else the lower one of the banks', else as rivers. Throws InputError as
/// `NearSamples::terrain` does.
std::vector<double> measure_water(const WaterNetwork& network, std::span<const double> lake_levels,
                                  NearSamples& samples, double river_width);

/// The nodes of the regression: elevations as targets, weighted by length; those that must be equal to
/// another are merged into the first of them and stay without falls; lakes are given.
std::vector<LevelNode> make_level_nodes(const WaterNetwork& network, const WaterFlow& flow,
                                        std::span<const double> elevations);

}  // namespace tinwright

#endif
