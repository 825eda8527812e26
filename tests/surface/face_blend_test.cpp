#include "tinwright/surface/face_blend.hpp"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Shares = std::array<double, 3>;

Shares random_shares(Random& random) {
    const double a = random.real();
    const double b = (1 - a) * random.real();
    return {a, b, 1 - a - b};
}

/// The change of a corner's function with a step along the face.
double along(const FaceBlend& blend, unsigned corner, const Shares& step) {
    return blend.slope[corner][0] * step[0] + blend.slope[corner][1] * step[1] +
           blend.slope[corner][2] * step[2];
}

}  // namespace

TEST_SUITE("surface/face_blend") {
    TEST_CASE("functions sum to one, and slopes are those of differences") {
        Random random(1);
        for (int i = 0; i < cases(500); ++i) {
            CAPTURE(i);
            const Shares at = random_shares(random);
            const Shares foot{random.real(), random.real(), random.real()};
            const Shares step{1, -0.25, -0.75};
            const double h = 1e-6;
            const auto moved = [&](double by) {
                return blend_smoothly({at[0] + by * step[0], at[1] + by * step[1], at[2] + by * step[2]},
                                      foot);
            };
            const FaceBlend blend = blend_smoothly(at, foot);
            const FaceBlend ahead = moved(h);
            const FaceBlend behind = moved(-h);
            double sum = 0;
            for (unsigned corner = 0; corner < 3; ++corner) {
                sum += blend.share[corner];
                REQUIRE(blend.share[corner] >= -1e-15);
                REQUIRE(std::abs(along(blend, corner, step) -
                                 (ahead.share[corner] - behind.share[corner]) / (2 * h)) < 1e-5);
            }
            REQUIRE(std::abs(sum - 1) < 1e-14);
        }
    }

    TEST_CASE("at a corner its function is one, and no function has a slope") {
        const Shares foot{0.4, 0.6, 0.3};
        for (unsigned corner = 0; corner < 3; ++corner) {
            Shares at{};
            at[corner] = 1;
            const FaceBlend blend = blend_smoothly(at, foot);
            for (unsigned i = 0; i < 3; ++i) {
                CHECK(blend.share[i] == (i == corner ? 1 : 0));
                CHECK(std::abs(along(blend, i, {1, -1, 0})) < 1e-14);
                CHECK(std::abs(along(blend, i, {0, 1, -1})) < 1e-14);
            }
        }
    }

    TEST_CASE(
        "on an edge the third function vanishes with its slope, and none changes towards the foot's line") {
        Random random(2);
        for (int i = 0; i < cases(200); ++i) {
            CAPTURE(i);
            const Shares foot{random.real(), random.real(), random.real()};
            for (unsigned opposite = 0; opposite < 3; ++opposite) {
                const unsigned first = (opposite + 1) % 3;
                const unsigned second = (opposite + 2) % 3;
                Shares at{};
                at[first] = random.real();
                at[second] = 1 - at[first];
                Shares to_centroid{1.0 / 3, 1.0 / 3, 1.0 / 3};
                to_centroid[first] -= 1 - foot[opposite];
                to_centroid[second] -= foot[opposite];
                const FaceBlend blend = blend_smoothly(at, foot);
                REQUIRE(std::abs(blend.share[opposite]) < 1e-15);
                for (unsigned corner = 0; corner < 3; ++corner) {
                    REQUIRE(std::abs(along(blend, corner, to_centroid)) < 1e-13);
                }
                Shares along_edge{};
                along_edge[first] = 1;
                along_edge[second] = -1;
                REQUIRE(std::abs(along(blend, opposite, along_edge)) < 1e-13);
            }
        }
    }
}
