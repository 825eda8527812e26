#include "tinwright/delaunay/octant_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

constexpr std::size_t kOctants = 8;
/// Only in these is a neighbour looked for: the other end of an edge finds it in the opposite octant.
constexpr int kOctantsLookedAt = 4;
/// More than rounding can take from a reach, of a few operations.
constexpr double kMargin = 1 + 0x1p-40;

// Of the norm, the greatest Euclidean length of what has length 1, squared. Up to p = 2 that is along an
// axis, from there on along a diagonal.
double find_widest(Norm norm) {
    if (norm.is_maximum()) {
        return 2;
    }
    return norm.power() == 1 ? 1 : std::exp2(1 - 2.0 / norm.power());
}

// The length of (1, 1) less that of (1, 0).
double find_slant(Norm norm) { return norm.is_maximum() ? 0 : std::exp2(1.0 / norm.power()) - 1; }

}  // namespace

OctantSearch::OctantSearch(const TriangleMesh& mesh, std::span<const Key2> keys, Norm norm, LuneRim rim)
    : mesh_(&mesh),
      keys_(keys),
      lengths_(keys, norm),
      rim_(rim),
      widest_(find_widest(norm) * kMargin),
      slant_(find_slant(norm)),
      view_(mesh, keys) {}

void OctantSearch::find(VertexId p, HalfEdgeId start, std::vector<GraphEdge>& edges) {
    p_ = p;
    eye_ = keys_[p.value];
    found_.clear();
    is_around_ = true;
    HalfEdgeId h = start;
    do {
        if (starts_corner(h)) {
            is_around_ = false;
            find_in_corner(h);
        }
        h = next_around(*mesh_, h);
    } while (h != start);
    if (is_around_ && mesh_->is_terrain(face_of(start))) {
        find_in_corner(start);
    }
    std::sort(found_.begin(), found_.end(),
              [](const Candidate& a, const Candidate& b) { return a.vertex < b.vertex; });
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const bool is_first = i == 0 || found_[i - 1].vertex != found_[i].vertex;
        const bool is_again = i + 1 < found_.size() && found_[i + 1].vertex == found_[i].vertex;
        if (is_first && (!found_[i].is_wall_between || is_again)) {
            edges.push_back({std::min(p, found_[i].vertex), std::max(p, found_[i].vertex)});
        }
    }
}

bool OctantSearch::starts_corner(HalfEdgeId h) const {
    return mesh_->is_terrain(face_of(h)) &&
           (mesh_->is_constrained(h) || !mesh_->is_terrain(face_of(mesh_->twin(h))));
}

// What is nearest in an octant is seen first, and most candidates are blocked by that already.
void OctantSearch::find_in_corner(HalfEdgeId first) {
    first_ = keys_[mesh_->destination(first).value];
    first_octant_ = octant(eye_, first_);
    look_for_nearest(first);
    choose_candidates();
    drop_blocked();
    if (!candidates_.empty()) {
        look_as_far_as_candidates(first);
        drop_blocked();
        found_.insert(found_.end(), candidates_.begin(), candidates_.end());
    }
}

void OctantSearch::look_for_nearest(HalfEdgeId first) {
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
        const bool is_looked_at =
            (static_cast<std::size_t>(first_octant_) + i) % kOctants < std::size_t{kOctantsLookedAt};
        nearest_[i] = is_looked_at ? std::numeric_limits<double>::infinity() : 0;
    }
    view_.look(
        first, [&](HalfEdgeId h) { return mesh_->is_constrained(h); },
        [&](HalfEdgeId edge, VertexId right, VertexId left) {
            return may_hide(edge, squared_reach_between(keys_[right.value], keys_[left.value]));
        });
}

void OctantSearch::look_as_far_as_candidates(HalfEdgeId first) {
    double reach = 0;
    for (const Candidate& candidate : candidates_) {
        reach = std::max(reach, squared_reach(keys_[candidate.vertex.value]));
    }
    view_.look(
        first, [&](HalfEdgeId h) { return mesh_->is_constrained(h); },
        [&](HalfEdgeId edge) { return may_hide(edge, reach); });
    const auto seen = view_.seen();
    for (Candidate& candidate : candidates_) {
        candidate.index = seen.size() - 1;
        if (!candidate.is_last) {
            candidate.index = 0;
            while (seen[candidate.index].vertex != candidate.vertex) {
                ++candidate.index;
            }
        }
    }
}

// Octants follow each other counter-clockwise; the first may come again as the last. Where the view goes all
// around that makes a candidate too many at most.
void OctantSearch::choose_candidates() {
    candidates_.clear();
    const auto seen = view_.seen();
    std::size_t begin = 0;  // of the candidates in this octant
    int last = -1;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const VertexId v = seen[i].vertex;
        const int here = octant(eye_, keys_[v.value]);
        if (here >= kOctantsLookedAt) {
            last = here;
            continue;
        }
        if (here != last) {
            last = here;
            begin = candidates_.size();
            candidates_.push_back(candidate(i));
            continue;
        }
        const VertexId best = candidates_[begin].vertex;
        const bool is_equal = rim_ == LuneRim::Outside && lengths_.compare(p_, v, p_, best) == 0;
        if (!is_equal && lengths_.is_shorter(p_, v, p_, best)) {
            candidates_.resize(begin);
        }
        if (is_equal || candidates_.size() == begin) {
            candidates_.push_back(candidate(i));
        }
    }
}

OctantSearch::Candidate OctantSearch::candidate(std::size_t index) const {
    const auto seen = view_.seen();
    const bool is_last = !is_around_ && index + 1 == seen.size();
    Candidate made{index, seen[index].vertex, is_last, false};
    if (!is_around_ && (index == 0 || is_last)) {
        const HalfEdgeId wall = is_last ? seen[index].at : previous(seen[index].at);
        made.is_wall_between = mesh_->is_terrain(face_of(mesh_->twin(wall)));
    }
    return made;
}

void OctantSearch::drop_blocked() {
    std::erase_if(candidates_, [&](const Candidate& candidate) { return is_blocked(candidate); });
}

bool OctantSearch::is_blocked(const Candidate& q) const {
    const auto seen = view_.seen();
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const VertexId x = seen[i].vertex;
        if (x == q.vertex || !(rim_ == LuneRim::Ordered ? lengths_.is_in_lune(x, p_, q.vertex)
                                                        : lengths_.is_in_open_lune(x, p_, q.vertex))) {
            continue;
        }
        // Between directions of more than 180 degrees there is a wall on the other, narrow side.
        const int turn = orient2d(eye_, keys_[q.vertex.value], keys_[x.value]);
        if (is_around_ || (i > q.index ? turn > 0 : turn < 0)) {
            return true;
        }
    }
    return false;
}

// Number of the octant in which a key is seen, from that of the corner's first vertex on. All around there
// are 8; otherwise what comes last may be in the first's octant again, with a wall between them.
std::size_t OctantSearch::slot(Key2 key) const {
    const auto turns = static_cast<std::size_t>(octant(eye_, key) - first_octant_ + 8) % kOctants;
    return turns == 0 && !is_around_ && orient2d(eye_, first_, key) < 0 ? kOctants : turns;
}

// The greatest reach of the octants between two directions.
double OctantSearch::squared_reach_between(Key2 right, Key2 left) {
    const std::size_t count = is_around_ ? kOctants : kOctants + 1;
    const std::size_t begin = slot(right);
    std::size_t end = slot(left);
    nearest_[begin] = std::min(nearest_[begin], squared_reach(right));
    if (end < begin && !is_around_) {
        end = kOctants;  // the far side of the only wall
    }
    nearest_[end] = std::min(nearest_[end], squared_reach(left));
    double reach = nearest_[end];
    for (std::size_t i = begin; i != end; i = i + 1 == count ? 0 : i + 1) {
        reach = std::max(reach, nearest_[i]);
    }
    return reach;
}

// Square of the greatest Euclidean distance from p of what is not farther than v, or more. The length of (1,
// t) is convex in t, so for t from 0 to 1 it is not above its chord.
double OctantSearch::squared_reach(Key2 key) const {
    const double x = std::abs(key.x - eye_.x);
    const double y = std::abs(key.y - eye_.y);
    const double length = std::max(x, y) + std::min(x, y) * slant_;
    return length * length * widest_;
}

// Whether a vertex within that distance may be seen through an edge: the argument is at
// HalfLuneSearch::may_hide.
bool OctantSearch::may_hide(HalfEdgeId edge, double squared_reach) const {
    return squared_distance(eye_, keys_[mesh_->origin(edge).value]) < squared_reach ||
           squared_distance(eye_, keys_[mesh_->destination(edge).value]) < squared_reach;
}

}  // namespace tinwright
