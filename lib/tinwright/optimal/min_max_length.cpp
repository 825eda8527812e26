#include "tinwright/optimal/min_max_length.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/expandable_edge.hpp"
#include "tinwright/optimal/incomplete_polygon.hpp"
#include "tinwright/optimal/stopwatch.hpp"
#include "tinwright/optimal/wall_polygon.hpp"

namespace tinwright {

namespace {

using internal::ExpandableEdgeSearch;
using internal::IncompletePolygon;
using internal::Poll;
using internal::VertexPair;
using internal::WallPolygon;
using internal::Walls;

/// A polygon that is yet to be looked at, and what became of it.
struct Task {
    HalfEdgeId wall{};       ///< one of its sides
    std::uint32_t size = 0;  ///< number of sides
    bool is_incomplete = false;
    bool is_done = false;
    std::vector<FaceId> slots;
    std::vector<CavityFace> faces;  ///< in their place; empty: they are as good as any
};

/// Looks at one polygon after the other.
class PolygonOptimizer {
  public:
    /// `in_graph`: of each half-edge whether its edge is known to be empty on both sides.
    PolygonOptimizer(const TriangleMesh& mesh, const LengthOrder& order, Walls& walls,
                     std::span<const std::uint8_t> in_graph)
        : order_(order), in_graph_(in_graph), polygon_(mesh, order, walls), walls_(walls) {}

    void run(Task& task, const Poll& poll);
    [[nodiscard]] std::size_t candidates() const { return search_.candidates(); }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return order_.keys()[v.value]; }
    [[nodiscard]] VertexPair ends(HalfEdgeId h) const {
        return {polygon_.mesh().origin(h), polygon_.mesh().destination(h)};
    }
    [[nodiscard]] bool is_shorter(VertexPair x, VertexPair y) const {
        return order_.is_shorter(x.first, x.second, y.first, y.second);
    }
    [[nodiscard]] bool is_really_shorter(VertexPair x, VertexPair y) const {
        return order_.compare(x.first, x.second, y.first, y.second) < 0;
    }
    [[nodiscard]] VertexPair longest_side() const;
    [[nodiscard]] HalfEdgeId longest_diagonal() const;
    [[nodiscard]] std::optional<VertexPair> bound_without(HalfEdgeId longest, const Poll& poll) const;
    [[nodiscard]] std::optional<std::uint32_t> find_shortest_long_side();
    bool improve_complete(HalfEdgeId longest, Task& task, const Poll& poll);

    const LengthOrder& order_;
    std::span<const std::uint8_t> in_graph_;
    WallPolygon polygon_;
    const Walls& walls_;
    ExpandableEdgeSearch search_{polygon_};
    IncompletePolygon parts_{polygon_};
    std::vector<WallPolygon::Sight> space_;
};

void PolygonOptimizer::run(Task& task, const Poll& poll) {
    polygon_.trace(task.wall);
    const std::optional<std::uint32_t> long_side = find_shortest_long_side();
    const HalfEdgeId longest = longest_diagonal();
    task.is_incomplete = long_side.has_value();
    if (!long_side) {
        task.is_done = improve_complete(longest, task, poll);
    } else if (is_really_shorter(longest_side(), ends(longest))) {
        task.is_done =
            parts_.triangulate(polygon_.after(*long_side), *long_side,
                               CavityFace::Across::rim(polygon_.side(*long_side)), task.faces, poll);
    } else {
        task.is_done = true;
    }
    if (!task.is_done) {
        task.faces.clear();
    }
    if (!task.faces.empty()) {
        task.slots.assign(polygon_.faces().begin(), polygon_.faces().end());
    }
}

/// Whether it was not stopped.
bool PolygonOptimizer::improve_complete(HalfEdgeId longest, Task& task, const Poll& poll) {
    constexpr std::uint32_t kMany = 64;
    const VertexPair pair = ends(longest);
    std::optional<ExpandableEdgeSearch::Diagonal> best;
    if (const auto bound = bound_without(longest, poll)) {
        best = polygon_.size() > kMany ? search_.find_among_many(*bound, pair, poll)
                                       : search_.find_among_few(*bound, pair);
    }
    if (!best || !is_really_shorter({polygon_.vertex(best->low), polygon_.vertex(best->high)}, pair)) {
        return poll();
    }
    const auto other_part = [&] { return CavityFace::Across::inner(0, 2); };
    return parts_.triangulate(best->low, best->high, {}, task.faces, poll) &&
           parts_.triangulate(best->high, best->low, other_part(), task.faces, poll);
}

VertexPair PolygonOptimizer::longest_side() const {
    VertexPair longest = ends(polygon_.side(0));
    for (std::uint32_t position = 1; position < polygon_.size(); ++position) {
        const VertexPair side = ends(polygon_.side(position));
        longest = is_shorter(longest, side) ? side : longest;
    }
    return longest;
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

HalfEdgeId PolygonOptimizer::longest_diagonal() const {
    std::optional<HalfEdgeId> longest;
    for (const FaceId face : polygon_.faces()) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge(face, i);
            if (walls_.is_wall[h.value] == 0 && h < polygon_.mesh().twin(h) &&
                (!longest || is_shorter(ends(*longest), ends(h)))) {
                longest = h;
            }
        }
    }
    return *longest;
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
        const auto [a, b] = ends(side);
        const auto sights = polygon_.look(position, {a, b}, space_);
        const auto is_in_half_lune = [&](const WallPolygon::Sight& sight) {
            return order_.is_in_lune(sight.vertex, a, b) &&
                   orient2d(order_.keys()[a.value], order_.keys()[b.value],
                            order_.keys()[sight.vertex.value]) > 0;
        };
        if (std::any_of(sights.begin(), sights.end(), is_in_half_lune)) {
            shortest = position;
        }
    }
    return shortest;
}

/// Makes one TIN optimal.
class LengthOptimizer {
  public:
    LengthOptimizer(Tin& tin, const OptimizeOptions& options)
        : tin_(tin), options_(options), order_(tin.keys, options.norm), stopwatch_(options) {}

    OptimizeReport run();

  private:
    bool find_graph();
    void insert_graph(const Progress& progress);
    void make_walls();
    void find_polygons();
    void improve_polygons();
    void improve_together(std::size_t begin, std::size_t end);
    void apply();
    [[nodiscard]] bool must_stop(std::size_t done);

    static constexpr double kGraphPart = 0.3;  // of the work

    Tin& tin_;
    const OptimizeOptions& options_;
    LengthOrder order_;
    internal::Stopwatch stopwatch_;
    Walls walls_;
    std::vector<std::uint8_t> in_graph_;
    std::vector<Task> tasks_;
    std::size_t sides_ = 0;  // of all tasks
    OptimizeReport report_;
    LengthReport detail_;
};

OptimizeReport LengthOptimizer::run() {
    report_.before = find_worst(tin_, Criterion::Length, options_.norm);
    const TriangleMesh at_the_start = options_.norm.is_euclidean() ? TriangleMesh() : tin_.mesh;
    if (find_graph()) {
        make_walls();
        find_polygons();
        improve_polygons();
        apply();
    }
    report_.after = find_worst(tin_, Criterion::Length, options_.norm);
    if (stopwatch_.has_stopped() && report_.after.all > report_.before.all) {
        tin_.mesh = at_the_start;
        report_.after = report_.before;
    }
    report_.stopped_by = stopwatch_.stopped_by();
    report_.seconds = stopwatch_.seconds();
    report_.length = detail_;
    return report_;
}

/// False if stopped.
bool LengthOptimizer::find_graph() {
    const auto slots = static_cast<double>(tin_.mesh.slot_count());
    stopwatch_.set_stage(0, kGraphPart);
    const Progress progress = [&](double part) {
        const auto done = static_cast<std::size_t>(part * slots);
        return !stopwatch_.is_over(done, tin_.mesh.slot_count(), done);
    };
    try {
        if (options_.norm.is_euclidean()) {
            in_graph_ = mark_relative_neighbors(tin_.mesh, tin_.keys, progress);
        } else {
            insert_graph(progress);
        }
    } catch (const Cancelled&) {
        return false;
    }
    stopwatch_.set_stage(kGraphPart, 1);
    return true;
}

void LengthOptimizer::make_walls() {
    walls_.is_wall = in_graph_;
    const TriangleMesh& mesh = tin_.mesh;
    std::size_t in_graph_only = 0;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (!mesh.is_terrain({f})) {  // few look across their edges
                walls_.is_wall[mesh.twin(h).value] = 1;
            } else if (mesh.is_constrained(h)) {
                walls_.is_wall[h.value] = 1;
            } else {
                in_graph_only += in_graph_[h.value];
            }
        }
    }
    detail_.graph_edges = in_graph_only / 2;
}

/// Makes the edges of the graph edges of the mesh, and marks them.
void LengthOptimizer::insert_graph(const Progress& progress) {
    TriangleMesh& mesh = tin_.mesh;
    const std::vector<GraphEdge> graph =
        make_relative_neighborhood_graph(mesh, tin_.keys, options_.norm, LuneRim::Ordered, progress);
    std::vector<GraphEdge> constrained;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const auto [a, b] = std::minmax(mesh.origin(h), mesh.destination(h));
            if (mesh.is_constrained(h) || mesh.is_border(h)) {
                constrained.push_back({a, b});
            }
        }
    }
    std::sort(constrained.begin(), constrained.end());
    std::vector<Segment> segments;
    segments.reserve(graph.size());
    for (const GraphEdge& edge : graph) {
        segments.push_back({edge.a, edge.b});
    }
    insert_segments(mesh, tin_.keys, segments);

    in_graph_.assign(4 * mesh.slot_count(), 0);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (!mesh.is_constrained(h)) {
                continue;
            }
            const auto [a, b] = std::minmax(mesh.origin(h), mesh.destination(h));
            const GraphEdge edge{a, b};
            const bool is_in_graph = std::binary_search(graph.begin(), graph.end(), edge);
            in_graph_[h.value] = is_in_graph ? 1 : 0;
            if (is_in_graph && !std::binary_search(constrained.begin(), constrained.end(), edge)) {
                mesh.set_constrained(h, false);
                in_graph_[mesh.twin(h).value] = 1;
            }
        }
    }
}

void LengthOptimizer::find_polygons() {
    const TriangleMesh& mesh = tin_.mesh;
    walls_.position.assign(walls_.is_wall.size(), 0);
    std::vector<std::uint8_t> is_seen(walls_.is_wall.size(), 0);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId first = half_edge({f}, i);
            if (walls_.is_wall[first.value] == 0 || is_seen[first.value] != 0) {
                continue;
            }
            std::uint32_t size = 0;
            HalfEdgeId side = first;
            do {
                is_seen[side.value] = 1;
                ++size;
                side = next(side);
                while (walls_.is_wall[side.value] == 0) {
                    side = next(mesh.twin(side));
                }
            } while (side != first);
            if (size > 3) {
                tasks_.push_back({first, size, false, false, {}, {}});
                sides_ += size;
                detail_.largest = std::max<std::size_t>(detail_.largest, size);
            }
        }
    }
    detail_.polygons = tasks_.size();
}

bool LengthOptimizer::must_stop(std::size_t done) { return stopwatch_.is_over(done, sides_, done); }

/// Small polygons are shared out among threads by the block; a large one is a block of its own, during which
/// is asked whether to stop.
void LengthOptimizer::improve_polygons() {
    constexpr std::size_t kBlock = 1U << 16U;  // sides
    constexpr std::uint32_t kLarge = 1U << 12U;
    std::size_t done = 0;
    for (std::size_t begin = 0; begin < tasks_.size() && !must_stop(done);) {
        std::size_t end = begin;
        std::size_t sides = 0;
        while (end < tasks_.size() && sides < kBlock && tasks_[end].size < kLarge) {
            sides += tasks_[end++].size;
        }
        if (end == begin) {
            sides = tasks_[begin].size;
            PolygonOptimizer optimizer(tin_.mesh, order_, walls_, in_graph_);
            optimizer.run(tasks_[end++], [&] { return !must_stop(done); });
            report_.candidates += optimizer.candidates();
        } else {
            improve_together(begin, end);
        }
        done += sides;
        begin = end;
    }
}

void LengthOptimizer::improve_together(std::size_t begin, std::size_t end) {
    constexpr std::size_t kGrain = 256;
    tbb::enumerable_thread_specific<PolygonOptimizer> optimizers(
        [&] { return PolygonOptimizer(tin_.mesh, order_, walls_, in_graph_); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, kGrain), [&](const auto& range) {
        PolygonOptimizer& optimizer = optimizers.local();
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
            optimizer.run(tasks_[k], [] { return true; });
        }
    });
    for (const PolygonOptimizer& optimizer : optimizers) {
        report_.candidates += optimizer.candidates();
    }
}

void LengthOptimizer::apply() {
    bool is_all_done = true;
    for (const Task& task : tasks_) {
        is_all_done = is_all_done && task.is_done;
        report_.tries += task.is_done ? 1U : 0U;
        detail_.incomplete += task.is_incomplete ? 1U : 0U;
        if (!task.faces.empty()) {
            refill_cavity(tin_.mesh, task.slots, task.faces);
            ++detail_.changed;
            report_.insertions += task.faces.size() - 1;
        }
    }
    if (is_all_done) {
        report_.proof = Proof::Theorem;
    }
}

}  // namespace

OptimizeReport minimize_longest_edge(Tin& tin, const OptimizeOptions& options) {
    return LengthOptimizer(tin, options).run();
}

}  // namespace tinwright
