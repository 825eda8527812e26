#ifndef TINWRIGHT_WATER_BAYS_HPP
#define TINWRIGHT_WATER_BAYS_HPP

#include <vector>

#include "tinwright/water/water_mesh.hpp"

namespace tinwright {

/// Which face slots are open water: inside, and in no little bay. A bay is what an edge cuts off, with no
/// island in it, of a face with three inner edges, when the way to its far end through the middles of edges
/// is shorter than the edge is long or than half the height of the face above it. Thus the branches that a
/// medial axis sends into the corners of banks do not count [prasad1997], and arms do that go further than
/// they or half the water before them are wide. Where all branches of the water can be cut off so, the face
/// in the middle of it is left: that which halves the longest way. Open water is connected where the water
/// is, and has the same islands. O(n log n).
std::vector<bool> find_open_water(const WaterMesh& water);

}  // namespace tinwright

#endif
