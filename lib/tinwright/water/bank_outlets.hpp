#ifndef TINWRIGHT_WATER_BANK_OUTLETS_HPP
#define TINWRIGHT_WATER_BANK_OUTLETS_HPP

#include <cstdint>
#include <vector>

#include "tinwright/water/water_network.hpp"

/// Which way water between banks goes, by the rivers drawn there. Private to the room of water.
namespace tinwright {

/// Sections that water leaves banks at: where rivers, as they were drawn, lead out of banks; and the nearest
/// end of the banks where one ends between them or on them, coming from inside. Those that have come no
/// nearer to that end, by the width of the water there, since they came between the banks are tributaries:
/// they say nothing. Nodes, perhaps repeated.
std::vector<std::uint32_t> find_bank_outlets(const WaterNetwork& network);

}  // namespace tinwright

#endif
