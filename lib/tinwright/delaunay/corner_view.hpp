#ifndef TINWRIGHT_DELAUNAY_CORNER_VIEW_HPP
#define TINWRIGHT_DELAUNAY_CORNER_VIEW_HPP

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// What a vertex sees through a triangulation in which some edges are walls.
///
/// A corner of a vertex is the room between two walls that end there, or all around it where no wall does.
/// Another vertex is seen from it if the segment to it starts into the corner and meets no wall and no vertex
/// on its way; the ends of the corner's two walls are seen too. The way leads from face to face through a
/// wedge of lines of sight, narrowed by each vertex that is met, so that in a polygon, whose faces make a
/// tree, each face is passed once: O(size of the polygon).
class CornerView {
  public:
    struct Seen {
        VertexId vertex;
        /// A half-edge that starts there, of the face through which it is seen: it tells the corner of that
        /// vertex that the line of sight arrives at.
        HalfEdgeId at;
    };

    /// Both must outlive the view.
    CornerView(const TriangleMesh& mesh, std::span<const Key2> keys) : mesh_(&mesh), keys_(keys) {}

    /// Looks from the origin of `first`, whose face is terrain, counter-clockwise from that half-edge on to
    /// the next wall, or once around. `is_wall(h)`: whether the edge of a half-edge is a wall; the terrain's
    /// border always is. `is_worth(h)`: whether to look through the edge of `h`, a half-edge whose face is on
    /// the near side; what is beyond an edge that is not worth it is left out. `is_worth(h, right, left)` is
    /// told as well between which two seen vertices the lines of sight pass there.
    template <class IsWall, class IsWorth>
    void look(HalfEdgeId first, const IsWall& is_wall, const IsWorth& is_worth);

    /// What was seen, counter-clockwise; the first is the destination of `first`.
    [[nodiscard]] std::span<const Seen> seen() const { return seen_; }
    /// Whether the view goes all around: after the last vertex comes the first again. Where a single wall
    /// ends, it is seen twice, first and last.
    [[nodiscard]] bool is_around() const { return is_around_; }

  private:
    struct Wedge {
        HalfEdgeId edge;  ///< on the near side
        VertexId right;   ///< the lines of sight pass between these two
        VertexId left;
        bool is_vertex;  ///< no wedge: `right` is to be noted as seen, at `edge`
    };

    [[nodiscard]] int side(VertexId eye, VertexId to, VertexId v) const {
        return orient2d(keys_[eye.value], keys_[to.value], keys_[v.value]);
    }
    template <class IsWall>
    [[nodiscard]] bool is_closed(HalfEdgeId h, const IsWall& is_wall) const {
        return is_wall(h) || !mesh_->is_terrain(face_of(mesh_->twin(h)));
    }
    template <class IsWall, class IsWorth>
    void look_through(HalfEdgeId edge, VertexId eye, const IsWall& is_wall, const IsWorth& is_worth);

    const TriangleMesh* mesh_;
    std::span<const Key2> keys_;
    std::vector<Seen> seen_;
    std::vector<Wedge> wedges_;  // stack
    bool is_around_ = false;
};

template <class IsWall, class IsWorth>
void CornerView::look(HalfEdgeId first, const IsWall& is_wall, const IsWorth& is_worth) {
    seen_.clear();
    const VertexId eye = mesh_->origin(first);
    seen_.push_back({mesh_->destination(first), next(first)});
    HalfEdgeId spoke = first;
    for (;;) {
        look_through(next(spoke), eye, is_wall, is_worth);
        const HalfEdgeId incoming = previous(spoke);  // the face's other edge at the eye
        const HalfEdgeId following = mesh_->twin(incoming);
        const bool is_end = is_closed(incoming, is_wall);
        is_around_ = following == first && !is_end;
        if (is_around_) {
            return;
        }
        seen_.push_back({mesh_->origin(incoming), incoming});
        if (is_end) {
            return;
        }
        spoke = following;
    }
}

/// Depth first, so that vertices come in the order of their directions.
template <class IsWall, class IsWorth>
void CornerView::look_through(HalfEdgeId edge, VertexId eye, const IsWall& is_wall, const IsWorth& is_worth) {
    wedges_.assign(1, {edge, mesh_->origin(edge), mesh_->destination(edge), false});
    while (!wedges_.empty()) {
        const Wedge wedge = wedges_.back();
        wedges_.pop_back();
        if (wedge.is_vertex) {
            seen_.push_back({wedge.right, wedge.edge});
            continue;
        }
        if (is_closed(wedge.edge, is_wall)) {
            continue;
        }
        if constexpr (std::is_invocable_v<const IsWorth&, HalfEdgeId, VertexId, VertexId>) {
            if (!is_worth(wedge.edge, wedge.right, wedge.left)) {
                continue;
            }
        } else if (!is_worth(wedge.edge)) {
            continue;
        }
        const HalfEdgeId behind = mesh_->twin(wedge.edge);
        const HalfEdgeId to_the_left = previous(behind);
        const VertexId apex = mesh_->origin(to_the_left);
        const bool is_past_right = side(eye, wedge.right, apex) > 0;
        const bool is_before_left = side(eye, wedge.left, apex) < 0;
        if (is_before_left) {
            wedges_.push_back({to_the_left, is_past_right ? apex : wedge.right, wedge.left, false});
        }
        if (is_past_right && is_before_left) {
            wedges_.push_back({to_the_left, apex, apex, true});
        }
        if (is_past_right) {
            wedges_.push_back({next(behind), wedge.right, is_before_left ? apex : wedge.left, false});
        }
    }
}

}  // namespace tinwright

#endif
