#ifndef TINWRIGHT_WATER_LAKES_HPP
#define TINWRIGHT_WATER_LAKES_HPP

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/water/near_samples.hpp"
#include "tinwright/water/water.hpp"

/// The level of each lake, and what samples beside it say. Private to the room of water.
namespace tinwright {

/// A lake: its rings, by index of the line and as keys, closed.
struct LakeShape {
    std::vector<std::uint32_t> lines;
    std::vector<CleanLine> rings;
};

struct MeasuredLake {
    LakeLevel lake;
    /// Samples that are not inside, but no farther from the shore than the shore's width, ascending.
    std::vector<std::uint32_t> beside;
    double z_low = 0;  ///< of the shore's own z, where it has any
    double z_high = 0;
};

/// The elevation that a rule takes of some, one at least.
double choose_level(const LevelRule& rule, std::vector<double> z);

/// Measures a lake; `lines`: what `shape.lines` are indices of. Throws InputError as `NearSamples::terrain`.
MeasuredLake measure_lake(const LakeShape& shape, std::span<const Breakline> lines, NearSamples& samples,
                          const Lattice& lattice, const LevelRule& rule, double shore_width);

}  // namespace tinwright

#endif
