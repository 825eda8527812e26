#ifndef TINWRIGHT_OPTIMAL_EMPTY_TRIANGLE_SEARCH_HPP
#define TINWRIGHT_OPTIMAL_EMPTY_TRIANGLE_SEARCH_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tinwright/optimal/ear_cutting.hpp"

namespace tinwright::internal {

/// The search for an edge to insert under the weak condition. Of all improvements of a face p q r that break
/// it at q, take the one whose edge q s crosses the fewest edges: it holds the faces q p s and q s r, so the
/// triangle p r s is empty, and both p and r see s (docs/criteria.md, "The minimal candidate"). The search
/// walks outwards from p r through what both still see, nearest first. Not installed.
class EmptyTriangleSearch {
  public:
    /// As `WedgeSearch::find`. Linear in the faces in sight, plus the length of the way to each candidate of
    /// which both faces at q are better.
    template <FaceCriterion C>
    bool find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor);

    [[nodiscard]] const Refill& refill() const { return refill_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_; }

  private:
    /// The ray from a vertex through another.
    struct Ray {
        VertexId from;
        VertexId through;
    };
    /// An edge to cross next, and what bounds the view through it: vertices seen lie to the right of the left
    /// ray and to the left of the right ray.
    struct Node {
        HalfEdgeId edge;  ///< in the face on the near side; runs from the right to the left
        std::uint32_t parent;
        Ray left;
        Ray right;
    };

    template <FaceCriterion C>
    bool fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
              std::uint32_t last);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> way_;
    EarStack<Side::Left> left_;
    EarStack<Side::Right> right_;
    Refill refill_;
    std::size_t candidates_ = 0;
};

template <FaceCriterion C>
bool EmptyTriangleSearch::find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face,
                               unsigned anchor) {
    const TriangleMesh& mesh = space.mesh;
    const HalfEdgeId first = half_edge(face, next_corner(anchor));
    if (!space.may_cross(first, limit.value())) {
        return false;
    }
    const VertexId q = mesh.vertex(face, anchor);
    const VertexId r = mesh.vertex(face, next_corner(anchor));
    const VertexId p = mesh.vertex(face, previous_corner(anchor));
    nodes_.clear();
    nodes_.push_back({first, 0, {q, p}, {q, r}});
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Node node = nodes_[i];
        const HalfEdgeId t = mesh.twin(node.edge);
        const HalfEdgeId of_left = previous(t);  // from s to the left end
        const HalfEdgeId of_right = next(t);     // from the right end to s
        const VertexId s = mesh.origin(of_left);
        const bool is_right_of_left = space.orient(node.left.from, node.left.through, s) < 0;
        const bool is_left_of_right = space.orient(node.right.from, node.right.through, s) > 0;
        bool goes_left = is_right_of_left;  // through the edge between s and the left end
        bool goes_right = is_left_of_right;
        Ray left = node.left;
        Ray right = node.right;
        if (is_right_of_left && is_left_of_right) {
            ++candidates_;
            if (limit.admits(space.criterion.measure(q, p, s)) &&
                limit.admits(space.criterion.measure(q, s, r)) && fill(space, limit, face, anchor, i)) {
                return true;
            }
            goes_left = space.orient(r, s, mesh.origin(t)) > 0;
            goes_right = space.orient(p, s, mesh.origin(of_right)) < 0;
            left = {p, s};
            right = {r, s};
        }
        if (goes_left && space.may_cross(of_left, limit.value())) {
            nodes_.push_back({of_left, i, node.left, right});
        }
        if (goes_right && space.may_cross(of_right, limit.value())) {
            nodes_.push_back({of_right, i, left, node.right});
        }
    }
    return false;
}

/// Fills both sides of the edge from the anchor to the vertex behind the edge of node `last`.
template <FaceCriterion C>
bool EmptyTriangleSearch::fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
                               std::uint32_t last) {
    using Across = CavityFace::Across;
    const TriangleMesh& mesh = space.mesh;
    const VertexId q = mesh.vertex(face, anchor);
    way_.assign(1, last);
    while (way_.back() != 0) {
        way_.push_back(nodes_[way_.back()].parent);
    }
    std::reverse(way_.begin(), way_.end());

    left_.start(q, mesh.vertex(face, previous_corner(anchor)), half_edge(face, previous_corner(anchor)));
    right_.start(q, mesh.vertex(face, next_corner(anchor)), half_edge(face, anchor));
    refill_.slots.assign(1, face);
    // The faces at q are q p s and q s r: until the end, the edges q p and q r are kept.
    constexpr std::size_t kKept = 2;
    for (std::size_t i = 0; i < way_.size(); ++i) {
        const HalfEdgeId t = mesh.twin(nodes_[way_[i]].edge);
        refill_.slots.push_back(face_of(t));
        const HalfEdgeId of_left = previous(t);
        const HalfEdgeId of_right = next(t);
        const VertexId s = mesh.origin(of_left);
        if (i + 1 == way_.size()) {
            if (!left_.cut(space, limit, s, Across::rim(of_left), kKept) ||
                !right_.cut(space, limit, s, Across::rim(of_right), kKept)) {
                return false;
            }
            left_.close(s);
            right_.close(s);
        } else if (nodes_[way_[i + 1]].edge == of_right) {
            left_.cut(space, limit, s, Across::rim(of_left), kKept);
            left_.push(s);
        } else {
            right_.cut(space, limit, s, Across::rim(of_right), kKept);
            right_.push(s);
        }
    }
    refill_.join(left_, right_);
    return true;
}

}  // namespace tinwright::internal

#endif
