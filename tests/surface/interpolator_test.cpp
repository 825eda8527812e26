// What every method promises (surface/interpolator.hpp), on every kind of TIN.
#include "tinwright/surface/interpolator.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/surface/interpolation.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

struct TinKind {
    const char* name;
    Tin (*make)(Random& random);
};

Tin survey(Random& random) { return tin_of_samples(decimal_samples(random, 150, 2, 512345.67, 5400000, 80)); }

const std::vector<TinKind>& tin_kinds() {
    static const std::vector<TinKind> kinds{
        {"survey", survey},
        {"grid", [](Random& /*random*/) { return delaunay_tin(grid_keys(12, 11)); }},
        {"scan rows",
         [](Random& random) { return tin_of_samples(scan_samples(random, 150), DuplicatePolicy::Mean); }},
        {"flipped",
         [](Random& random) {
             Tin tin = survey(random);
             flip_at_random(random, tin, 200);
             return tin;
         }},
        {"with voids",
         [](Random& random) {
             Tin tin = survey(random);
             make_voids_at_random(random, tin, 30);
             return tin;
         }},
        {"with sharp edges",
         [](Random& random) {
             Tin tin = survey(random);
             constrain_at_random(random, tin, 40);
             return tin;
         }},
        {"all of it",
         [](Random& random) {
             Tin tin = survey(random);
             flip_at_random(random, tin, 50);
             constrain_at_random(random, tin, 20);
             make_voids_at_random(random, tin, 20);
             return tin;
         }},
    };
    return kinds;
}

/// A place within a face, by shares of its corners.
SurfacePlace place_in(const Tin& tin, const QueryLattice& lattice, FaceId face, double a, double b) {
    const auto& v = tin.mesh.face(face).vertex;
    const Key2 p = lattice.scaled(tin.key(v[0]));
    const Key2 q = lattice.scaled(tin.key(v[1]));
    const Key2 r = lattice.scaled(tin.key(v[2]));
    const double c = 1 - a - b;
    return {face, {std::nearbyint(a * p.x + b * q.x + c * r.x), std::nearbyint(a * p.y + b * q.y + c * r.y)}};
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

std::vector<SurfacePlace> random_places(Random& random, const Tin& tin, int count) {
    const QueryLattice lattice(tin);
    const std::vector<FaceId> faces = terrain_faces(tin);
    std::vector<SurfacePlace> places;
    for (int i = 0; i < count; ++i) {
        const FaceId face =
            faces[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(faces.size()) - 1))];
        // Inside, near an edge, near a vertex.
        const double near = random.integer(0, 3) == 0 ? 1e-6 : 1;
        const double a = near * random.real();
        const double b = (1 - a) * (random.integer(0, 3) == 0 ? 1e-6 : 1) * random.real();
        places.push_back(place_in(tin, lattice, face, a, b));
    }
    return places;
}

double doubled_area_of(const Tin& tin, const QueryLattice& lattice, FaceId face) {
    const auto& v = tin.mesh.face(face).vertex;
    return doubled_area(lattice.scaled(tin.key(v[0])), lattice.scaled(tin.key(v[1])),
                        lattice.scaled(tin.key(v[2])));
}

double z_range(const Tin& tin) {
    const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
    return std::max(*high - *low, 1e-300);
}

void give_wavy_elevations(Tin& tin) {
    const Box box = tin.bounds();
    const double width = box.x_max - box.x_min;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const Point3 p = tin.position({v});
        tin.z[v] =
            100 + 10 * std::sin(7 * (p.x - box.x_min) / width) * std::cos(5 * (p.y - box.y_min) / width);
    }
}

/// The surface of a TIN by one method.
struct Reading {
    std::unique_ptr<Interpolator> surface;
    std::unique_ptr<SurfaceReader> reader;

    Reading(const Tin& tin, InterpolationMethod method, double guard = 0.25, int threads = 1)
        : surface(make_interpolator(tin, SharpEdges(tin, {}),
                                    {.method = method, .smooth = {.guard = guard}, .threads = threads})),
          reader(surface->make_reader()) {}
};

/// Runs `body(tin, method)` for every method on every kind of TIN.
template <class Body>
void for_all(int usual, const Body& body) {
    for (const TinKind& kind : tin_kinds()) {
        for (int seed = 1; seed <= cases(usual); ++seed) {
            for (const auto& named : kInterpolationMethods) {
                const std::string_view name = named.first;
                const auto method = named.second;
                CAPTURE(std::string(kind.name));
                CAPTURE(seed);
                CAPTURE(name);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = kind.make(random);
                give_wavy_elevations(tin);
                body(tin, method, random);
            }
        }
    }
}

}  // namespace

TEST_SUITE("surface/interpolator") {
    TEST_CASE("every surface passes through its vertices, bit for bit, whichever face is asked") {
        for_all(2, [](const Tin& tin, InterpolationMethod method, Random& /*random*/) {
            const Reading of(tin, method);
            const QueryLattice lattice(tin);
            for (const FaceId face : terrain_faces(tin)) {
                for (const VertexId v : tin.mesh.face(face).vertex) {
                    REQUIRE(of.reader->elevation({face, lattice.scaled(tin.key(v))}) == tin.z[v.value]);
                }
            }
        });
    }

    TEST_CASE("a plane is read as the plane it is") {
        for_all(3, [](Tin& tin, InterpolationMethod method, Random& random) {
            if (method == InterpolationMethod::Nearest) {
                return;
            }
            const QueryLattice lattice(tin);
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                tin.z[v] = 0.5 * tin.keys[v].x - 0.25 * tin.keys[v].y;  // exact
            }
            const double step = tin.lattice.quantum();
            const Reading of(tin, method);
            for (const SurfacePlace& place : random_places(random, tin, 200)) {
                const SurfaceReading reading = of.reader->read(place);
                const double expected = (0.5 * place.at.x - 0.25 * place.at.y) / lattice.scale();
                REQUIRE(std::abs(reading.z - expected) <= 1e-12 * z_range(tin));
                REQUIRE(std::abs(reading.gradient.x * step - 0.5) < 1e-6);
                REQUIRE(std::abs(reading.gradient.y * step + 0.25) < 1e-6);
            }
        });
    }

    TEST_CASE("shares sum to one and make the elevation") {
        for_all(2, [](const Tin& tin, InterpolationMethod method, Random& random) {
            if (method == InterpolationMethod::CloughTocherLimit) {
                return;
            }
            const Reading of(tin, method, std::numeric_limits<double>::infinity());
            std::vector<VertexWeight> weights;
            for (const SurfacePlace& place : random_places(random, tin, 60)) {
                of.reader->find_weights(place, weights);
                double sum = 0;
                double z = 0;
                double size = 0;
                std::vector<std::uint32_t> vertices;
                for (const VertexWeight& share : weights) {
                    sum += share.weight;
                    z += share.weight * tin.z[share.vertex.value];
                    size += std::abs(share.weight);
                    vertices.push_back(share.vertex.value);
                }
                REQUIRE(std::abs(sum - 1) <= 1e-8 * size);
                REQUIRE(std::abs(z - of.reader->elevation(place)) <= 1e-8 * size * 110);
                std::sort(vertices.begin(), vertices.end());
                REQUIRE(std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end());
            }
        });
    }

    TEST_CASE("a reading depends on nothing read before, and has the elevation's bits") {
        for_all(1, [](const Tin& tin, InterpolationMethod method, Random& random) {
            const Reading of(tin, method);
            const std::vector<SurfacePlace> places = random_places(random, tin, 100);
            std::vector<double> first;
            for (const SurfacePlace& place : places) {
                first.push_back(of.reader->elevation(place));
            }
            const auto other = of.surface->make_reader();
            for (std::size_t i = places.size(); i-- > 0;) {
                const SurfaceReading reading = other->read(places[i]);
                REQUIRE(std::bit_cast<std::uint64_t>(reading.z) == std::bit_cast<std::uint64_t>(first[i]));
                REQUIRE(std::isfinite(reading.gradient.x));
                REQUIRE(std::isfinite(reading.gradient.y));
            }
        });
    }

    TEST_CASE("the number of threads changes no bit") {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
        for_all(1, [](const Tin& tin, InterpolationMethod method, Random& random) {
            const Reading one(tin, method, 0.25, 1);
            const Reading four(tin, method, 0.25, 4);
            for (const SurfacePlace& place : random_places(random, tin, 100)) {
                REQUIRE(one.reader->elevation(place) == four.reader->elevation(place));
            }
        });
    }

    TEST_CASE("surfaces are continuous across all edges, sharp or not") {
        for_all(2, [](const Tin& tin, InterpolationMethod method, Random& random) {
            if (method == InterpolationMethod::Nearest) {
                return;
            }
            const Reading of(tin, method);
            const QueryLattice lattice(tin);
            for (const FaceId face : terrain_faces(tin)) {
                for (unsigned corner = 0; corner < 3; ++corner) {
                    const FaceId beyond = face_of(tin.mesh.twin(half_edge(face, corner)));
                    if (!tin.mesh.is_terrain(beyond) || beyond < face) {
                        continue;
                    }
                    // The place on the edge, rounded, asked of both faces.
                    const double share = random.real();
                    std::array<double, 3> shares{};
                    shares[corner] = share;
                    shares[next_corner(corner)] = 1 - share;
                    const SurfacePlace here = place_in(tin, lattice, face, shares[0], shares[1]);
                    const double z = of.reader->elevation(here);
                    REQUIRE(std::abs(of.reader->elevation({beyond, here.at}) - z) < 1e-6 * z_range(tin));
                }
            }
        });
    }

    TEST_CASE("gradients are those of the elevations") {
        for_all(1, [](const Tin& tin, InterpolationMethod method, Random& random) {
            if (method == InterpolationMethod::Nearest) {
                return;
            }
            const Reading of(tin, method, std::numeric_limits<double>::infinity());
            const QueryLattice lattice(tin);
            const std::vector<FaceId> faces = terrain_faces(tin);
            int bad = 0;
            int all = 0;
            for (int i = 0; i < 60; ++i) {
                const FaceId face = faces[static_cast<std::size_t>(
                    random.integer(0, static_cast<std::int64_t>(faces.size()) - 1))];
                const SurfacePlace place = place_in(tin, lattice, face, 0.2 + 0.3 * random.real(), 0.3);
                // Steps well above the lattice's and well below the face's size.
                const double size = std::sqrt(std::abs(doubled_area_of(tin, lattice, face)));
                const double step = std::nearbyint(size * 1e-4) + 1;
                const Point2 gradient = of.reader->read(place).gradient;
                const auto at = [&](double x, double y) {
                    return of.reader->elevation({face, {place.at.x + x, place.at.y + y}});
                };
                const double length = 2 * step * lattice.step();
                const double x = (at(step, 0) - at(-step, 0)) / length;
                const double y = (at(0, step) - at(0, -step)) / length;
                const double scale = 1e-3 * (std::abs(x) + std::abs(y)) + 1e-4;
                ++all;
                bad += std::abs(gradient.x - x) + std::abs(gradient.y - y) > scale ? 1 : 0;
            }
            // Differences may straddle an edge, a kernel's own crease, or where a value is clamped.
            CHECK(bad * 10 <= all);
        });
    }

    TEST_CASE("elevations that no sum of squares holds are refused by what needs such sums") {
        for (const auto& named : kInterpolationMethods) {
            const std::string_view name = named.first;
            const auto method = named.second;
            CAPTURE(std::string(name));
            const Tin tin = tin_of_samples({{0, 0, 0}, {10, 0, 1e101}, {0, 10, 5}});
            const auto make = [&, chosen = method] { Reading(tin, chosen); };
            if (method == InterpolationMethod::Linear || method == InterpolationMethod::Nearest) {
                CHECK_NOTHROW(make());
            } else {
                const std::string message = message_of<InputError>(make);
                CHECK(message.starts_with("the elevation 1"));
                CHECK(message.ends_with(
                    " at (10, 0) is beyond 1e100, which only the methods linear and nearest can read"));
            }
        }
    }
}
