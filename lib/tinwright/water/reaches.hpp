#ifndef TINWRIGHT_WATER_REACHES_HPP
#define TINWRIGHT_WATER_REACHES_HPP

#include <span>
#include <vector>

#include "tinwright/water/water.hpp"
#include "tinwright/water/water_flow.hpp"
#include "tinwright/water/water_network.hpp"

/// Reaches with what belongs to them. Private to the room of water.
namespace tinwright {

/// One reach a run, in the runs' order. `levels`: one a node; `level_of`: of each vertex. O(n).
std::vector<Reach> make_reaches(const WaterNetwork& network, const WaterFlow& flow,
                                std::span<const double> levels, std::span<const double> level_of);

}  // namespace tinwright

#endif
