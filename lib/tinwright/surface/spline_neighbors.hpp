#ifndef TINWRIGHT_SURFACE_SPLINE_NEIGHBORS_HPP
#define TINWRIGHT_SURFACE_SPLINE_NEIGHBORS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/vertex_fan.hpp"
#include "tinwright/surface/vertex_neighbors.hpp"

namespace tinwright {

/// Finds the vertices that a vertex's surface depends on, one vertex after the other. On one thread.
///
/// They are the vertices that the TIN joins to it, and around it an equal number of the nearest in each
/// octant, as far as there are so many near; where an octant has fewer, the nearest of the others make up for
/// it. All are in its sight: no sharp edge and no border lies between. Samples along tracks and contours
/// would otherwise know their own line only.
class SplineNeighbors {
  public:
    /// `count`: of neighbours, 8 or more make octants. Both must outlive it.
    SplineNeighbors(const Tin& tin, const SharpEdges& sharp, int count);

    /// The neighbours, nearest first, of a fan's vertex; valid until the next call. Independent of earlier
    /// calls and of the order of faces. O(d log d + c log c) for d edges at the vertex, c neighbours.
    std::span<const VertexId> find(const VertexFan& fan);

  private:
    struct Candidate {
        double distance;  // squared
        VertexId vertex;
        HalfEdgeId way;  // to it, from the vertex that it was found from
        bool is_joined;
    };
    static bool is_later(const Candidate& a, const Candidate& b);
    [[nodiscard]] std::uint8_t octant_to(VertexId v) const;
    [[nodiscard]] bool is_of_terrain(HalfEdgeId h) const;
    void add(HalfEdgeId h, bool is_joined);
    void visit_center(HalfEdgeId start);
    void visit(const Candidate& from);
    bool is_new(VertexId v);
    bool accept(const Candidate& candidate);
    void select();

    const Tin& tin_;
    NeighborSearch sight_;
    std::size_t count_;
    std::size_t quota_;  // of an octant
    std::size_t most_;   // vertices to look at
    VertexFan fan_;
    VertexId center_{};
    std::vector<Candidate> heap_;
    std::vector<Candidate> accepted_;   // in sight, nearest first
    std::vector<std::uint8_t> octant_;  // of each
    std::array<std::size_t, 8> in_octant_{};
    std::vector<std::uint32_t> seen_;  // hash table of vertices, plus one; 0: free
    std::size_t seen_count_ = 0;
    std::vector<bool> is_taken_;
    std::vector<VertexId> found_;
};

}  // namespace tinwright

#endif
