#ifndef TINWRIGHT_WATER_LEVEL_DIVISION_HPP
#define TINWRIGHT_WATER_LEVEL_DIVISION_HPP

#include <cstdint>
#include <vector>

#include "tinwright/water/pooling.hpp"

namespace tinwright {

/// Which pools have one level in the best levels of any network: of each pool the first of those that it is
/// pooled with, or its own number. Chains and trees by pooling; other connected parts are divided at
/// thresholds into what is above and what is below, until each is level [picard1976; luss2012].
std::vector<std::uint32_t> find_level_groups(PooledFalls falls);

}  // namespace tinwright

#endif
