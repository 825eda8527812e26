#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tinwright/optimal/optimize.hpp"

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// Edge insertion against all triangulations of a few points in general position.

namespace {

/// A TIN in general position with up to 10 vertices: of every three, one is Delaunay, one has constrained
/// Delaunay edges, and one is flipped at random, with constrained edges and voids or without.
Tin general_tin(std::uint64_t seed) {
    Random random(seed);
    const auto families = general_families();
    Tin tin = families[seed % families.size()].make(random, static_cast<std::size_t>(random.integer(4, 10)));
    const std::uint64_t kind = seed / families.size() % 3;
    if (kind == 2) {
        flip_at_random(random, tin, static_cast<int>(random.integer(1, 30)));
    }
    if (kind != 0) {
        constrain_at_random(random, tin, static_cast<int>(random.integer(kind == 2 ? 0 : 1, 4)));
    }
    if (kind == 2 && random.integer(0, 2) == 0) {
        make_voids_at_random(random, tin, static_cast<int>(random.integer(1, 3)));
    }
    return tin;
}

void check_report(const OptimizeReport& report, const Tin& before, const Tin& after, Criterion criterion) {
    const auto worst = [criterion](const Tin& tin) {
        return report_of(tin, criterion, badnesses_of(tin, criterion, Faces::Terrain).front());
    };
    REQUIRE(are_close(report.before.all, worst(before)));
    REQUIRE(are_close(report.after.all, worst(after)));
    REQUIRE(report.stopped_by == StoppedBy::Finished);
    REQUIRE(report.tries >= report.insertions);  // what has no anchor is frozen untried
    REQUIRE(report.candidates >= report.insertions);
}

/// The sorted vector of the optimum is the oracle's, face by face.
void check_vector_optima(Criterion criterion) {
    std::size_t insertions = 0;
    for (int seed = 0; seed < cases(20000); ++seed) {
        CAPTURE(seed);
        const Tin start = general_tin(static_cast<std::uint64_t>(seed));
        CAPTURE(describe(start));
        Tin tin = start;
        const OptimizeReport report = optimize_to(kVectorScope, criterion, tin);
        REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All),
                          oracle::best_badnesses(sites_of(start), criterion)));
        REQUIRE(is_sound(tin));
        REQUIRE(report.proof == Proof::Theorem);
        check_report(report, start, tin, criterion);
        insertions += report.insertions;
    }
    CHECK(insertions > static_cast<std::size_t>(cases(20000)) / 2);  // there is something to do
}

/// Badnesses of a sorted vector down to a stop, as far as they can be told from it.
std::vector<long double> prefix(const std::vector<long double>& vector, long double stop, bool with_stop) {
    std::vector<long double> above;
    for (const long double value : vector) {
        if (are_close(value, stop) ? with_stop : value > stop) {
            above.push_back(value);
        }
    }
    return above;
}

}  // namespace

TEST_SUITE("optimal/edge_insertion") {
    TEST_CASE("angle: the sorted vector is the best of all triangulations") {
        check_vector_optima(Criterion::Angle);
    }

    TEST_CASE("height: the sorted vector is the best of all triangulations") {
        check_vector_optima(Criterion::Height);
    }

    TEST_CASE("slope: the sorted vector is the best of all triangulations") {
        check_vector_optima(Criterion::Slope);
    }

    TEST_CASE("eccentricity: the sorted vector is the best of all triangulations") {
        check_vector_optima(Criterion::Eccentricity);
    }

    TEST_CASE("the optimal vector belongs to one TIN, whatever the faces at the start") {
        for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Slope}) {
            CAPTURE(name_of(criterion));
            for (int seed = 0; seed < cases(1000); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto family = general_families()[static_cast<std::size_t>(seed) % 4];
                Tin tin = family.make(random, static_cast<std::size_t>(random.integer(5, 40)));
                Tin other = tin;
                flip_at_random(random, other, 200);
                optimize_to(kVectorScope, criterion, tin);
                optimize_to(kVectorScope, criterion, other);
                REQUIRE(terrain_of(tin.mesh) == terrain_of(other.mesh));
            }
        }
    }

    TEST_CASE("scope max: the worst measure is the least possible") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (int seed = 0; seed < cases(3000); ++seed) {
                CAPTURE(seed);
                const Tin start = general_tin(static_cast<std::uint64_t>(seed));
                Tin tin = start;
                const OptimizeReport report = optimize_to(kMaxScope, criterion, tin);
                REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All).front(),
                                  oracle::best_badnesses(sites_of(start), criterion).front()));
                REQUIRE(report.proof == Proof::Theorem);
                REQUIRE(is_sound(tin));
                check_report(report, start, tin, criterion);
            }
        }
    }

    TEST_CASE("scopes top and above: down to the stop the faces are those of the optimal vector") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (int seed = 0; seed < cases(3000); ++seed) {
                CAPTURE(seed);
                const Tin start = general_tin(static_cast<std::uint64_t>(seed));
                const auto before = badnesses_of(start, criterion, Faces::Terrain);
                const auto best = oracle::best_badnesses(sites_of(start), criterion);
                Random random(static_cast<std::uint64_t>(seed) + 1000000);
                const double percent = 100 * random.real() * random.real() + 1e-6;
                const auto rank = static_cast<std::size_t>(
                    std::max(1.0, std::ceil(percent / 100 * static_cast<double>(before.size()))));
                const long double stop = before[rank - 1];
                CAPTURE(percent);
                for (const bool is_top : {true, false}) {
                    CAPTURE(is_top);
                    Tin tin = start;
                    const Scope scope = is_top ? Scope{Scope::Kind::Top, percent}
                                               : Scope{Scope::Kind::Above, report_of(start, criterion, stop)};
                    const OptimizeReport report = optimize_to(scope, criterion, tin);
                    const auto after = badnesses_of(tin, criterion, Faces::All);
                    const auto after_terrain = badnesses_of(tin, criterion, Faces::Terrain);
                    REQUIRE(are_close(prefix(after, stop, false), prefix(best, stop, false)));
                    if (is_top) {
                        REQUIRE(are_close(prefix(after, stop, true), prefix(best, stop, true)));
                        REQUIRE((report.proof == Proof::None) == prefix(after_terrain, stop, true).empty());
                    } else if (!prefix(after_terrain, stop, false).empty()) {
                        REQUIRE(report.proof != Proof::None);
                    }
                    if (report.proof != Proof::None) {
                        REQUIRE(are_close(after.front(), best.front()));
                    }
                    REQUIRE(is_sound(tin));
                    check_report(report, start, tin, criterion);
                }
            }
        }
    }

    TEST_CASE("a TIN without a face above the stop stays as it is") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (int seed = 0; seed < cases(200); ++seed) {
                CAPTURE(seed);
                const Tin start = general_tin(static_cast<std::uint64_t>(seed));
                const long double worst = badnesses_of(start, criterion, Faces::Terrain).front();
                // Nothing measures more than 180 degrees.
                const long double most = criterion == Criterion::Angle ? 180 : INFINITY;
                const long double stop = criterion == Criterion::Height
                                             ? worst * (1 - 1e-6L)
                                             : std::min(worst * (1 + 1e-6L) + 1e-6L, most);
                Tin tin = start;
                const OptimizeReport report =
                    optimize_to({Scope::Kind::Above, report_of(start, criterion, stop)}, criterion, tin);
                REQUIRE(report.tries == 0);
                REQUIRE(report.proof == Proof::None);
                REQUIRE(terrain_of(tin.mesh) == terrain_of(start.mesh));
            }
        }
    }

    TEST_CASE("scope above takes faces that are worse than the stop, not those that are as bad") {
        // Four faces around (2, 1); their worst slope, 2, is the same number as a report and as a measure.
        const Tin start = tin_of_faces({{{0, 0}, 0}, {{4, 0}, 8}, {{4, 4}, 8}, {{0, 4}, 0}, {{2, 1}, 4}},
                                       {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
        REQUIRE(find_worst(start, Criterion::Slope).all == 2);
        Tin tin = start;
        CHECK(optimize_to({Scope::Kind::Above, 2.0}, Criterion::Slope, tin).tries == 0);
        CHECK(optimize_to({Scope::Kind::Above, 1.999}, Criterion::Slope, tin).tries > 0);
    }
}
