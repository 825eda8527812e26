#include "tinwright/surface/gradients.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using tinwright::CornerGradients;
using tinwright::GradientMethod;
using tinwright::HalfEdgeId;
using tinwright::Key2;
using tinwright::Point2;
using tinwright::SharpEdges;
using tinwright::Tin;
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
}
