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
/// Sine of the least angle at which lines are made to meet, and the share of a distance by which vertices
/// must be nearer for that to count there.
constexpr double kThin = 0x1p-20;
constexpr double kSlack = 0x1p-20;
/// Looking through so many edges costs less than to find out that some are not worth it.
constexpr int kFewEdges = 64;
/// How far a neighbour may be that blocks what is in an octant; at 3 it might be 180 degrees away.
constexpr std::size_t kOctantsAway = 2;

// Of the norm, the greatest Euclidean length of what has length 1, squared. Up to p = 2 that is along an
// axis, from there on along a diagonal.
double find_widest(Norm norm) {
    if (norm.is_maximum()) {
        return 2;
    }
    return norm.power() == 1 ? 1 : std::exp2(1 - 2.0 / norm.power());
}

double cross(Key2 a, Key2 b) { return a.x * b.y - a.y * b.x; }
double square(Key2 a) { return a.x * a.x + a.y * a.y; }

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
    looked_ = 0;
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
        const bool is_looked_at =
            (static_cast<std::size_t>(first_octant_) + i) % kOctants < std::size_t{kOctantsLookedAt};
        nearest_[i] = is_looked_at ? std::numeric_limits<double>::infinity() : 0;
        blockers_[i] = {{}, std::numeric_limits<double>::infinity()};
    }
    // The corner's edges first, so that few octants are looked into to their end.
    for (HalfEdgeId h = first;;) {
        note_neighbor(keys_[mesh_->destination(h).value]);
        const HalfEdgeId incoming = previous(h);
        h = mesh_->twin(incoming);
        if (h == first || mesh_->is_constrained(h) || !mesh_->is_terrain(face_of(h))) {
            break;
        }
    }
    view_.look(
        first, [&](HalfEdgeId h) { return mesh_->is_constrained(h); },
        [&](HalfEdgeId edge, VertexId right, VertexId left) {
            return is_worth(edge, keys_[right.value], keys_[left.value]);
        });
}

void OctantSearch::look_as_far_as_candidates(HalfEdgeId first) {
    lunes_.clear();
    for (const Candidate& candidate : candidates_) {
        lunes_.push_back(lune_of(keys_[candidate.vertex.value]));
    }
    view_.look(
        first, [&](HalfEdgeId h) { return mesh_->is_constrained(h); },
        [&](HalfEdgeId edge) {
            return std::any_of(lunes_.begin(), lunes_.end(), [&](const Lune& lune) {
                return may_meet(edge, lune) && may_hide(edge, lune.squared_reach);
            });
        });
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

void OctantSearch::note_neighbor(Key2 key) {
    const std::size_t i = slot(key);
    nearest_[i] = std::min(nearest_[i], squared_reach(key));
    const double distance = length(lengths_.norm(), eye_, key);
    if (distance < blockers_[i].distance) {
        blockers_[i] = {from_eye(key), distance};
    }
}

// Whether through an edge, between two directions, something may be seen that is the nearest in its octant
// and not blocked by the nearest neighbours in the mesh.
bool OctantSearch::is_worth(HalfEdgeId edge, Key2 right, Key2 left) {
    ++looked_;
    const std::size_t count = is_around_ ? kOctants : kOctants + 1;
    const std::size_t begin = slot(right);
    std::size_t end = slot(left);
    nearest_[begin] = std::min(nearest_[begin], squared_reach(right));
    if (end < begin && !is_around_) {
        end = kOctants;  // the far side of the only wall
    }
    nearest_[end] = std::min(nearest_[end], squared_reach(left));
    const Key2 a = keys_[mesh_->origin(edge).value];
    const Key2 b = keys_[mesh_->destination(edge).value];
    const double distance = std::min(squared_distance(eye_, a), squared_distance(eye_, b));
    for (std::size_t i = begin;; i = i + 1 == count ? 0 : i + 1) {
        if (distance < nearest_[i] &&
            !(looked_ > kFewEdges && is_blocked_behind(edge, i == begin ? from_eye(right) : octant_ray(i),
                                                       i == end ? from_eye(left) : octant_ray(i + 1), i))) {
            return true;
        }
        if (i == end) {
            return false;
        }
    }
}

// First ray of the octant with a slot.
Key2 OctantSearch::octant_ray(std::size_t slot) const {
    constexpr std::array<Key2, kOctants> kRays = {
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    return kRays[(static_cast<std::size_t>(first_octant_) + slot) % kOctants];
}

// Tries the mesh neighbours in this octant and up to two away, which are less than 180 degrees apart in the
// corner from what is in this one. What is nearest in its place then may be no neighbour: the lunes of all
// candidates are looked at in full.
bool OctantSearch::is_blocked_behind(HalfEdgeId edge, Key2 right, Key2 left, std::size_t slot) const {
    const std::size_t count = is_around_ ? kOctants : kOctants + 1;
    const Key2 a = from_eye(keys_[mesh_->origin(edge).value]);
    const Key2 b = from_eye(keys_[mesh_->destination(edge).value]);
    const Key2 along{b.x - a.x, b.y - a.y};
    const double height = cross(a, along);  // of p above the edge, times its length
    const double farthest = std::max(square(a), square(b));
    if (height * height < kThin * kThin * farthest * square(along)) {
        return false;
    }
    const auto meet = [&](Key2 ray) {
        const double scale = height / cross(ray, along);
        return Key2{ray.x * scale, ray.y * scale};
    };
    const Key2 on_right = meet(right);
    const Key2 on_left = meet(left);
    const auto blocks = [&](std::size_t other, Key2 near, Key2 far) {
        return is_blocked_beyond(blockers_[other], near, far);
    };
    const Key2 u = blockers_[slot].step;
    if ((cross(u, right) > 0 && blocks(slot, on_right, on_left)) ||
        (cross(left, u) > 0 && blocks(slot, on_left, on_right))) {
        return true;
    }
    for (std::size_t away = 1; away <= kOctantsAway; ++away) {
        if (((is_around_ || slot >= away) && blocks((slot + count - away) % count, on_right, on_left)) ||
            ((is_around_ || slot + away < count) && blocks((slot + away) % count, on_left, on_right))) {
            return true;
        }
    }
    return false;
}

// Whether u is in the open lune of p and whatever is beyond the segment from `near` to `far`, seen from p,
// where u is on near's side and `far` less than 180 degrees from it. With p as origin:
//
// If |v - u| < |v|, that is so for s v, s > 1, and for v + t u, t > 0, as well. For |s v - u| grows with s at
// no more than the rate |v|, at which |s v| grows; and |v + t u| is convex in t, so that its increase over a
// step of 1 does not fall. The latter, being positive at 0, shows that |v + t u| >= |v| too. So if u is in
// the open lune of p and w, it is in those of all s w + t u, s >= 1 and t >= 0. For w take the point of far's
// ray from which, in the direction of u, one gets to `near`, or `far` if that is nearer to p: the segment is
// among these points and what is beyond is with it, since all between far's ray and near's is a sum of
// positive multiples of w and u.
//
// The angles of the edge with lines of sight and of these with u have sines of kThin or more, so that
// rounding moves w by less than 2^-26 of its distance from p; kSlack is far more.
bool OctantSearch::is_blocked_beyond(const Blocker& u, Key2 near, Key2 far) const {
    if (u.distance == std::numeric_limits<double>::infinity()) {
        return false;
    }
    const double near_cross = std::abs(cross(near, u.step));
    const double far_cross = std::abs(cross(far, u.step));
    const double least = kThin * kThin * square(u.step);
    if (near_cross * near_cross < least * square(near) || far_cross * far_cross < least * square(far)) {
        return false;
    }
    const double part = std::min(near_cross / far_cross, 1.0);
    const Key2 w{far.x * part, far.y * part};
    const double distance = length(lengths_.norm(), {0, 0}, w);
    const double between = length(lengths_.norm(), u.step, w);
    return distance - u.distance > kSlack * distance && distance - between > kSlack * distance;
}

// The distance from p, or more. The length of (1, t) is convex in t, so for t from 0 to 1 it is not above its
// chord.
double OctantSearch::reach(Key2 key) const {
    const double x = std::abs(key.x - eye_.x);
    const double y = std::abs(key.y - eye_.y);
    return std::max(x, y) + std::min(x, y) * slant_;
}

// Square of the greatest Euclidean distance from p of what is not farther than v, or more.
double OctantSearch::squared_reach(Key2 key) const {
    const double length = reach(key);
    return length * length * widest_;
}

// Of what has length 1, neither coordinate is greater than 1, nor their sum than that of two equal ones.
OctantSearch::Lune OctantSearch::lune_of(Key2 key) const {
    const double x = key.x - eye_.x;
    const double y = key.y - eye_.y;
    const double width = reach(key) * kMargin;
    const double diagonal = width * kMargin * 2 / (1 + slant_);
    const auto common = [](double center, double half) {
        return Range{std::max(-half, center - half), std::min(half, center + half)};
    };
    return {squared_reach(key),
            {common(x, width), common(y, width), common(x + y, diagonal), common(x - y, diagonal)}};
}

// The lune is convex and p on its rim: what is in it and seen through an edge is seen through a point of the
// edge that is in it too, or on its rim.
bool OctantSearch::may_meet(HalfEdgeId edge, const Lune& lune) const {
    const auto measures = [&](VertexId v) {
        const double x = keys_[v.value].x - eye_.x;
        const double y = keys_[v.value].y - eye_.y;
        return std::array<double, 4>{x, y, x + y, x - y};
    };
    const auto a = measures(mesh_->origin(edge));
    const auto b = measures(mesh_->destination(edge));
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto [least, greatest] = std::minmax(a[i], b[i]);
        if (greatest < lune.ranges[i].least || least > lune.ranges[i].greatest) {
            return false;
        }
    }
    return true;
}

// Whether a vertex within that distance may be seen through an edge: the argument is at
// HalfLuneSearch::may_hide.
bool OctantSearch::may_hide(HalfEdgeId edge, double squared_reach) const {
    return squared_distance(eye_, keys_[mesh_->origin(edge).value]) < squared_reach ||
           squared_distance(eye_, keys_[mesh_->destination(edge).value]) < squared_reach;
}

}  // namespace tinwright
