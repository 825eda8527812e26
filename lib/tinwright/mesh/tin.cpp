#include "tinwright/mesh/tin.hpp"

namespace tinwright {

Box Tin::bounds() const {
    // Rounding is monotone, so the box of the keys becomes the box of the positions.
    Box of_keys;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!mesh.is_terrain({f})) {
            continue;
        }
        for (const VertexId v : mesh.face({f}).vertex) {
            of_keys.add(key(v).x, key(v).y);
        }
    }
    if (of_keys.is_empty()) {
        return {};
    }
    const Point2 low = lattice.position({of_keys.x_min, of_keys.y_min});
    const Point2 high = lattice.position({of_keys.x_max, of_keys.y_max});
    return {low.x, low.y, high.x, high.y};
}

}  // namespace tinwright
