#ifndef TINWRIGHT_OPTIMAL_WEDGE_SEARCH_HPP
#define TINWRIGHT_OPTIMAL_WEDGE_SEARCH_HPP

#include <cstddef>

#include "tinwright/optimal/ear_cutting.hpp"

namespace tinwright::internal {

/// The search for an edge to insert under the strong condition: walks away from the face, trying each vertex
/// met within a wedge that every failure narrows [tan1993, Sec. 3.4.4]. Not installed.
class WedgeSearch {
  public:
    /// Seeks an edge at corner `anchor` of `face` whose insertion replaces faces no worse than it by better
    /// ones, looking at most `horizon` faces deep. If there is one, `refill()` is it. O(faces crossed).
    template <FaceCriterion C>
    bool find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
              unsigned horizon = kNoHorizon);

    [[nodiscard]] const Refill& refill() const { return refill_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_; }
    /// How deep the last search that failed looked, 1 for the face next to the face to improve; more than the
    /// horizon if it wanted to look deeper.
    [[nodiscard]] unsigned reach() const { return static_cast<unsigned>(refill_.slots.size()); }

  private:
    EarStack<Side::Left> left_;
    EarStack<Side::Right> right_;
    Refill refill_;
    std::size_t candidates_ = 0;
};

template <FaceCriterion C>
bool WedgeSearch::find(const SearchSpace<C>& space, MeasureLimit& limit, FaceId face, unsigned anchor,
                       unsigned horizon) {
    using Across = CavityFace::Across;
    // q: the anchor; s: the vertex being tried; `wedge_left`, `wedge_right`: the rays from q through them
    // bound what is left to try. `h` runs from the last vertex on the right to the last on the left.
    const TriangleMesh& mesh = space.mesh;
    refill_.slots.assign(1, face);
    HalfEdgeId h = half_edge(face, next_corner(anchor));
    if (!space.may_cross(h, limit.value())) {
        return false;
    }
    const VertexId q = mesh.vertex(face, anchor);
    VertexId wedge_right = mesh.origin(h);
    VertexId wedge_left = mesh.vertex(face, previous_corner(anchor));
    left_.start(q, wedge_left, half_edge(face, previous_corner(anchor)));
    right_.start(q, wedge_right, half_edge(face, anchor));
    do {
        const HalfEdgeId t = mesh.twin(h);
        refill_.slots.push_back(face_of(t));
        const HalfEdgeId of_left = previous(t);  // between s and the last vertex on the left
        const HalfEdgeId of_right = next(t);
        const VertexId s = mesh.origin(of_left);
        const bool is_left_outside = space.orient(q, wedge_left, s) >= 0;
        const bool is_right_outside = !is_left_outside && space.orient(q, wedge_right, s) <= 0;
        bool goes_left = is_left_outside;
        if (is_left_outside) {
            left_.cut(space, limit, s, Across::rim(of_left), 1);
        } else if (is_right_outside) {
            right_.cut(space, limit, s, Across::rim(of_right), 1);
        } else {
            ++candidates_;
            const auto left_mark = left_.mark();
            const auto right_mark = right_.mark();
            const bool is_left_filled = left_.cut(space, limit, s, Across::rim(of_left), 1);
            const bool is_right_filled = right_.cut(space, limit, s, Across::rim(of_right), 1);
            if (is_left_filled && is_right_filled) {
                refill_.join(left_, right_);
                return true;
            }
            if (!is_left_filled && !is_right_filled) {
                return false;  // nothing is left of the wedge
            }
            goes_left = !is_left_filled;
            if (goes_left) {
                wedge_left = s;
                right_.restore(right_mark);
            } else {
                wedge_right = s;
                left_.restore(left_mark);
            }
        }
        if (goes_left) {
            left_.push(s);
            h = of_right;
        } else {
            right_.push(s);
            h = of_left;
        }
    } while (reach() <= horizon && space.may_cross(h, limit.value()));
    return false;
}

}  // namespace tinwright::internal

#endif
