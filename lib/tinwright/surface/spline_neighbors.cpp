#include "tinwright/surface/spline_neighbors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

/// Vertices looked at for each neighbour wanted: beyond, octants that are not full stay so.
constexpr std::size_t kLooks = 4;
/// Vertices that the TIN joins to one are neighbours, but the hub of a wheel has only so many more than asked
/// for.
constexpr std::size_t kMostJoined = 16;

/// 0 to 7 counter-clockwise; each holds the ray it begins with.
std::uint8_t octant_of(double dx, double dy) {
    unsigned octant = 0;
    if (dy < 0 || (dy == 0 && dx < 0)) {
        octant = 4;
        dx = -dx;
        dy = -dy;
    }
    if (dx <= 0) {
        octant += 2;
        const double old = dx;
        dx = dy;
        dy = -old;
    }
    return static_cast<std::uint8_t>(octant + (dy >= dx ? 1U : 0U));
}

}  // namespace

std::uint8_t SplineNeighbors::octant_to(VertexId v) const {
    const Key2 from = tin_.key(center_);
    const Key2 to = tin_.key(v);
    return octant_of(to.x - from.x, to.y - from.y);
}

bool SplineNeighbors::is_of_terrain(HalfEdgeId h) const {
    return tin_.mesh.is_terrain(face_of(h)) || tin_.mesh.is_terrain(face_of(tin_.mesh.twin(h)));
}

bool SplineNeighbors::is_later(const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance > b.distance : b.vertex < a.vertex;
}

SplineNeighbors::SplineNeighbors(const Tin& tin, const SharpEdges& sharp, int count)
    : tin_(tin),
      sight_(tin, sharp),
      count_(static_cast<std::size_t>(count)),
      quota_((count_ + 7) / 8),
      most_(kLooks * count_) {
    seen_.resize(std::bit_ceil(8 * most_));
}

/// Whether a vertex was not seen before; it is now. Of too many, none is new.
bool SplineNeighbors::is_new(VertexId v) {
    if (2 * seen_count_ > seen_.size()) {
        return false;
    }
    const std::size_t mask = seen_.size() - 1;
    std::size_t slot = (v.value * std::size_t{2654435761U} >> 7U) & mask;
    while (seen_[slot] != 0) {
        if (seen_[slot] == v.value + 1) {
            return false;
        }
        slot = (slot + 1) & mask;
    }
    seen_[slot] = v.value + 1;
    ++seen_count_;
    return true;
}

void SplineNeighbors::add(HalfEdgeId h, bool is_joined) {
    const VertexId to = tin_.mesh.destination(h);
    heap_.push_back({squared_distance(tin_.key(center_), tin_.key(to)), to, h, is_joined});
}

/// Adds the vertices that the center is joined to; of a hub so many of the nearest in each octant as are
/// wanted in all.
void SplineNeighbors::visit_center(HalfEdgeId start) {
    HalfEdgeId h = start;
    do {
        if (is_of_terrain(h)) {
            add(h, true);
        }
        h = next_around(tin_.mesh, h);
    } while (h != start);
    if (heap_.size() > 8 * count_) {
        std::sort(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return is_later(b, a); });
        std::array<std::size_t, 8> kept{};
        std::size_t total = 0;
        for (const Candidate& each : heap_) {
            if (kept[octant_to(each.vertex)]++ < count_) {
                heap_[total++] = each;
            }
        }
        heap_.resize(total);
    }
    for (const Candidate& each : heap_) {
        is_new(each.vertex);
    }
    std::make_heap(heap_.begin(), heap_.end(), is_later);
}

/// Adds the vertices that a neighbour is joined to, alternately to the left and to the right of the way that
/// it was come by; of a hub those that are beside the way.
void SplineNeighbors::visit(const Candidate& from) {
    const TriangleMesh& mesh = tin_.mesh;
    HalfEdgeId left = mesh.twin(from.way);
    HalfEdgeId right = left;
    for (std::size_t steps = 0; steps < 8 * count_ && next_around(mesh, left) != right; ++steps) {
        const bool is_left = steps % 2 == 0;
        const HalfEdgeId h = is_left ? next_around(mesh, left) : next_clockwise(mesh, right);
        (is_left ? left : right) = h;
        if (is_of_terrain(h) && is_new(mesh.destination(h))) {
            add(h, false);
            std::push_heap(heap_.begin(), heap_.end(), is_later);
        }
    }
}

/// Notes a vertex that is in sight. Whether it is.
bool SplineNeighbors::accept(const Candidate& candidate) {
    if (!candidate.is_joined && !sight_.sees(fan_, candidate.vertex)) {
        return false;
    }
    octant_.push_back(octant_to(candidate.vertex));
    ++in_octant_[octant_.back()];
    accepted_.push_back(candidate);
    return true;
}

std::span<const VertexId> SplineNeighbors::find(const VertexFan& fan) {
    fan_ = fan;
    center_ = tin_.mesh.origin(fan.first);
    heap_.clear();
    accepted_.clear();
    octant_.clear();
    in_octant_ = {};
    std::fill(seen_.begin(), seen_.end(), 0U);
    seen_count_ = 0;
    is_new(center_);
    visit_center(fan.first);
    // On a Delaunay TIN every vertex has a neighbour nearer to the center, so they come by distance.
    for (std::size_t looked = 0; !heap_.empty() && looked < most_; ++looked) {
        if (accepted_.size() >= count_ &&
            std::ranges::all_of(in_octant_, [&](std::size_t n) { return n >= quota_; })) {
            break;
        }
        std::pop_heap(heap_.begin(), heap_.end(), is_later);
        const Candidate candidate = heap_.back();
        heap_.pop_back();
        if (accept(candidate)) {
            visit(candidate);
        }
    }
    while (!heap_.empty()) {  // what the TIN joins, however far
        std::pop_heap(heap_.begin(), heap_.end(), is_later);
        if (heap_.back().is_joined) {
            accept(heap_.back());
        }
        heap_.pop_back();
    }
    select();
    return found_;
}

void SplineNeighbors::select() {
    std::array<std::size_t, 8> taken{};
    std::size_t joined = 0;
    std::size_t total = 0;
    is_taken_.assign(accepted_.size(), false);
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
        const bool is_joined = accepted_[i].is_joined && joined < count_ + kMostJoined;
        joined += is_joined ? 1 : 0;
        if (taken[octant_[i]] < quota_ && total < count_) {
            is_taken_[i] = true;
            ++total;
            ++taken[octant_[i]];
        } else if (is_joined) {
            is_taken_[i] = true;
        }
    }
    for (std::size_t i = 0; i < accepted_.size() && total < count_; ++i) {
        if (!is_taken_[i]) {
            is_taken_[i] = true;
            ++total;
        }
    }
    found_.clear();
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
        if (is_taken_[i]) {
            found_.push_back(accepted_[i].vertex);
        }
    }
}

}  // namespace tinwright
