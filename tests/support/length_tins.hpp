#ifndef TINWRIGHT_TESTS_SUPPORT_LENGTH_TINS_HPP
#define TINWRIGHT_TESTS_SUPPORT_LENGTH_TINS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/norm.hpp"
#include "tinwright/mesh/tin.hpp"

#include "support/point_sets.hpp"
#include "support/random_tins.hpp"

/// TINs on which the longest edge is hard to make short: nearly equal lengths, and long edges
/// that Delaunay has and need not have.
namespace tinwright_tests {

/// l1, l2, linf, lp:3, lp:5.
std::span<const tinwright::Norm> length_norms();

/// Equilateral lattices as far as keys allow, facing arcs, kites, lattices with holes, far clusters.
std::span<const TinFamily> length_families();

/// Those, the general and the degenerate ones.
std::vector<TinFamily> all_tin_families();

/// A constrained Delaunay TIN of up to `most` vertices, of any family: every second has constrained edges, of
/// these some voids, some cracks. Without faces if all vertices are collinear.
tinwright::Tin any_small_tin(std::uint64_t seed, std::size_t most);

/// The constrained Delaunay TIN of the inside of a counter-clockwise simple polygon; outside of it there may
/// be more vertices, of which no terrain is made.
tinwright::Tin tin_of_ring(const std::vector<tinwright::Key2>& ring,
                           const std::vector<tinwright::Key2>& outside = {});

/// Tries to make as many random segments between vertices constrained edges, where they cross none.
void add_segments_at_random(Random& random, tinwright::Tin& tin, int count);

/// Keeps as terrain about `count` faces that hang together along a tree of shared edges; the other edges
/// between two of them become constrained: dangling edges and cracks.
void keep_tree_of_faces(Random& random, tinwright::Tin& tin, std::size_t count);

}  // namespace tinwright_tests

#endif
