#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/delaunay/conforming_delaunay.hpp"
#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/cgal_peer.hpp"
#include "benchmarks/line_terrains.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::Breakline;
using tinwright::ConformingMethod;
using tinwright::Point3;

// Samples may lie at one place, and on lines.
constexpr tinwright::DuplicateOptions kDuplicates{.policy = tinwright::DuplicatePolicy::Mean};

tinwright::ConstrainedTin make_tin(const LineTerrain& terrain, bool wants_fine_lattice) {
    tinwright::ConstrainedTinOptions options;
    options.duplicates = kDuplicates;
    options.wants_fine_lattice = wants_fine_lattice;
    return tinwright::make_constrained_tin(terrain.samples, terrain.lines, options);
}

/// Points of lines at one location become one.
Network make_network(const LineTerrain& terrain) {
    Network network{terrain.samples, {}};
    std::map<std::pair<double, double>, std::uint32_t> numbers;
    for (const Breakline& line : terrain.lines) {
        std::optional<std::uint32_t> from;
        for (const Point3& p : line.points) {
            const auto [at, is_new] =
                numbers.try_emplace({p.x, p.y}, static_cast<std::uint32_t>(network.points.size()));
            if (is_new) {
                network.points.push_back(p);
            }
            if (from && *from != at->second) {
                network.segments.emplace_back(*from, at->second);
            }
            from = at->second;
        }
    }
    return network;
}

std::function<Measured()> in_child(Work work) {
    return [work = std::move(work)] { return measure_in_child(work); };
}

std::string count_text(double count) { return number(std::round(count)); }

/// Lattice, order, noding, Delaunay mesh, segments: what CGAL does too, but for the noding.
Work constrained(const LineTerrain& terrain, int threads) {
    return [&terrain, threads](Meter& meter) {
        meter.start();
        tbb::task_arena(threads).execute([&] {
            const tinwright::ConstrainedTin made = make_tin(terrain, false);
            meter.stop();
            meter.note(static_cast<double>(made.tin.mesh.count_terrain()));
        });
    };
}

Work triangulation(const LineTerrain& terrain, int threads) {
    return [&terrain, threads](Meter& meter) {
        tinwright::TriangulateOptions options;
        options.duplicates = kDuplicates;
        options.threads = threads;
        meter.start();
        const tinwright::Triangulated made = tinwright::triangulate(terrain.samples, terrain.lines, options);
        meter.stop();
        meter.note(static_cast<double>(made.report.faces));
    };
}

/// `make_conforming` on a constrained TIN that is made before. Notes the number of Steiner points.
Work conforming(const LineTerrain& terrain, ConformingMethod method) {
    return [&terrain, method](Meter& meter) {
        tbb::task_arena(1).execute([&] {
            tinwright::ConstrainedTin made = make_tin(terrain, true);
            tinwright::ConformingOptions options;
            options.method = method;
            meter.start();
            const tinwright::ConformingReport report = tinwright::make_conforming(made.tin, options);
            meter.stop();
            if (!report.is_conforming) {
                throw std::runtime_error("the triangulation does not conform to " +
                                         std::to_string(report.open_edges) + " edges");
            }
            meter.note(static_cast<double>(report.steiner_vertices));
        });
    };
}

void measure_constrained(const std::string& name, const LineTerrain& terrain, std::optional<Target> target,
                         int rounds, ResultTable& table) {
    const Network network = make_network(terrain);
    std::vector<std::function<Measured()>> contenders{
        in_child(constrained(terrain, 1)), in_child(constrained(terrain, 2)),
        in_child(triangulation(terrain, 1)), in_child(triangulation(terrain, 2))};
    if (has_cgal()) {
        contenders.push_back(in_child([&](Meter& meter) { measure_cgal_constrained(network, meter); }));
    }
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    std::string peer = "not built in";
    std::string peer_peak = peer;
    double peer_seconds = 0;
    const auto vertices = static_cast<double>(network.points.size());
    if (has_cgal()) {
        peer_seconds = results[4].cpu_seconds;
        peer = in_seconds(peer_seconds);
        peer_peak = number(results[4].peak_bytes / vertices) + " bytes";
        if (std::fabs(results[0].note - results[4].note) > 1e-3 * results[4].note) {
            throw std::runtime_error(name + ": " + std::to_string(results[0].note) + " faces, CGAL has " +
                                     std::to_string(results[4].note));
        }
    }
    const std::array names{"lattice, order, noding, Delaunay, segments", "`triangulate`"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Measured& one = results[2 * i];
        const Measured& two = results[2 * i + 1];
        const std::string what = name + ": " + names[i];
        table.add(what, in_seconds(one.cpu_seconds), peer,
                  has_cgal() ? std::optional(one.cpu_seconds / peer_seconds) : std::nullopt, target);
        table.add(what + ", two threads to one", in_seconds(two.wall_seconds), in_seconds(one.wall_seconds),
                  one.wall_seconds / two.wall_seconds, std::nullopt, "x");
    }
    const double peak = std::max(results[2].peak_bytes, results[3].peak_bytes) / vertices;
    table.add(name + ": peak memory of `triangulate` a vertex", number(peak) + " bytes", peer_peak, peak,
              std::nullopt, " bytes");
}

struct ConformingSet {
    std::string name;
    std::function<LineTerrain()> make;
    double steiner_target;  // of the points that CGAL adds
    std::optional<Target> time_target;
};

void measure_conforming(const ConformingSet& set, int rounds, ResultTable& table) {
    const LineTerrain terrain = set.make();
    const Network network = make_network(terrain);
    std::vector<std::function<Measured()>> contenders{in_child(conforming(terrain, ConformingMethod::Split))};
    if (has_cgal()) {
        contenders.push_back(in_child([&](Meter& meter) { measure_cgal_conforming(network, meter); }));
    }
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    const Measured blocking = measure_in_child(conforming(terrain, ConformingMethod::Blocking));
    std::string peer_count = "not built in";
    std::string peer_time = peer_count;
    const auto ratio_to_cgal = [&](const Measured& ours, double Measured::*figure) {
        return has_cgal() && results[1].*figure > 0 ? std::optional(ours.*figure / (results[1].*figure))
                                                    : std::nullopt;
    };
    if (has_cgal()) {
        peer_count = count_text(results[1].note);
        peer_time = in_seconds(results[1].cpu_seconds);
    }
    const Measured& split = results[0];
    table.add(set.name + ": Steiner points", count_text(split.note), peer_count,
              ratio_to_cgal(split, &Measured::note), at_most(set.steiner_target));
    table.add(set.name + ": Steiner points, `blocking`", count_text(blocking.note), peer_count,
              ratio_to_cgal(blocking, &Measured::note));
    table.add(set.name + ": time", in_seconds(split.cpu_seconds), peer_time,
              ratio_to_cgal(split, &Measured::cpu_seconds), set.time_target);
    table.add(set.name + ": time, `blocking`", in_seconds(blocking.cpu_seconds), peer_time,
              ratio_to_cgal(blocking, &Measured::cpu_seconds));
}

/// A number of rings, fans, edges: no less than it takes to be something like the whole.
std::size_t part_of(double full, double scale) {
    return static_cast<std::size_t>(std::max(4.0, std::round(full * scale)));
}

}  // namespace

void run_constrained(const Settings& settings) {
    ResultTable table("Constrained Delaunay triangulation", "tinwright", cgal_name());
    measure_constrained("10^6 samples, 10^4 lines of 20 segments", samples_and_lines(settings.count(1e6)),
                        at_most(0.5), settings.rounds, table);
    measure_constrained("contours 5 m apart, 10^6 vertices",
                        contours(part_of(348, std::sqrt(settings.scale)), 5, 2), std::nullopt,
                        settings.rounds, table);
}

void run_conforming(const Settings& settings) {
    const double scale = settings.scale;
    const std::vector<ConformingSet> sets{
        {"10^6 samples, 10^4 lines of 20 segments", [&] { return samples_and_lines(settings.count(1e6)); },
         1.03, at_most(0.5)},
        {"contours 5 m apart, a vertex every 10 m",
         [&] { return contours(part_of(100, std::sqrt(scale)), 5, 10); }, 1.03, std::nullopt},
        {"contours 0.3 m apart, a vertex every 2 m", [&] { return contours(part_of(100, scale), 0.3, 2); },
         1.03, std::nullopt},
        {"contours 0.3 m apart, irregular vertices", [&] { return irregular_contours(part_of(60, scale)); },
         1.03, std::nullopt},
        {"2000 fans of six segments, 1 to 9 degrees", [&] { return sharp_fans(part_of(2000, scale)); }, 0.5,
         std::nullopt},
        {"60 close parallel edges, 60 pairs of samples",
         [&] { return close_parallel_edges(part_of(60, std::sqrt(scale)), part_of(60, std::sqrt(scale))); },
         0.15, std::nullopt}};
    ResultTable table("Conforming Delaunay triangulation, one thread", "`split` or `blocking`", cgal_name());
    for (const ConformingSet& set : sets) {
        measure_conforming(set, settings.rounds, table);
    }
}

}  // namespace tinwright_benchmarks
