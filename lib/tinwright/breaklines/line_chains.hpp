#ifndef TINWRIGHT_BREAKLINES_LINE_CHAINS_HPP
#define TINWRIGHT_BREAKLINES_LINE_CHAINS_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/breaklines/noding.hpp"

namespace tinwright {

/// The vertices that each line passes, in its own order and direction: what `pieces` do not tell.
/// `noded`: the lines noded without snapping, pieces numbered as `lines` are. Lines of one point have an
/// empty chain. O(n log n) but for lines that double back on themselves.
std::vector<std::vector<std::uint32_t>> find_line_chains(std::span<const CleanLine> lines,
                                                         const NodedLines& noded);

}  // namespace tinwright

#endif
