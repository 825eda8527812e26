#include "tinwright/geometry/ground_measures.hpp"

#include <cmath>
#include <limits>

namespace tinwright {

double GroundMeasures::length(Point2 a, Point2 b) const {
    return length_function ? length_function(a, b) : std::hypot(b.x - a.x, b.y - a.y);
}

PlaneBand GroundMeasures::band_around(double length) const {
    const double of_plane = length / plane_unit;
    if (!is_geodesic()) {
        return {of_plane, of_plane};
    }
    constexpr double kRounding = 1e-9;  // of projections and geodesics, far above what they are off by
    if (!(distortion < 0.5)) {
        return {0, std::numeric_limits<double>::infinity()};
    }
    // Whichever of the two lengths `distortion` is taken as a part of.
    const double part = distortion / (1 - distortion) + kRounding;
    return {of_plane * (1 - part), of_plane * (1 + part)};
}

double GroundMeasures::area(std::span<const Point2> ring) const {
    if (area_function) {
        return std::abs(area_function(ring));
    }
    double twice = 0;
    for (std::size_t i = 2; i < ring.size(); ++i) {  // relative to the first, as map coordinates are large
        twice += (ring[i - 1].x - ring[0].x) * (ring[i].y - ring[0].y) -
                 (ring[i].x - ring[0].x) * (ring[i - 1].y - ring[0].y);
    }
    return std::abs(twice) / 2;
}

double GroundMeasures::length(std::span<const Point2> line) const {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        sum += length(line[i - 1], line[i]);
    }
    return sum;
}

}  // namespace tinwright
