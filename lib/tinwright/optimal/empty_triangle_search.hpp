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
    /// As `WedgeSearch::find`. Linear in the faces in sight, plus the length of the way to each candidate of
    /// which both faces at q are better.
    bool find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
              unsigned horizon = kNoHorizon);

    [[nodiscard]] const Refill& refill() const { return refill_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_; }

    /// How deep the last search that failed looked, 1 for the face next to the face to improve; more than the
    /// horizon if it came that far.
    [[nodiscard]] unsigned reach() const { return reach_; }
    /// Faces looked at and ears cut, by all searches.
    [[nodiscard]] std::size_t visits() const { return visits_; }

  private:
    /// An edge to cross next, and what bounds the view through it: the vertices in sight lie to the right of
    /// a ray from p and to the left of a ray from r, given by their directions in keys.
    struct Node {
        HalfEdgeId edge{};  ///< in the face on the near side; runs from the right to the left
        std::uint32_t parent = 0;
        std::uint32_t polygons = 0;  ///< index of its polygons, or `kNone` while nobody has asked for them
        Direction left;
        Direction right;
        typename C::Cut::State state{};
    };

    /// The chains on both sides of the way to a node.
    struct Polygons {
        EarCutter::Chain left;
        EarCutter::Chain right;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    /// The faces at q are q p s and q s r: until the end, the edges q p and q r are kept.
    static constexpr std::uint32_t kKept = 2;

    bool fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, std::uint32_t last);
    Polygons polygons_of(const SearchSpace<C>& space, MeasureLimit& limit, std::uint32_t node);

    std::vector<Node> nodes_;
    std::vector<Polygons> polygons_;
    std::vector<std::uint32_t> way_;
    EarCutter cutter_;
    Refill refill_;
    std::size_t candidates_ = 0;
    std::size_t visits_ = 0;
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
    const auto is_better = [&](VertexId a, VertexId b, VertexId c) {
        return limit.admits(space.criterion.measure(a, b, c));
    };
    const typename C::Cut cut(space.criterion, q, p, r, measure);
    nodes_.resize(std::max<std::size_t>(nodes_.size(), kLeastNodes));
    nodes_[0] = {first, 0, 0, direction(at_p, at_q), direction(at_r, at_q), cut.start()};
    cutter_.clear();
    polygons_.clear();
    polygons_.push_back({cutter_.start(q, p, half_edge(face, previous_corner(anchor))),
                         cutter_.start(q, r, half_edge(face, anchor))});
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
            if (is_better(q, p, s) && is_better(q, s, r) && fill(space, limit, face, i)) {
                visits_ += count + cutter_.ear_count();
                return true;
            }
            left = from_p;
            right = from_r;
            const Key2 left_end = space.keys[beyond[corner_of(t)].value];
            const Key2 right_end = space.keys[beyond[next_corner(corner_of(t))].value];
            goes_left = turn(right, direction(left_end, at_r)) > 0;
            goes_right = turn(left, direction(right_end, at_p)) < 0;
        }
        const bool is_to_cut = reach_ % C::Cut::kLevels == 0;
        const auto open = [&](HalfEdgeId edge, VertexId a, VertexId b, Direction to_left,
                              Direction to_right) {
            nodes_[count] = {edge, i, kNone, to_left, to_right, node.state};
            const bool is_open = reach_ < horizon && space.may_cross(edge, measure) &&
                                 (!is_to_cut || cut.cross(nodes_[count].state, a, b));
            count += is_open ? 1 : 0;
        };
        if (goes_left) {  // from s to the left end
            open(previous(t), s, beyond[corner_of(t)], node.left, right);
        }
        if (goes_right) {  // from the right end to s
            open(next(t), beyond[next_corner(corner_of(t))], s, left, node.right);
        }
        if (i + 1 == level_end) {
            ++reach_;  // one more than was walked: it was looked whether to go there
            level_end = count;
        }
    }
    visits_ += count + cutter_.ear_count();
    return false;
}

/// The polygons on both sides of the way to a node, made from those of the nearest node on it that has some.
template <WeakCriterion C>
typename EmptyTriangleSearch<C>::Polygons EmptyTriangleSearch<C>::polygons_of(const SearchSpace<C>& space,
                                                                              MeasureLimit& limit,
                                                                              std::uint32_t node) {
    using Across = CavityFace::Across;
    way_.clear();
    for (; nodes_[node].polygons == kNone; node = nodes_[node].parent) {
        way_.push_back(node);
    }
    Polygons polygons = polygons_[nodes_[node].polygons];
    for (; !way_.empty(); way_.pop_back()) {
        Node& child = nodes_[way_.back()];
        const HalfEdgeId t = space.mesh.twin(nodes_[child.parent].edge);
        const HalfEdgeId of_left = previous(t);
        const VertexId s = space.mesh.origin(of_left);
        if (child.edge == of_left) {
            polygons.right.tip_edge = Across::rim(next(t));
            cutter_.cut<Side::Right>(space, limit, polygons.right, s, kKept);
            cutter_.push(polygons.right, s);
        } else {
            polygons.left.tip_edge = Across::rim(of_left);
            cutter_.cut<Side::Left>(space, limit, polygons.left, s, kKept);
            cutter_.push(polygons.left, s);
        }
        child.polygons = static_cast<std::uint32_t>(polygons_.size());
        polygons_.push_back(polygons);
    }
    return polygons;
}

/// Fills both sides of the edge from the anchor to the vertex behind the edge of node `last`.
template <WeakCriterion C>
bool EmptyTriangleSearch<C>::fill(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face,
                                  std::uint32_t last) {
    using Across = CavityFace::Across;
    const TriangleMesh& mesh = space.mesh;
    auto [left, right] = polygons_of(space, limit, last);
    const HalfEdgeId t = mesh.twin(nodes_[last].edge);
    const VertexId s = mesh.origin(previous(t));
    left.tip_edge = Across::rim(previous(t));
    right.tip_edge = Across::rim(next(t));
    if (!cutter_.cut<Side::Left>(space, limit, left, s, kKept) ||
        !cutter_.cut<Side::Right>(space, limit, right, s, kKept)) {
        return false;
    }
    cutter_.add_ear<Side::Left>(left, s);
    cutter_.add_ear<Side::Right>(right, s);
    cutter_.join(left, right, refill_.faces);
    refill_.slots.assign(1, face);
    for (std::uint32_t node = last;; node = nodes_[node].parent) {
        refill_.slots.push_back(face_of(mesh.twin(nodes_[node].edge)));
        if (node == 0) {
            return true;
        }
    }
}

}  // namespace tinwright::internal

#endif
