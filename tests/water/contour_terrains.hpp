#ifndef TINWRIGHT_TESTS_WATER_CONTOUR_TERRAINS_HPP
#define TINWRIGHT_TESTS_WATER_CONTOUR_TERRAINS_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/point.hpp"

/// Contours of surfaces that are known, by marching over the squares of a grid: each square gives segments.
namespace tinwright_tests {

/// Elevation over the square from (0, 0) to (1000, 1000).
struct ContourTerrain {
    const char* name;
    double (*z)(double x, double y);
};

inline std::span<const ContourTerrain> contour_terrains() {
    static constexpr std::array kTerrains{
        ContourTerrain{"a cone",
                       [](double x, double y) { return 166.5 - 0.3 * std::hypot(x - 503.1, y - 497.3); }},
        ContourTerrain{"a bowl",
                       [](double x, double y) {
                           const double r = std::hypot(x - 503.1, y - 497.3);
                           return 42.7 + r * r / 2500;
                       }},
        ContourTerrain{"a winding ridge",
                       [](double x, double y) {
                           const double across = std::abs(y - 500 - 120 * std::sin(x / 140));
                           return 180.4 - 0.25 * across - 0.05 * x;
                       }},
        ContourTerrain{"a winding valley",
                       [](double x, double y) {
                           const double across = std::abs(y - 500 - 120 * std::sin(x / 140));
                           return 20.3 + 0.25 * across + 0.05 * x;
                       }},
        ContourTerrain{"a saddle",
                       [](double x, double y) {
                           return 104.3 + ((x - 497) * (x - 497) - (y - 503) * (y - 503)) / 4000;
                       }},
        ContourTerrain{"hills", [](double x, double y) {
                           return 100.3 + 25 * std::sin(x / 90) * std::cos(y / 110) +
                                  8 * std::sin(x / 37 + y / 45);
                       }}};
    return kTerrains;
}

/// The contours at multiples of `interval` as lines of two points, to the centimetre. `squares` a side.
inline std::vector<tinwright::Breakline> contours_of(const ContourTerrain& terrain, double interval,
                                                     int squares) {
    using tinwright::Point3;
    const double side = 1000.0 / squares;
    const auto crossing = [&](Point3 p, Point3 q, double level) -> std::optional<Point3> {
        if ((p.z < level) == (q.z < level)) {
            return std::nullopt;
        }
        if (q.x < p.x || q.y < p.y) {
            std::swap(p, q);  // the same point from both sides
        }
        double low = 0;
        double high = 1;
        for (int i = 0; i < 40; ++i) {
            const double t = (low + high) / 2;
            const double z = terrain.z(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y));
            ((z < level) == (p.z < level) ? low : high) = t;
        }
        const double x = p.x + low * (q.x - p.x);
        const double y = p.y + low * (q.y - p.y);
        return Point3{std::round(x * 100) / 100, std::round(y * 100) / 100, level};
    };
    std::vector<tinwright::Breakline> lines;
    const auto march = [&](const std::array<Point3, 3>& corners) {
        double lowest = corners[0].z;
        double highest = lowest;
        for (const Point3& corner : corners) {
            lowest = std::min(lowest, corner.z);
            highest = std::max(highest, corner.z);
        }
        for (double level = std::ceil(lowest / interval) * interval; level <= highest; level += interval) {
            std::vector<Point3> points;
            for (std::size_t i = 0; i < 3; ++i) {
                if (const auto point = crossing(corners[i], corners[(i + 1) % 3], level)) {
                    points.push_back(*point);
                }
            }
            if (points.size() == 2 && (points[0].x != points[1].x || points[0].y != points[1].y)) {
                lines.push_back({.points = points});
            }
        }
    };
    for (int row = 0; row < squares; ++row) {
        for (int column = 0; column < squares; ++column) {
            const auto at = [&](int i, int j) {
                const double x = (column + i) * side;
                const double y = (row + j) * side;
                return Point3{x, y, terrain.z(x, y)};
            };
            march({at(0, 0), at(1, 0), at(1, 1)});
            march({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return lines;
}

/// The ends of all segments, each once.
inline std::vector<tinwright::Point3> points_of(const std::vector<tinwright::Breakline>& lines) {
    std::vector<tinwright::Point3> points;
    for (const tinwright::Breakline& line : lines) {
        points.insert(points.end(), line.points.begin(), line.points.end());
    }
    return points;
}

}  // namespace tinwright_tests

#endif
