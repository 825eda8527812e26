#include "tinwright/surface/face_circles.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// Corners of a face: of any form, needles, almost in a row, on a small lattice (where circles have many
/// lattice points), each as large as keys get or small and far out.
std::array<Key2, 3> corners_of(Random& random, int form, double size, Key2 origin) {
    const auto any = [&] { return std::floor(size * random.real()); };
    Key2 a{any(), any()};
    Key2 b{any(), any()};
    Key2 c{any(), any()};
    if (form == 1) {
        c = {b.x + static_cast<double>(random.integer(-2, 2)),
             b.y + static_cast<double>(random.integer(0, 2))};
    } else if (form == 2) {
        const double along = random.real();
        c = {std::round(a.x + along * (b.x - a.x)) + static_cast<double>(random.integer(-1, 1)),
             std::round(a.y + along * (b.y - a.y))};
    } else if (form == 3) {
        for (Key2* const key : {&a, &b, &c}) {
            *key = {static_cast<double>(random.integer(0, 10)), static_cast<double>(random.integer(0, 10))};
        }
    }
    for (Key2* const key : {&a, &b, &c}) {
        *key = {std::abs(key->x) + origin.x, std::abs(key->y) + origin.y};
    }
    return {a, b, c};
}

}  // namespace

TEST_SUITE("surface/face_circles") {
    TEST_CASE("which places are inside is exact, on circles and beside them") {
        int on_circle = 0;
        for (int seed = 1; seed <= cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const int form = seed % 4;
            const bool is_large = seed % 8 < 4;
            const double size = is_large ? 0x1p49 : 0x1p12;
            const double far_out = is_large || form == 3 ? 0 : 0x1p48 * random.real();
            std::array<Key2, 3> corner =
                corners_of(random, form, size, {std::floor(far_out), std::floor(far_out / 3)});
            const int turn = orient2d(corner[0], corner[1], corner[2]);
            if (turn == 0) {
                continue;
            }
            if (turn < 0) {
                std::swap(corner[1], corner[2]);
            }
            Tin tin = tin_of(corner);
            tin.mesh = mesh_of(3, {0, 1, 2});
            const QueryLattice lattice(tin);
            const FaceCircles circles(tin, lattice);
            std::array<Key2, 3> key{};
            for (std::uint32_t i = 0; i < 3; ++i) {
                key[i] = lattice.scaled(corner[i]);
            }
            // The circle, roughly; places are on it but for that and rounding.
            const double bx = key[1].x - key[0].x;
            const double by = key[1].y - key[0].y;
            const double cx = key[2].x - key[0].x;
            const double cy = key[2].y - key[0].y;
            const double doubled = 2 * (bx * cy - by * cx);
            const double ux = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / doubled;
            const double uy = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / doubled;
            std::vector<Key2> places(key.begin(), key.end());
            for (int i = 0; i < 60; ++i) {
                const double angle = 7 * random.real();
                const double from = i % 3 == 0 ? 0 : std::atan2(-uy, -ux);  // corner 0 as seen from there
                const double turned = from + (i % 3 == 1 ? angle * 1e-6 : angle);
                const double radius = std::hypot(ux, uy);
                places.push_back({std::round(key[0].x + ux + radius * std::cos(turned)),
                                  std::round(key[0].y + uy + radius * std::sin(turned))});
                const Key2& near = key[static_cast<std::size_t>(i % 3)];
                places.push_back({near.x + static_cast<double>(random.integer(-3, 3)),
                                  near.y + static_cast<double>(random.integer(-3, 3))});
                places.push_back({std::floor(0x1p50 * random.real()), std::floor(0x1p50 * random.real())});
            }
            for (int x = 0; form == 3 && x <= 10; ++x) {
                for (int y = 0; y <= 10; ++y) {
                    places.push_back(lattice.scaled({static_cast<double>(x), static_cast<double>(y)}));
                }
            }
            for (const Key2 place : places) {
                if (!(std::abs(place.x) <= 0x1p52 && std::abs(place.y) <= 0x1p52)) {
                    continue;
                }
                const int sign = incircle(key[0], key[1], key[2], place);
                on_circle += sign == 0 ? 1 : 0;
                REQUIRE(circles.is_inside({0}, place) == (sign > 0));
            }
        }
        CHECK(on_circle > 1000);
    }
}
