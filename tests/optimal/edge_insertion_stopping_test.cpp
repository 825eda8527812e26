#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// Optimising that is stopped, by a budget or by its caller, and large TINs, stopped or not.

namespace {

constexpr int kNever = std::numeric_limits<int>::max();

struct Stopped {
    OptimizeReport report;
    int calls = 0;
};

/// Optimises, the progress callback saying stop at its call number `stop_at`.
Stopped optimize_until(int stop_at, Scope scope, Criterion criterion, Tin& tin) {
    Stopped result;
    OptimizeOptions options;
    options.criterion = criterion;
    options.scope = scope;
    bool is_fraction = true;
    options.progress = [&](double fraction) {
        is_fraction = is_fraction && fraction >= 0 && fraction <= 1;
        return ++result.calls < stop_at;
    };
    result.report = optimize(tin, options);
    CHECK(is_fraction);
    return result;
}

void check_stopped(const Tin& start, const Tin& stopped, const OptimizeReport& report, StoppedBy by,
                   Criterion criterion) {
    REQUIRE(report.stopped_by == by);
    REQUIRE(report.proof == Proof::None);
    REQUIRE(is_sound(stopped));
    REQUIRE(measures_of(stopped, criterion) <= measures_of(start, criterion));
    REQUIRE(are_close(report.after.all, report_of(stopped, criterion,
                                                  badnesses_of(stopped, criterion, Faces::Terrain).front())));
}

/// Samples of a terrain whose relief halves with its wave length.
Tin fractal_terrain(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    struct Wave {
        double x, y, phase, height;
    };
    std::vector<Wave> waves;
    for (int octave = 0; octave < 9; ++octave) {
        for (int i = 0; i < 4; ++i) {
            const double frequency = std::ldexp(0.005, octave) * (0.7 + 0.6 * random.real());
            const double direction = 6.2831853 * random.real();
            waves.push_back({frequency * std::cos(direction), frequency * std::sin(direction),
                             6.2831853 * random.real(), std::ldexp(60.0, -octave)});
        }
    }
    std::vector<Point3> samples = decimal_samples(random, count, 3, 0, 0, 1000);
    for (Point3& p : samples) {
        p.z = 0;
        for (const Wave& wave : waves) {
            p.z += wave.height * std::sin(wave.x * p.x + wave.y * p.y + wave.phase);
        }
    }
    return tin_of_samples(samples, DuplicatePolicy::Mean);
}

}  // namespace

TEST_SUITE("optimal/edge_insertion_stopping") {
    TEST_CASE("without time, or told to stop at once, the TIN stays as it is and nothing is proven") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            Random random(1);
            const Tin start = general_families()[0].make(random, 100);
            for (const Scope scope : {kVectorScope, kMaxScope, Scope{}, Scope{Scope::Kind::Above, 0.0}}) {
                CAPTURE(static_cast<int>(scope.kind));
                if (scope.kind == Scope::Kind::Above && criterion == Criterion::Height) {
                    continue;  // no face is lower than zero
                }
                Tin tin = start;
                OptimizeOptions options;
                options.criterion = criterion;
                options.scope = scope;
                options.budget_seconds = 0;
                check_stopped(start, tin, optimize(tin, options), StoppedBy::Budget, criterion);
                CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
                const Stopped stopped = optimize_until(1, scope, criterion, tin);
                check_stopped(start, tin, stopped.report, StoppedBy::Interrupt, criterion);
                CHECK(stopped.calls == 1);
                CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
            }
        }
    }

    TEST_CASE("stopped anywhere on the way the TIN is sound and no worse; going on ends at the optimum") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (const Scope scope : {kVectorScope, Scope{Scope::Kind::Top, 30}}) {
                CAPTURE(static_cast<int>(scope.kind));
                Random random(2);
                Tin start = general_families()[1].make(random, 1000);
                flip_at_random(random, start, 3000);
                Tin finished = start;
                const Stopped all = optimize_until(kNever, scope, criterion, finished);
                REQUIRE(all.report.stopped_by == StoppedBy::Finished);
                REQUIRE(all.calls > 1);
                std::size_t insertions = 0;
                for (int i = 0; i < 12; ++i) {
                    const int stop_at = 2 + (all.calls - 2) * i / 12;
                    CAPTURE(stop_at);
                    Tin tin = start;
                    const Stopped stopped = optimize_until(stop_at, scope, criterion, tin);
                    check_stopped(start, tin, stopped.report, StoppedBy::Interrupt, criterion);
                    CHECK(stopped.calls == stop_at);
                    insertions += stopped.report.insertions;
                    if (scope.kind == Scope::Kind::Vector) {
                        optimize_to(scope, criterion, tin);
                        REQUIRE(are_close(badnesses_of(tin, criterion, Faces::All),
                                          badnesses_of(finished, criterion, Faces::All)));
                    }
                }
                CHECK(insertions > 0);
            }
        }
    }

    TEST_CASE("a large TIN out of time is sound and no worse") {
        const Tin start = fractal_terrain(5, 20000);
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (const double seconds : {1e-4, 1e-3, 5e-3}) {
                CAPTURE(seconds);
                Tin tin = start;
                OptimizeOptions options;
                options.criterion = criterion;
                options.scope = kVectorScope;
                options.budget_seconds = seconds;
                check_stopped(start, tin, optimize(tin, options), StoppedBy::Budget, criterion);
            }
        }
    }

    TEST_CASE(
        "50 000 samples of a fractal terrain: every criterion and scope passes the audits, and is proven") {
        const Tin start = fractal_terrain(7, 50000);
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            double worst = 0;
            for (const Scope scope : {kVectorScope, kMaxScope, Scope{Scope::Kind::Top, 0.5}}) {
                CAPTURE(static_cast<int>(scope.kind));
                Tin tin = start;
                const OptimizeReport report = optimize_to(scope, criterion, tin);
                REQUIRE(report.stopped_by == StoppedBy::Finished);
                REQUIRE((report.proof == Proof::Theorem || report.proof == Proof::Tested));
                REQUIRE(is_sound(tin));
                REQUIRE(measures_of(tin, criterion) <= measures_of(start, criterion));
                REQUIRE((report.insertions > 0 || scope.kind == Scope::Kind::Max));
                if (scope.kind != Scope::Kind::Top) {  // whose stop is another for the faces there are now
                    REQUIRE(optimize_to(scope, criterion, tin).insertions == 0);
                }
                // All scopes agree on the worst face.
                worst = scope.kind == Scope::Kind::Vector ? report.after.all : worst;
                REQUIRE(are_close(report.after.all, worst));
            }
        }
    }
}
