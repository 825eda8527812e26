#include <cmath>
#include <initializer_list>
#include <string>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/insertion_oracle.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// No edge whose insertion would improve an optimised TIN is left, however it is filled in on both sides.

namespace {

/// Whether `any_tin` starts from flipped faces.
bool is_flipped(int seed) { return seed % 3 == 2; }

/// A TIN of `count` vertices; every second seed has constrained edges and voids, every third was flipped.
Tin any_tin(const TinFamily& family, std::uint64_t seed, std::size_t count) {
    Random random(seed);
    Tin tin = family.make(random, count);
    if (tin.mesh.count_terrain() == 0) {
        return tin;
    }
    const int some = static_cast<int>(count / 10);
    if (seed % 3 == 2) {
        flip_at_random(random, tin, 10 * some);
    }
    if (seed % 2 == 1) {
        constrain_at_random(random, tin, some);
        make_voids_at_random(random, tin, some / 4);
    }
    return tin;
}

constexpr Scope kTopScope{Scope::Kind::Top, 5};

void check_scopes(std::initializer_list<Scope> scopes, const Tin& start, Criterion criterion) {
    for (const Scope scope : scopes) {
        CAPTURE(static_cast<int>(scope.kind));
        Tin tin = start;
        optimize_to(scope, criterion, tin);
        REQUIRE(is_sound(tin));
        long double least = -INFINITY;
        if (scope.kind == Scope::Kind::Max) {
            least = badnesses_of(tin, criterion, Faces::Terrain).front();
        } else if (scope.kind == Scope::Kind::Top) {
            const auto before = badnesses_of(start, criterion, Faces::Terrain);
            least = before[(before.size() * 5 + 99) / 100 - 1];
        }
        const auto better = oracle::find_better_insertion(tin, criterion, least);
        if (better) {
            CAPTURE(describe(start));
            FAIL("inserting ", better->q.value, " ", better->s.value, " improves ",
                 static_cast<double>(better->before));
        }
    }
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_local") {
    TEST_CASE("no single insertion improves a TIN in general position, up to 200 vertices") {
        for (const TinFamily& family : general_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(12); ++seed) {
                CAPTURE(seed);
                const Tin start = any_tin(family, static_cast<std::uint64_t>(seed), seed % 5 == 4 ? 200 : 40);
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    check_scopes({kVectorScope, kTopScope, kMaxScope}, start, criterion);
                }
            }
        }
    }

    TEST_CASE("no single insertion improves a TIN with ties") {
        for (const TinFamily& family : degenerate_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(12); ++seed) {
                CAPTURE(seed);
                const Tin start = any_tin(family, static_cast<std::uint64_t>(seed), seed % 5 == 4 ? 120 : 40);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                // Scope max ends at the first of the worst faces that cannot be improved: not looked at here.
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    if (criterion == Criterion::Slope && is_flipped(seed)) {
                        continue;  // coplanar faces that share a slope may be stuck, as Lemma 4.6 says
                    }
                    check_scopes({kVectorScope, kTopScope}, start, criterion);
                }
            }
        }
    }

    TEST_CASE("the search does find what improves a Delaunay TIN") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            int improvable = 0;
            for (int seed = 0; seed < cases(20); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const Tin start = general_families()[0].make(random, 40);
                improvable += oracle::find_better_insertion(start, criterion, -INFINITY) ? 1 : 0;
                // And nothing where edge insertion cannot improve on the worst face.
                const long double worst = badnesses_of(start, criterion, Faces::Terrain).front();
                Tin tin = start;
                const bool is_worst_improvable = optimize_to(kMaxScope, criterion, tin).insertions > 0;
                REQUIRE(oracle::find_better_insertion(start, criterion, worst).has_value() ==
                        is_worst_improvable);
            }
            CHECK(improvable > cases(20) * 9 / 10);
        }
    }
}
