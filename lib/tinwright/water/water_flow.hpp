#ifndef TINWRIGHT_WATER_WATER_FLOW_HPP
#define TINWRIGHT_WATER_WATER_FLOW_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/water/flow.hpp"
#include "tinwright/water/isotonic_regression.hpp"
#include "tinwright/water/water.hpp"
#include "tinwright/water/water_network.hpp"

/// Which way the runs of a network of water go. Private to the room of water.
namespace tinwright {

struct WaterFlow {
    std::vector<bool> is_reversed;        ///< of each run: against the order of its stops
    std::vector<std::uint32_t> first_of;  ///< of each node the first that must have its level: see `equal`
    std::vector<Fall> falls;       ///< between nodes that are their own `first_of`; distinct, ascending
    std::vector<Fall> bank_falls;  ///< between sections as they are numbered; ascending

    /// Stops of a run as the water passes them.
    [[nodiscard]] std::vector<std::uint32_t> stops(const WaterNetwork& network, std::uint32_t run) const;
    /// Where a run begins and ends as the water goes.
    [[nodiscard]] std::uint32_t upper_end(const WaterNetwork& network, std::uint32_t run) const {
        return is_reversed[run] ? network.runs[run].to : network.runs[run].from;
    }
    [[nodiscard]] std::uint32_t lower_end(const WaterNetwork& network, std::uint32_t run) const {
        return is_reversed[run] ? network.runs[run].from : network.runs[run].to;
    }
    /// The nodes between which a vertex on banks has its level, upper first; the same twice for another
    /// vertex.
    [[nodiscard]] Fall around(const WaterNetwork& network, std::uint32_t vertex) const;
};

/// `elevations`: measured or given, one a node. Rivers run as they were drawn, or as `orient_links` finds;
/// banks toward where a river leaves them, or by elevation where none does. O(n log n).
WaterFlow find_flow(const WaterNetwork& network, std::span<const double> elevations, FlowRule rule);

}  // namespace tinwright

#endif
