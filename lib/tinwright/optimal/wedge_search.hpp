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
    /// horizon if it came that far.
    [[nodiscard]] unsigned reach() const { return static_cast<unsigned>(refill_.slots.size()); }

    /// Faces looked at, by all searches.
    [[nodiscard]] std::size_t visits() const { return visits_; }

  private:
    enum class Outcome : std::uint8_t { Filled, LeftStuck, RightStuck, BothStuck };

    template <FaceCriterion C>
    Outcome cut_both(const SearchSpace<C>& space, MeasureLimit& limit, EarCutter::Chain& left,
                     EarCutter::Chain& right, VertexId s);

    EarCutter cutter_;
    Refill refill_;
    std::size_t candidates_ = 0;
    std::size_t visits_ = 0;
};

/// Cuts ears on both sides in turn, so that what one side loses when the other gets stuck is no more than
/// that one keeps [tan1993, Sec. 3.4.5]. A stuck side lets the other go on for about as long again: mostly it
/// gets stuck too, and then the wedge is empty.
template <FaceCriterion C>
WedgeSearch::Outcome WedgeSearch::cut_both(const SearchSpace<C>& space, MeasureLimit& limit,
                                           EarCutter::Chain& left, EarCutter::Chain& right, VertexId s) {
    constexpr unsigned kLeastExtra = 8;
    bool is_left_stuck = false;
    bool is_right_stuck = false;
    unsigned cuts = 0;
    while (!is_left_stuck && !is_right_stuck && (left.size > 1 || right.size > 1)) {
        ++cuts;
        is_left_stuck = left.size > 1 && !cutter_.cut_one<Side::Left>(space, limit, left, s);
        is_right_stuck = right.size > 1 && !cutter_.cut_one<Side::Right>(space, limit, right, s);
    }
    if (!is_left_stuck && !is_right_stuck) {
        return Outcome::Filled;
    }
    for (unsigned extra = cuts + kLeastExtra; extra > 0 && is_left_stuck != is_right_stuck; --extra) {
        if (is_left_stuck ? right.size == 1 : left.size == 1) {
            break;
        }
        if (is_left_stuck) {
            is_right_stuck = !cutter_.cut_one<Side::Right>(space, limit, right, s);
        } else {
            is_left_stuck = !cutter_.cut_one<Side::Left>(space, limit, left, s);
        }
    }
    if (is_left_stuck && is_right_stuck) {
        return Outcome::BothStuck;
    }
    return is_left_stuck ? Outcome::LeftStuck : Outcome::RightStuck;
}

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
    cutter_.clear();
    EarCutter::Chain left = cutter_.start(q, wedge_left, half_edge(face, previous_corner(anchor)));
    EarCutter::Chain right = cutter_.start(q, wedge_right, half_edge(face, anchor));
    do {
        const HalfEdgeId t = mesh.twin(h);
        refill_.slots.push_back(face_of(t));
        const HalfEdgeId of_left = previous(t);  // between s and the last vertex on the left
        const HalfEdgeId of_right = next(t);
        const VertexId s = mesh.origin(of_left);
        const bool is_left_outside = space.orient(q, wedge_left, s) >= 0;
        const bool is_right_outside = !is_left_outside && space.orient(q, wedge_right, s) <= 0;
        left.tip_edge = Across::rim(of_left);
        right.tip_edge = Across::rim(of_right);
        bool goes_left = is_left_outside;
        ++visits_;
        if (is_left_outside) {
            cutter_.cut<Side::Left>(space, limit, left, s, 1);
        } else if (is_right_outside) {
            cutter_.cut<Side::Right>(space, limit, right, s, 1);
        } else {
            ++candidates_;
            const EarCutter::Chain left_before = left;
            const EarCutter::Chain right_before = right;
            switch (cut_both(space, limit, left, right, s)) {
                case Outcome::Filled:
                    cutter_.join(left, right, refill_.faces);
                    return true;
                case Outcome::BothStuck:
                    return false;  // nothing is left of the wedge
                case Outcome::LeftStuck:
                    goes_left = true;
                    wedge_left = s;
                    right = right_before;
                    break;
                case Outcome::RightStuck:
                    wedge_right = s;
                    left = left_before;
                    break;
            }
        }
        cutter_.push(goes_left ? left : right, s);
        h = goes_left ? of_right : of_left;
    } while (reach() <= horizon && space.may_cross(h, limit.value()));
    return false;
}

}  // namespace tinwright::internal

#endif
