#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/optimal/length_certificate.hpp"
#include "tinwright/optimal/min_max_length.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "optimal/length_checks.hpp"
#include "support/cases.hpp"
#include "support/ring_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// Equal lengths, collinear and co-circular vertices, and what must not depend on order, threads or stops.

namespace {

constexpr int kNever = std::numeric_limits<int>::max();

/// A ring against dynamic programming, in all norms.
void check_ring(const std::vector<Key2>& ring) {
    const Tin start = tin_of_ring(ring);
    const auto regions = oracle::regions_of(start, {});
    REQUIRE(regions.size() == 1);
    for (const Norm norm : length_norms()) {
        CAPTURE(norm_name(norm));
        const oracle::LengthRanks ranks(norm, start.keys);
        Tin tin = start;
        const OptimizeReport report = optimize_length(tin, norm);
        check_kept(start, tin);
        REQUIRE(oracle::longest_edge(tin, ranks) ==
                oracle::least_longest_edge(start.keys, regions[0].ring, ranks));
        check_length_report(start, tin, report, norm);
    }
}

struct Stopped {
    OptimizeReport report;
    int calls = 0;
};

/// Optimises, the progress callback saying stop at its call number `stop_at`.
Stopped optimize_until(int stop_at, Norm norm, Tin& tin) {
    Stopped result;
    OptimizeOptions options;
    options.criterion = Criterion::Length;
    options.norm = norm;
    bool is_fraction = true;
    options.progress = [&](double fraction) {
        is_fraction = is_fraction && fraction >= 0 && fraction <= 1;
        return ++result.calls < stop_at;
    };
    result.report = optimize(tin, options);
    CHECK(is_fraction);
    return result;
}

void check_stopped(const Tin& start, const Tin& tin, const OptimizeReport& report, StoppedBy by, Norm norm) {
    check_kept(start, tin);
    REQUIRE(report.stopped_by == by);
    REQUIRE(report.proof == Proof::None);
    REQUIRE(are_close(report.before.all, longest_of(start, norm)));
    REQUIRE(are_close(report.after.all, longest_of(tin, norm)));
    REQUIRE(report.after.all <= report.before.all);
}

TriangulateOptions options_for(Norm norm, DomainRule domain, int threads) {
    TriangulateOptions options;
    options.domain = domain;
    options.threads = threads;
    options.optimize.emplace();
    options.optimize->criterion = Criterion::Length;
    options.optimize->norm = norm;
    return options;
}

}  // namespace

TEST_SUITE("optimal/min_max_length_degenerate") {
    TEST_CASE("a square grid keeps its faces, the diagonal being needed in every norm") {
        struct Expected {
            Norm norm;
            double longest = 0;
        };
        for (const Expected& expected :
             {Expected{Norm(), std::sqrt(2.0)}, Expected{Norm::lp(1), 2.0}, Expected{Norm::maximum(), 1.0}}) {
            CAPTURE(norm_name(expected.norm));
            const Tin start = delaunay_tin(grid_keys(9, 7));
            Tin tin = start;
            const OptimizeReport report = optimize_length(tin, expected.norm);
            CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
            CHECK(report.before.all == doctest::Approx(expected.longest));
            CHECK(report.after.all == doctest::Approx(expected.longest));
            CHECK(report.proof == Proof::Theorem);
        }
    }

    TEST_CASE("all of a small lattice but a few vertices") {
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const int size = static_cast<int>(random.integer(3, 6));
            std::vector<Key2> keys = shuffled(random, grid_keys(size, size));
            keys.resize(
                std::min<std::size_t>(keys.size() - static_cast<std::size_t>(random.integer(0, 5)), 16));
            const Tin start = delaunay_tin(keys);
            if (start.mesh.count_terrain() == 0) {
                continue;
            }
            for (const Norm norm : length_norms()) {
                CAPTURE(norm_name(norm));
                CAPTURE(describe(start));
                const oracle::LengthRanks ranks(norm, start.keys);
                Tin tin = start;
                const OptimizeReport report = optimize_length(tin, norm);
                check_kept(start, tin);
                REQUIRE(oracle::longest_edge(tin, ranks) ==
                        oracle::least_longest_edge(oracle::terrain_sites(start), ranks));
                check_length_report(start, tin, report, norm);
                check_flipped_back(tin, ranks);
                if (norm.is_euclidean()) {
                    check_polygons(start, tin, report);
                }
            }
        }
    }

    TEST_CASE("polygons with many corners in a line get no flat face") {
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            // A right-angled polygon with a vertex at each key of its sides: a staircase, as high as it is
            // wide.
            const int steps = static_cast<int>(random.integer(1, 4));
            std::vector<Key2> corners{{0, 0}};
            double x = 0;
            double y = 0;
            for (int i = 0; i < steps; ++i) {
                x += static_cast<double>(random.integer(1, 4));
                corners.push_back({x, y});
                y += static_cast<double>(random.integer(1, 4));
                corners.push_back({x, y});
            }
            corners.push_back({0, y});
            std::vector<Key2> ring;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Key2 to = corners[(i + 1) % corners.size()];
                for (Key2 at = corners[i]; at != to;) {
                    ring.push_back(at);
                    at.x += at.x < to.x ? 1 : at.x > to.x ? -1 : 0;
                    at.y += at.y < to.y ? 1 : at.y > to.y ? -1 : 0;
                }
            }
            check_ring(ring);
        }
    }

    TEST_CASE("co-circular vertices, up to 60") {
        for (int seed = 0; seed < cases(30); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Key2> keys = circle_keys(random, static_cast<std::size_t>(random.integer(4, 60)));
            const auto angle = [](Key2 key) { return std::atan2(key.y - 40000, key.x - 40000); };
            std::sort(keys.begin(), keys.end(), [&](Key2 a, Key2 b) { return angle(a) < angle(b); });
            check_ring(keys);
        }
    }

    TEST_CASE("vertices on one line and one off it have a single triangulation") {
        std::vector<Key2> keys{{50, 60}};
        for (int i = 0; i < 20; ++i) {
            keys.push_back({7.0 * i, 3.0 * i});
        }
        for (const Norm norm : length_norms()) {
            const Tin start = delaunay_tin(keys);
            Tin tin = start;
            const OptimizeReport report = optimize_length(tin, norm);
            check_kept(start, tin);
            CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
            CHECK(report.proof == Proof::Theorem);
        }
    }

    TEST_CASE("norms of high powers, nearly the maximum norm") {
        for (const Norm norm : {Norm::lp(Norm::kLargestPower), Norm::lp(17)}) {
            for (int seed = 0; seed < cases(300); ++seed) {
                CAPTURE(seed);
                const Tin start = any_small_tin(static_cast<std::uint64_t>(seed), 11);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                const oracle::LengthRanks ranks(norm, start.keys);
                Tin tin = start;
                optimize_length(tin, norm);
                check_kept(start, tin);
                REQUIRE(oracle::longest_edge(tin, ranks) ==
                        oracle::least_longest_edge(oracle::terrain_sites(start), ranks));
            }
        }
    }

    TEST_CASE("the order of the samples and the number of threads do not matter") {
        const DomainRule trimmed{DomainRule::Kind::Trimmed, 0};
        for (int seed = 0; seed < cases(4); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::vector<Point3> samples =
                seed % 2 == 0 ? decimal_samples(random, 3000, 1, 0, 0, 30) : scan_samples(random, 3000);
            for (const Norm norm : length_norms()) {
                CAPTURE(norm_name(norm));
                for (const DomainRule& domain : {DomainRule{}, trimmed}) {
                    TriangulateOptions options = options_for(norm, domain, 1);
                    options.duplicates.policy = DuplicatePolicy::Mean;
                    const Triangulated first = triangulate(samples, options);
                    REQUIRE(is_sound(first.tin));
                    REQUIRE(first.report.optimize->proof == Proof::Theorem);
                    REQUIRE(certify_length(first.tin, {.norm = norm, .largest_polygon = {}, .progress = {}})
                                .is_optimal);
                    for (const int threads : {2, 4}) {
                        CAPTURE(threads);
                        options.threads = threads;
                        const Triangulated other = triangulate(shuffled(random, samples), options);
                        REQUIRE(words_of(other.tin) == words_of(first.tin));
                        REQUIRE(other.report.optimize->insertions == first.report.optimize->insertions);
                    }
                }
            }
        }
    }

    TEST_CASE("the domain is that of the Delaunay TIN") {
        for (int seed = 0; seed < cases(4); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::vector<Point3> samples = decimal_samples(random, 500, 2, 1000, 1000, 100);
            for (const DomainRule& domain :
                 {DomainRule{DomainRule::Kind::Trimmed, 0}, DomainRule{DomainRule::Kind::Concave, 12}}) {
                TriangulateOptions options = options_for({}, domain, 1);
                const Triangulated optimal = triangulate(samples, options);
                options.optimize.reset();
                const Triangulated delaunay = triangulate(samples, options);
                check_kept(delaunay.tin, optimal.tin);
                check_length_report(delaunay.tin, optimal.tin, *optimal.report.optimize, {});
            }
        }
    }

    TEST_CASE("without time, or told to stop at once, the TIN is sound and nothing is proven") {
        Random random(1);
        const Tin start = general_families()[0].make(random, 300);
        for (const Norm norm : length_norms()) {
            CAPTURE(norm_name(norm));
            Tin tin = start;
            OptimizeOptions options;
            options.criterion = Criterion::Length;
            options.norm = norm;
            options.budget_seconds = 0;
            check_stopped(start, tin, optimize(tin, options), StoppedBy::Budget, norm);
            Tin other = start;
            const Stopped stopped = optimize_until(1, norm, other);
            check_stopped(start, other, stopped.report, StoppedBy::Interrupt, norm);
            if (norm.is_euclidean()) {
                CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
                CHECK(terrain_of(other.mesh) == terrain_of(start.mesh));
            }
        }
    }

    TEST_CASE("stopped anywhere in a large polygon the TIN is sound and no worse") {
        Random random(2);
        const Tin start = tin_of_ring(ring_families()[0].make(random, 4200));
        Tin finished = start;
        const Stopped all = optimize_until(kNever, {}, finished);
        REQUIRE(all.report.stopped_by == StoppedBy::Finished);
        REQUIRE(all.calls > 2);
        for (const int stop_at : {2, 2 + (all.calls - 2) / 2}) {
            CAPTURE(stop_at);
            Tin tin = start;
            const Stopped stopped = optimize_until(stop_at, {}, tin);
            check_stopped(start, tin, stopped.report, StoppedBy::Interrupt, {});
        }
    }

    TEST_CASE("stopped anywhere in the search of another norm's graph the TIN is sound and no worse") {
        Random random(3);
        const Tin start = general_families()[0].make(random, 20'000);
        Tin finished = start;
        const Stopped all = optimize_until(kNever, Norm::lp(1), finished);
        REQUIRE(all.report.stopped_by == StoppedBy::Finished);
        REQUIRE(all.calls > 4);
        for (const int stop_at : {2, 4}) {
            CAPTURE(stop_at);
            Tin tin = start;
            const Stopped stopped = optimize_until(stop_at, Norm::lp(1), tin);
            check_stopped(start, tin, stopped.report, StoppedBy::Interrupt, Norm::lp(1));
            CHECK(stopped.calls == stop_at);
            CHECK(terrain_of(tin.mesh) == terrain_of(start.mesh));
        }
    }

    TEST_CASE("the scope is always the longest edge") {
        Random random(3);
        const Tin start = length_families()[3].make(random, 60);
        Tin expected = start;
        optimize_length(expected);
        for (const Scope scope :
             {Scope{Scope::Kind::Vector, 0}, Scope{Scope::Kind::Top, 1}, Scope{Scope::Kind::Above, 1e9}}) {
            Tin tin = start;
            OptimizeOptions options;
            options.criterion = Criterion::Length;
            options.scope = scope;
            CHECK(optimize(tin, options).proof == Proof::Theorem);
            CHECK(words_of(tin) == words_of(expected));
        }
    }
}
