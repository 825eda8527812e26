#ifndef TINWRIGHT_TESTS_SURFACE_NEIGHBOR_SURFACES_HPP
#define TINWRIGHT_TESTS_SURFACE_NEIGHBOR_SURFACES_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/natural_neighbor.hpp"

#include "support/point_sets.hpp"
#include "support/tins.hpp"

/// TINs, and places on them, for the tests of natural neighbours.
namespace tinwright_tests {

using Kind = tinwright::NaturalNeighborOptions::Kind;

struct NamedKind {
    const char* name;
    Kind kind;
};
inline constexpr std::array kMeans{NamedKind{"sibson", Kind::Sibson}, NamedKind{"laplace", Kind::Laplace}};
inline constexpr std::array kKinds{NamedKind{"sibson", Kind::Sibson}, NamedKind{"laplace", Kind::Laplace},
                                   NamedKind{"c1", Kind::C1}};

/// A TIN with all that reading it takes.
struct Surface {
    Surface(const tinwright::Tin& of, Kind kind, const tinwright::SharpEdges& sharp = {})
        : tin(of),
          locator(of),
          interpolator(make_natural_neighbor(of, sharp, {kind, tinwright::GradientMethod::Octant})),
          reader(interpolator->make_reader()) {}

    [[nodiscard]] std::optional<double> elevation(tinwright::Key2 at) const {
        const std::optional<tinwright::SurfacePlace> place = locator.find(at);
        return place ? std::optional(reader->elevation(*place)) : std::nullopt;
    }

    const tinwright::Tin& tin;
    tinwright::SurfaceLocator locator;
    std::unique_ptr<tinwright::Interpolator> interpolator;
    std::unique_ptr<tinwright::SurfaceReader> reader;
};

using Elevation = std::function<double(double x, double y)>;

/// Gives the vertices elevations by their keys, over the largest of these.
inline double give_elevations(tinwright::Tin& tin, const Elevation& elevation) {
    double extent = 1;
    for (const tinwright::Key2& key : tin.keys) {
        extent = std::max({extent, key.x, key.y});
    }
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        tin.z[v] = elevation(tin.keys[v].x / extent, tin.keys[v].y / extent);
    }
    return extent;
}

inline double plane(double x, double y) { return 3 * x - 2 * y; }
inline double waves(double x, double y) { return std::sin(7 * x) * std::cos(5 * y) + 100; }

inline double range_of(const tinwright::Tin& tin) {
    const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
    return *high - *low;
}

inline std::array<tinwright::Key2, 3> corners_of(const tinwright::Tin& tin,
                                                 const tinwright::QueryLattice& lattice,
                                                 tinwright::FaceId f) {
    std::array<tinwright::Key2, 3> corner{};
    for (unsigned i = 0; i < 3; ++i) {
        corner[i] = lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
    }
    return corner;
}

/// The step nearest to where shares b and c of the second and third corner lead.
inline tinwright::Key2 blend(const std::array<tinwright::Key2, 3>& corner, double b, double c) {
    const auto axis = [&](double x0, double x1, double x2) {
        return std::nearbyint(x0 + b * (x1 - x0) + c * (x2 - x0));
    };
    return {axis(corner[0].x, corner[1].x, corner[2].x), axis(corner[0].y, corner[1].y, corner[2].y)};
}

inline std::vector<tinwright::FaceId> terrain_faces(const tinwright::Tin& tin) {
    std::vector<tinwright::FaceId> faces;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    return faces;
}

/// The places that are hardest: vertices, middles and other points of edges, centres of faces, points close
/// to corners and edges, each of these a step aside as well; and some at random.
inline std::vector<tinwright::SurfacePlace> hard_places(Random& random,
                                                        const tinwright::SurfaceLocator& locator,
                                                        const tinwright::Tin& tin) {
    std::vector<tinwright::SurfacePlace> places;
    for (const tinwright::FaceId f : terrain_faces(tin)) {
        const std::array<tinwright::Key2, 3> corner = corners_of(tin, locator.lattice(), f);
        const double b = random.real();
        for (const tinwright::Key2 key :
             {blend(corner, 0, 0), blend(corner, 0.5, 0), blend(corner, 0.5, 0.5), blend(corner, 0.25, 0),
              blend(corner, 1.0 / 3, 1.0 / 3), blend(corner, 0.999, 0.0005), blend(corner, 0.4, 1e-7),
              blend(corner, b, random.real() * (1 - b))}) {
            for (const double dx : {0.0, 1.0, -1.0}) {
                for (const double dy : {0.0, 1.0, -1.0}) {
                    if (const auto place = locator.find(tinwright::Key2{key.x + dx, key.y + dy})) {
                        places.push_back(*place);
                    }
                }
            }
        }
    }
    return places;
}

inline std::vector<tinwright::SurfacePlace> random_places(Random& random,
                                                          const tinwright::SurfaceLocator& locator,
                                                          const tinwright::Tin& tin) {
    std::vector<tinwright::SurfacePlace> places;
    for (const tinwright::FaceId f : terrain_faces(tin)) {
        const double b = 0.05 + 0.9 * random.real();
        const tinwright::Key2 at =
            blend(corners_of(tin, locator.lattice(), f), b, (0.05 + 0.9 * random.real()) * (1 - b));
        if (const auto place = locator.find(at)) {
            places.push_back(*place);
        }
    }
    return places;
}

/// Places on a half-edge, its ends left out.
inline std::vector<tinwright::Key2> places_along(const tinwright::Tin& tin,
                                                 const tinwright::QueryLattice& lattice,
                                                 tinwright::HalfEdgeId h) {
    const tinwright::Key2 a = lattice.scaled(tin.key(tin.mesh.origin(h)));
    const tinwright::Key2 b = lattice.scaled(tin.key(tin.mesh.destination(h)));
    std::vector<tinwright::Key2> places;  // exact: keys are scaled by a power of two
    for (const double way : {0.5, 0.25, 0.875}) {
        const tinwright::Key2 at{a.x + way * (b.x - a.x), a.y + way * (b.y - a.y)};
        if (at.x == std::nearbyint(at.x) && at.y == std::nearbyint(at.y)) {
            places.push_back(at);
        }
    }
    return places;
}

inline tinwright::Tin survey(Random& random, std::size_t count) {
    return tin_of_samples(decimal_samples(random, count, 2, 512345.67, 5400000, 80));
}

/// A square grid, jittered, 100 steps apart on average.
inline tinwright::Tin jittered(Random& random, int side) {
    std::vector<tinwright::Key2> keys;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            keys.push_back({1e6 * i + random.key(9e5), 1e6 * j + random.key(9e5)});
        }
    }
    return delaunay_tin(std::move(keys));
}

}  // namespace tinwright_tests

#endif
