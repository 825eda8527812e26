#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// Edge insertion where many measures are equal: the worst is still the least possible, nothing gets worse.

namespace {

/// Whether `degenerate_tin` starts from flipped faces.
bool is_flipped(int seed) { return seed % 3 == 2; }

/// Of every three, one is Delaunay, one has constrained edges, and one is flipped at random with constrained
/// edges and voids or without.
Tin degenerate_tin(const TinFamily& family, std::uint64_t seed, std::size_t least, std::size_t most) {
    Random random(seed);
    const auto count = random.integer(static_cast<std::int64_t>(least), static_cast<std::int64_t>(most));
    Tin tin = family.make(random, static_cast<std::size_t>(count));
    if (tin.mesh.count_terrain() == 0) {
        return tin;
    }
    if (seed % 3 == 2) {
        flip_at_random(random, tin, static_cast<int>(random.integer(1, 4 * count)));
    }
    if (seed % 3 != 0) {
        constrain_at_random(random, tin, static_cast<int>(random.integer(0, count / 2)));
    }
    if (seed % 3 == 2 && random.integer(0, 2) == 0) {
        make_voids_at_random(random, tin, static_cast<int>(random.integer(1, count / 3)));
    }
    return tin;
}

/// Constrained edges and voids stay, and so does the sorted vector's rank.
void check_change(const Tin& before, const Tin& after, Criterion criterion) {
    REQUIRE(is_sound(after));
    REQUIRE(measures_of(after, criterion) <= measures_of(before, criterion));
    const auto sorted_constraints = [](const Tin& tin) {
        auto edges = sites_of(tin).constraints;
        for (oracle::Edge& edge : edges) {
            std::sort(edge.begin(), edge.end());
        }
        std::sort(edges.begin(), edges.end());
        return edges;
    };
    REQUIRE(sorted_constraints(after) == sorted_constraints(before));
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_degenerate") {
    TEST_CASE("with ties the worst measure is the least possible, by scope vector and by scope max") {
        for (const TinFamily& family : degenerate_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(600); ++seed) {
                CAPTURE(seed);
                const Tin start = degenerate_tin(family, static_cast<std::uint64_t>(seed), 4, 9);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                CAPTURE(describe(start));
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    const long double worst = oracle::best_badnesses(sites_of(start), criterion).front();
                    for (const Scope scope : {kVectorScope, kMaxScope}) {
                        Tin tin = start;
                        const OptimizeReport report = optimize_to(scope, criterion, tin);
                        // Lemma 4.6 of [tan1993] needs that no four vertices are coplanar: where two coplanar
                        // faces share the worst slope, insertions may be stuck, if the start is not Delaunay.
                        if (criterion != Criterion::Slope || !is_flipped(seed) ||
                            report.proof == Proof::Theorem) {
                            REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All).front(), worst));
                        }
                        REQUIRE(report.proof == (report.ties > 0 ? Proof::Tested : Proof::Theorem));
                        check_change(start, tin, criterion);
                    }
                }
            }
        }
    }

    TEST_CASE("larger sets with ties end, and nothing is worse than before") {
        for (const TinFamily& family : degenerate_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(30); ++seed) {
                CAPTURE(seed);
                const Tin start = degenerate_tin(family, static_cast<std::uint64_t>(seed), 20, 150);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                for (const Criterion criterion : kInsertionCriteria) {
                    CAPTURE(name_of(criterion));
                    for (const Scope scope : {kVectorScope, kMaxScope, Scope{Scope::Kind::Top, 5.0}}) {
                        Tin tin = start;
                        optimize_to(scope, criterion, tin);
                        check_change(start, tin, criterion);
                    }
                }
            }
        }
    }

    TEST_CASE("faces without a slope, and faces on one plane, are left alone") {
        Random random(3);
        std::vector<oracle::Site> level;
        std::vector<oracle::Site> tilted;
        for (int i = 0; i < 300; ++i) {
            const Key2 key{random.key(1000), random.key(1000)};
            level.push_back({key, 12.5});
            tilted.push_back({key, 2 * key.x - 3 * key.y});
        }
        for (const Scope scope : {kVectorScope, kMaxScope, Scope{}}) {
            Tin tin = tin_of_sites(level);
            const auto faces = terrain_of(tin.mesh);
            const OptimizeReport report = optimize_to(scope, Criterion::Slope, tin);
            CHECK(report.after.all == 0);
            CHECK(terrain_of(tin.mesh) == faces);
            Tin plane = tin_of_sites(tilted);
            optimize_to(scope, Criterion::Slope, plane);
            CHECK(is_sound(plane));
            CHECK(measures_of(plane, Criterion::Slope).front() == doctest::Approx(13));
        }
    }

    TEST_CASE("grids keep their Delaunay faces") {
        for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
            CAPTURE(name_of(criterion));
            Tin tin = delaunay_tin(grid_keys(20, 15));
            const auto faces = terrain_of(tin.mesh);
            for (const Scope scope : {kMaxScope, Scope{}, kVectorScope}) {
                CHECK(optimize_to(scope, criterion, tin).insertions == 0);
                CHECK(terrain_of(tin.mesh) == faces);
            }
        }
    }

    TEST_CASE("on a slanted plane nothing is changed for what rounding makes of equal slopes") {
        Random random(7);
        std::vector<Point3> samples = decimal_samples(random, 2000, 2, 600000, 5000000, 500);
        for (Point3& p : samples) {
            // Centimetres and quarters of them: each z is the double nearest to its decimal.
            p.z = std::round(2500 * (p.x - 600000) + 5000 * (p.y - 5000000)) / 10000;
        }
        Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
        const OptimizeReport report =
            optimize(tin, {.criterion = Criterion::Slope, .scope = {.kind = Scope::Kind::Vector}});
        CHECK(report.insertions == 0);
        CHECK(report.proof == Proof::Tested);
    }
}
