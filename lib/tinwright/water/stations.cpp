#include "tinwright/water/stations.hpp"

#include <cmath>
#include <cstddef>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

std::vector<Point3> add_stations(const std::vector<Point3>& line, double spacing, const Lattice& lattice) {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < line.size(); ++i) {
        points.push_back(line[i]);
        if (i + 1 == line.size()) {
            break;
        }
        // From the same end whatever the line's direction, so that both ways make the same points.
        const bool is_forward =
            precedes(lattice.key({line[i].x, line[i].y}), lattice.key({line[i + 1].x, line[i + 1].y}));
        const Point3& from = is_forward ? line[i] : line[i + 1];
        const Point3& to = is_forward ? line[i + 1] : line[i];
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        const double parts = std::ceil(length / spacing);
        for (double part = 1; part < parts; ++part) {
            const double share = (is_forward ? part : parts - part) / parts;
            const Point2 at = lattice.position(
                lattice.key({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)}));
            points.push_back({at.x, at.y, from.z + share * (to.z - from.z)});
        }
    }
    return points;
}

}  // namespace tinwright
