#ifndef TINWRIGHT_WATER_WATER_RUNS_HPP
#define TINWRIGHT_WATER_WATER_RUNS_HPP

#include <vector>

#include "tinwright/water/water_network.hpp"

/// The stretches of a network of water. Private to the room of water.
namespace tinwright {

/// Fills `network.runs`: first those of rivers, line by line, then those of banks. `is_in_water`: of each
/// noded piece, whether it is part of a river inside a lake or between banks, and so of no run. O(n log n).
void find_runs(WaterNetwork& network, const std::vector<bool>& is_in_water);

}  // namespace tinwright

#endif
