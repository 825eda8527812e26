#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// The faces may be taken in any order: sweeps end where worst first does, and nothing is forgotten on the
/// way. At sizes where improvements reach far, and far too many for an oracle.

namespace {

/// Scope above, with a stop that every face that can be improved is above: worst face first, down to the end.
Scope worst_first(Criterion criterion) {
    return {Scope::Kind::Above, criterion == Criterion::Height ? 1e15 : 0.0};
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_order") {
    TEST_CASE("sweeps end at the vector that worst first ends at") {
        for (const TinFamily& family : general_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin start = family.make(random, 800);
                constrain_at_random(random, start, seed % 2 == 0 ? 0 : 80);
                make_voids_at_random(random, start, seed % 2 == 0 ? 0 : 20);
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    Tin swept = start;
                    Tin descended = start;
                    const OptimizeReport of_sweeps = optimize_to(kVectorScope, criterion, swept);
                    const OptimizeReport of_descent =
                        optimize_to(worst_first(criterion), criterion, descended);
                    REQUIRE(of_sweeps.insertions > 0);
                    REQUIRE(of_sweeps.proof == of_descent.proof);
                    REQUIRE(are_close(badnesses_of(swept, criterion, Faces::All),
                                      badnesses_of(descended, criterion, Faces::All)));
                }
            }
        }
    }

    TEST_CASE("the vector does not depend on the faces at the start") {
        for (const TinFamily& family : general_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(4); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const Tin start = family.make(random, 800);
                Tin flipped = start;
                flip_at_random(random, flipped, 20000);
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    Tin tin = start;
                    Tin other = flipped;
                    optimize_to(kVectorScope, criterion, tin);
                    optimize_to(kVectorScope, criterion, other);
                    REQUIRE(is_sound(other));
                    REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All),
                                      badnesses_of(other, criterion, Faces::All)));
                }
            }
        }
    }

    TEST_CASE("optimising again finds nothing to do, with ties or without") {
        const auto check = [](const TinFamily& family, std::uint64_t seed) {
            CAPTURE(std::string(family.name));
            CAPTURE(seed);
            Random random(seed);
            Tin start = family.make(random, 150);
            if (start.mesh.count_terrain() == 0) {
                return;
            }
            if (seed % 2 == 1) {
                flip_at_random(random, start, 1500);
            }
            for (const Criterion criterion : kInsertionCriteria) {
                CAPTURE(name_of(criterion));
                Tin tin = start;
                optimize_to(kVectorScope, criterion, tin);
                const auto faces = terrain_of(tin.mesh);
                for (const Scope scope : {kVectorScope, worst_first(criterion), kMaxScope, Scope{}}) {
                    CAPTURE(static_cast<int>(scope.kind));
                    REQUIRE(optimize_to(scope, criterion, tin).insertions == 0);
                    REQUIRE(terrain_of(tin.mesh) == faces);
                }
            }
        };
        for (int seed = 0; seed < cases(4); ++seed) {
            for (const TinFamily& family : general_families()) {
                check(family, static_cast<std::uint64_t>(seed));
            }
            for (const TinFamily& family : degenerate_families()) {
                check(family, static_cast<std::uint64_t>(seed));
            }
        }
    }
}
