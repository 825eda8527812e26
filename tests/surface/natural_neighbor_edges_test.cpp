// What natural neighbours do at edges, vertices and the border.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/natural_neighbor.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "surface/neighbor_surfaces.hpp"

using namespace tinwright;
using namespace tinwright_tests;

TEST_SUITE("surface/natural_neighbor") {
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
