#ifndef TINWRIGHT_WATER_SECTION_CHOICE_HPP
#define TINWRIGHT_WATER_SECTION_CHOICE_HPP

#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/mesh/handles.hpp"

namespace tinwright {

/// An edge across a row of faces.
struct RowEdge {
    VertexId left;
    VertexId right;
    double length = 0;
    bool is_free = true;  ///< whether it may be chosen
};

/// Chooses edges that share no vertex: many, and square to the water. An edge r times as long as the shortest
/// that it shares an end with is worth 3 - 2 r^2: 1 if it is that one itself, 1/2 if it is 27 degrees off it,
/// nothing beyond 35. Those chosen are of worth, and worth most together. `row`: from one edge to the next,
/// one of the ends stays. Returns indices, ascending; at least one if all are free. O(n).
std::vector<std::uint32_t> choose_sections(std::span<const RowEdge> row);

}  // namespace tinwright

#endif
