#include "tinwright/surface/natural_neighbor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/locator.hpp"

#include "support/cases.hpp"
#include "support/tins.hpp"
#include "support/voronoi_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Kind = NaturalNeighborOptions::Kind;

struct Named {
    Kind kind;
    const char* name;
};
constexpr std::array kKinds{Named{Kind::Sibson, "sibson"}, Named{Kind::Laplace, "laplace"},
                            Named{Kind::C1, "c1"}};

/// A TIN and all that reading it takes.
struct Surface {
    Surface(const Tin& from, const SharpEdges& sharp, Kind kind)
        : tin(from),
          locator(from),
          interpolator(make_natural_neighbor(from, sharp, {kind, GradientMethod::Octant})),
          reader(interpolator->make_reader()) {}

    const Tin& tin;
    SurfaceLocator locator;
    std::unique_ptr<Interpolator> interpolator;
    std::unique_ptr<SurfaceReader> reader;
};

/// The places that are hardest, on the terrain: vertices, middles of edges, centres of faces, all of these a
/// step aside, and some places at random.
std::vector<SurfacePlace> hard_places(Random& random, const Tin& tin, const SurfaceLocator& locator) {
    std::vector<Key2> keys;
    const QueryLattice& lattice = locator.lattice();
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        std::array<Key2, 3> corner{};
        for (unsigned i = 0; i < 3; ++i) {
            corner[i] = lattice.scaled(tin.key(tin.mesh.vertex({f}, i)));
        }
        const auto blend = [&](double b, double c) {
            const auto axis = [&](double x0, double x1, double x2) {
                return std::nearbyint(x0 + b * (x1 - x0) + c * (x2 - x0));
            };
            return Key2{axis(corner[0].x, corner[1].x, corner[2].x),
                        axis(corner[0].y, corner[1].y, corner[2].y)};
        };
        keys.insert(keys.end(), {blend(0, 0), blend(0.5, 0), blend(0.5, 0.5), blend(0.25, 0), blend(1.0 / 3, 1.0 / 3),
                                 blend(0.999, 0.0005), blend(0.4, 1e-7)});
        const double b = random.real();
        keys.push_back(blend(b, random.real() * (1 - b)));
    }
    std::vector<SurfacePlace> places;
    for (const Key2& key : keys) {
        for (const double dx : {0.0, 1.0, -1.0}) {
            for (const double dy : {0.0, 1.0, -1.0}) {
                if (const auto place = locator.find(Key2{key.x + dx, key.y + dy})) {
                    places.push_back(*place);
                }
            }
        }
    }
    return places;
}

double plane(const QueryLattice& lattice, Key2 at, double extent) {
    return (3 * (at.x / lattice.scale()) - 2 * (at.y / lattice.scale())) / extent;
}

}  // namespace

TEST_SUITE("surface/natural_neighbor") {
    TEST_CASE("planes are reproduced and shares sum to one on every family of vertices") {
        double worst = 0;
        for (int seed = 0; seed < cases(3); ++seed) {
            for (const KeyFamily& family : key_families()) {
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = delaunay_tin(family.make(random, 40));
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                const QueryLattice lattice(tin);
                double extent = 0;
                for (const Key2& key : tin.keys) {
                    extent = std::max({extent, key.x, key.y});
                }
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    tin.z[v] = plane(lattice, lattice.scaled(tin.key({v})), extent);
                }
                const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
                for (const Named& kind : kKinds) {
                    Surface surface(tin, {}, kind.kind);
                    CAPTURE(seed);
                    CAPTURE(family.name);
                    CAPTURE(kind.name);
                    double bad = 0, badsum = 0;
                    for (const SurfacePlace& place : hard_places(random, tin, surface.locator)) {
                        const double expected = plane(lattice, place.at, extent);
                        const double z = surface.reader->elevation(place);
                        const double err = std::abs(z - expected) / (*high - *low);
                        std::vector<VertexWeight> weights;
                        surface.reader->find_weights(place, weights);
                        double sum = 0;
                        for (auto& w : weights) sum += w.weight;
                        badsum = std::max(badsum, std::abs(sum - 1));
                        if (!(err < 1e6)) bad = 1e9;
                        bad = std::max(bad, err);
                    }
                    printf("%-28s %-8s plane %.2e sum %.2e\n", family.name, kind.name, bad, badsum);
                    worst = std::max(worst, bad);
                }
            }
        }
        CHECK(worst < 1e-12);
    }
}
