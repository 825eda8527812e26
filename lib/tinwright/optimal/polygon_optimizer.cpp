#include "tinwright/optimal/polygon_optimizer.hpp"

#include <algorithm>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright::internal {

void PolygonOptimizer::run(PolygonTask& task, const Poll& poll) {
    polygon_.trace(task.wall);
    if (polygon_.faces().size() + 2 != polygon_.size()) {
        return;  // walls that hang together leave no islands; these are of another triangulation's graph
    }
    const std::optional<std::uint32_t> long_side = find_shortest_long_side();
    task.is_incomplete = long_side.has_value();
    if (long_side) {
        const HalfEdgeId base = polygon_.side(*long_side);
        task.optimum = ends(base);
        task.is_done = parts_.triangulate(polygon_.after(*long_side), *long_side,
                                          CavityFace::Across::rim(base), task.faces, poll);
    } else {
        task.is_done = improve_complete(task, poll);
    }
    if (!task.is_done) {
        task.faces.clear();
    }
    if (!task.faces.empty()) {
        task.slots.assign(polygon_.faces().begin(), polygon_.faces().end());
    }
}

/// Whether it was not stopped.
bool PolygonOptimizer::improve_complete(PolygonTask& task, const Poll& poll) {
    constexpr std::uint32_t kMany = 64;
    task.optimum = ends(task.longest);
    std::optional<ExpandableEdgeSearch::Diagonal> best;
    if (const auto bound = bound_without(task.longest, poll)) {
        best = polygon_.size() > kMany ? search_.find_among_many(*bound, task.optimum, poll)
                                       : search_.find_among_few(*bound, task.optimum);
    }
    if (!best) {
        return poll();
    }
    const VertexPair edge{polygon_.vertex(best->low), polygon_.vertex(best->high)};
    if (!is_really_shorter(edge, task.optimum)) {
        return true;
    }
    task.optimum = edge;
    const CavityFace::Across first_part = CavityFace::Across::inner(0, 2);
    return parts_.triangulate(best->low, best->high, {}, task.faces, poll) &&
           parts_.triangulate(best->high, best->low, first_part, task.faces, poll);
}

/// Without its longest diagonal p q a polygon has a face at p, and one at q, whose opposite edge crosses p q,
/// and no edge as long. Of all triangles that might be those faces the least in longest edge is taken, and
/// the longer of the two edges is the bound; where there are no such triangles, the diagonal cannot be
/// avoided. That spares most polygons that keep their faces the search.
std::optional<VertexPair> PolygonOptimizer::bound_without(HalfEdgeId longest, const Poll& poll) const {
    const VertexPair pq = ends(longest);
    const std::uint32_t from = walls_.position[longest.value];
    const std::uint32_t to = walls_.position[next(longest).value];
    std::optional<VertexPair> at_p;
    std::optional<VertexPair> at_q;
    const auto lessen = [&](std::optional<VertexPair>& least, VertexId corner, VertexPair xy) {
        VertexPair edge = xy;
        for (const VertexPair& side : {VertexPair{corner, xy.first}, VertexPair{corner, xy.second}}) {
            edge = is_shorter(edge, side) ? side : edge;
        }
        if ((least ? is_shorter(edge, *least) : is_really_shorter(edge, pq)) &&
            do_cross(key(pq.first), key(pq.second), key(xy.first), key(xy.second))) {
            least = edge;
        }
    };
    for (std::uint32_t i = polygon_.after(from); i != to && poll(); i = polygon_.after(i)) {
        for (std::uint32_t j = polygon_.after(to); j != from; j = polygon_.after(j)) {
            const VertexPair xy{polygon_.vertex(i), polygon_.vertex(j)};
            if (is_really_shorter(xy, pq)) {
                lessen(at_p, pq.first, xy);
                lessen(at_q, pq.second, xy);
            }
        }
    }
    if (!at_p || !at_q) {
        return std::nullopt;
    }
    return is_shorter(*at_p, *at_q) ? at_q : at_p;
}

/// Of the sides that are not empty towards the inside.
std::optional<std::uint32_t> PolygonOptimizer::find_shortest_long_side() {
    std::optional<std::uint32_t> shortest;
    for (std::uint32_t position = 0; position < polygon_.size(); ++position) {
        const HalfEdgeId side = polygon_.side(position);
        if (in_graph_[side.value] != 0 ||
            (shortest && !is_shorter(ends(side), ends(polygon_.side(*shortest))))) {
            continue;
        }
        const VertexPair pair = ends(side);
        const auto sights = polygon_.look(position, pair, space_);
        const auto is_in_half_lune = [&](const WallPolygon::Sight& sight) {
            return order_.is_in_lune(sight.vertex, pair.first, pair.second) &&
                   orient2d(key(pair.first), key(pair.second), key(sight.vertex)) > 0;
        };
        if (std::any_of(sights.begin(), sights.end(), is_in_half_lune)) {
            shortest = position;
        }
    }
    return shortest;
}

}  // namespace tinwright::internal
