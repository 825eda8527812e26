#ifndef TINWRIGHT_DELAUNAY_TREE_OF_REGIONS_HPP
#define TINWRIGHT_DELAUNAY_TREE_OF_REGIONS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/delaunay/blocking_disks.hpp"
#include "tinwright/delaunay/lines_in_disks.hpp"

/// Regions of the graph H of [tan1993, Sec. 6.2.2]: what the blocking disks and the parts of lines outside
/// them leave of the plane. Between the vertices on it, a circle is taken for its walls.
namespace tinwright {

/// That vertices on the boundary of the region on one side of an unprotected edge are projected onto it.
struct Export {
    std::uint32_t edge;  ///< index
    bool is_from_left;   ///< as seen from its line's first end
    friend bool operator==(const Export&, const Export&) = default;
};

/// The order of exports of [tan1993, Sec. 6.3.2]: regions that share an unprotected edge are neighbours in a
/// tree, one within each face of the disks' walls; first each region exports to its parent, children before
/// parents, then to its children, parents first. So each export comes after all that it depends on.
///
/// Both sides of every edge occur once. Regions are found as orbits around the edges' ends on the circles:
/// where rounding puts ends in the wrong order there, regions come out wrong and the order is not the best,
/// but there is one. O((n + e) log n) for n disks and e edges.
std::vector<Export> order_exports(const BlockingDisks& disks, std::span<const Key2> keys,
                                  const LinesInDisks& lines);

}  // namespace tinwright

#endif
