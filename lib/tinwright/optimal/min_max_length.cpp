#include "tinwright/optimal/min_max_length.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/polygon_optimizer.hpp"
#include "tinwright/optimal/stopwatch.hpp"

namespace tinwright {

namespace {

using internal::PolygonOptimizer;
using internal::PolygonTask;
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
    std::vector<PolygonTask> tasks_;
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
    for (const PolygonTask& task : tasks_) {
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
