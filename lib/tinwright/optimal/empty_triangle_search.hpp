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
/// walks outwards from p r through what both still see, nearest first, as far as the criterion's cut leaves
/// hope. Not installed.
template <WeakCriterion C>
class EmptyTriangleSearch {
  public:
    /// As `WedgeSearch::find`. Linear in the faces in sight, plus the
    /// length of the way to each candidate of which both faces at q are better.
    bool find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
              unsigned horizon = kNoHorizon);

    [[nodiscard]] const Refill& refill() const { return refill_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_; }

    /// How deep the last search that failed looked, 1 for the face next to the face to improve; more than the
    /// horizon if it wanted to look deeper.
    [[nodiscard]] unsigned reach() const { return reach_; }

  private:
    /// An edge to cross next, and what bounds the view through it: the vertices in sight lie to the right of
    /// a ray from p and to the left of a ray from r, given by their directions in keys.
    struct Node {
        HalfEdgeId edge;  ///< in the face on the near side; runs from the right to the left
        std::uint32_t parent;
        Direction left;
        Direction right;
        typename C::Cut::State state;
    };

    bool fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
              std::uint32_t last);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> way_;
    EarStack<Side::Left> left_;
    EarStack<Side::Right> right_;
    Refill refill_;
    std::size_t candidates_ = 0;
    unsigned reach_ = 0;
};

template <WeakCriterion C>
bool EmptyTriangleSearch<C>::find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face,
                                  unsigned anchor, unsigned horizon) {
    const TriangleMesh& mesh = space.mesh;
    constexpr std::size_t kLeastNodes = 64;
    const HalfEdgeId first = half_edge(face, next_corner(anchor));
    reach_ = 1;
    if (!space.may_cross(first, limit.value())) {
        return false;
    }
    const VertexId q = mesh.vertex(face, anchor);
    const VertexId r = mesh.vertex(face, next_corner(anchor));
    const VertexId p = mesh.vertex(face, previous_corner(anchor));
    const Key2 at_q = space.keys[q.value];
    const Key2 at_p = space.keys[p.value];
    const Key2 at_r = space.keys[r.value];
    const double measure = limit.value();
    const typename C::Cut cut(space.criterion, q, p, r, measure);
    nodes_.resize(std::max<std::size_t>(nodes_.size(), kLeastNodes));
    nodes_[0] = {first, 0, direction(at_p, at_q), direction(at_r, at_q), cut.start()};
    std::uint32_t count = 1;
    std::uint32_t level_end = 1;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (count + 2 > nodes_.size()) {
            nodes_.resize(2 * nodes_.size());
        }
        const Node& node = nodes_[i];
        const HalfEdgeId t = mesh.twin(node.edge);
        const auto& beyond = mesh.face(face_of(t)).vertex;
        const VertexId s = beyond[previous_corner(corner_of(t))];
        const Key2 at_s = space.keys[s.value];
        const Direction from_p = direction(at_s, at_p);
        const Direction from_r = direction(at_s, at_r);
        Direction left = node.left;
        Direction right = node.right;
        bool goes_left = turn(left, from_p) < 0;  // to the right of the left ray: through s and the left end
        bool goes_right = turn(right, from_r) > 0;
        if (goes_left && goes_right) {
            ++candidates_;
            if (limit.admits(space.criterion.measure(q, p, s)) &&
                limit.admits(space.criterion.measure(q, s, r)) && fill(space, limit, face, anchor, i)) {
                return true;
            }
            left = from_p;
            right = from_r;
            const Key2 left_end = space.keys[beyond[corner_of(t)].value];
            const Key2 right_end = space.keys[beyond[next_corner(corner_of(t))].value];
            goes_left = turn(right, direction(left_end, at_r)) > 0;
            goes_right = turn(left, direction(right_end, at_p)) < 0;
        }
        const bool is_within = reach_ < horizon;
        const bool is_to_cut = reach_ % C::Cut::kLevels == 0;
        // Runs from s to the left end, and from the right end to s.
        const HalfEdgeId of_left = previous(t);
        const HalfEdgeId of_right = next(t);
        if (goes_left && is_within && space.may_cross(of_left, measure)) {
            nodes_[count] = {of_left, i, node.left, right, node.state};
            count += !is_to_cut || cut.cross(nodes_[count].state, s, beyond[corner_of(t)]) ? 1 : 0;
        }
        if (goes_right && is_within && space.may_cross(of_right, measure)) {
            nodes_[count] = {of_right, i, left, node.right, node.state};
            count +=
                !is_to_cut || cut.cross(nodes_[count].state, beyond[next_corner(corner_of(t))], s) ? 1 : 0;
        }
        if (i + 1 == level_end) {
            ++reach_;  // one more than was walked: it was looked whether to go there
            level_end = count;
        }
    }
    return false;
}

/// Fills both sides of the edge from the anchor to the vertex behind the edge of node `last`.
template <WeakCriterion C>
bool EmptyTriangleSearch<C>::fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face,
                                  unsigned anchor, std::uint32_t last) {
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
