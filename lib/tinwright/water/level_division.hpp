#ifndef TINWRIGHT_WATER_LEVEL_DIVISION_HPP
#define TINWRIGHT_WATER_LEVEL_DIVISION_HPP

#include <vector>

#include "tinwright/water/pooling.hpp"

namespace tinwright {

/// The best levels of pools in any network, one each: chains and trees by pooling; other connected parts are
/// divided at thresholds into what is above and what is below, until each is level [picard1976; luss2012].
/// Rounded: falls may rise by as much.
std::vector<double> divide_levels(PooledFalls falls);

}  // namespace tinwright

#endif
