#include <stdexcept>

#include "benchmarks/geos_peer.hpp"

namespace tinwright_benchmarks {

bool has_geos() { return false; }

std::string geos_name() { return "GEOS (not found at build time)"; }

void measure_geos_noding(std::span<const tinwright::Breakline> /*lines*/, Meter& /*meter*/) {
    throw std::runtime_error("built without GEOS");
}

}  // namespace tinwright_benchmarks
