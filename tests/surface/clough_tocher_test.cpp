#include "tinwright/surface/clough_tocher.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/surface/cubic_face.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/locator.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using tinwright::CubicFace;
using tinwright::CubicFaceData;
using tinwright::CubicFaceForm;
using tinwright::FaceId;
using tinwright::GradientMethod;
using tinwright::HalfEdgeId;
using tinwright::Key2;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::QueryLattice;
using tinwright::SharpEdges;
using tinwright::SurfacePlace;
using tinwright::SurfaceReader;
using tinwright::SurfaceReading;
using tinwright::Tin;
using tinwright::VertexId;
using tinwright::VertexWeight;
using tinwright_tests::Random;

namespace {

constexpr std::array kMethods{GradientMethod::Ring, GradientMethod::Octant, GradientMethod::Sibson};

double hill(double x, double y) { return 40 * std::sin(x / 30) * std::cos(y / 40) + 0.1 * x; }

/// Samples to the millimetre around a place in UTM metres, of `surface` as seen from there.
std::vector<Point3> survey(Random& random, int count, double extent,
                           const std::function<double(double, double)>& surface) {
    std::vector<Point3> samples;
    for (int i = 0; i < count; ++i) {
        const auto coordinate = [&](double origin) {
            const double steps = std::floor(random.real() * extent * 1000);
            return std::pair{steps / 1000, (origin * 1000 + steps) / 1000};
        };
        const auto [x, world_x] = coordinate(512000);
        const auto [y, world_y] = coordinate(5400000);
        samples.push_back({world_x, world_y, surface(x, y)});
    }
    return samples;
}

Tin survey_tin(Random& random, int count) {
    return tinwright_tests::tin_of_samples(survey(random, count, 100, hill),
                                           tinwright::DuplicatePolicy::First);
}

template <class Visit>
void for_faces(const Tin& tin, Visit visit) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            visit(FaceId{f});
        }
    }
}

template <class Visit>
void for_inner_edges(const Tin& tin, Visit visit) {
    for_faces(tin, [&](FaceId f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = tinwright::half_edge(f, i);
            if (h < tin.mesh.twin(h) && tin.mesh.is_terrain(face_of(tin.mesh.twin(h)))) {
                visit(h);
            }
        }
    });
}

/// The place nearest to these shares of a face's corners.
SurfacePlace place_at(const Tin& tin, const QueryLattice& lattice, FaceId f, double b, double c) {
    std::array<Key2, 3> key;
    for (unsigned i = 0; i < 3; ++i) {
        key[i] = lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
    }
    return {f,
            {std::nearbyint(key[0].x + b * (key[1].x - key[0].x) + c * (key[2].x - key[0].x)),
             std::nearbyint(key[0].y + b * (key[1].y - key[0].y) + c * (key[2].y - key[0].y))}};
}

SurfacePlace random_place(Random& random, const Tin& tin, const QueryLattice& lattice, FaceId f) {
    const double b = random.real();
    const double c = (1 - b) * random.real();
    return place_at(tin, lattice, f, b, c);
}

/// The place at a share of an edge, as seen from one of its faces.
SurfacePlace place_on(const Tin& tin, const QueryLattice& lattice, HalfEdgeId h, double share) {
    const Key2 a = lattice.scaled(tin.key(tin.mesh.origin(h)));
    const Key2 b = lattice.scaled(tin.key(tin.mesh.destination(h)));
    return {face_of(h),
            {std::nearbyint(a.x + share * (b.x - a.x)), std::nearbyint(a.y + share * (b.y - a.y))}};
}

double range_of(const Tin& tin) {
    const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
    return *high - *low;
}

/// Corners, in CRS units about the first, for the macro-element alone.
struct Triangle {
    std::array<Point2, 3> corner;

    [[nodiscard]] std::array<Point2, 3> edges() const {
        std::array<Point2, 3> edge;
        for (unsigned i = 0; i < 3; ++i) {
            const Point2 to = corner[(i + 1) % 3];
            edge[i] = {to.x - corner[i].x, to.y - corner[i].y};
        }
        return edge;
    }
    [[nodiscard]] Point2 at(const tinwright::Shares& s) const {
        return {s[0] * corner[0].x + s[1] * corner[1].x + s[2] * corner[2].x,
                s[0] * corner[0].y + s[1] * corner[1].y + s[2] * corner[2].y};
    }
};

/// The element with a function's own elevations and gradients.
template <class Value, class Gradient>
CubicFace element_of(const Triangle& triangle, Value value, Gradient gradient) {
    const std::array<Point2, 3> edge = triangle.edges();
    CubicFaceData data;
    for (unsigned i = 0; i < 3; ++i) {
        const Point2 g = gradient(triangle.corner[i]);
        const Point2 next = edge[i];
        const Point2 last = edge[(i + 2) % 3];
        data.z[i] = value(triangle.corner[i]);
        data.rise[i] = {g.x * next.x + g.y * next.y, -(g.x * last.x + g.y * last.y)};
    }
    return {CubicFaceForm(edge), data};
}

tinwright::Shares random_shares(Random& random) {
    const double b = random.real();
    const double c = (1 - b) * random.real();
    return {1 - b - c, b, c};
}

/// A plain with a bank: a line that bends and climbs, steep on one side of it.
Tin banked_tin(Random& random, bool is_straight) {
    const auto bank = [&](double x) { return is_straight ? 50.0 : 50 + 12 * std::sin(x / 9); };
    const auto ground = [&](double x, double y) {
        return 0.05 * x + 0.02 * y + (y > bank(x) ? 0.8 * (y - bank(x)) : 0);
    };
    std::vector<Point3> samples = survey(random, 300, 100, ground);
    tinwright::Breakline line;
    for (int x = 3; x <= 97; x += is_straight ? 2 : 4) {
        const double y = std::round(bank(x) * 1000) / 1000;
        line.points.push_back({512000.0 + x, 5400000.0 + y, 0.05 * x + 0.02 * y});
    }
    tinwright::ConstrainedTinOptions options;
    options.duplicates.policy = tinwright::DuplicatePolicy::First;
    return tinwright::make_constrained_tin(samples, std::vector{line}, options).tin;
}

}  // namespace

TEST_SUITE("surface/clough_tocher") {
    TEST_CASE("a macro-element with exact gradients reproduces quadratics") {
        for (int seed = 1; seed <= tinwright_tests::cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Triangle triangle{};
            for (Point2& p : triangle.corner) {
                p = {random.real(), random.real()};
            }
            std::array<double, 6> q{};
            for (double& each : q) {
                each = 2 * random.real() - 1;
            }
            const auto value = [&](Point2 p) {
                return q[0] + q[1] * p.x + q[2] * p.y + q[3] * p.x * p.x + q[4] * p.x * p.y +
                       q[5] * p.y * p.y;
            };
            const CubicFace face = element_of(triangle, value, [&](Point2 p) {
                return Point2{q[1] + 2 * q[3] * p.x + q[4] * p.y, q[2] + q[4] * p.x + 2 * q[5] * p.y};
            });
            for (int k = 0; k < 20; ++k) {
                const tinwright::Shares share = random_shares(random);
                REQUIRE(std::abs(face.at(share).z - value(triangle.at(share))) <= 1e-12);
            }
        }
    }

    TEST_CASE("a macro-element is smooth across the lines to its centroid") {
        for (int seed = 1; seed <= tinwright_tests::cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            CubicFaceData data;
            for (unsigned i = 0; i < 3; ++i) {
                data.z[i] = random.real();
                data.rise[i] = {random.real() - 0.5, random.real() - 0.5};
            }
            const CubicFace face(
                CubicFaceForm(Triangle{{{{0, 0}, {1 + random.real(), 0}, {random.real(), 1}}}}.edges()),
                data);
            for (unsigned i = 0; i < 3; ++i) {
                const double to_center = random.real();
                tinwright::Shares share{to_center / 3, to_center / 3, to_center / 3};
                share[i] += 1 - to_center;
                constexpr double kStep = 1e-9;
                tinwright::Shares left = share;
                tinwright::Shares right = share;
                left[(i + 1) % 3] += kStep;
                left[(i + 2) % 3] -= kStep;
                right[(i + 1) % 3] -= kStep;
                right[(i + 2) % 3] += kStep;
                const CubicFace::Value a = face.at(left);
                const CubicFace::Value b = face.at(right);
                REQUIRE(std::abs(a.z - b.z) <= 1e-7);
                for (unsigned k = 0; k < 2; ++k) {  // differences of shares' changes are what counts
                    REQUIRE(std::abs((a.change[k] - a.change[2]) - (b.change[k] - b.change[2])) <= 1e-6);
                }
            }
        }
    }

    TEST_CASE("errors fall with the third power of the spacing where gradients are exact") {
        const auto value = [](Point2 p) { return std::sin(3 * p.x) * std::cos(2 * p.y); };
        const auto gradient = [](Point2 p) {
            return Point2{3 * std::cos(3 * p.x) * std::cos(2 * p.y),
                          -2 * std::sin(3 * p.x) * std::sin(2 * p.y)};
        };
        const auto worst = [&](double size) {
            Random random(7);
            const Triangle triangle{{{{0.3, 0.4}, {0.3 + size, 0.4 + 0.1 * size}, {0.3, 0.4 + size}}}};
            const CubicFace face = element_of(triangle, value, gradient);
            double error = 0;
            for (int k = 0; k < 500; ++k) {
                const tinwright::Shares share = random_shares(random);
                error = std::max(error, std::abs(face.at(share).z - value(triangle.at(share))));
            }
            return error;
        };
        for (const double size : {0.4, 0.2, 0.1, 0.05}) {
            CAPTURE(size);
            const double order = std::log2(worst(size) / worst(size / 2));
            CHECK(order > 2.6);
            CHECK(order < 3.4);
        }
    }

    TEST_CASE("planes are reproduced on every kind of TIN") {
        for (const auto families :
             {tinwright_tests::general_families(), tinwright_tests::degenerate_families()}) {
            for (const tinwright_tests::TinFamily& family : families) {
                for (int seed = 1; seed <= tinwright_tests::cases(3); ++seed) {
                    CAPTURE(family.name);
                    CAPTURE(seed);
                    Random random(static_cast<std::uint64_t>(seed));
                    Tin tin = family.make(random, 40);
                    if (tin.mesh.count_terrain() == 0) {
                        continue;
                    }
                    tinwright_tests::flip_at_random(random, tin, 10);
                    tinwright_tests::constrain_at_random(random, tin, seed % 2 == 0 ? 10 : 0);
                    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                        tin.z[v] = 3 + 0.5 * tin.keys[v].x - 0.25 * tin.keys[v].y;
                    }
                    const SharpEdges sharp(tin, {});
                    const QueryLattice lattice(tin);
                    const double tolerance = 1e-12 * range_of(tin);
                    for (const GradientMethod method : kMethods) {
                        const auto surface = make_clough_tocher(tin, sharp, {.gradients = method});
                        const auto reader = surface->make_reader();
                        for_faces(tin, [&](FaceId f) {
                            double aspect = 1;
                            for (unsigned i = 0; i < 3; ++i) {
                                const Key2 a = tin.key(tin.mesh.vertex(f, i));
                                const Key2 b = tin.key(tin.mesh.vertex(f, (i + 1) % 3));
                                const Key2 c = tin.key(tin.mesh.vertex(f, (i + 2) % 3));
                                aspect = std::max(aspect, tinwright::squared_distance(a, b) /
                                                              tinwright::doubled_area(a, b, c));
                            }
                            const SurfacePlace place = random_place(random, tin, lattice, f);
                            const double z = 3 + (0.5 * place.at.x - 0.25 * place.at.y) / lattice.scale();
                            REQUIRE(std::abs(reader->elevation(place) - z) <= tolerance * aspect);
                        });
                    }
                }
            }
        }
    }

    TEST_CASE("the surface passes through the vertices bit for bit, with the gradients at the corners") {
        Random random(1);
        const Tin tin = survey_tin(random, 200);
        const SharpEdges sharp(tin, {});
        const QueryLattice lattice(tin);
        for (const bool is_limited : {false, true}) {
            const auto surface = make_clough_tocher(tin, sharp, {.is_limited = is_limited});
            const auto reader = surface->make_reader();
            const tinwright::CornerGradients gradients(tin, sharp, GradientMethod::Octant);
            for_faces(tin, [&](FaceId f) {
                for (unsigned i = 0; i < 3; ++i) {
                    const VertexId v = tin.mesh.vertex(f, i);
                    const SurfaceReading reading = reader->read({f, lattice.scaled(tin.key(v))});
                    REQUIRE(std::bit_cast<std::uint64_t>(reading.z) ==
                            std::bit_cast<std::uint64_t>(tin.z[v.value]));
                    REQUIRE(reading.gradient == gradients.at(tinwright::half_edge(f, i)));
                }
            });
        }
    }

    TEST_CASE("elevation and gradient are the same on both sides of an edge") {
        for (int seed = 1; seed <= tinwright_tests::cases(5); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = survey_tin(random, 300);
            tinwright_tests::flip_at_random(random, tin, seed % 2 == 0 ? 100 : 0);
            const QueryLattice lattice(tin);
            for (const GradientMethod method : kMethods) {
                const auto surface = make_clough_tocher(tin, {}, {.gradients = method});
                const auto reader = surface->make_reader();
                for_inner_edges(tin, [&](HalfEdgeId h) {
                    const double share = random.real();
                    const SurfacePlace here = place_on(tin, lattice, h, share);
                    const SurfacePlace there{face_of(tin.mesh.twin(h)), here.at};
                    const SurfaceReading a = reader->read(here);
                    const SurfaceReading b = reader->read(there);
                    const double steep = 1 + std::hypot(a.gradient.x, a.gradient.y);
                    CAPTURE(steep);
                    REQUIRE(std::abs(a.z - b.z) <= 1e-7 * steep);
                    REQUIRE(std::hypot(a.gradient.x - b.gradient.x, a.gradient.y - b.gradient.y) <=
                            1e-5 * steep);
                });
            }
        }
    }

    TEST_CASE("the gradient is the limit of differences of elevations") {
        Random random(3);
        const Tin tin = survey_tin(random, 300);
        const QueryLattice lattice(tin);
        for (const bool is_limited : {false, true}) {
            const auto surface = make_clough_tocher(tin, {}, {.is_limited = is_limited});
            const auto reader = surface->make_reader();
            int wrong = 0;
            for_faces(tin, [&](FaceId f) {
                const SurfacePlace place = random_place(random, tin, lattice, f);
                const SurfaceReading reading = reader->read(place);
                REQUIRE(reading.z == reader->elevation(place));
                const double step = std::nearbyint(1e-4 / lattice.step());
                const auto slope = [&](double x, double y) {
                    const SurfacePlace ahead{f, {place.at.x + x * step, place.at.y + y * step}};
                    const SurfacePlace behind{f, {place.at.x - x * step, place.at.y - y * step}};
                    return (reader->elevation(ahead) - reader->elevation(behind)) /
                           (2 * step * lattice.step());
                };
                const double error =
                    std::hypot(slope(1, 0) - reading.gradient.x, slope(0, 1) - reading.gradient.y);
                wrong += error > 1e-4 * (1 + std::hypot(reading.gradient.x, reading.gradient.y)) ? 1 : 0;
            });
            CHECK(wrong <= 10);  // needles at the hull, and where the limit sets in between the two
        }
    }

    TEST_CASE("weights sum to one and give the elevation") {
        for (int seed = 1; seed <= tinwright_tests::cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = seed % 2 == 0 ? survey_tin(random, 100) : banked_tin(random, false);
            const SharpEdges sharp(tin, {});
            const QueryLattice lattice(tin);
            for (const GradientMethod method : kMethods) {
                const auto surface = make_clough_tocher(tin, sharp, {.gradients = method});
                const auto reader = surface->make_reader();
                std::vector<VertexWeight> weights;
                for_faces(tin, [&](FaceId f) {
                    const SurfacePlace place = random_place(random, tin, lattice, f);
                    reader->find_weights(place, weights);
                    double sum = 0;
                    double size = 0;
                    double z = 0;
                    for (const VertexWeight& each : weights) {
                        sum += each.weight;
                        size += std::abs(each.weight);
                        z += each.weight * tin.z[each.vertex.value];
                    }
                    REQUIRE(std::abs(sum - 1) <= 1e-12 * size);
                    REQUIRE(std::abs(z - reader->elevation(place)) <= 1e-9 * size);
                });
            }
        }
    }

    TEST_CASE("the surface is continuous at sharp edges, straight along them, and breaks across them") {
        for (int seed = 1; seed <= tinwright_tests::cases(4); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = banked_tin(random, false);
            const SharpEdges sharp(tin, {});
            const QueryLattice lattice(tin);
            const auto surface = make_clough_tocher(tin, sharp);
            const auto reader = surface->make_reader();
            int breaks = 0;
            for_inner_edges(tin, [&](HalfEdgeId h) {
                const double share = random.real();
                const SurfacePlace here = place_on(tin, lattice, h, share);
                const SurfaceReading a = reader->read(here);
                const SurfaceReading b = reader->read({face_of(tin.mesh.twin(h)), here.at});
                REQUIRE(std::abs(a.z - b.z) <= 1e-6);
                if (sharp.is_sharp(h)) {
                    const double straight = (1 - share) * tin.z[tin.mesh.origin(h).value] +
                                            share * tin.z[tin.mesh.destination(h).value];
                    REQUIRE(std::abs(a.z - straight) <= 1e-6);
                    breaks +=
                        std::hypot(a.gradient.x - b.gradient.x, a.gradient.y - b.gradient.y) > 0.4 ? 1 : 0;
                }
            });
            CHECK(breaks >= 12);  // of about 24, the slope across being 0.8
        }
    }

    TEST_CASE("beside a straight line of one slope the surface is smooth but across the line") {
        Random random(5);
        const Tin tin = banked_tin(random, true);
        const SharpEdges sharp(tin, {});
        const QueryLattice lattice(tin);
        const auto surface = make_clough_tocher(tin, sharp);
        const auto reader = surface->make_reader();
        for_inner_edges(tin, [&](HalfEdgeId h) {
            if (!sharp.is_sharp(h)) {
                const SurfacePlace here = place_on(tin, lattice, h, random.real());
                const Point2 a = reader->read(here).gradient;
                const Point2 b = reader->read({face_of(tin.mesh.twin(h)), here.at}).gradient;
                REQUIRE(std::hypot(a.x - b.x, a.y - b.y) <= 1e-5 * (1 + std::hypot(a.x, a.y)));
            }
        });
    }

    TEST_CASE("limited, the surface keeps to the elevations around, and stays continuous") {
        for (int seed = 1; seed <= tinwright_tests::cases(4); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = survey_tin(random, 300);
            for (double& z : tin.z) {
                z = random.integer(0, 3) == 0 ? 10 : 0;  // plains with steps, which a cubic overshoots
            }
            const QueryLattice lattice(tin);
            const auto free = make_clough_tocher(tin, {});
            const auto limited = make_clough_tocher(tin, {}, {.is_limited = true});
            const auto free_reader = free->make_reader();
            const auto reader = limited->make_reader();
            int beyond = 0;
            for_faces(tin, [&](FaceId f) {
                const SurfacePlace place = random_place(random, tin, lattice, f);
                const double z = free_reader->elevation(place);
                beyond += z < -1e-9 || z > 10 + 1e-9 ? 1 : 0;
                REQUIRE(reader->elevation(place) >= 0);
                REQUIRE(reader->elevation(place) <= 10 * (1 + 1e-15));
            });
            CHECK(beyond > 20);
            for_inner_edges(tin, [&](HalfEdgeId h) {
                const SurfacePlace here = place_on(tin, lattice, h, random.real());
                const SurfacePlace there{face_of(tin.mesh.twin(h)), here.at};
                REQUIRE(std::abs(reader->elevation(here) - reader->elevation(there)) <= 1e-6);
            });
        }
    }

    TEST_CASE("a surface does not depend on threads, on what was read before, or where faces start") {
        Random random(9);
        const Tin tin = banked_tin(random, false);
        const SharpEdges sharp(tin, {});
        const QueryLattice lattice(tin);
        std::vector<SurfacePlace> places;
        for_faces(tin, [&](FaceId f) { places.push_back(random_place(random, tin, lattice, f)); });
        std::vector<std::vector<double>> readings;
        for (const int threads : {1, 4}) {
            tbb::task_arena arena(threads);
            arena.execute([&] {
                const auto surface = make_clough_tocher(tin, sharp);
                const auto reader = surface->make_reader();
                std::vector<double> z;
                for (const SurfacePlace& place : places) {
                    const SurfaceReading reading = reader->read(place);
                    z.insert(z.end(), {reading.z, reading.gradient.x, reading.gradient.y});
                    REQUIRE(surface->make_reader()->elevation(place) == reading.z);
                }
                readings.push_back(z);
            });
        }
        CHECK(readings[0] == readings[1]);
    }

    TEST_CASE("on Franke's function errors are a fraction of those of facets, and fall faster") {
        const auto franke = [](double x, double y) {  // the first of [franke1982]
            const auto bump = [](double a, double b) { return std::exp(-(a * a + b * b) / 4); };
            return 0.75 * bump(9 * x - 2, 9 * y - 2) + 0.5 * bump(9 * x - 7, 9 * y - 3) +
                   0.75 * std::exp(-std::pow(9 * x + 1, 2) / 49 - (9 * y + 1) / 10) -
                   0.2 * std::exp(-std::pow(9 * x - 4, 2) - std::pow(9 * y - 7, 2));
        };
        const auto errors = [&](int side) {  // of facets, and of the surface
            Random random(2);
            std::vector<Point3> samples;
            for (int i = 0; i < side * side; ++i) {
                const auto off = [&](int place) {
                    return std::round((place + 0.1 + 0.8 * random.real()) / (side - 2) * 1e6) / 1e6;
                };
                const double x = off(i % side - 1);
                const double y = off(i / side - 1);
                samples.push_back({x + 1, y + 1, franke(x, y)});
            }
            const Tin tin = tinwright_tests::tin_of_samples(samples);
            const tinwright::SurfaceLocator locator(tin);
            const auto facets = tinwright::make_linear(tin);
            const auto surface = make_clough_tocher(tin, {});
            const auto linear = facets->make_reader();
            const auto smooth = surface->make_reader();
            std::array<double, 2> sum{};
            int count = 0;
            for (int i = 0; i < 1000; ++i) {
                const double x = random.real();
                const double y = random.real();
                if (const auto place = locator.find(Point2{x + 1, y + 1})) {
                    sum[0] += std::pow(linear->elevation(*place) - franke(x, y), 2);
                    sum[1] += std::pow(smooth->elevation(*place) - franke(x, y), 2);
                    ++count;
                }
            }
            CHECK(count > 950);
            return std::array{std::sqrt(sum[0] / count), std::sqrt(sum[1] / count)};
        };
        const auto of_33 = errors(6);
        const auto of_100 = errors(10);
        const auto of_400 = errors(20);
        const auto of_1600 = errors(40);
        CHECK(of_33[1] < of_33[0]);
        CHECK(of_33[1] < 0.09);
        CHECK(of_100[1] < 0.7 * of_100[0]);
        CHECK(of_100[1] < 0.03);
        CHECK(of_400[1] < 0.4 * of_400[0]);
        CHECK(of_1600[1] < 0.2 * of_1600[0]);
        CHECK(std::log2(of_400[1] / of_1600[1]) > 2.5);
    }
}
