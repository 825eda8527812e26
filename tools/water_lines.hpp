#ifndef TINWRIGHT_TOOLS_WATER_LINES_HPP
#define TINWRIGHT_TOOLS_WATER_LINES_HPP

#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/water/water.hpp"

namespace tinwright::tools {

/// Puts what `level_water` made in the place of the lines and samples that it was made of. The lines' array
/// gets the sections too, each as a part of the feature that its banks are.
void take_water(io::Samples& samples, io::Lines& lines, std::vector<Breakline> made,
                const std::vector<std::uint32_t>& origin,
                const std::vector<std::pair<std::uint32_t, double>>& lifted);

}  // namespace tinwright::tools

#endif
