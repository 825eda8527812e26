#include "benchmarks/line_terrains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

using tinwright::Breakline;
using tinwright::Point3;
using tinwright_tests::Random;

namespace {

double to_centimetres(double value) { return std::round(value * 100) / 100; }

/// A place to the centimetre, on a slanting plane.
Point3 place(double x, double y) {
    const double x_cm = to_centimetres(x);
    const double y_cm = to_centimetres(y);
    return {x_cm, y_cm, 0.03 * x_cm + 0.01 * y_cm};
}

double between(Random& random, double low, double high) { return low + (high - low) * random.real(); }

/// Distance of a contour from the hill's top, in the direction `angle`, where it is `mean` on average.
double contour_radius(double mean, double angle) {
    return mean + 3 * std::sin(5 * angle) + 2 * std::sin(9 * angle + 1);
}

Point3 on_contour(double mean, double angle) {
    const double radius = contour_radius(mean, angle);
    return place(5000 + radius * std::cos(angle), 5000 + radius * std::sin(angle));
}

void close(Breakline& ring) { ring.points.push_back(ring.points.front()); }

}  // namespace

LineTerrain samples_and_lines(std::size_t samples) {
    constexpr int kSegments = 20;
    Random random(21);
    LineTerrain terrain;
    const double width = std::sqrt(static_cast<double>(samples));
    for (std::size_t i = 0; i < samples; ++i) {
        const double x = between(random, 0, width);
        terrain.samples.push_back(place(x, between(random, 0, width)));
    }
    const std::size_t lines = samples / 100;
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(lines))));
    const double cell = width / static_cast<double>(columns);
    for (std::size_t i = 0; i < lines; ++i) {
        const std::size_t row = i / columns;
        const double left = static_cast<double>(i % columns) * cell;
        const double low = static_cast<double>(row) * cell;
        Breakline line;
        double up = 0.5;
        for (int j = 0; j <= kSegments; ++j) {
            up = std::clamp(up + between(random, -0.03, 0.03), 0.1, 0.9);
            line.points.push_back(place(left + cell * (0.02 + 0.96 * j / kSegments), low + cell * up));
        }
        terrain.lines.push_back(std::move(line));
    }
    return terrain;
}

LineTerrain contours(std::size_t rings, double apart, double step) {
    LineTerrain terrain;
    for (std::size_t i = 0; i < rings; ++i) {
        const double mean = 50 + apart * static_cast<double>(i);
        const int vertices = static_cast<int>(2 * std::numbers::pi * mean / step);
        Breakline ring;
        for (int v = 0; v < vertices; ++v) {
            ring.points.push_back(on_contour(mean, 2 * std::numbers::pi * v / vertices));
        }
        close(ring);
        terrain.lines.push_back(std::move(ring));
    }
    return terrain;
}

LineTerrain irregular_contours(std::size_t rings) {
    Random random(22);
    LineTerrain terrain;
    for (std::size_t i = 0; i < rings; ++i) {
        Breakline ring;
        for (double angle = 0; angle < 2 * std::numbers::pi - 0.05; angle += between(random, 0.01, 0.06)) {
            ring.points.push_back(on_contour(50 + 0.3 * static_cast<double>(i), angle));
        }
        close(ring);
        terrain.lines.push_back(std::move(ring));
    }
    return terrain;
}

LineTerrain sharp_fans(std::size_t fans) {
    constexpr std::size_t kColumns = 50;
    Random random(23);
    LineTerrain terrain;
    for (std::size_t i = 0; i < fans; ++i) {
        const double x = 500 + 100 * static_cast<double>(i % kColumns);
        const std::size_t row = i / kColumns;
        const double y = 500 + 100 * static_cast<double>(row);
        double angle = between(random, 0, 2 * std::numbers::pi);
        for (int j = 0; j < 6; ++j) {
            const double length = between(random, 20, 45);
            Breakline line;
            line.points = {place(x, y), place(x + length * std::cos(angle), y + length * std::sin(angle))};
            terrain.lines.push_back(std::move(line));
            angle += between(random, 1, 9) * std::numbers::pi / 180;
        }
    }
    return terrain;
}

LineTerrain close_parallel_edges(std::size_t edges, std::size_t pairs) {
    constexpr double kLength = 1000;
    LineTerrain terrain;
    for (std::size_t i = 0; i < edges; ++i) {
        const double y = 500 + 0.01 * static_cast<double>(i);
        Breakline line;
        line.points = {place(500, y), place(500 + kLength, y)};
        terrain.lines.push_back(std::move(line));
    }
    for (std::size_t j = 0; j < pairs; ++j) {
        const double x = 500 + kLength * (static_cast<double>(j) + 0.5) / static_cast<double>(pairs);
        terrain.samples.push_back(place(x, 500 - 0.02));
        terrain.samples.push_back(place(x, 500 + 0.01 * static_cast<double>(edges) + 0.01));
    }
    return terrain;
}

}  // namespace tinwright_benchmarks
