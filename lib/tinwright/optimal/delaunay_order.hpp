#ifndef TINWRIGHT_OPTIMAL_DELAUNAY_ORDER_HPP
#define TINWRIGHT_OPTIMAL_DELAUNAY_ORDER_HPP

#include <array>
#include <vector>

#include "tinwright/mesh/tin.hpp"

namespace tinwright::internal {

/// Counts the vertices inside a face's circle, exactly; those on it do not count. An edge of a face whose
/// circle has k of them is a Delaunay edge of order k [gudmundsson2002].
///
/// Vertices are looked for along the edges of the TIN at the start, from the corners of the face, no farther
/// than the circle and not from one side of a constrained edge to the other. Of a Delaunay TIN these are all:
/// its edges lead from a corner to every vertex inside, within the circle. Of a constrained one they are
/// those that the face could have as neighbours; what is behind a breakline that divides the disk is none of
/// them.
class DelaunayOrder {
  public:
    /// Keeps a copy of the mesh at the start. O(n), 70 bytes a vertex.
    explicit DelaunayOrder(const Tin& start);

    /// Whether the circle of a face with these corners has `order` vertices inside at most. `corner`:
    /// half-edges of `now` that start at the face's corners, counter-clockwise, on its side of constrained
    /// edges. `now` has the vertices and constrained edges of the start.
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
