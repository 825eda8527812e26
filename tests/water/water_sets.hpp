#ifndef TINWRIGHT_TESTS_WATER_WATER_SETS_HPP
#define TINWRIGHT_TESTS_WATER_WATER_SETS_HPP

#include <cmath>
#include <initializer_list>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"

#include "support/point_sets.hpp"

/// Small waters to test with.
namespace tinwright_tests {

inline tinwright::Breakline river(std::initializer_list<tinwright::Point3> points) {
    tinwright::Breakline line;
    line.points = points;
    line.role = tinwright::LineRole::River;
    return line;
}

/// A closed ring of a lake or of banks; its first point is repeated.
inline tinwright::Breakline ring(tinwright::LineRole role, std::uint32_t polygon,
                                 std::vector<tinwright::Point3> points) {
    tinwright::Breakline line;
    line.points = std::move(points);
    line.points.push_back(line.points.front());
    line.role = role;
    line.polygon = polygon;
    return line;
}

inline tinwright::Breakline rectangle(tinwright::LineRole role, std::uint32_t polygon, double x_min,
                                      double y_min, double x_max, double y_max, double z) {
    return ring(role, polygon, {{x_min, y_min, z}, {x_max, y_min, z}, {x_max, y_max, z}, {x_min, y_max, z}});
}

/// Samples on a square lattice of whole numbers, `z(x, y)` high.
template <class Surface>
std::vector<tinwright::Point3> lattice_samples(int x_min, int y_min, int x_max, int y_max, int step,
                                               const Surface& z) {
    std::vector<tinwright::Point3> samples;
    for (int y = y_min; y <= y_max; y += step) {
        for (int x = x_min; x <= x_max; x += step) {
            samples.push_back({static_cast<double>(x), static_cast<double>(y),
                               z(static_cast<double>(x), static_cast<double>(y))});
        }
    }
    return samples;
}

}  // namespace tinwright_tests

#endif
