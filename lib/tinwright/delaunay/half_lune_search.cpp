#include "tinwright/delaunay/half_lune_search.hpp"

#include <algorithm>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

// It can only be the longest edge.
unsigned HalfLuneSearch::find_occupied(FaceId f) const {
    const auto& v = mesh_->face(f).vertex;
    const unsigned of_two = lengths_.is_shorter(v[0], v[1], v[1], v[2]) ? 1 : 0;
    const bool is_third = lengths_.is_shorter(v[of_two], v[of_two + 1], v[2], v[0]);
    const unsigned longest = is_third ? 2 : of_two;
    if (rim_ == LuneRim::Ordered) {
        return longest;
    }
    const unsigned end = next_corner(longest);
    return lengths_.is_in_open_lune(v[previous_corner(longest)], v[longest], v[end]) ? longest : 3;
}

// Turning about both ends by turns, done when one of them is, costs the lesser degree for each edge. Those
// sum to a multiple of the number of edges in a plane graph, whereas a hub's degree squared might be spent on
// its edges.
bool HalfLuneSearch::is_empty(HalfEdgeId h) {
    if (is_lune_in_circle(h)) {
        return true;
    }
    const VertexId p = mesh_->origin(h);
    const VertexId q = mesh_->destination(h);
    Turn about_p{p, q, h, true};
    Turn about_q{q, p, next(h), false};
    for (;;) {
        for (Turn* turn : {&about_p, &about_q}) {
            const Found found = look_on(*turn);
            if (found != Found::NothingYet) {
                return found == Found::Nothing;
            }
        }
    }
}

// Looks behind the face, then enters the next one.
HalfLuneSearch::Found HalfLuneSearch::look_on(Turn& turn) {
    if (!is_empty_behind(next(turn.corner), turn.eye, turn.other)) {
        return Found::Vertex;
    }
    const auto spoke = [&] { return turn.is_left ? previous(turn.corner) : turn.corner; };
    const auto end = [&] { return mesh_->origin(turn.is_left ? spoke() : next(spoke())); };
    if (is_closed(spoke()) || is_beyond_lune(turn.eye, turn.other, end())) {
        return Found::Nothing;
    }
    const HalfEdgeId behind = mesh_->twin(spoke());
    turn.corner = turn.is_left ? behind : next(behind);
    return is_in_lune(end(), turn.eye, turn.other) ? Found::Vertex : Found::NothingYet;
}

// The edge p q is seen from its half-lune at 60 degrees or more, and at less from what is outside the circle
// of the face p q c, if it is from c: then the half-lune is inside. A vertex in it would be seen from within
// the face: one in the lune that sees p and q with no other vertex between. The cosine of 60 degrees squared
// is 0.25; rounding cannot make 0.26 of it.
bool HalfLuneSearch::is_lune_in_circle(HalfEdgeId h) const {
    const Key2 p = keys_[mesh_->origin(h).value];
    const Key2 q = keys_[mesh_->destination(h).value];
    const Key2 c = keys_[mesh_->origin(previous(h)).value];
    const double product = (p.x - c.x) * (q.x - c.x) + (p.y - c.y) * (q.y - c.y);
    return product > 0 && product * product > 0.26 * squared_distance(c, p) * squared_distance(c, q);
}

// From p, what is nearer than q and at least as near to q is within 60 degrees of the direction to q. The
// cosine of 60 degrees squared is 0.25; rounding cannot make 0.24 of it. A face that starts within 60 degrees
// ends within 240, so the turn cannot miss what lies beyond.
bool HalfLuneSearch::is_beyond_lune(VertexId p, VertexId q, VertexId spoke) const {
    const Key2 eye = keys_[p.value];
    const Key2 to = keys_[q.value];
    const Key2 key = keys_[spoke.value];
    const double product = (to.x - eye.x) * (key.x - eye.x) + (to.y - eye.y) * (key.y - eye.y);
    return product <= 0 || product * product < 0.24 * squared_distance(eye, to) * squared_distance(eye, key);
}

// What is seen through an edge a b from p, and not farther than p q, is not seen if neither a nor b is nearer
// than q: let x be it, so that |p x| <= |p a| and |p x| <= |p b|. In the triangles p x a and p x b the angles
// at x are then at least 90 degrees less half of those at p; so the angles of a b at p and at x sum to more
// than 180 degrees, and p or x is strictly within the circle of the face before a b. Both are seen from
// within that face, which is constrained Delaunay.
//
// Nor is anything in the lune behind an edge that is farther from the line p q than the lune is wide, 0.8661
// times its length to each side, since lines of sight lead away from that line.
bool HalfLuneSearch::may_hide(HalfEdgeId edge, VertexId p, VertexId q) const {
    const VertexId a = mesh_->origin(edge);
    const VertexId b = mesh_->destination(edge);
    if (lengths_.compare(p, a, p, q) >= 0 && lengths_.compare(p, b, p, q) >= 0) {
        return false;
    }
    const Key2 eye = keys_[p.value];
    const Key2 to = keys_[q.value];
    const auto aside = [&](VertexId v) {
        const Key2 key = keys_[v.value];
        return (to.x - eye.x) * (key.y - eye.y) - (to.y - eye.y) * (key.x - eye.x);
    };
    const double width = 0.867 * squared_distance(eye, to);
    const auto [least, greatest] = std::minmax({aside(a), aside(b)});
    return least <= width && greatest >= -width;
}

bool HalfLuneSearch::is_empty_behind(HalfEdgeId far, VertexId p, VertexId q) {
    const auto side = [&](VertexId to, VertexId v) {
        return orient2d(keys_[p.value], keys_[to.value], keys_[v.value]);
    };
    wedges_.assign(1, {far, mesh_->origin(far), mesh_->destination(far)});
    while (!wedges_.empty()) {
        const Wedge wedge = wedges_.back();
        wedges_.pop_back();
        if (is_closed(wedge.edge) || !may_hide(wedge.edge, p, q)) {
            continue;
        }
        const HalfEdgeId behind = mesh_->twin(wedge.edge);
        const VertexId apex = mesh_->origin(previous(behind));
        const bool is_past_right = side(wedge.right, apex) > 0;
        const bool is_before_left = side(wedge.left, apex) < 0;
        if (is_past_right && is_before_left && is_in_lune(apex, p, q)) {
            return false;
        }
        if (is_past_right) {
            wedges_.push_back({next(behind), wedge.right, is_before_left ? apex : wedge.left});
        }
        if (is_before_left) {
            wedges_.push_back({previous(behind), is_past_right ? apex : wedge.right, wedge.left});
        }
    }
    return true;
}

}  // namespace tinwright
