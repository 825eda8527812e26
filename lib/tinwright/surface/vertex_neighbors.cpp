#include "tinwright/surface/vertex_neighbors.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <utility>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

template <class Neighbor>
bool is_nearer(const Neighbor& a, const Neighbor& b) {
    return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.vertex < b.vertex);
}

/// 0 to 7 counter-clockwise from the positive x axis; each has its clockwise border. Exact. Without branches:
/// no processor can foretell where the next vertex is.
unsigned octant_of(Key2 offset) {
    constexpr std::array<double, 2> kTurned{1, -1};
    const bool is_up = (offset.y > 0) | ((offset.y == 0) & (offset.x > 0));
    const unsigned half = is_up ? 0 : 1;
    const double x = kTurned[half] * offset.x;
    const double y = kTurned[half] * offset.y;
    // From here on in the half-plane above the x axis, its right end included.
    const unsigned quarter = x > 0 ? 0 : 1;
    const bool is_second = quarter == 0 ? y >= x : -x >= y;
    return 4 * half + 2 * quarter + (is_second ? 1U : 0U);
}

/// Follows the straight line from one vertex to another through the faces between them.
class Sight {
  public:
    Sight(const Tin& tin, const SharpEdges& sharp, VertexId target)
        : mesh_(tin.mesh), tin_(tin), sharp_(sharp), target_(target) {}

    [[nodiscard]] bool is_free(const VertexFan& fan) const {
        const VertexId from = mesh_.origin(fan.first);
        std::optional<Way> way;
        visit_fan(mesh_, fan, [&](HalfEdgeId h) { way = way ? way : into(h); });
        while (way && !(way->is_through_vertex && mesh_.origin(way->h) == target_)) {
            way = way->is_through_vertex ? past(way->h) : across(way->h, from);
        }
        return way.has_value();
    }

  private:
    /// Where the line leaves a face: through the origin of one of its half-edges, or else across it.
    struct Way {
        HalfEdgeId h{};
        bool is_through_vertex = false;
    };

    /// From the origin of a half-edge into its face; empty if the line does not run there.
    [[nodiscard]] std::optional<Way> into(HalfEdgeId corner) const {
        const Key2 at = tin_.key(mesh_.origin(corner));
        const Key2 to = tin_.key(target_);
        const int right = orient2d(at, tin_.key(mesh_.destination(corner)), to);
        const int left = orient2d(at, to, tin_.key(mesh_.origin(previous(corner))));
        if (right < 0 || left < 0) {
            return std::nullopt;
        }
        if (right == 0) {
            return Way{next(corner), true};
        }
        return left == 0 ? Way{previous(corner), true} : Way{next(corner), false};
    }

    /// Beyond the origin of a half-edge, through the faces of its fan.
    [[nodiscard]] std::optional<Way> past(HalfEdgeId corner) const {
        std::optional<Way> way;
        visit_fan(mesh_, find_fan(mesh_, sharp_, corner), [&](HalfEdgeId h) { way = way ? way : into(h); });
        return way;
    }

    /// Beyond a half-edge that the line from `from` crosses.
    [[nodiscard]] std::optional<Way> across(HalfEdgeId h, VertexId from) const {
        if (is_wall(mesh_, sharp_, h)) {
            return std::nullopt;
        }
        const HalfEdgeId entry = mesh_.twin(h);
        const Key2 apex = tin_.key(mesh_.origin(previous(entry)));
        const int side = orient2d(tin_.key(from), tin_.key(target_), apex);
        return side > 0 ? Way{next(entry), false} : Way{previous(entry), side == 0};
    }

    const TriangleMesh& mesh_;
    const Tin& tin_;
    const SharpEdges& sharp_;
    VertexId target_;
};

}  // namespace

bool NeighborSearch::sees(const VertexFan& fan, VertexId target) const {
    return Sight(tin_, sharp_, target).is_free(fan);
}

void NeighborSearch::find_ring(const VertexFan& fan, std::vector<VertexNeighbor>& neighbors) {
    center_ = tin_.mesh.origin(fan.first);
    neighbors.clear();
    visit_fan(tin_.mesh, fan, [&](HalfEdgeId h) { neighbors.push_back(neighbor(tin_.mesh.destination(h))); });
    const VertexId last = last_neighbor(tin_.mesh, fan);
    if (last != neighbors.front().vertex) {
        neighbors.push_back(neighbor(last));
    }
    std::sort(neighbors.begin(), neighbors.end(), is_nearer<VertexNeighbor>);
}

void NeighborSearch::find_octants(const VertexFan& fan, unsigned per_octant,
                                  std::vector<VertexNeighbor>& neighbors) {
    assert(per_octant >= 1 && per_octant <= kMostPerOctant);
    has_met_wall_ = !fan.is_closed;
    if (!has_met_wall_) {
        collect(fan, per_octant, false);
    }
    if (has_met_wall_) {  // rare, so only then each vertex is looked for along a straight line
        collect(fan, per_octant, true);
    }
    neighbors.clear();
    for (const Octant& octant : octants_) {
        for (unsigned i = 0; i < octant.count; ++i) {
            neighbors.push_back(neighbor(octant.nearest[i].vertex));
        }
    }
}

VertexNeighbor NeighborSearch::neighbor(VertexId vertex) const {
    const Key2 from = tin_.key(center_);
    const Key2 to = tin_.key(vertex);
    return {vertex, {to.x - from.x, to.y - from.y}, squared_distance(from, to)};
}

/// Whether the vertex was not in the set.
inline bool NeighborSearch::insert_visited(VertexId vertex) {
    const std::size_t mask = visited_.size() - 1;
    std::size_t place = (vertex.value * 0x9E3779B1U) & mask;
    for (; visited_[place].epoch == epoch_; place = (place + 1) & mask) {
        if (visited_[place].vertex == vertex.value) {
            return false;
        }
    }
    visited_[place] = {vertex.value, epoch_};
    if (2 * ++visited_count_ > visited_.size()) {
        grow_visited();
    }
    return true;
}

void NeighborSearch::collect(const VertexFan& fan, unsigned per_octant, bool is_sight_checked) {
    center_ = tin_.mesh.origin(fan.first);
    for (Octant& octant : octants_) {
        octant.count = 0;
    }
    clear_visited();
    insert_visited(center_);
    queue_.clear();
    const Order order{fan, per_octant, is_sight_checked};
    visit_fan(tin_.mesh, fan, [&](HalfEdgeId h) { visit(next(h), true, order); });
    visit(previous(fan.last), true, order);
    const std::size_t most = queue_.size() + kMostVisits;
    std::size_t begin = 0;
    for (int level = 1; level < kLevels && !have_octants(level == 1 ? per_octant : 1); ++level) {
        const std::size_t end = queue_.size();
        for (std::size_t i = begin; i < end && queue_.size() < most; ++i) {
            visit_around(queue_[i], most, order);
        }
        begin = end;
    }
}

/// Visits what is adjacent to the origin of a half-edge, on the side of walls that the half-edge is on.
void NeighborSearch::visit_around(HalfEdgeId corner, std::size_t most, const Order& order) {
    const TriangleMesh& mesh = tin_.mesh;
    HalfEdgeId h = corner;
    while (queue_.size() < most) {
        visit(next(h), false, order);
        if (is_wall(mesh, sharp_, previous(h))) {
            visit(previous(h), false, order);
            has_met_wall_ = true;
            break;
        }
        h = next_around(mesh, h);
        if (h == corner) {
            return;
        }
    }
    for (h = corner; !is_wall(mesh, sharp_, h) && queue_.size() < most;) {
        h = next_clockwise(mesh, h);
        visit(next(h), false, order);
    }
}

/// Looks at the origin of a half-edge, unless that was done.
void NeighborSearch::visit(HalfEdgeId corner, bool is_adjacent, const Order& order) {
    const VertexId v = tin_.mesh.origin(corner);
    if (!insert_visited(v)) {
        return;
    }
    queue_.push_back(corner);
    const Key2 from = tin_.key(center_);
    const Key2 to = tin_.key(v);
    const Candidate candidate{squared_distance(from, to), v};
    Octant& octant = octants_[octant_of({to.x - from.x, to.y - from.y})];
    const bool is_full = octant.count == order.per_octant;
    if ((is_full && !is_nearer(candidate, octant.nearest[octant.count - 1])) ||
        (order.is_sight_checked && !is_adjacent && !sees(order.fan, v))) {
        return;
    }
    unsigned place = is_full ? octant.count - 1 : octant.count++;
    for (; place > 0 && is_nearer(candidate, octant.nearest[place - 1]); --place) {
        octant.nearest[place] = octant.nearest[place - 1];
    }
    octant.nearest[place] = candidate;
}

bool NeighborSearch::have_octants(unsigned count) const {
    return std::all_of(octants_.begin(), octants_.end(),
                       [&](const Octant& octant) { return octant.count >= count; });
}

void NeighborSearch::grow_visited() {
    const std::vector<Visited> old = std::exchange(visited_, std::vector<Visited>(4 * visited_.size()));
    visited_count_ = 0;
    for (const Visited& entry : old) {
        if (entry.epoch == epoch_) {
            insert_visited({entry.vertex});
        }
    }
}

void NeighborSearch::clear_visited() {
    constexpr std::size_t kSmall = 512;
    if (visited_.empty() || ++epoch_ == 0) {
        visited_.assign(std::max(visited_.size(), kSmall), {0, 0});
        epoch_ = 1;
    }
    visited_count_ = 0;
}

}  // namespace tinwright
