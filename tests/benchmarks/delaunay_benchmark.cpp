#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/cgal_peer.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

struct PointSet {
    std::string name;
    std::function<Points()> make;
    double target;  // of the time CGAL takes
    int rounds;
};

Work triangulation(const Points& points, int threads) {
    return [&points, threads](Meter& meter) {
        tinwright::TriangulateOptions options;
        options.threads = threads;
        meter.start();
        const tinwright::Triangulated made = tinwright::triangulate(points, options);
        meter.stop();
        meter.note(static_cast<double>(made.report.faces));
    };
}

/// Lattice, order, duplicates and mesh: what CGAL does too, and the rest of `triangulate` left out.
Work kernel(const Points& points, int threads) {
    return [&points, threads](Meter& meter) {
        meter.start();
        tbb::task_arena(threads).execute([&] {
            const tinwright::SampleVertices vertices = tinwright::make_sample_vertices(points);
            const tinwright::TriangleMesh mesh = tinwright::make_delaunay(vertices.keys);
            meter.stop();
            meter.note(static_cast<double>(mesh.slot_count()));
        });
    };
}

void measure_set(const PointSet& set, ResultTable& table) {
    const Points points = set.make();
    const auto in_child = [](Work work) {
        return [work = std::move(work)] { return measure_in_child(work); };
    };
    std::vector<std::function<Measured()>> contenders{
        in_child(triangulation(points, 1)), in_child(kernel(points, 1)), in_child(triangulation(points, 2)),
        in_child(kernel(points, 2))};
    if (has_cgal()) {
        contenders.push_back(in_child([&](Meter& meter) { measure_cgal(points, meter); }));
    }
    const std::vector<Measured> results = measure_in_turn(contenders, set.rounds);
    const Measured& whole = results[0];
    const Measured& core = results[1];
    const Measured& whole_2 = results[2];
    const Measured& core_2 = results[3];
    const auto count = static_cast<double>(points.size());

    std::string peer = "not built in";
    std::string peer_peak = peer;
    std::optional<double> core_ratio;
    std::optional<double> whole_ratio;
    if (has_cgal()) {
        const Measured& cgal = results[4];
        peer = in_seconds(cgal.cpu_seconds);
        peer_peak = number(cgal.peak_bytes / count) + " bytes";
        core_ratio = core.cpu_seconds / cgal.cpu_seconds;
        whole_ratio = whole.cpu_seconds / cgal.cpu_seconds;
        // Needles along straight hulls differ: rows of decimals are straight for one of the two only.
        if (std::fabs(whole.note - cgal.note) > 1e-3 * cgal.note) {
            throw std::runtime_error(set.name + ": " + std::to_string(whole.note) + " faces, CGAL has " +
                                     std::to_string(cgal.note));
        }
    }
    table.add(set.name + ": lattice, order, Delaunay", in_seconds(core.cpu_seconds), peer, core_ratio,
              at_most(set.target));
    table.add(set.name + ": `triangulate`", in_seconds(whole.cpu_seconds), peer, whole_ratio,
              at_most(set.target));
    table.add(set.name + ": the same, two threads to one", in_seconds(whole_2.wall_seconds),
              in_seconds(whole.wall_seconds), whole.wall_seconds / whole_2.wall_seconds, at_least(1.6), "x");
    table.add(set.name + ": lattice, order, Delaunay, two threads to one", in_seconds(core_2.wall_seconds),
              in_seconds(core.wall_seconds), core.wall_seconds / core_2.wall_seconds, at_least(1.6), "x");
    const double peak = std::max(whole.peak_bytes, whole_2.peak_bytes) / count;
    table.add(set.name + ": peak memory of `triangulate` a point", number(peak) + " bytes", peer_peak, peak,
              at_most(110), " bytes");
}

}  // namespace

void run_delaunay(const Settings& settings) {
    const std::size_t million = settings.count(1e6);
    const int side = settings.side(1000);
    const int rounds = settings.rounds;
    const std::array<PointSet, 5> sets{
        PointSet{"10^6 uniform", [&] { return uniform_points(million); }, 0.45, rounds},
        PointSet{"10^6 scan rows", [&] { return scan_points(million); }, 0.45, rounds},
        PointSet{"1000 x 1000 grid, by rows", [&] { return grid_points(side, false); }, 0.25, rounds},
        PointSet{"1000 x 1000 grid, shuffled", [&] { return grid_points(side, true); }, 0.25, rounds},
        PointSet{"10^7 uniform", [&] { return uniform_points(settings.count(1e7)); }, 0.50,
                 std::min(rounds, 3)}};
    ResultTable table("Delaunay triangulation", "tinwright", cgal_name());
    for (const PointSet& set : sets) {
        measure_set(set, table);
    }
}

}  // namespace tinwright_benchmarks
