#include "tinwright/geometry/ground_measures.hpp"

#include <cmath>

namespace tinwright {

double GroundMeasures::length(Point2 a, Point2 b) const {
    return length_function ? length_function(a, b) : std::hypot(b.x - a.x, b.y - a.y);
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
