#ifndef TINWRIGHT_TESTS_WATER_RIVER_SETS_HPP
#define TINWRIGHT_TESTS_WATER_RIVER_SETS_HPP

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "support/point_sets.hpp"

namespace tinwright_tests {

/// Rivers that wander over a terrain of random samples: bends within a cell and far, along edges of cells and
/// through corners, out of the raster and back, meeting and dividing at each other's points; z never rises
/// downstream, some reaches are level.
struct Rivers {
    tinwright::Tin tin;
    std::vector<bool> is_river_line;
};

inline std::vector<tinwright::Breakline> wandering_rivers(Random& random, double unit) {
    std::vector<tinwright::Breakline> lines;
    const auto at = [&](std::int64_t i) { return unit * static_cast<double>(i); };
    for (std::int64_t count = random.integer(1, 4); count > 0; --count) {
        tinwright::Breakline river;
        river.role = tinwright::LineRole::River;
        std::int64_t x = random.integer(-20, 100);
        std::int64_t y = random.integer(-20, 100);
        double z = 50 + static_cast<double>(random.integer(0, 20));
        if (!lines.empty() && random.integer(0, 1) == 0) {  // leaves another one
            const tinwright::Breakline& other = lines[static_cast<std::size_t>(
                random.integer(0, static_cast<std::int64_t>(lines.size()) - 1))];
            const tinwright::Point3 from = other.points[static_cast<std::size_t>(
                random.integer(0, static_cast<std::int64_t>(other.points.size()) - 1))];
            x = static_cast<std::int64_t>(std::lround(from.x / unit));
            y = static_cast<std::int64_t>(std::lround(from.y / unit));
            z = from.z;
        }
        const std::int64_t stride = random.integer(1, 30);
        for (std::int64_t i = random.integer(2, 25); i > 0; --i) {
            river.points.push_back({at(x), at(y), z});
            const std::int64_t turn = random.integer(0, 3);
            x += turn == 0 ? 0 : random.integer(-stride / 2, stride);
            y += turn == 1 ? 0 : turn == 2 ? 4 * random.integer(-3, 3) : random.integer(-stride, stride);
            z -= random.integer(0, 2) == 0 ? 0 : 0.37 * random.real();
        }
        lines.push_back(river);
    }
    return lines;
}

inline Rivers make_rivers(Random& random, double unit) {
    std::vector<tinwright::Breakline> lines = wandering_rivers(random, unit);
    std::vector<tinwright::Point3> samples;
    for (int i = 0; i < 60; ++i) {
        samples.push_back({unit * static_cast<double>(random.integer(-60, 160)),
                           unit * static_cast<double>(random.integer(-60, 160)),
                           80 + static_cast<double>(random.integer(0, 1000)) / 100});
    }
    tinwright::TriangulateOptions options;
    options.duplicates.policy = tinwright::DuplicatePolicy::Min;
    options.noding.crossing_z = tinwright::CrossingPolicy::Min;
    options.noding.crossing_tolerance = 0;
    Rivers made;
    made.tin = triangulate(samples, lines, options).tin;
    made.is_river_line.assign(lines.size(), true);
    return made;
}

/// Edges that rivers run along, from the higher to the lower end; level ones both ways.
inline std::vector<std::pair<tinwright::VertexId, tinwright::VertexId>> falls_of(const Rivers& rivers) {
    std::vector<std::pair<tinwright::VertexId, tinwright::VertexId>> falls;
    for (const tinwright::LineTrace& trace : rivers.tin.traces) {
        if (rivers.is_river_line[trace.line]) {
            const double z_a = rivers.tin.z[trace.a.value];
            const double z_b = rivers.tin.z[trace.b.value];
            if (z_a >= z_b) {
                falls.emplace_back(trace.a, trace.b);
            }
            if (z_b >= z_a) {
                falls.emplace_back(trace.b, trace.a);
            }
        }
    }
    return falls;
}

}  // namespace tinwright_tests

#endif
