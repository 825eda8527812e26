#include "tinwright/surface/natural_neighbor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/voronoi_oracle.hpp"
#include "surface/neighbor_surfaces.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// Of two surfaces that should be one.
double difference(const Surface& a, const Surface& b, const std::vector<SurfacePlace>& places) {
    double worst = 0;
    for (const SurfacePlace& place : places) {
        const std::optional<double> other = b.elevation(place.at);
        REQUIRE(other);
        worst = std::max(worst, std::abs(a.reader->elevation(place) - *other));
    }
    return worst;
}

}  // namespace

TEST_SUITE("surface/natural_neighbor") {
    TEST_CASE("planes come out to 1e-12 of their range on every family of vertices, shares are positive") {
        for (int seed = 0; seed < cases(2); ++seed) {
            for (const KeyFamily& family : key_families()) {
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = delaunay_tin(family.make(random, 40));
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                const double extent = give_elevations(tin, plane);
                for (const NamedKind& kind : kMeans) {
                    CAPTURE(seed);
                    CAPTURE(std::string(family.name));
                    CAPTURE(std::string(kind.name));
                    const Surface surface(tin, kind.kind);
                    const double scale = extent * surface.locator.lattice().scale();
                    std::vector<VertexWeight> weights;
                    double worst = 0;
                    double least = 0;
                    double off_one = 0;
                    for (const SurfacePlace& place : hard_places(random, surface.locator, tin)) {
                        const double expected = plane(place.at.x / scale, place.at.y / scale);
                        const double error = std::abs(surface.reader->elevation(place) - expected);
                        worst = error <= worst ? worst : error;  // a NaN too
                        surface.reader->find_weights(place, weights);
                        double sum = 0;
                        for (const VertexWeight& share : weights) {
                            sum += share.weight;
                            least = std::min(least, share.weight);
                        }
                        off_one = std::max(off_one, std::abs(sum - 1));
                    }
                    CHECK(worst <= 1e-12 * range_of(tin));
                    CHECK(least > -1e-11);
                    CHECK(off_one < 1e-14);
                }
            }
        }
    }

    TEST_CASE("shares are the areas and sides of Voronoi cells") {
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const Tin& tin : {survey(random, 60), jittered(random, 7), delaunay_tin(grid_keys(7, 6)),
                                   delaunay_tin(circle_keys(random, 30)),
                                   tin_of_samples(scan_samples(random, 60), DuplicatePolicy::Mean)}) {
                const Surface sibson(tin, Kind::Sibson);
                const Surface laplace(tin, Kind::Laplace);
                const QueryLattice lattice(tin);
                std::vector<Key2> sites;
                for (const Key2& key : tin.keys) {
                    sites.push_back(lattice.scaled(key));
                }
                for (const SurfacePlace& place : random_places(random, sibson.locator, tin)) {
                    const auto cells = oracle::voronoi_shares(sites, place.at);
                    if (!cells) {
                        continue;
                    }
                    long double area = 0;
                    long double side = 0;
                    for (const oracle::CellShare& cell : *cells) {
                        area += cell.area;
                        side += cell.side;
                    }
                    std::vector<long double> areas(tin.vertex_count());
                    std::vector<long double> sides(tin.vertex_count());
                    for (const oracle::CellShare& cell : *cells) {
                        areas[cell.site] = cell.area / area;
                        sides[cell.site] = cell.side / side;
                    }
                    const auto worst = [&](const Surface& surface, const std::vector<long double>& expected) {
                        std::vector<VertexWeight> weights;
                        surface.reader->find_weights(place, weights);
                        std::vector<double> found(tin.vertex_count());
                        for (const VertexWeight& share : weights) {
                            found[share.vertex.value] += share.weight;
                        }
                        double error = 0;
                        for (std::size_t v = 0; v < found.size(); ++v) {
                            error = std::max(error, static_cast<double>(std::abs(found[v] - expected[v])));
                        }
                        return error;
                    };
                    REQUIRE(worst(sibson, areas) < 1e-9);
                    REQUIRE(worst(laplace, sides) < 1e-9);
                }
            }
        }
    }

    TEST_CASE("the choice of faces and smooth constrained edges have no influence") {
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = survey(random, 100);
            give_elevations(tin, waves);
            Tin flipped = tin;
            flip_at_random(random, flipped, 100);
            Tin steepest = tin;
            optimize_to(kVectorScope, Criterion::Slope, steepest);
            Tin smooth = flipped;
            constrain_at_random(random, smooth, 40);
            for (const NamedKind& kind : kKinds) {
                CAPTURE(std::string(kind.name));
                const Surface reference(tin, kind.kind);
                for (const Tin* other : {&flipped, &steepest, &smooth}) {
                    const Surface surface(*other, kind.kind);
                    CHECK(difference(surface, reference, random_places(random, surface.locator, *other)) <
                          1e-11);
                    CHECK(difference(surface, reference, hard_places(random, surface.locator, *other)) <
                          1e-11);
                }
            }
        }
    }

    TEST_CASE("sharp edges survive the change of faces, each side as it is") {
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = survey(random, 80);
            make_voids_at_random(random, tin, 5);
            constrain_at_random(random, tin, 15);
            give_elevations(tin, waves);
            Tin flipped = tin;
            flip_at_random(random, flipped, 150);
            for (const NamedKind& kind : kKinds) {
                CAPTURE(std::string(kind.name));
                const Surface reference(tin, kind.kind, SharpEdges(tin, {}));
                const Surface surface(flipped, kind.kind, SharpEdges(flipped, {}));
                CHECK(difference(surface, reference, random_places(random, surface.locator, flipped)) <
                      1e-11);
                CHECK(difference(surface, reference, hard_places(random, surface.locator, flipped)) < 1e-11);
            }
        }
    }

    TEST_CASE("C1 has a (x^2 + y^2) + plane wherever all gradients around are exact") {
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = jittered(random, 14);
            const auto bowl = [](double x, double y) { return 5 * (x * x + y * y) - 3 * x + y; };
            const double extent = give_elevations(tin, bowl);
            const Surface surface(tin, Kind::C1);
            const double scale = extent * surface.locator.lattice().scale();
            for (const SurfacePlace& place : random_places(random, surface.locator, tin)) {
                const double x = place.at.x / scale;
                const double y = place.at.y / scale;
                if (std::abs(x - 0.5) < 0.3 && std::abs(y - 0.5) < 0.3) {
                    const SurfaceReading reading = surface.reader->read(place);
                    REQUIRE(std::abs(reading.z - bowl(x, y)) < 1e-10);
                    REQUIRE(std::abs(reading.gradient.x * extent - (10 * x - 3)) < 1e-7);
                    REQUIRE(std::abs(reading.gradient.y * extent - (10 * y + 1)) < 1e-7);
                }
            }
        }
    }
}
