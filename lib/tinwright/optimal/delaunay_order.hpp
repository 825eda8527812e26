#ifndef TINWRIGHT_OPTIMAL_DELAUNAY_ORDER_HPP
#define TINWRIGHT_OPTIMAL_DELAUNAY_ORDER_HPP

#include <array>
#include <vector>

#include "tinwright/mesh/tin.hpp"

namespace tinwright::internal {

/// How far a face is from Delaunay: its order is the number of vertices inside its circle
/// [gudmundsson2002], decided exactly. Vertices on the circle do not count.
///
/// Vertices are looked for along the edges of the TIN at the start, from the corners of the face, without
/// passing through a constrained edge or beside one from one side to the other, and no farther than the
/// circle. Of a Delaunay TIN these are all: its edges lead from a corner to every vertex inside, within the
/// circle. Of a constrained one they are those that the face could have as neighbours; what is behind a
/// breakline that divides the disk is none of them.
class DelaunayOrder {
  public:
    /// Keeps a copy of the mesh at the start. O(n), 70 bytes a vertex.
    explicit DelaunayOrder(const Tin& start);

    /// Whether the order of a face with these corners is `order` at most. `corner`: half-edges of `now` that
    /// start at the face's corners, counter-clockwise, on its side of constrained edges. `now` has the
    /// vertices and constrained edges of the start.
    bool is_at_most(const Tin& now, const std::array<HalfEdgeId, 3>& corner, int order);

  private:
    [[nodiscard]] bool is_barrier(HalfEdgeId h) const;
    [[nodiscard]] HalfEdgeId corner_at_start(const TriangleMesh& now, HalfEdgeId corner) const;
    void visit_sector(const Tin& now, const std::array<Key2, 3>& circle, HalfEdgeId corner);
    void visit(const Tin& now, const std::array<Key2, 3>& circle, HalfEdgeId corner);

    TriangleMesh start_;
    std::vector<HalfEdgeId> starts_;
    std::vector<HalfEdgeId> pending_;  // corners to look around from
    std::vector<HalfEdgeId> seen_;     // corners looked at
    std::vector<VertexId> inside_;
};

}  // namespace tinwright::internal

#endif
