#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/optimal/min_max_length.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/cgal_peer.hpp"
#include "benchmarks/growth.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/terrain_points.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::GraphEdge;
using tinwright::Key2;
using tinwright::Norm;
using tinwright::TriangleMesh;
using Keys = std::span<const Key2>;

struct PointSet {
    std::string name;
    Points (*make)(std::size_t);
};

constexpr double kLongSeconds = 5;  // a run that takes longer is not repeated to know how it grows

/// `minimize_longest_edge` of the Delaunay TIN of `points`, which is made before. Notes the number of sides
/// of the largest polygon that was looked at.
std::function<Measured()> shortening(const Points& points, Norm norm, int threads,
                                     const tinwright::DomainRule& domain = {}) {
    const Work work = [&points, norm, threads, domain](Meter& meter) {
        tinwright::TriangulateOptions how;
        how.domain = domain;
        how.threads = threads;
        tinwright::Triangulated made = tinwright::triangulate(points, how);
        tinwright::OptimizeOptions options;
        options.criterion = tinwright::Criterion::Length;
        options.norm = norm;
        tinwright::OptimizeReport report;
        meter.start();
        tbb::task_arena(threads).execute(
            [&] { report = tinwright::minimize_longest_edge(made.tin, options); });
        meter.stop();
        if (report.proof != tinwright::Proof::Theorem) {
            throw std::runtime_error("the longest edge is not proven");
        }
        meter.note(static_cast<double>(report.length.value().largest));
    };
    return [work] { return measure_in_child(work); };
}

/// What all ratios are taken to: the mesh of keys that are in order and differ.
std::function<Measured()> delaunay(const Points& points) {
    const Work work = [&points](Meter& meter) {
        const tinwright::SampleVertices vertices = tinwright::make_sample_vertices(points);
        meter.start();
        tbb::task_arena(1).execute([&] {
            const TriangleMesh mesh = tinwright::make_delaunay(vertices.keys);
            meter.stop();
            meter.note(static_cast<double>(mesh.slot_count()));
        });
    };
    return [work] { return measure_in_child(work); };
}

using MakeGraph = std::function<std::vector<GraphEdge>(const TriangleMesh&, Keys)>;

/// A graph from the Delaunay mesh at hand to its edges. Notes their number.
std::function<Measured()> graph(const Points& points, const MakeGraph& make, int threads) {
    const Work work = [&points, make, threads](Meter& meter) {
        const tinwright::SampleVertices vertices = tinwright::make_sample_vertices(points);
        const TriangleMesh mesh = tinwright::make_delaunay(vertices.keys);
        meter.start();
        tbb::task_arena(threads).execute([&] {
            const std::vector<GraphEdge> edges = make(mesh, vertices.keys);
            meter.stop();
            meter.note(static_cast<double>(edges.size()));
        });
    };
    return [work] { return measure_in_child(work); };
}

std::vector<GraphEdge> make_tree(const TriangleMesh& mesh, Keys keys) {
    return make_minimum_spanning_tree(mesh, keys);
}

/// Ratios to the mesh on one thread, and what two gain.
class Comparison {
  public:
    Comparison(std::string set, const Points& points)
        : set_(std::move(set)), points_(points), contenders_{delaunay(points)} {}

    void add_shortening(const std::string& name, Norm norm, std::optional<Target> target = std::nullopt,
                        const tinwright::DomainRule& domain = {}) {
        add("min-max length" + name, target,
            [&](int threads) { return shortening(points_, norm, threads, domain); });
    }
    void add_graph(const std::string& name, const MakeGraph& make) {
        add(name, std::nullopt, [&](int threads) { return graph(points_, make, threads); });
    }

    /// Returns the figures of the first that was added.
    Measured report(int rounds, ResultTable& table) const {
        const std::vector<Measured> results = measure_in_turn(contenders_, rounds);
        const Measured& base = results[0];
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const Measured& one = results[2 * i + 1];
            const Measured& two = results[2 * i + 2];
            const std::string name = set_ + ": " + rows_[i].name;
            table.add(name, in_seconds(one.cpu_seconds), in_seconds(base.cpu_seconds),
                      one.cpu_seconds / base.cpu_seconds, rows_[i].target);
            table.add(name + ", two threads to one", in_seconds(two.wall_seconds),
                      in_seconds(one.wall_seconds), one.wall_seconds / two.wall_seconds, std::nullopt, "x");
        }
        return results[1];
    }

  private:
    struct Row {
        std::string name;
        std::optional<Target> target;
    };

    template <class WithThreads>
    void add(const std::string& name, std::optional<Target> target, WithThreads with_threads) {
        rows_.push_back({name, target});
        contenders_.push_back(with_threads(1));
        contenders_.push_back(with_threads(2));
    }

    std::string set_;
    const Points& points_;
    std::vector<std::function<Measured()>> contenders_;
    std::vector<Row> rows_;
};

/// A domain without long border edges, so that polygons inside decide the longest edge.
tinwright::DomainRule dense_domain(const Points& points) {
    const auto by_x = std::minmax_element(points.begin(), points.end(),
                                          [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto by_y = std::minmax_element(points.begin(), points.end(),
                                          [](const auto& a, const auto& b) { return a.y < b.y; });
    const double area = (by_x.second->x - by_x.first->x) * (by_y.second->y - by_y.first->y);
    tinwright::DomainRule rule;
    rule.kind = tinwright::DomainRule::Kind::Concave;
    rule.length = 3 * std::sqrt(area / static_cast<double>(points.size()));
    return rule;
}

void measure_euclidean(const PointSet& set, std::size_t count, std::optional<Target> target, int rounds,
                       ResultTable& table) {
    const Points points = set.make(count);
    Comparison comparison(set.name, points);
    comparison.add_shortening("", Norm(), target);
    comparison.add_shortening(", no long border edges", Norm(), target, dense_domain(points));
    comparison.add_graph("minimum spanning tree", make_tree);
    comparison.add_graph("Gabriel graph", tinwright::make_gabriel_graph);
    comparison.add_graph("relative neighbourhood graph", [](const TriangleMesh& mesh, Keys keys) {
        return make_relative_neighborhood_graph(mesh, keys);
    });
    const Measured shortened = comparison.report(rounds, table);
    const double bytes = shortened.peak_bytes / static_cast<double>(points.size());
    table.add(set.name + ": memory of min-max length over the TIN", number(bytes) + " bytes a vertex", "",
              bytes, std::nullopt, " bytes");
    table.add(set.name + ": the largest polygon", "", "", shortened.note, std::nullopt, " sides");
}

void measure_norms(const PointSet& set, std::size_t count, int rounds, ResultTable& table) {
    const Points points = set.make(count);
    Comparison comparison(set.name, points);
    for (const Norm norm : {Norm::lp(1), Norm::maximum(), Norm::lp(3)}) {
        comparison.add_shortening(", " + norm_name(norm), norm);
        comparison.add_graph("relative neighbourhood graph, " + norm_name(norm),
                             [norm](const TriangleMesh& mesh, Keys keys) {
                                 return make_relative_neighborhood_graph(mesh, keys, norm);
                             });
    }
    comparison.report(rounds, table);
}

/// Ours and Boost's, each from its own Delaunay triangulation.
void compare_trees(const PointSet& set, std::size_t count, int rounds, ResultTable& table) {
    const Points points = set.make(count);
    std::vector<std::function<Measured()>> contenders{graph(points, make_tree, 1)};
    if (has_cgal()) {
        contenders.emplace_back([&points] {
            return measure_in_child([&points](Meter& meter) { measure_cgal_spanning_tree(points, meter); });
        });
    }
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    const double ours = results[0].cpu_seconds;
    const std::string name = set.name + ": minimum spanning tree, Boost's on " + cgal_name();
    if (has_cgal()) {
        const double theirs = results[1].cpu_seconds;
        table.add(name, in_seconds(ours), in_seconds(theirs), ours / theirs);
    } else {
        table.add(name, in_seconds(ours), "not built in", std::nullopt);
    }
}

constexpr std::array<double, 5> kGrowing{10'000, 31'623, 100'000, 316'228, 1'000'000};

}  // namespace

void run_length(const Settings& settings) {
    const std::array<PointSet, 4> sets{PointSet{"uniform", noisy_points}, PointSet{"scan rows", scan_points},
                                       PointSet{"grid", square_points}, PointSet{"clusters", cluster_points}};
    ResultTable table("Longest edges and graphs of 10^6 points, one thread", "`minimize_longest_edge`, graph",
                      "`make_delaunay`");
    for (const PointSet& set : sets) {
        const std::optional<Target> target = &set == sets.data() ? at_most(8) : std::nullopt;
        measure_euclidean(set, settings.count(1e6), target, settings.rounds, table);
    }
    for (const PointSet& set : {sets[0], sets[1], sets[2]}) {
        measure_norms(set, settings.count(1e6), settings.rounds, table);
    }
    measure_norms({"clusters, 10^4 points", cluster_points}, settings.count(1e4), settings.rounds, table);
    compare_trees(sets[0], settings.count(1e6), settings.rounds, table);
}

void run_length_growth(const Settings& settings) {
    const std::array<PointSet, 3> sets{PointSet{"uniform", fractal_points},
                                       PointSet{"scan rows", scan_points},
                                       PointSet{"clusters", cluster_points}};
    std::vector<std::size_t> counts;
    counts.reserve(kGrowing.size());
    for (const double full : kGrowing) {
        counts.push_back(static_cast<std::size_t>(std::max(100.0, std::round(full * settings.scale))));
    }
    GrowthTable table("CPU seconds, min-max length", counts, at_most(1.15));
    for (const PointSet& set : sets) {
        Growth growth{set.name, {}};
        for (const std::size_t count : counts) {
            const Points points = set.make(count);
            const std::function<Measured()> run = shortening(points, Norm(), 1);
            const Measured result = measure_in_turn(std::span(&run, 1), settings.rounds)[0];
            growth.steps.push_back({static_cast<double>(count), result.cpu_seconds});
        }
        table.add(growth);
    }
}

void run_length_worst(const Settings& settings) {
    const std::array<PointSet, 2> sets{PointSet{"two arcs", arc_points},
                                       PointSet{"one circle", circle_points}};
    ResultTable table("Huge polygons, one thread", "`minimize_longest_edge`", "largest polygon");
    for (const PointSet& set : sets) {
        Growth growth{set.name, {}};
        for (const double full : {1000, 2000, 4000, 8000, 16000}) {
            const Points points = set.make(static_cast<std::size_t>(std::max(200.0, full * settings.scale)));
            const std::function<Measured()> run = shortening(points, Norm(), 1);
            Measured result = run();
            if (result.cpu_seconds < kLongSeconds) {
                result = measure_in_turn(std::span(&run, 1), settings.rounds)[0];
            }
            const auto count = static_cast<double>(points.size());
            growth.steps.push_back({count, result.cpu_seconds});
            table.add(set.name + ": " + std::to_string(points.size()) + " points",
                      in_seconds(result.cpu_seconds),
                      std::to_string(static_cast<long>(result.note)) + " sides",
                      1e6 * result.cpu_seconds / count, std::nullopt, " us a point");
        }
        table.add(set.name + ": exponent of the growth", "", "", growth.exponent());
    }
}

}  // namespace tinwright_benchmarks
