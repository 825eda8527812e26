#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include <doctest/doctest.h>

#include "tinwright/criteria/visit_criterion.hpp"

#include "faces.hpp"
#include "support/cases.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// At which corners an improvement has to break a face.

namespace {

unsigned anchors_of(Criterion criterion, const Face& face, Norm norm = {}) {
    const Tin tin = tin_of_face(face);
    return visit_criterion(
        criterion, tin, [](const FaceCriterion auto& code) { return code.anchors({0}, {1}, {2}); }, norm);
}

}  // namespace

TEST_SUITE("criteria/anchors") {
    TEST_CASE(
        "the obtuse corner is the anchor for angle, height and eccentricity; without one there is none") {
        int obtuse = 0;
        int right = 0;
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            unsigned expected = 0;
            for (unsigned i = 0; i < 3; ++i) {
                const int sign =
                    oracle::angle_sign(face[(i + 1) % 3].key, face[i].key, face[(i + 2) % 3].key);
                expected |= sign < 0 ? 1U << i : 0U;
                right += sign == 0 ? 1 : 0;
            }
            obtuse += expected != 0 ? 1 : 0;
            for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
                REQUIRE(anchors_of(criterion, face) == expected);
            }
        }
        CHECK(obtuse > cases(6000) / 4);
        CHECK(right > cases(6000) / 100);
    }

    TEST_CASE("length: the anchors are the corners opposite the longest edges, in every norm") {
        std::array<int, 4> counts{};
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            for (const Norm norm : {Norm(), Norm::lp(1), Norm::maximum(), Norm::lp(3), Norm::lp(12)}) {
                CAPTURE(norm_name(norm));
                unsigned expected = 0;
                for (unsigned i = 0; i < 3; ++i) {
                    const Key2 p = face[i].key;
                    const Key2 q = face[(i + 1) % 3].key;
                    const Key2 r = face[(i + 2) % 3].key;
                    const bool is_longest = oracle::compare_lengths(norm, q, r, p, q) >= 0 &&
                                            oracle::compare_lengths(norm, q, r, r, p) >= 0;
                    expected |= is_longest ? 1U << i : 0U;
                }
                ++counts[static_cast<std::size_t>(std::popcount(expected))];
                REQUIRE(anchors_of(Criterion::Length, face, norm) == expected);
            }
        }
        CHECK(counts[1] > 0);
        CHECK(counts[2] > 0);  // isosceles
        // Equilateral in the two norms whose unit disks are squares.
        const Face diamond{{{{0, 0}, 0}, {{2, 0}, 0}, {{1, 1}, 0}}};
        CHECK(anchors_of(Criterion::Length, diamond, Norm::lp(1)) == 7);
        const Face square{{{{0, 0}, 0}, {{2, 0}, 0}, {{1, 2}, 0}}};
        CHECK(anchors_of(Criterion::Length, square, Norm::maximum()) == 7);
    }

    TEST_CASE("slope: the anchor is the corner whose descent line runs through the face") {
        for (int seed = 0; seed < cases(6000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face = any_face(random);
            if (!orient(face)) {
                continue;
            }
            const unsigned exact = Exact(face).descent_corners();
            const unsigned anchors = anchors_of(Criterion::Slope, face);
            if (std::has_single_bit(exact)) {
                REQUIRE((anchors & exact) == exact);  // perhaps another in doubt
            } else {
                REQUIRE((anchors == 0 || (anchors & exact) == exact));
            }
        }
    }

    TEST_CASE(
        "slope: small integers leave no doubt: one anchor, none for level faces and for two descent lines") {
        std::array<int, 4> counts{};
        for (int seed = 0; seed < cases(10000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Face face{};
            const double limit = seed % 2 == 0 ? 5 : 0x1p24;
            for (Corner& corner : face) {
                corner = {{random.key(limit), random.key(limit)},
                          static_cast<double>(random.integer(0, 4)) / 8};
            }
            if (!orient(face)) {
                continue;
            }
            const unsigned exact = Exact(face).descent_corners();
            ++counts[static_cast<std::size_t>(std::popcount(exact))];
            REQUIRE(anchors_of(Criterion::Slope, face) == (std::has_single_bit(exact) ? exact : 0U));
        }
        CHECK(counts[0] == 0);
        CHECK(counts[1] > 0);
        CHECK(counts[2] > 0);
        CHECK(counts[3] > 0);
        // The gradient along the edge from corner 0 to corner 1, in all turns of the corners.
        Face face{{{{0, 0}, 0}, {{2, 0}, 2}, {{1, 1}, 1}}};
        for (int turn = 0; turn < 3; ++turn) {
            CHECK(anchors_of(Criterion::Slope, face) == 0);
            std::rotate(face.begin(), face.begin() + 1, face.end());
        }
        face[0].z += 0.001;
        CHECK(std::popcount(anchors_of(Criterion::Slope, face)) == 1);
    }
}
