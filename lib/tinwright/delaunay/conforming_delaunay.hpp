#ifndef TINWRIGHT_DELAUNAY_CONFORMING_DELAUNAY_HPP
#define TINWRIGHT_DELAUNAY_CONFORMING_DELAUNAY_HPP

#include <cstddef>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

enum class ConformingMethod {
    Split,    ///< few Steiner points: edges are split where the vertex that disturbs them projects
    Blocking  ///< [tan1993, Ch. 6]: a number of points bounded by the number of vertices and edges alone
};

struct ConformingOptions {
    ConformingMethod method = ConformingMethod::Split;
    /// Steiner points allowed; 0: ten a vertex and a hundred an edge of a line, which nothing seen comes
    /// near; for Blocking ten more, but at most 10^8, for each pair of a vertex and an edge.
    std::size_t max_steiner = 0;
    Progress progress = {};
};

struct ConformingReport {
    std::size_t steiner_vertices = 0;
    /// Whether every edge of a line has an empty disk: some circle through its ends with no vertex inside.
    bool is_conforming = true;
    std::size_t open_edges = 0;         ///< edges without one
    bool is_budget_spent = false;       ///< they are open for want of budget; else the lattice leaves no room
    std::size_t blocking_disks = 0;     ///< Blocking only
    std::size_t blocking_vertices = 0;  ///< Blocking only: of the Steiner points, those on blocking circles
};

/// Adds Steiner points on the edges of lines (`tin.traces`) until the triangulation is Delaunay and every
/// such edge in it. z of a Steiner point is linear along the edge it was put on; its position is a lattice
/// point less than a step away from that edge, and never outside the hull.
///
/// `tin`: constrained Delaunay, nothing marked outside, constrained edges those of its traces. New vertices
/// are sorted in, so vertex numbers change; traces follow.
/// Throws Cancelled. O((n + s) log n) for s Steiner points in practice.
ConformingReport make_conforming(Tin& tin, const ConformingOptions& options = {});

/// Whether every edge of a line lies in an empty disk. `tin`: constrained Delaunay. Exact. O(n).
bool is_conforming(const Tin& tin);

/// Number of edges of lines that lie in no empty disk. Exact. O(n) when there are none; else O(n log n),
/// since one such edge hides vertices from others, and the Delaunay triangulation of all vertices has to
/// tell.
std::size_t count_open_edges(const Tin& tin);

}  // namespace tinwright

#endif
