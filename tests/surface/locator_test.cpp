#include "tinwright/surface/locator.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/breakline_distance.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

__extension__ using Int128 = __int128;

Int128 doubled_area_of(Key2 a, Key2 b, Key2 c) {
    const auto whole = [](double value) { return static_cast<Int128>(static_cast<std::int64_t>(value)); };
    return whole(b.x - a.x) * whole(c.y - a.y) - whole(b.y - a.y) * whole(c.x - a.x);
}

/// All faces, one after the other.
std::optional<FaceId> face_by_trying(const Tin& tin, const QueryLattice& lattice, Key2 at) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        bool holds = tin.mesh.is_terrain({f});
        for (unsigned i = 0; i < 3 && holds; ++i) {
            const Key2 a = lattice.scaled(tin.key(tin.mesh.vertex({f}, i)));
            const Key2 b = lattice.scaled(tin.key(tin.mesh.vertex({f}, next_corner(i))));
            holds = doubled_area_of(a, b, at) >= 0;
        }
        if (holds) {
            return FaceId{f};
        }
    }
    return std::nullopt;
}

/// Places of interest: vertices, the middles of edges and steps beside them, and any.
std::vector<Key2> places_on(Random& random, const Tin& tin, const QueryLattice& lattice) {
    std::vector<Key2> places;
    const auto vertex = [&] {
        const std::int64_t last = static_cast<std::int64_t>(tin.vertex_count()) - 1;
        return lattice.scaled(tin.keys[static_cast<std::size_t>(random.integer(0, last))]);
    };
    for (int i = 0; i < 40; ++i) {
        const Key2 a = vertex();
        const Key2 b = vertex();
        const Key2 middle{std::floor((a.x + b.x) / 2), std::floor((a.y + b.y) / 2)};
        const auto aside = [&](Key2 at) {
            return Key2{at.x + static_cast<double>(random.integer(-1, 1)),
                        at.y + static_cast<double>(random.integer(-1, 1))};
        };
        const double part = random.real();
        for (const Key2 place :
             {a, middle, aside(a), aside(middle),
              Key2{std::round(a.x + part * (b.x - a.x)), std::round(a.y + part * (b.y - a.y))}}) {
            places.push_back(place);
        }
    }
    return places;
}

}  // namespace

TEST_SUITE("surface/locator") {
    TEST_CASE("the face found is the first that holds the place, on TINs of every kind and with voids") {
        for (const auto families : {general_families(), degenerate_families()}) {
            for (const TinFamily& family : families) {
                CAPTURE(family.name);
                for (int seed = 0; seed < cases(5); ++seed) {
                    CAPTURE(seed);
                    Random random(static_cast<std::uint64_t>(seed));
                    Tin tin = family.make(random, 60);
                    if (tin.mesh.count_terrain() == 0) {
                        continue;
                    }
                    make_voids_at_random(random, tin, seed % 3 == 0 ? 0 : 20);
                    const SurfaceLocator locator(tin);
                    for (const Key2 at : places_on(random, tin, locator.lattice())) {
                        const auto expected = face_by_trying(tin, locator.lattice(), at);
                        const auto found = locator.find(at);
                        REQUIRE(found.has_value() == expected.has_value());
                        if (found) {
                            CHECK(found->face == *expected);
                            CHECK(found->at == at);
                        }
                    }
                }
            }
        }
    }

    TEST_CASE("what lies far out is outside, however far") {
        const Tin tin = tin_of_samples({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}});
        const SurfaceLocator locator(tin);
        CHECK(locator.find(Point2{5, 5}).has_value());
        CHECK(locator.find(Point2{0, 10}).has_value());
        for (const double far : {10.000001, 1e3, 1e12, 1e300}) {
            CHECK_FALSE(locator.find(Point2{far, 1}).has_value());
            CHECK_FALSE(locator.find(Point2{1, -far}).has_value());
        }
    }

    TEST_CASE("decimal positions on an edge are on it") {
        const Tin tin = tin_of_samples({{100.1, 200.1, 0}, {100.4, 200.4, 0}, {100.1, 200.4, 0}});
        const SurfaceLocator locator(tin);
        CHECK(locator.find(Point2{100.2, 200.2}).has_value());
        CHECK(locator.find(Point2{100.25, 200.25}).has_value());
        CHECK_FALSE(locator.find(Point2{100.2, 200.1999999}).has_value());
    }

    TEST_CASE("a TIN without terrain has no place") {
        const Tin empty;
        CHECK_FALSE(SurfaceLocator(empty).find(Point2{0, 0}).has_value());
    }
}

TEST_SUITE("surface/breakline_distance") {
    TEST_CASE("the distance is that of the nearest constrained edge, found by looking at all") {
        for (const TinFamily& family : general_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(5); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = family.make(random, 60);
                constrain_at_random(random, tin, seed == 0 ? 1 : 15);
                const QueryLattice lattice(tin);
                const BreaklineDistance distance(tin, {});
                for (const Key2 at : places_on(random, tin, lattice)) {
                    double expected = std::numeric_limits<double>::infinity();
                    const Point2 p = lattice.position(at);
                    for (std::uint32_t h = 0; h < 4 * tin.mesh.slot_count(); ++h) {
                        if (h % 4 == 3 || !tin.mesh.is_constrained({h}) ||
                            !tin.mesh.is_terrain(face_of({h})) ||
                            !tin.mesh.is_terrain(face_of(tin.mesh.twin({h})))) {
                            continue;
                        }
                        // The nearest of many points of the edge, and its ends.
                        const Point3 a = tin.position(tin.mesh.origin({h}));
                        const Point3 b = tin.position(tin.mesh.destination({h}));
                        const double square = std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2);
                        const double part = std::clamp(
                            ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / square, 0.0, 1.0);
                        expected = std::min(expected, std::hypot(a.x + part * (b.x - a.x) - p.x,
                                                                 a.y + part * (b.y - a.y) - p.y));
                    }
                    const double found = distance.at(at);
                    CHECK(distance.is_empty() == std::isinf(expected));
                    const Box bounds = tin.bounds();
                    const double size = std::max({std::abs(bounds.x_max), std::abs(bounds.y_max), 1.0});
                    CHECK((found == expected || std::abs(found - expected) <= 1e-9 * size));
                }
            }
        }
    }

    TEST_CASE("lines that are no breaklines do not count, and neither does the border") {
        Tin tin = tin_of_samples({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {4, 5, 0}, {6, 5, 0}});
        const QueryLattice lattice(tin);
        CHECK(BreaklineDistance(tin, {}).is_empty());
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                const HalfEdgeId h = half_edge({f}, i);
                const VertexId a = tin.mesh.origin(h);
                const VertexId b = tin.mesh.destination(h);
                const bool is_middle = tin.position(a).y == 5 && tin.position(b).y == 5;
                if ((is_middle || tin.mesh.is_border(h)) && a < b) {
                    tin.mesh.set_constrained(h, true);
                    if (is_middle) {
                        tin.traces = {{a, b, 1, 1}};
                    }
                }
            }
        }
        CHECK(BreaklineDistance(tin, {true, false}).is_empty());
        const BreaklineDistance distance(tin, {false, true});
        CHECK(distance.at(lattice.at({5, 5})) == 0);
        CHECK(distance.at(lattice.at({5, 2})) == 3);
        CHECK(distance.at(lattice.at({9, 9})) == 5);
        CHECK(distance.at(lattice.at({1004, 5})) == 998);
    }
}
