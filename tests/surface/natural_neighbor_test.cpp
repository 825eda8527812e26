#include "tinwright/surface/natural_neighbor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/locator.hpp"

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"
#include "support/voronoi_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Kind = NaturalNeighborOptions::Kind;

struct NamedKind {
    const char* name;
    Kind kind;
};
constexpr std::array kMeans{NamedKind{"sibson", Kind::Sibson}, NamedKind{"laplace", Kind::Laplace}};
constexpr std::array kKinds{NamedKind{"sibson", Kind::Sibson}, NamedKind{"laplace", Kind::Laplace},
                            NamedKind{"c1", Kind::C1}};

/// A TIN with all that reading it takes.
struct Surface {
    Surface(const Tin& of, Kind kind, const SharpEdges& sharp = {})
        : tin(of),
          locator(of),
          interpolator(make_natural_neighbor(of, sharp, {kind, GradientMethod::Octant})),
          reader(interpolator->make_reader()) {}

    [[nodiscard]] std::optional<double> elevation(Key2 at) const {
        const std::optional<SurfacePlace> place = locator.find(at);
        return place ? std::optional(reader->elevation(*place)) : std::nullopt;
    }

    const Tin& tin;
    SurfaceLocator locator;
    std::unique_ptr<Interpolator> interpolator;
    std::unique_ptr<SurfaceReader> reader;
};

using Elevation = std::function<double(double x, double y)>;

/// Gives the vertices elevations by their keys, over the largest of these.
double give_elevations(Tin& tin, const Elevation& elevation) {
    double extent = 1;
    for (const Key2& key : tin.keys) {
        extent = std::max({extent, key.x, key.y});
    }
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        tin.z[v] = elevation(tin.keys[v].x / extent, tin.keys[v].y / extent);
    }
    return extent;
}

double plane(double x, double y) { return 3 * x - 2 * y; }
double waves(double x, double y) { return std::sin(7 * x) * std::cos(5 * y) + 100; }

double range_of(const Tin& tin) {
    const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
    return *high - *low;
}

std::array<Key2, 3> corners_of(const Tin& tin, const QueryLattice& lattice, FaceId f) {
    std::array<Key2, 3> corner{};
    for (unsigned i = 0; i < 3; ++i) {
        corner[i] = lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
    }
    return corner;
}

/// The step nearest to where shares b and c of the second and third corner lead.
Key2 blend(const std::array<Key2, 3>& corner, double b, double c) {
    const auto axis = [&](double x0, double x1, double x2) {
        return std::nearbyint(x0 + b * (x1 - x0) + c * (x2 - x0));
    };
    return {axis(corner[0].x, corner[1].x, corner[2].x), axis(corner[0].y, corner[1].y, corner[2].y)};
}

std::vector<FaceId> terrain_faces(const Tin& tin) {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    return faces;
}

/// The places that are hardest: vertices, middles and other points of edges, centres of faces, points close
/// to corners and edges, each of these a step aside as well; and some at random.
std::vector<SurfacePlace> hard_places(Random& random, const SurfaceLocator& locator, const Tin& tin) {
    std::vector<SurfacePlace> places;
    for (const FaceId f : terrain_faces(tin)) {
        const std::array<Key2, 3> corner = corners_of(tin, locator.lattice(), f);
        const double b = random.real();
        for (const Key2 key :
             {blend(corner, 0, 0), blend(corner, 0.5, 0), blend(corner, 0.5, 0.5), blend(corner, 0.25, 0),
              blend(corner, 1.0 / 3, 1.0 / 3), blend(corner, 0.999, 0.0005), blend(corner, 0.4, 1e-7),
              blend(corner, b, random.real() * (1 - b))}) {
            for (const double dx : {0.0, 1.0, -1.0}) {
                for (const double dy : {0.0, 1.0, -1.0}) {
                    if (const auto place = locator.find(Key2{key.x + dx, key.y + dy})) {
                        places.push_back(*place);
                    }
                }
            }
        }
    }
    return places;
}

std::vector<SurfacePlace> random_places(Random& random, const SurfaceLocator& locator, const Tin& tin) {
    std::vector<SurfacePlace> places;
    for (const FaceId f : terrain_faces(tin)) {
        const double b = 0.05 + 0.9 * random.real();
        const Key2 at =
            blend(corners_of(tin, locator.lattice(), f), b, (0.05 + 0.9 * random.real()) * (1 - b));
        if (const auto place = locator.find(at)) {
            places.push_back(*place);
        }
    }
    return places;
}

/// Places on a half-edge, its ends left out.
std::vector<Key2> places_along(const Tin& tin, const QueryLattice& lattice, HalfEdgeId h) {
    const Key2 a = lattice.scaled(tin.key(tin.mesh.origin(h)));
    const Key2 b = lattice.scaled(tin.key(tin.mesh.destination(h)));
    std::vector<Key2> places;  // exact: keys are scaled by a power of two
    for (const double way : {0.5, 0.25, 0.875}) {
        const Key2 at{a.x + way * (b.x - a.x), a.y + way * (b.y - a.y)};
        if (at.x == std::nearbyint(at.x) && at.y == std::nearbyint(at.y)) {
            places.push_back(at);
        }
    }
    return places;
}

Tin survey(Random& random, std::size_t count) {
    return tin_of_samples(decimal_samples(random, count, 2, 512345.67, 5400000, 80));
}

/// A square grid, jittered, 100 steps apart on average.
Tin jittered(Random& random, int side) {
    std::vector<Key2> keys;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            keys.push_back({1e6 * i + random.key(9e5), 1e6 * j + random.key(9e5)});
        }
    }
    return delaunay_tin(std::move(keys));
}

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

    TEST_CASE("the surface is linear along the border and along sharp edges, from both sides") {
        for (int seed = 0; seed < cases(3); ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = survey(random, 80);
            make_voids_at_random(random, tin, 6);
            constrain_at_random(random, tin, 25);
            give_elevations(tin, waves);
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                tin.z[v] += random.real();
            }
            const SharpEdges sharp(tin, {});
            for (const NamedKind& kind : kKinds) {
                CAPTURE(seed);
                CAPTURE(std::string(kind.name));
                const Surface surface(tin, kind.kind, sharp);
                const QueryLattice& lattice = surface.locator.lattice();
                for (const FaceId f : terrain_faces(tin)) {
                    for (const HalfEdgeId h : {half_edge(f, 0), half_edge(f, 1), half_edge(f, 2)}) {
                        if (!sharp.is_sharp(h) && (kind.kind == Kind::C1 || !tin.mesh.is_border(h))) {
                            continue;
                        }
                        const Key2 a = lattice.scaled(tin.key(tin.mesh.origin(h)));
                        const Key2 b = lattice.scaled(tin.key(tin.mesh.destination(h)));
                        const double z_a = tin.z[tin.mesh.origin(h).value];
                        const double z_b = tin.z[tin.mesh.destination(h).value];
                        for (const Key2 at : places_along(tin, lattice, h)) {
                            const double way =
                                b.x == a.x ? (at.y - a.y) / (b.y - a.y) : (at.x - a.x) / (b.x - a.x);
                            const SurfaceReading reading = surface.reader->read({f, at});
                            REQUIRE(std::abs(reading.z - (z_a + way * (z_b - z_a))) < 1e-12);
                            const double rise =
                                (reading.gradient.x * (b.x - a.x) + reading.gradient.y * (b.y - a.y)) *
                                lattice.step();
                            REQUIRE(std::abs(rise - (z_b - z_a)) < 1e-9);
                        }
                    }
                }
            }
        }
    }

    TEST_CASE("gradients are the limits of differences, on edges and borders those from inside") {
        for (int seed = 0; seed < cases(3); ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = jittered(random, 7);
            constrain_at_random(random, tin, 12);
            make_voids_at_random(random, tin, 4);
            const double extent = give_elevations(tin, waves);
            const SharpEdges sharp(tin, {});
            for (const NamedKind& kind : kKinds) {
                CAPTURE(seed);
                CAPTURE(std::string(kind.name));
                const Surface surface(tin, kind.kind, sharp);
                const QueryLattice& lattice = surface.locator.lattice();
                for (const FaceId f : terrain_faces(tin)) {
                    const std::array<Key2, 3> corner = corners_of(tin, lattice, f);
                    for (const Key2 at :
                         {blend(corner, 0.3, 0.4), blend(corner, 0.5, 0), blend(corner, 0.25, 0.75)}) {
                        CAPTURE(f.value);
                        const SurfaceReading here = surface.reader->read({f, at});
                        // Inwards from everywhere on the face: to its centre. Richardson's extrapolation from
                        // two forward differences.
                        const Key2 centre = blend(corner, 1.0 / 3, 1.0 / 3);
                        const auto slope = [&](double way) {
                            const Key2 to{at.x + std::nearbyint(way * (centre.x - at.x)),
                                          at.y + std::nearbyint(way * (centre.y - at.y))};
                            const double length = std::hypot(to.x - at.x, to.y - at.y) * lattice.step();
                            const double along =
                                (here.gradient.x * (to.x - at.x) + here.gradient.y * (to.y - at.y)) *
                                lattice.step() / length;
                            return (surface.reader->elevation({f, to}) - here.z) / length - along;
                        };
                        const double error = 2 * slope(0x1p-14) - slope(0x1p-13);
                        REQUIRE(std::abs(error) < 1e-4 / (extent * tin.lattice.quantum()) * 100);
                    }
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

    TEST_CASE("a sharp line from border to border leaves two surfaces that know nothing of each other") {
        Random random(7);
        // No vertex within a circle over an edge of the line, so its edges are there.
        std::vector<Key2> left;
        std::vector<Key2> all;
        for (int i = 0; i < 12; ++i) {
            left.push_back({5e5, 1e5 * i});  // the line
        }
        for (int i = 0; i < 60; ++i) {
            left.push_back({random.key(4.4e5), 1e5 + random.key(9e5)});
        }
        all = left;
        for (int i = 0; i < 60; ++i) {
            all.push_back({5.6e5 + random.key(4e5), 1e5 + random.key(9e5)});
        }
        const auto cliff = [](Key2 key) { return std::sin(key.x / 1e5) + (key.x > 5e5 ? 1000 : 0); };
        Tin half = delaunay_tin(left);
        Tin tin = delaunay_tin(all);
        for (Tin* each : {&half, &tin}) {
            for (std::uint32_t v = 0; v < each->vertex_count(); ++v) {
                each->z[v] = cliff(each->keys[v]);
            }
        }
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned corner = 0; corner < 3 && tin.mesh.is_terrain({f}); ++corner) {
                const HalfEdgeId h = half_edge({f}, corner);
                if (tin.key(tin.mesh.origin(h)).x == 5e5 && tin.key(tin.mesh.destination(h)).x == 5e5) {
                    tin.mesh.set_constrained(h, true);
                }
            }
        }
        for (const NamedKind& kind : kMeans) {
            CAPTURE(std::string(kind.name));
            const Surface alone(half, kind.kind);
            const Surface surface(tin, kind.kind, SharpEdges(tin, {}));
            const double scale = alone.locator.lattice().scale();
            for (int i = 0; i < 500; ++i) {
                const Key2 at{random.key(4.99e5), random.key(1e6)};
                const auto expected = alone.elevation({at.x * scale, at.y * scale});
                const double own = surface.locator.lattice().scale();
                const auto found = surface.elevation({at.x * own, at.y * own});
                if (expected && found) {
                    REQUIRE(std::abs(*expected - *found) < 1e-12 * 1000);
                }
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

    TEST_CASE("gradients of Sibson and C1 have no jumps at edges, those of C1 none at vertices") {
        Random random(3);
        Tin tin = jittered(random, 8);
        const double extent = give_elevations(tin, waves);
        for (const Kind kind : {Kind::Sibson, Kind::C1}) {
            const Surface surface(tin, kind);
            const QueryLattice& lattice = surface.locator.lattice();
            for (const FaceId f : terrain_faces(tin)) {
                const std::array<Key2, 3> corner = corners_of(tin, lattice, f);
                const auto jump = [&](Key2 from, Key2 to) {
                    const auto here = surface.locator.find(from);
                    const auto there = surface.locator.find(to);
                    if (!here || !there) {
                        return 0.0;
                    }
                    const Point2 a = surface.reader->read(*here).gradient;
                    const Point2 b = surface.reader->read(*there).gradient;
                    return std::hypot(a.x - b.x, a.y - b.y) * extent;
                };
                const Key2 middle = blend(corner, 0.5, 0);
                CHECK(jump({middle.x + 1, middle.y + 1}, {middle.x - 1, middle.y - 1}) < 1e-5);
                if (kind == Kind::C1) {
                    CHECK(jump(corner[0], {corner[0].x + 1, corner[0].y}) < 1e-5);
                    CHECK(jump(corner[0], {corner[0].x, corner[0].y - 1}) < 1e-5);
                }
            }
        }
    }

    TEST_CASE("a place off its face by a rounding reads as its neighbourhood does") {
        Random random(5);
        Tin tin = survey(random, 60);
        give_elevations(tin, waves);
        for (const NamedKind& kind : kKinds) {
            CAPTURE(std::string(kind.name));
            const Surface surface(tin, kind.kind);
            for (const FaceId f : terrain_faces(tin)) {
                const std::array<Key2, 3> corner = corners_of(tin, surface.locator.lattice(), f);
                const Key2 middle = blend(corner, 0.5, 0);
                const double z = surface.reader->elevation({f, middle});
                for (const Key2 aside : {Key2{1, 0}, Key2{-1, 0}, Key2{0, 1}, Key2{0, -1}}) {
                    const SurfaceReading reading =
                        surface.reader->read({f, {middle.x + aside.x, middle.y + aside.y}});
                    REQUIRE(std::abs(reading.z - z) < 1e-6);
                    REQUIRE(std::isfinite(reading.gradient.x));
                    REQUIRE(std::isfinite(reading.gradient.y));
                }
            }
        }
    }
}
