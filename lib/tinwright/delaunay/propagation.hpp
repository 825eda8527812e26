#ifndef TINWRIGHT_DELAUNAY_PROPAGATION_HPP
#define TINWRIGHT_DELAUNAY_PROPAGATION_HPP

#include <cstddef>
#include <utility>
#include <vector>

#include "tinwright/delaunay/steiner_point.hpp"
#include "tinwright/geometry/progress.hpp"

namespace tinwright {

struct BlockingReport {
    std::size_t disks = 0;
    std::size_t circle_vertices = 0;      ///< Steiner points where lines meet blocking circles
    std::size_t touching_vertices = 0;    ///< where circles touch
    std::size_t propagated_vertices = 0;  ///< projections of vertices onto edges of lines
    bool is_within_budget = true;
    /// The projections: the vertex made, and the one it was projected from; in the inserter's numbers.
    std::vector<std::pair<VertexId, VertexId>> projections;
};

/// Adds the Steiner points of [tan1993, Ch. 6] for n vertices and m edges of lines, in all fewer than
/// 4 m^2 n + 10 m n + 4 n vertices [Theorem 6.7]: first the blocking disks of all vertices; then vertices
/// are projected onto the parts of lines outside the disks until no such part has a vertex in the disk that
/// it is a diameter of. A part inside a disk has that disk, since nothing is ever put into one.
///
/// As in the thesis: tree, disks, protected and unprotected edges, projections, and their order (6.3.2). Not
/// as in the thesis:
/// - Points on circles are put in on demand only, so the vertices are a part of those of the thesis. An edge
///   of a line is left whole until a vertex lies in the disk that it is a diameter of. Where circles touch
///   there is a vertex only if a projection would else pass there from one face of the walls into another:
///   Lemma 6.6 needs no more, and Lemma 6.5, which says that nothing is overlooked, none of them.
/// - Instead of the boundaries of regions, the constrained Delaunay triangulation is asked for the vertex
///   to project: of all that see an unprotected edge from one side, the apex of the face there sees it
///   under the greatest angle, so it lies in the edge's disk if any of them does. That makes stages 1 and 2
///   of 6.3.2 superfluous; stage 3 is repeated where something has changed since.
/// - Edges on the hull are left alone: they are Delaunay anyway.
/// - Points are rounded to the lattice, which the thesis leaves open (6.4). Much of what is exact there is a
///   tie that rounding would decide at random: many points on one circle, and right angles. Hence ends of
///   chords are moved a little (`move_chord_ends`), projections go some steps beyond the right angle where
///   edges meet, and none leads back to where it came from (Lemma 6.3). Where lines come within some steps
///   of each other, edges may stay open all the same; they are left to the caller.
///
/// `max_steiner`: no more vertices than that are made. `inserter`: nothing put in yet.
/// Throws Cancelled. O((n + s) log n) for s Steiner points in practice.
BlockingReport block_and_propagate(SteinerInserter& inserter, std::size_t max_steiner,
                                   const Progress& progress);

}  // namespace tinwright

#endif
