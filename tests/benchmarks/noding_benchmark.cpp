#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "tinwright/breaklines/noding.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/geos_peer.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/report.hpp"
#include "support/line_sets.hpp"

namespace tinwright_benchmarks {

namespace {

using Lines = std::vector<tinwright::Breakline>;
using tinwright_tests::Random;

constexpr double kWide = 1e7;  // centimetres

tinwright::Point3 point_at(double x, double y) {
    return tinwright_tests::survey_point(std::llround(x), std::llround(y));
}

/// Lines of `segments` segments each, `count` segments in all, at random places and in random directions;
/// each segment is crossed by about `crossings` others, if the lines are straight.
Lines random_lines(std::size_t count, std::size_t segments, double crossings) {
    Random random(1);
    const double step = kWide * std::sqrt(crossings * std::numbers::pi / 2 / static_cast<double>(count));
    Lines lines;
    for (std::size_t made = 0; made < count; made += segments) {
        double x = kWide * random.real();
        double y = kWide * random.real();
        double direction = 2 * std::numbers::pi * random.real();
        tinwright::Breakline line;
        line.points.push_back(point_at(x, y));
        for (std::size_t i = 0; i < segments; ++i) {
            x += step * std::cos(direction);
            y += step * std::sin(direction);
            line.points.push_back(point_at(x, y));
            direction += random.real() - 0.5;
        }
        lines.push_back(line);
    }
    return lines;
}

Lines long_among_short(std::size_t count) {
    Lines lines = random_lines(count, 1, 2);
    Random random(2);
    for (std::size_t i = 0; i < count / 1000; ++i) {
        tinwright::Breakline line;
        line.points = {point_at(kWide * random.real(), kWide * random.real()),
                       point_at(kWide * random.real(), kWide * random.real())};
        lines.push_back(line);
    }
    return lines;
}

/// Wavy rings inside each other, which do not meet.
Lines contours(std::size_t count) {
    constexpr std::size_t kCorners = 1000;
    Lines lines;
    for (std::size_t ring = 0; ring < count / kCorners; ++ring) {
        const double radius = 1e5 + 2000 * static_cast<double>(ring);
        tinwright::Breakline line;
        for (std::size_t i = 0; i < kCorners; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCorners;
            const double wave = radius * (1 + 0.2 * std::sin(9 * angle));
            line.points.push_back(point_at(wave * std::cos(angle), wave * std::sin(angle)));
        }
        line.points.push_back(line.points.front());
        lines.push_back(line);
    }
    return lines;
}

struct LineSet {
    std::string name;
    std::function<Lines()> make;
    bool are_segments;             // then both count the same parts
    std::optional<Target> target;  // of the time GEOS takes
};

/// From lines in CRS units to vertices, elevations, pieces and conflicts.
Work noding(const Lines& lines, int threads) {
    return [&lines, threads](Meter& meter) {
        meter.start();
        tbb::task_arena(threads).execute([&] {
            std::vector<tinwright::Point3> points;
            for (const tinwright::Breakline& line : lines) {
                points.insert(points.end(), line.points.begin(), line.points.end());
            }
            const tinwright::Lattice lattice = tinwright::find_lattice({}, points).lattice;
            const tinwright::NodedLines noded =
                tinwright::node_lines(lines, lattice.refined(tinwright::kRefinementBits));
            meter.stop();
            meter.note(static_cast<double>(noded.pieces.size()));
        });
    };
}

void measure_set(const LineSet& set, int rounds, ResultTable& table) {
    const Lines lines = set.make();
    const auto in_child = [](Work work) {
        return [work = std::move(work)] { return measure_in_child(work); };
    };
    std::vector<std::function<Measured()>> contenders{in_child(noding(lines, 1)), in_child(noding(lines, 2))};
    if (has_geos()) {
        contenders.emplace_back(in_child([&](Meter& meter) { measure_geos_noding(lines, meter); }));
    }
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    const Measured& one = results[0];
    const Measured& two = results[1];
    std::string peer = "not built in";
    std::optional<double> ratio;
    if (has_geos()) {
        const Measured& geos = results[2];
        peer = in_seconds(geos.cpu_seconds);
        ratio = one.cpu_seconds / geos.cpu_seconds;
        if (set.are_segments && std::fabs(one.note - geos.note) > 1e-3 * geos.note) {
            throw std::runtime_error(set.name + ": " + std::to_string(one.note) + " pieces, GEOS has " +
                                     std::to_string(geos.note));
        }
    }
    table.add(set.name + ", " + std::to_string(static_cast<std::size_t>(one.note)) + " pieces",
              in_seconds(one.cpu_seconds), peer, ratio, set.target);
    table.add(set.name + ": two threads to one", in_seconds(two.wall_seconds), in_seconds(one.wall_seconds),
              one.wall_seconds / two.wall_seconds, std::nullopt, "x");
}

}  // namespace

void run_noding(const Settings& settings) {
    const std::size_t count = settings.count(1e5);
    const std::array<LineSet, 4> sets{
        LineSet{"10^5 segments, ten crossings each", [&] { return random_lines(count, 1, 10); }, true,
                at_most(0.5)},
        LineSet{"5000 polylines of 20 segments", [&] { return random_lines(count, 20, 4); }, false,
                at_most(0.5)},
        LineSet{"10^5 short segments and 100 long ones", [&] { return long_among_short(count); }, true,
                at_most(0.5)},
        LineSet{"contours of 10^5 segments, no crossings", [&] { return contours(count); }, false,
                std::nullopt}};
    ResultTable table("Noding", "tinwright", geos_name());
    for (const LineSet& set : sets) {
        measure_set(set, settings.rounds, table);
    }
}

}  // namespace tinwright_benchmarks
