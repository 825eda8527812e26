#include "tinwright/surface/gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using tinwright::CornerGradients;
using tinwright::GradientMethod;
using tinwright::GradientWeight;
using tinwright::HalfEdgeId;
using tinwright::Key2;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::SharpEdges;
using tinwright::Tin;
using tinwright::VertexId;
using tinwright_tests::Random;

namespace {

constexpr std::array kMethods{GradientMethod::Ring, GradientMethod::Octant, GradientMethod::Sibson};

/// Random TINs of all families, some with flipped edges, voids and constrained edges, which are sharp as no
/// line says why they are there.
template <class Visit>
void for_random_tins(int count, Visit visit) {
    const int seeds = tinwright_tests::cases(count);
    for (const auto families :
         {tinwright_tests::general_families(), tinwright_tests::degenerate_families()}) {
        for (const tinwright_tests::TinFamily& family : families) {
            for (int seed = 1; seed <= seeds; ++seed) {
                CAPTURE(family.name);
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = family.make(random, 40);
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                tinwright_tests::flip_at_random(random, tin, seed % 3 == 0 ? 20 : 0);
                tinwright_tests::constrain_at_random(random, tin, seed % 2 == 0 ? 12 : 0);
                if (seed % 5 == 0 && tin.mesh.count_terrain() > 8) {
                    tinwright_tests::make_voids_at_random(random, tin, 5);
                }
                visit(random, tin);
            }
        }
    }
}

template <class Visit>
void for_corners(const Tin& tin, Visit visit) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            visit(tinwright::half_edge({f}, i));
        }
    }
}

/// A function on the unit square, at places off the points of a square grid, in curve order.
template <class Value>
Tin jittered_tin(Random& random, int side, Value value) {
    std::vector<Point3> samples;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double x = std::round((column + 0.2 + 0.6 * random.real()) / side * 1e6) / 1e6;
            const double y = std::round((row + 0.2 + 0.6 * random.real()) / side * 1e6) / 1e6;
            samples.push_back({x, y, value(x, y)});
        }
    }
    return tinwright_tests::tin_of_samples(samples);
}

/// Far enough from the border of such a TIN.
bool is_inside(Point3 p) { return std::min({p.x, p.y, 1 - p.x, 1 - p.y}) > 0.25; }

/// Longest edge over height of the worst needle: by so much do roundings grow.
double worst_aspect(const Tin& tin) {
    double worst = 1;
    for_corners(tin, [&](HalfEdgeId h) {
        const Key2 a = tin.key(tin.mesh.origin(h));
        const Key2 b = tin.key(tin.mesh.destination(h));
        const Key2 c = tin.key(tin.mesh.origin(previous(h)));
        worst = std::max(worst, tinwright::squared_distance(a, b) / tinwright::doubled_area(a, b, c));
    });
    return worst;
}

}  // namespace

TEST_SUITE("surface/gradients") {
    TEST_CASE("every estimator has the gradient of a plane") {
        for_random_tins(6, [](Random& /*random*/, Tin& tin) {
            const Point2 slope{0.5, -0.25};
            double range = 0;
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                tin.z[v] = 7 + slope.x * tin.keys[v].x + slope.y * tin.keys[v].y;
                range = std::max(range, std::abs(tin.z[v]));
            }
            const double tolerance = 1e-13 * range * worst_aspect(tin);
            const SharpEdges sharp(tin, {});
            for (const GradientMethod method : kMethods) {
                CAPTURE(static_cast<int>(method));
                const CornerGradients gradients(tin, sharp, method);
                for_corners(tin, [&](HalfEdgeId h) {
                    const Point2 g = gradients.at(h);
                    for (const HalfEdgeId edge : {h, previous(h)}) {
                        const Key2 a = tin.key(tin.mesh.origin(edge));
                        const Key2 b = tin.key(tin.mesh.destination(edge));
                        const double error = (g.x - slope.x) * (b.x - a.x) + (g.y - slope.y) * (b.y - a.y);
                        REQUIRE(std::abs(error) <= tolerance);
                    }
                });
            }
        });
    }

    TEST_CASE("octants have the gradient of a quadric inside") {
        for (int seed = 1; seed <= tinwright_tests::cases(5); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto value = [](double x, double y) {
                return 1 + x - 2 * y + x * x - 3 * x * y + 2 * y * y;
            };
            const Tin tin = jittered_tin(random, 20, value);
            const CornerGradients gradients(tin, {}, GradientMethod::Octant);
            for_corners(tin, [&](HalfEdgeId h) {
                const Point3 p = tin.position(tin.mesh.origin(h));
                if (is_inside(p)) {
                    const Point2 g = gradients.at(h);
                    REQUIRE(std::abs(g.x - (1 + 2 * p.x - 3 * p.y)) <= 1e-9);
                    REQUIRE(std::abs(g.y - (-2 - 3 * p.x + 4 * p.y)) <= 1e-9);
                }
            });
        }
    }

    TEST_CASE("errors inside fall with the spacing, those of octants with its square") {
        const auto value = [](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); };
        const auto error = [&](GradientMethod method, int side) {
            Random random(4);
            const Tin tin = jittered_tin(random, side, value);
            const CornerGradients gradients(tin, {}, method);
            double sum = 0;
            double count = 0;
            for_corners(tin, [&](HalfEdgeId h) {
                const Point3 p = tin.position(tin.mesh.origin(h));
                if (is_inside(p)) {
                    const Point2 g = gradients.at(h);
                    sum += std::pow(g.x - 3 * std::cos(3 * p.x) * std::cos(2 * p.y), 2) +
                           std::pow(g.y + 2 * std::sin(3 * p.x) * std::sin(2 * p.y), 2);
                    ++count;
                }
            });
            return std::sqrt(sum / count);
        };
        for (const int side : {16, 32}) {
            CAPTURE(side);
            const auto order = [&](GradientMethod method) {
                return std::log2(error(method, side) / error(method, 2 * side));
            };
            CHECK(order(GradientMethod::Ring) > 0.8);
            CHECK(order(GradientMethod::Octant) > 1.7);
            CHECK(order(GradientMethod::Sibson) > 0.8);
        }
    }

    TEST_CASE("weights sum to zero and give the gradient") {
        for_random_tins(3, [](Random& random, Tin& tin) {
            for (double& z : tin.z) {
                z = random.real();
            }
            const SharpEdges sharp(tin, {});
            for (const GradientMethod method : kMethods) {
                CAPTURE(static_cast<int>(method));
                const CornerGradients gradients(tin, sharp, method);
                for_corners(tin, [&](HalfEdgeId h) {
                    if (random.integer(0, 7) != 0) {
                        return;
                    }
                    const std::vector<GradientWeight> weights = gradients.weights(h);
                    Point2 sum;
                    Point2 g;
                    double size = 0;
                    for (const GradientWeight& each : weights) {
                        sum = {sum.x + each.weight.x, sum.y + each.weight.y};
                        g = {g.x + each.weight.x * tin.z[each.vertex.value],
                             g.y + each.weight.y * tin.z[each.vertex.value]};
                        size += std::hypot(each.weight.x, each.weight.y);
                    }
                    REQUIRE(std::hypot(sum.x, sum.y) <= 1e-10 * size);
                    REQUIRE(std::hypot(g.x - gradients.at(h).x, g.y - gradients.at(h).y) <= 1e-10 * size);
                });
            }
        });
    }

    TEST_CASE("each side of a straight sharp line has its own plane's gradient") {
        for (int seed = 1; seed <= tinwright_tests::cases(5); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Point3> samples;
            const auto z = [](double x, double y) { return x + (y > 50 ? 2 * (y - 50) : -0.5 * (y - 50)); };
            for (int i = 0; i < 200; ++i) {
                const double x = random.key(100000) / 1000;
                const double y = random.key(100000) / 1000;
                samples.push_back({x, y, z(x, y)});
            }
            tinwright::Breakline line;
            for (const double x : {-10.0, 20.0, 23.0, 60.0, 110.0}) {
                line.points.push_back({x, 50, x});
            }
            tinwright::ConstrainedTinOptions options;
            options.duplicates.policy = tinwright::DuplicatePolicy::First;
            const Tin tin = tinwright::make_constrained_tin(samples, std::vector{line}, options).tin;
            const SharpEdges sharp(tin, {});
            for (const GradientMethod method : kMethods) {
                const CornerGradients gradients(tin, sharp, method);
                for_corners(tin, [&](HalfEdgeId h) {
                    double side = 0;
                    for (unsigned i = 0; i < 3; ++i) {
                        side += tin.position(tin.mesh.vertex(face_of(h), i)).y - 50;
                    }
                    const Point3 p = tin.position(tin.mesh.origin(h));
                    if (p.y != 50 || (p.x > 0 && p.x < 100)) {
                        const Point2 g = gradients.at(h);
                        REQUIRE(std::abs(g.x - 1) <= 1e-6);
                        REQUIRE(std::abs(g.y - (side > 0 ? 2 : -0.5)) <= 1e-6);
                    }
                });
            }
        }
    }

    TEST_CASE("along a sharp edge both sides have its slope") {
        for_random_tins(4, [](Random& random, Tin& tin) {
            for (double& z : tin.z) {
                z = random.real();
            }
            const SharpEdges sharp(tin, {});
            const double tolerance = 1e-13 * worst_aspect(tin);
            const CornerGradients gradients(tin, sharp, GradientMethod::Octant);
            for_corners(tin, [&](HalfEdgeId h) {
                const auto check = [&](HalfEdgeId corner, VertexId from, VertexId to) {
                    const Point2 g = gradients.at(corner);
                    const double x = tin.key(to).x - tin.key(from).x;
                    const double y = tin.key(to).y - tin.key(from).y;
                    const double size = 1 + std::hypot(g.x, g.y) * std::hypot(x, y);
                    REQUIRE(std::abs(g.x * x + g.y * y - (tin.z[to.value] - tin.z[from.value])) <=
                            tolerance * size);
                };
                if (sharp.is_sharp(h)) {
                    check(h, tin.mesh.origin(h), tin.mesh.destination(h));
                    check(next(h), tin.mesh.destination(h), tin.mesh.origin(h));
                }
            });
        });
    }

    TEST_CASE("where octants say too little the ring is asked") {
        Tin tin = tinwright_tests::delaunay_tin({{0, 0}, {100, 0}, {30, 80}, {120, 90}});
        tin.z = {1, 5, 2, 7};
        const CornerGradients octant(tin, {}, GradientMethod::Octant);
        const CornerGradients ring(tin, {}, GradientMethod::Ring);
        for_corners(tin, [&](HalfEdgeId h) { CHECK(octant.at(h) == ring.at(h)); });
    }

    TEST_CASE("faces that touch at a vertex only have a gradient each") {
        Tin tin = tinwright_tests::tin_of(std::vector<Key2>{{10, 10}, {20, 10}, {10, 20}, {0, 10}, {10, 0}});
        tin.mesh = tinwright_tests::mesh_of(5, {0, 1, 2, 0, 3, 4});
        tin.z = {0, 10, 20, 0, 30};
        const CornerGradients gradients(tin, {}, GradientMethod::Octant);
        for_corners(tin, [&](HalfEdgeId h) {
            const bool is_upper = face_of(h).value == 0;
            const Point2 g = gradients.at(h);
            CHECK(std::abs(g.x - (is_upper ? 1 : 0)) <= 1e-12);
            CHECK(std::abs(g.y - (is_upper ? 2 : -3)) <= 1e-12);
        });
    }

    TEST_CASE("gradients do not depend on threads, nor on how faces are numbered and turned") {
        Random random(6);
        const Tin tin = jittered_tin(random, 40, [](double x, double y) { return std::sin(9 * x * y); });
        std::vector<std::uint32_t> corners;
        for (const auto& face : tinwright_tests::terrain_of(tin.mesh)) {
            corners.insert(corners.end(), face.begin(), face.end());
        }
        Tin other = tin;
        other.mesh =
            tinwright_tests::mesh_of(tin.vertex_count(), tinwright_tests::shuffled_faces(random, corners));
        for (const GradientMethod method : kMethods) {
            const auto by_vertex = [&](const Tin& of, int threads) {
                std::vector<Point2> gradients(of.vertex_count());
                tbb::task_arena(threads).execute([&] {
                    const CornerGradients corner(of, {}, method);
                    for_corners(of, [&](HalfEdgeId h) { gradients[of.mesh.origin(h).value] = corner.at(h); });
                });
                return gradients;
            };
            const std::vector<Point2> once = by_vertex(tin, 1);
            CHECK(once == by_vertex(tin, 4));
            CHECK(once == by_vertex(other, 1));
        }
    }
}
