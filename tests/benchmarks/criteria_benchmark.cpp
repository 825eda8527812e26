#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/optimal/optimize.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/growth.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/terrain_points.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::Criterion;
using tinwright::OptimizeOptions;
using tinwright::Scope;

constexpr Scope kMax{Scope::Kind::Max, 0};
constexpr Scope kTop{Scope::Kind::Top, 0.5};
constexpr Scope kVector{Scope::Kind::Vector, 0};
/// A run that takes longer is stopped and not counted.
constexpr double kBudgetSeconds = 60;
/// A run that takes longer is not repeated to know how it grows.
constexpr double kLongSeconds = 5;

std::string name_of(Criterion criterion) { return std::string(criterion_traits(criterion).name); }

struct PointSet {
    std::string name;
    std::function<Points(std::size_t)> make;
};

/// `optimize` of the Delaunay TIN of `points`, which is made before the measurement starts. Notes the number
/// of vertices, 0 if it was stopped.
std::function<Measured()> optimization(const Points& points, Criterion criterion, Scope scope) {
    const Work work = [&points, criterion, scope](Meter& meter) {
        tinwright::Triangulated made = tinwright::triangulate(points);
        OptimizeOptions options;
        options.criterion = criterion;
        options.scope = scope;
        options.budget_seconds = kBudgetSeconds;
        tinwright::OptimizeReport report;
        meter.start();
        tbb::task_arena(1).execute([&] { report = tinwright::optimize(made.tin, options); });
        meter.stop();
        const bool is_finished = report.stopped_by == tinwright::StoppedBy::Finished;
        meter.note(is_finished ? static_cast<double>(made.tin.vertex_count()) : 0);
    };
    return [work] { return measure_in_child(work); };
}

/// What all ratios are taken to: lattice, order, duplicates and Delaunay mesh on one thread.
std::function<Measured()> delaunay(const Points& points) {
    const Work work = [&points](Meter& meter) {
        meter.start();
        tbb::task_arena(1).execute([&] {
            const tinwright::SampleVertices vertices = tinwright::make_sample_vertices(points);
            const tinwright::TriangleMesh mesh = tinwright::make_delaunay(vertices.keys);
            meter.stop();
            meter.note(static_cast<double>(mesh.slot_count()));
        });
    };
    return [work] { return measure_in_child(work); };
}

struct Row {
    Criterion criterion;
    Scope scope;
    const char* scope_name;
    std::optional<Target> target;  ///< of the time our Delaunay takes
};

std::vector<Row> rows() {
    constexpr std::array kVectorTargets{std::pair(Criterion::Angle, 8), std::pair(Criterion::Height, 14),
                                        std::pair(Criterion::Slope, 40),
                                        std::pair(Criterion::Eccentricity, 40)};
    std::vector<Row> all;
    for (const auto& [criterion, target] : kVectorTargets) {
        const bool is_strong = criterion_traits(criterion).condition == tinwright::InsertionCondition::Strong;
        all.push_back({criterion, kVector, "vector", at_most(target)});
        all.push_back({criterion, kTop, "top:0.5%", at_most(3)});
        all.push_back({criterion, kMax, "max", is_strong ? at_most(1.5) : std::nullopt});
    }
    return all;
}

void measure_set(const std::string& name, const Points& points, int rounds, ResultTable& table) {
    const std::vector<Row> all = rows();
    std::vector<std::function<Measured()>> contenders{delaunay(points)};
    for (const Row& row : all) {
        contenders.push_back(optimization(points, row.criterion, row.scope));
    }
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    const Measured& base = results[0];
    double most_bytes = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Measured& result = results[i + 1];
        table.add(name + ": " + name_of(all[i].criterion) + ", " + all[i].scope_name,
                  in_seconds(result.cpu_seconds), in_seconds(base.cpu_seconds),
                  result.note > 0 ? std::optional(result.cpu_seconds / base.cpu_seconds) : std::nullopt,
                  all[i].target);
        most_bytes = std::max(most_bytes, result.peak_bytes);
    }
    const double bytes = most_bytes / static_cast<double>(points.size());
    table.add(name + ": memory over the TIN, the most of all", number(bytes) + " bytes a vertex", "", bytes,
              at_most(120), " bytes");
}

/// CPU seconds for each number of points; stops at the first that takes too long.
Growth measure_growth(const std::string& name, const PointSet& set, std::span<const std::size_t> counts,
                      Criterion criterion, Scope scope, int rounds) {
    Growth growth{name, {}};
    for (const std::size_t count : counts) {
        const Points points = set.make(count);
        const std::function<Measured()> run = optimization(points, criterion, scope);
        Measured result = run();
        if (result.note > 0 && result.cpu_seconds < kLongSeconds) {
            result = measure_in_turn(std::span(&run, 1), rounds)[0];
        }
        if (!(result.note > 0)) {
            break;
        }
        growth.steps.push_back({result.note, result.cpu_seconds});
    }
    return growth;
}

std::vector<std::size_t> sizes(const Settings& settings, std::initializer_list<double> full) {
    std::vector<std::size_t> counts;
    std::transform(full.begin(), full.end(), std::back_inserter(counts), [&](double count) {
        return static_cast<std::size_t>(std::max(100.0, std::round(count * settings.scale)));
    });
    return counts;
}

}  // namespace

void run_criteria(const Settings& settings) {
    const std::array<PointSet, 3> sets{PointSet{"uniform", noisy_points}, PointSet{"scan rows", scan_points},
                                       PointSet{"fractal", fractal_points}};
    ResultTable table("Optimising the Delaunay TIN of 10^6 points, one thread", "`optimize`", "our Delaunay");
    for (const PointSet& set : sets) {
        measure_set(set.name, set.make(settings.count(1e6)), settings.rounds, table);
    }
}

void run_criteria_growth(const Settings& settings) {
    const std::array<PointSet, 2> sets{PointSet{"fractal", fractal_points},
                                       PointSet{"scan rows", scan_points}};
    const std::vector<std::size_t> counts = sizes(settings, {10'000, 31'623, 100'000, 316'228, 1'000'000});
    GrowthTable table("CPU seconds, scope vector", counts, at_most(1.15));
    std::vector<Growth> curves;
    for (const PointSet& set : sets) {
        for (const Criterion criterion : tinwright::kInsertionCriteria) {
            const std::string name = name_of(criterion) + ", " + set.name;
            curves.push_back(measure_growth(name, set, counts, criterion, kVector, settings.rounds));
            table.add(curves.back());
        }
    }
    if (!settings.images.empty()) {
        plot_growth(settings.images + "/criteria_growth.svg", curves);
    }
}

void run_criteria_worst(const Settings& settings) {
    struct Hard {
        PointSet set;
        double largest;
    };
    const std::array<Hard, 6> sets{Hard{{"circle", circle_points}, 8'000},
                                   Hard{{"convex position", convex_points}, 8'000},
                                   Hard{{"plain with a cliff", cliff_points}, 400'000},
                                   Hard{{"sea level", sea_points}, 400'000},
                                   Hard{{"facing rows", facing_points}, 32'000},
                                   Hard{{"grid", square_points}, 400'000}};
    GrowthTable table("CPU seconds, scope vector", 4);
    for (const Hard& hard : sets) {
        const std::vector<std::size_t> counts =
            sizes(settings, {hard.largest / 8, hard.largest / 4, hard.largest / 2, hard.largest});
        for (const Criterion criterion : tinwright::kInsertionCriteria) {
            table.add(measure_growth(hard.set.name + ": " + name_of(criterion), hard.set, counts, criterion,
                                     kVector, settings.rounds));
        }
    }
}

}  // namespace tinwright_benchmarks
