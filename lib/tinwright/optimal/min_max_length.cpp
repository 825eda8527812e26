#include "tinwright/optimal/min_max_length.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/bounded_delaunay.hpp"
#include "tinwright/optimal/polygon_optimizer.hpp"
#include "tinwright/optimal/stopwatch.hpp"

namespace tinwright {

namespace {

using internal::PolygonOptimizer;
using internal::PolygonTask;
using internal::VertexPair;
using internal::Walls;

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
    [[nodiscard]] std::vector<HalfEdgeId> find_long_edges() const;
    PolygonTask trace(HalfEdgeId longest);
    void find_polygons(std::size_t sides);
    void improve_polygons();
    void improve_together(std::size_t begin, std::size_t end);
    void improve_alone(PolygonTask& task);
    void apply();
    [[nodiscard]] bool was_optimal() const;
    [[nodiscard]] std::vector<FaceId> changed_faces() const;
    [[nodiscard]] VertexPair ends(HalfEdgeId h) const {
        return {tin_.mesh.origin(h), tin_.mesh.destination(h)};
    }
    [[nodiscard]] bool is_longer(VertexPair x, VertexPair y) const {
        return order_.compare(x.first, x.second, y.first, y.second) > 0;
    }
    [[nodiscard]] bool is_in_question(const PolygonTask& task) const {
        return is_longer(ends(task.longest), *bound_);
    }

    static constexpr double kGraphPart = 0.3;  // of the work

    Tin& tin_;
    const OptimizeOptions& options_;
    LengthOrder order_;
    internal::Stopwatch stopwatch_;
    std::optional<TriangleMesh> at_the_start_;  // if the graph has to be inserted
    Walls walls_;
    std::vector<std::uint8_t> in_graph_;
    std::vector<HalfEdgeId> long_edges_;  // diagonals longer than all walls, the longest first
    std::size_t next_ = 0;                // of these
    std::vector<std::uint8_t> is_seen_;   // by face: whether its polygon is known
    std::vector<PolygonTask> tasks_;
    std::size_t done_ = 0;  // tasks
    /// No triangulation has all edges shorter: the longest wall, and what polygons were seen to need.
    std::optional<VertexPair> bound_;
    bool is_proven_ = false;
    OptimizeReport report_;
    LengthReport detail_;
};

OptimizeReport LengthOptimizer::run() {
    report_.before = find_worst(tin_, Criterion::Length, options_.norm);
    if (!options_.norm.is_euclidean()) {
        at_the_start_ = tin_.mesh;
    }
    if (find_graph()) {
        make_walls();
        improve_polygons();
        apply();
    }
    report_.after = find_worst(tin_, Criterion::Length, options_.norm);
    if (stopwatch_.has_stopped() && report_.after.all > report_.before.all) {
        tin_.mesh = *at_the_start_;
        report_.after = report_.before;
        detail_.changed = 0;
        report_.insertions = 0;
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
        return !stopwatch_.is_over_now(static_cast<std::size_t>(part * slots), tin_.mesh.slot_count());
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
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (!mesh.is_terrain({f})) {  // few look across their edges
                walls_.is_wall[mesh.twin(h).value] = 1;
            } else if (mesh.is_constrained(h)) {
                walls_.is_wall[h.value] = 1;
            } else if (h < mesh.twin(h) || !mesh.is_terrain(face_of(mesh.twin(h)))) {  // once an edge
                detail_.graph_edges += in_graph_[h.value];
            }
        }
    }
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (walls_.is_wall[h.value] != 0 && (!bound_ || is_longer(ends(h), *bound_))) {
                bound_ = ends(h);
            }
        }
    }
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
            const auto [a, b] = std::minmax({mesh.origin(h), mesh.destination(h)});
            if (mesh.is_constrained(h)) {
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
            const auto [a, b] = std::minmax({mesh.origin(h), mesh.destination(h)});
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

/// Diagonals of polygons that are longer than all walls, the longest first.
std::vector<HalfEdgeId> LengthOptimizer::find_long_edges() const {
    const TriangleMesh& mesh = tin_.mesh;
    std::vector<HalfEdgeId> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (walls_.is_wall[h.value] == 0 && mesh.origin(h) < mesh.destination(h) &&
                is_longer(ends(h), *bound_)) {
                edges.push_back(h);
            }
        }
    }
    std::sort(edges.begin(), edges.end(), [this](HalfEdgeId g, HalfEdgeId h) {
        const auto [a, b] = ends(g);
        const auto [c, d] = ends(h);
        return order_.is_shorter(c, d, a, b);
    });
    return edges;
}

/// The polygon of a diagonal, which is its longest; its faces are marked as seen.
PolygonTask LengthOptimizer::trace(HalfEdgeId longest) {
    const TriangleMesh& mesh = tin_.mesh;
    PolygonTask task;
    task.longest = longest;
    task.wall = longest;
    while (walls_.is_wall[task.wall.value] == 0) {
        task.wall = next(mesh.twin(task.wall));
    }
    HalfEdgeId side = task.wall;
    do {
        ++task.size;
        side = next(side);
        is_seen_[face_of(side).value] = 1;
        while (walls_.is_wall[side.value] == 0) {
            side = next(mesh.twin(side));
            is_seen_[face_of(side).value] = 1;
        }
    } while (side != task.wall);
    return task;
}

/// About so many sides of polygons with an edge longer than the bound, which alone matter, in the order of
/// their longest edges.
void LengthOptimizer::find_polygons(std::size_t sides) {
    std::size_t found = 0;
    while (found < sides && next_ < long_edges_.size() && is_longer(ends(long_edges_[next_]), *bound_)) {
        const HalfEdgeId longest = long_edges_[next_++];
        if (is_seen_[face_of(longest).value] == 0) {
            tasks_.push_back(trace(longest));
            found += tasks_.back().size;
        }
    }
}

/// The longest edges first, until no polygon has one that is longer than some polygon, or wall, is known to
/// need. Small polygons are shared out among threads by the block; a large one is a block of its own, during
/// which is asked whether to stop.
void LengthOptimizer::improve_polygons() {
    constexpr std::size_t kBlock = 1U << 12U;    // sides
    constexpr std::uint32_t kLarge = 1U << 10U;  // a tenth of a second
    long_edges_ = find_long_edges();
    if (!long_edges_.empty()) {
        is_seen_.assign(tin_.mesh.slot_count(), 0);
        walls_.position.assign(walls_.is_wall.size(), 0);
    }
    for (;;) {
        if (done_ == tasks_.size()) {
            find_polygons(kBlock);
        }
        if (done_ == tasks_.size() || !is_in_question(tasks_[done_])) {
            break;
        }
        std::size_t end = done_;
        std::size_t sides = 0;
        while (end < tasks_.size() && sides < kBlock && tasks_[end].size < kLarge) {
            sides += tasks_[end++].size;
        }
        if (end == done_) {
            improve_alone(tasks_[end++]);
        } else {
            improve_together(done_, end);
        }
        for (; done_ < end && tasks_[done_].is_done; ++done_) {
            const PolygonTask& task = tasks_[done_];
            if (is_in_question(task) && is_longer(task.optimum, *bound_)) {
                bound_ = task.optimum;
            }
        }
        if (done_ < end || stopwatch_.is_over_now(next_, long_edges_.size())) {
            return;
        }
    }
    is_proven_ = true;
}

void LengthOptimizer::improve_alone(PolygonTask& task) {
    PolygonOptimizer optimizer(tin_.mesh, order_, walls_, in_graph_);
    std::size_t steps = 0;
    optimizer.run(task, [&] { return !stopwatch_.is_over(next_, long_edges_.size(), steps += task.size); });
    report_.candidates += optimizer.candidates();
}

void LengthOptimizer::improve_together(std::size_t begin, std::size_t end) {
    constexpr std::size_t kGrain = 64;
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

/// Whether the graph was inserted for nothing.
bool LengthOptimizer::was_optimal() const {
    if (!is_proven_ || !at_the_start_) {
        return false;
    }
    const TriangleMesh& mesh = *at_the_start_;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (is_longer({mesh.origin(h), mesh.destination(h)}, *bound_)) {
                return false;
            }
        }
    }
    return true;
}

/// Changes the faces of polygons that have too long an edge, and then back to Delaunay what the bound allows.
void LengthOptimizer::apply() {
    const bool is_kept = was_optimal();
    for (std::size_t k = 0; k < done_; ++k) {
        PolygonTask& task = tasks_[k];
        if (is_kept || !is_in_question(task)) {
            task.faces.clear();  // another polygon turned out to need as long an edge
        }
        detail_.incomplete += task.is_incomplete ? 1U : 0U;
        detail_.largest = std::max<std::size_t>(detail_.largest, task.size);
        if (!task.faces.empty()) {
            refill_cavity(tin_.mesh, task.slots, task.faces);
            ++detail_.changed;
            report_.insertions += task.faces.size() - 1;
        }
    }
    detail_.polygons = done_;
    report_.tries = done_;
    if (is_proven_) {
        report_.proof = Proof::Theorem;
    }
    if (is_kept) {
        tin_.mesh = *at_the_start_;
    } else if (is_proven_) {
        internal::flip_to_delaunay(tin_.mesh, order_, changed_faces(), *bound_);
    }
}

/// Those of changed polygons; all, if the graph's edges were inserted.
std::vector<FaceId> LengthOptimizer::changed_faces() const {
    std::vector<FaceId> faces;
    if (!options_.norm.is_euclidean()) {
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            faces.push_back({f});
        }
        return faces;
    }
    for (std::size_t k = 0; k < done_; ++k) {
        if (!tasks_[k].faces.empty()) {
            faces.insert(faces.end(), tasks_[k].slots.begin(), tasks_[k].slots.end());
        }
    }
    return faces;
}

}  // namespace

OptimizeReport minimize_longest_edge(Tin& tin, const OptimizeOptions& options) {
    return LengthOptimizer(tin, options).run();
}

}  // namespace tinwright
