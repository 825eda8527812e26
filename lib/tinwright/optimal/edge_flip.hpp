#ifndef TINWRIGHT_OPTIMAL_EDGE_FLIP_HPP
#define TINWRIGHT_OPTIMAL_EDGE_FLIP_HPP

#include <cstddef>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// Flips edges as long as the worse of the two faces gets better [lawson1972; tan1993, Sec. 2.3]. Constrained
/// edges stay. The result is a local optimum only, as Figure 4.1 of [tan1993] shows; edge insertion goes on
/// from there. Returns the number of flips. Each flip lowers the sorted vector of measures, so it ends; in
/// practice O(n).
std::size_t flip_edges(Tin& tin, Criterion criterion);

}  // namespace tinwright

#endif
