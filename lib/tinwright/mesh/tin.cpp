#include "tinwright/mesh/tin.hpp"

#include "tinwright/mesh/border.hpp"

namespace tinwright {

Box Tin::bounds() const {
    // Rounding is monotone, so the box of the keys becomes the box of the positions; and what is extreme is
    // on the border.
    Box of_keys;
    for (const HalfEdgeId h : find_border(mesh)) {
        const Key2 at = key(mesh.origin(h));
        of_keys.add(at.x, at.y);
    }
    if (of_keys.is_empty()) {
        return {};
    }
    const Point2 low = lattice.position({of_keys.x_min, of_keys.y_min});
    const Point2 high = lattice.position({of_keys.x_max, of_keys.y_max});
    return {low.x, low.y, high.x, high.y};
}

}  // namespace tinwright
