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
/// of the largest polygon.
std::function<Measured()> shortening(const Points& points, Norm norm, int threads) {
    const Work work = [&points, norm, threads](Meter& meter) {
        tinwright::TriangulateOptions how;
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
std::function<Measured()> delaunay(const Points& points, int threads) {
    const Work work = [&points, threads](Meter& meter) {
        const tinwright::SampleVertices vertices = tinwright::make_sample_vertices(points);
        meter.start();
        tbb::task_arena(threads).execute([&] {
            const TriangleMesh mesh = tinwright::make_delaunay(vertices.keys);
            meter.stop();
            meter.note(static_cast<double>(mesh.slot_count()));
        });
    };
    return [work] { return measure_in_child(work); };
}

using MakeGraph = std::vector<GraphEdge> (*)(const TriangleMesh&, Keys);

std::vector<GraphEdge> make_tree(const TriangleMesh& mesh, Keys keys) {
    return make_minimum_spanning_tree(mesh, keys);
}
template <int P>
std::vector<GraphEdge> make_relative(const TriangleMesh& mesh, Keys keys) {
    const Norm norm = P > 0 ? Norm::lp(std::max(P, 1)) : Norm::maximum();
    return make_relative_neighborhood_graph(mesh, keys, norm);
}

struct Graph {
    const char* name;
    MakeGraph make;
};
constexpr std::array kGraphs{Graph{"minimum spanning tree", make_tree},
                             Graph{"Gabriel graph", tinwright::make_gabriel_graph},
                             Graph{"relative neighbourhood graph", make_relative<2>},
                             Graph{"the same, l1", make_relative<1>},
                             Graph{"the same, linf", make_relative<0>},
                             Graph{"the same, lp:3", make_relative<3>}};

/// A graph from the Delaunay mesh at hand to its edges. Notes their number.
std::function<Measured()> graph(const Points& points, MakeGraph make, int threads) {
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

/// One thread for the ratio to the mesh, two for what they gain.
class Comparison {
  public:
    Comparison(std::string set, const Points& points)
        : set_(std::move(set)), points_(points), contenders_{delaunay(points, 1)} {}

    void add(std::string name, const std::function<std::function<Measured()>(int)>& with_threads,
             std::optional<Target> target = std::nullopt) {
        rows_.push_back({std::move(name), target});
        contenders_.push_back(with_threads(1));
        contenders_.push_back(with_threads(2));
    }

    void report(int rounds, ResultTable& table) const {
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
        // The first row is the optimum itself.
        const double bytes = results[1].peak_bytes / static_cast<double>(points_.size());
        table.add(set_ + ": memory of min-max length over the TIN", number(bytes) + " bytes a vertex", "",
                  bytes, std::nullopt, " bytes");
        table.add(set_ + ": sides of the largest polygon", number(results[1].note), "", std::nullopt);
    }

  private:
    struct Row {
        std::string name;
        std::optional<Target> target;
    };
    std::string set_;
    const Points& points_;
    std::vector<std::function<Measured()>> contenders_;
    std::vector<Row> rows_;
};

void measure_set(const PointSet& set, std::size_t count, std::optional<Target> target, int rounds,
                 ResultTable& table) {
    const Points points = set.make(count);
    Comparison comparison(set.name, points);
    const std::array<std::pair<std::string, Norm>, 4> norms{{{"min-max length", Norm()},
                                                             {"min-max length, l1", Norm::lp(1)},
                                                             {"min-max length, linf", Norm::maximum()},
                                                             {"min-max length, lp:3", Norm::lp(3)}}};
    for (const auto& [name, norm] : norms) {
        comparison.add(
            name, [&points, norm = norm](int threads) { return shortening(points, norm, threads); },
            norm.is_euclidean() ? target : std::nullopt);
    }
    for (const Graph& one : kGraphs) {
        comparison.add(one.name,
                       [&points, make = one.make](int threads) { return graph(points, make, threads); });
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
        measure_set(set, settings.count(1e6), target, settings.rounds, table);
    }
    compare_trees(sets[0], settings.count(1e6), settings.rounds, table);
}

void run_length_growth(const Settings& settings) {
    const std::array<PointSet, 3> sets{PointSet{"uniform", fractal_points},
                                       PointSet{"scan rows", scan_points},
                                       PointSet{"clusters", cluster_points}};
    std::vector<std::size_t> counts;
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
    const std::array<PointSet, 3> sets{PointSet{"two arcs", arc_points}, PointSet{"two circles", ring_points},
                                       PointSet{"one circle", circle_points}};
    ResultTable table("Huge polygons, one thread", "`minimize_longest_edge`", "largest polygon");
    for (const PointSet& set : sets) {
        Growth growth{set.name, {}};
        for (const double full : {1000, 2000, 4000, 8000, 16000}) {
            const Points points = set.make(static_cast<std::size_t>(std::max(100.0, full * settings.scale)));
            const std::function<Measured()> run = shortening(points, Norm(), 1);
            Measured result = run();
            if (result.cpu_seconds < kLongSeconds) {
                result = measure_in_turn(std::span(&run, 1), settings.rounds)[0];
            }
            growth.steps.push_back({static_cast<double>(points.size()), result.cpu_seconds});
            table.add(set.name + ": " + std::to_string(points.size()) + " points",
                      in_seconds(result.cpu_seconds), number(result.note) + " sides", std::nullopt);
        }
        table.add(set.name + ": exponent of the growth", "", "", growth.exponent());
    }
}

}  // namespace tinwright_benchmarks
