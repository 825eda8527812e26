#ifndef TINWRIGHT_TESTS_SUPPORT_RING_SETS_HPP
#define TINWRIGHT_TESTS_SUPPORT_RING_SETS_HPP

#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

#include "support/point_sets.hpp"

/// Seeded simple polygons.
namespace tinwright_tests {

/// A kind of polygons; `make` gives a counter-clockwise ring of about `sides` sides, 4 or more.
struct RingFamily {
    const char* name;
    std::vector<tinwright::Key2> (*make)(Random& random, std::size_t sides);
};

/// Near a circle (the first), regular, a circle with a part cut off, fans, stars, bows, combs, tangles of
/// random points, some of them on a small lattice, and few corners with many vertices between.
std::span<const RingFamily> ring_families();

}  // namespace tinwright_tests

#endif
