#include "tinwright/surface/facets.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/surface/interpolation.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/traced_surface.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr double kLevel = 101.7;

struct Waters {
    Tin tin;
    std::vector<bool> is_water;
};

/// Rough terrain, `seed` choosing whether its faces were flipped, with a lake of some 30 faces whose shore is
/// sharp; `is_level` or on a slope.
Waters make_waters(Random& random, bool is_flipped, bool is_level) {
    Waters made{tin_of_samples(decimal_samples(random, 220, 2, 512345.67, 5400000, 80)), {}};
    Tin& tin = made.tin;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        tin.z[v] = 95 + 15 * random.real();
    }
    if (is_flipped) {
        flip_at_random(random, tin, 300);
    }
    made.is_water.assign(tin.mesh.slot_count(), false);
    std::vector<FaceId> water;
    std::uint32_t first = 0;
    while (water.empty()) {
        first = static_cast<std::uint32_t>(
            random.integer(0, static_cast<std::int64_t>(tin.mesh.slot_count()) - 1));
        if (tin.mesh.is_terrain({first})) {
            water.push_back({first});
            made.is_water[first] = true;
        }
    }
    while (water.size() < 30) {
        const FaceId at =
            water[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(water.size()) - 1))];
        const FaceId next =
            face_of(tin.mesh.twin(half_edge(at, static_cast<unsigned>(random.integer(0, 2)))));
        if (tin.mesh.is_terrain(next) && !made.is_water[next.value]) {
            water.push_back(next);
            made.is_water[next.value] = true;
        }
    }
    for (const FaceId face : water) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(face, corner);
            const std::uint32_t v = tin.mesh.origin(h).value;
            tin.z[v] = is_level ? kLevel : 100 + 1e-9 * tin.keys[v].x;
            if (!made.is_water[face_of(tin.mesh.twin(h)).value]) {
                tin.mesh.set_constrained(h, true);
            }
        }
    }
    return made;
}

std::unique_ptr<Interpolator> make_surface(const Tin& tin, InterpolationMethod method) {
    return make_interpolator(tin, SharpEdges(tin, {}), {.method = method});
}

SurfacePlace place_in(const Tin& tin, const QueryLattice& lattice, FaceId face, double a, double b) {
    const auto& v = tin.mesh.face(face).vertex;
    const std::array<Key2, 3> p{lattice.scaled(tin.key(v[0])), lattice.scaled(tin.key(v[1])),
                                lattice.scaled(tin.key(v[2]))};
    const double c = 1 - a - b;
    return {face,
            {std::nearbyint(a * p[0].x + b * p[1].x + c * p[2].x),
             std::nearbyint(a * p[0].y + b * p[1].y + c * p[2].y)}};
}

/// Runs `body(waters, method, random)` for all methods on lakes, level or not, in TINs of both kinds.
template <class Body>
void for_all(const Body& body) {
    for (int seed = 1; seed <= cases(4); ++seed) {
        for (const auto& named : kInterpolationMethods) {
            const std::string_view name = named.first;
            CAPTURE(seed);
            CAPTURE(std::string(name));
            Random random(static_cast<std::uint64_t>(seed));
            const Waters waters = make_waters(random, seed % 2 == 0, seed % 4 < 2);
            body(waters, named.second, random);
        }
    }
}

}  // namespace

TEST_SUITE("surface/facets") {
    TEST_CASE("water is read from its facets, and the terrain by the method, bit for bit") {
        for_all([](const Waters& waters, InterpolationMethod method, Random& random) {
            const Tin& tin = waters.tin;
            const auto plain = make_surface(tin, method);
            const auto kept = keep_facets(tin, make_surface(tin, method), waters.is_water);
            const auto facets = make_linear(tin);
            const auto of_plain = plain->make_reader();
            const auto of_kept = kept->make_reader();
            const auto of_facets = facets->make_reader();
            const QueryLattice lattice(tin);
            std::vector<VertexWeight> weights;
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                if (!tin.mesh.is_terrain({f})) {
                    continue;
                }
                REQUIRE(kept->is_facet({f}) == waters.is_water[f]);
                const double a = random.real();
                const SurfacePlace place = place_in(tin, lattice, {f}, a, (1 - a) * random.real());
                SurfaceReader& expected = waters.is_water[f] ? *of_facets : *of_plain;
                const SurfaceReading reading = of_kept->read(place);
                REQUIRE(reading.z == expected.read(place).z);
                REQUIRE(reading.z == of_kept->elevation(place));
                REQUIRE(reading.gradient == expected.read(place).gradient);
                of_kept->find_weights(place, weights);
                REQUIRE(!weights.empty());
                REQUIRE((!waters.is_water[f] || weights.size() == 3));
            }
        });
    }

    TEST_CASE("level water is level to the bit, its shore included, with a gradient of zero") {
        for (int seed = 1; seed <= cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Waters waters = make_waters(random, seed % 2 == 0, true);
            const Tin& tin = waters.tin;
            const auto kept =
                keep_facets(tin, make_surface(tin, InterpolationMethod::CloughTocher), waters.is_water);
            const auto reader = kept->make_reader();
            const QueryLattice lattice(tin);
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                for (int i = 0; waters.is_water[f] && i < 20; ++i) {
                    const double a = random.integer(0, 3) == 0 ? 0 : random.real();
                    const SurfacePlace place = place_in(tin, lattice, {f}, a, (1 - a) * random.real());
                    const SurfaceReading reading = reader->read(place);
                    REQUIRE(reading.z == kLevel);
                    REQUIRE(reading.gradient.x == 0);
                    REQUIRE(reading.gradient.y == 0);
                }
            }
        }
    }

    TEST_CASE("every method but nearest meets the water at its shore") {
        for_all([](const Waters& waters, InterpolationMethod method, Random& random) {
            if (method == InterpolationMethod::Nearest) {
                return;
            }
            const Tin& tin = waters.tin;
            const auto kept = keep_facets(tin, make_surface(tin, method), waters.is_water);
            const auto reader = kept->make_reader();
            const QueryLattice lattice(tin);
            int met = 0;
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                for (unsigned corner = 0; waters.is_water[f] && corner < 3; ++corner) {
                    const FaceId beyond = face_of(tin.mesh.twin(half_edge({f}, corner)));
                    if (!tin.mesh.is_terrain(beyond) || waters.is_water[beyond.value]) {
                        continue;
                    }
                    std::array<double, 3> shares{};
                    shares[corner] = random.real();
                    shares[next_corner(corner)] = 1 - shares[corner];
                    const SurfacePlace here = place_in(tin, lattice, {f}, shares[0], shares[1]);
                    const double z = reader->elevation(here);
                    // The place is half a step off the edge, which is a slope's worth of elevation.
                    REQUIRE(std::abs(reader->elevation({beyond, here.at}) - z) < 1e-8);
                    ++met;
                }
            }
            REQUIRE(met > 5);
        });
    }

    TEST_CASE("nothing to keep, or nothing but facets, and the surface comes back as it is") {
        Random random(3);
        const Waters waters = make_waters(random, false, true);
        auto surface = make_surface(waters.tin, InterpolationMethod::NaturalNeighbor);
        const Interpolator* const before = surface.get();
        const auto after = keep_facets(waters.tin, std::move(surface), {});
        CHECK(after.get() == before);
        CHECK(keep_facets(waters.tin, nullptr, waters.is_water) == nullptr);
        CHECK_FALSE(before->is_facet({0}));
    }

    TEST_CASE("a surface traced at the level of a lake is level on it, its shore divided or not") {
        for_all([](const Waters& waters, InterpolationMethod method, Random& /*random*/) {
            if (method == InterpolationMethod::Nearest) {
                return;
            }
            const Tin& tin = waters.tin;
            const auto kept = keep_facets(tin, make_surface(tin, method), waters.is_water);
            const std::vector<double> levels{kLevel};
            const TracedSurface traced = trace_surface(tin, *kept, levels, 0.01);
            const SurfaceLocator locator(tin);
            const auto reader = kept->make_reader();
            for (std::uint32_t f = 0; f < traced.mesh.slot_count(); ++f) {
                if (!traced.mesh.is_terrain({f})) {
                    continue;
                }
                std::array<Point3, 3> p{};
                for (unsigned i = 0; i < 3; ++i) {
                    p[i] = traced.vertices[traced.mesh.vertex({f}, i).value];
                }
                const auto place =
                    locator.find(Point2{(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3});
                if (!place || !waters.is_water[place->face.value] || reader->elevation(*place) != kLevel) {
                    continue;
                }
                for (const Point3& corner : p) {
                    REQUIRE(corner.z == kLevel);
                }
            }
        });
    }
}
