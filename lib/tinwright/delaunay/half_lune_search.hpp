#ifndef TINWRIGHT_DELAUNAY_HALF_LUNE_SEARCH_HPP
#define TINWRIGHT_DELAUNAY_HALF_LUNE_SEARCH_HPP

#include <span>
#include <vector>

#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// Looks for vertices in the lunes of the edges of a mesh that is Delaunay, constrained or not, in the
/// Euclidean norm.
///
/// Any vertex in the lune of p q that p sees, in the corner of p in which q is, will do: if q does not see
/// it, a vertex of the shortest way from q to it is in the lune and seen from both (docs/criteria.md).
class HalfLuneSearch {
  public:
    /// Both must outlive the search.
    HalfLuneSearch(const TriangleMesh& mesh, std::span<const Key2> keys, LuneRim rim)
        : mesh_(&mesh), keys_(keys), lengths_(keys), rim_(rim) {}

    /// The corner of a face from which the edge starts that has the third vertex in its lune, or 3: none has.
    [[nodiscard]] unsigned find_occupied(FaceId f) const;

    /// Whether no vertex on the side of `h`, whose face is terrain, is in the lune of its edge. The third
    /// vertex of the face must not be.
    [[nodiscard]] bool is_empty(HalfEdgeId h);

  private:
    struct Wedge {
        HalfEdgeId edge;  // on the near side
        VertexId right;   // the lines of sight pass between these two
        VertexId left;
    };

    struct Turn {
        VertexId eye;       // one end of the edge
        VertexId other;     // the other end
        HalfEdgeId corner;  // from the eye, of the face that was reached
        bool is_left;       // counter-clockwise
    };
    enum class Found { Nothing, NothingYet, Vertex };

    [[nodiscard]] bool is_closed(HalfEdgeId h) const {
        return mesh_->is_constrained(h) || !mesh_->is_terrain(face_of(mesh_->twin(h)));
    }
    [[nodiscard]] bool is_in_lune(VertexId x, VertexId p, VertexId q) const {
        return rim_ == LuneRim::Ordered ? lengths_.is_in_lune(x, p, q) : lengths_.is_in_open_lune(x, p, q);
    }
    [[nodiscard]] Found look_on(Turn& turn);
    [[nodiscard]] bool is_lune_in_circle(HalfEdgeId h) const;
    [[nodiscard]] bool is_beyond_lune(VertexId p, VertexId q, VertexId spoke) const;
    [[nodiscard]] bool is_empty_behind(HalfEdgeId far, VertexId p, VertexId q);
    [[nodiscard]] bool may_hide(HalfEdgeId edge, VertexId p, VertexId q) const;

    const TriangleMesh* mesh_;
    std::span<const Key2> keys_;
    LengthOrder lengths_;
    LuneRim rim_;
    std::vector<Wedge> wedges_;  // stack
};

}  // namespace tinwright

#endif
