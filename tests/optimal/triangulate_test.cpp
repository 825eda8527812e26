#include "tinwright/optimal/triangulate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

template <class Exception>
std::string refusal_of(const std::vector<Point3>& samples, const TriangulateOptions& options = {}) {
    return message_of<Exception>([&] { triangulate(samples, options); });
}

std::vector<std::vector<Point3>> sample_sets(std::uint64_t seed) {
    Random random(seed);
    std::vector<Point3> doubles(2000);
    for (Point3& p : doubles) {
        p = {100 * random.real(), 100 * random.real(), random.real()};
    }
    std::vector<Point3> grid;
    for (const Key2 key : grid_keys(40, 30)) {
        grid.push_back({key.x, key.y, std::floor(10 * random.real())});
    }
    return {scan_samples(random, 3000), decimal_samples(random, 2000, 3, 500000, 4000000, 700), doubles,
            grid};
}

}  // namespace

TEST_SUITE("optimal/triangulate") {
    TEST_CASE("samples become a clean Delaunay TIN that has each of them as a vertex") {
        for (int seed = 0; seed < cases(4); ++seed) {
            CAPTURE(seed);
            for (const std::vector<Point3>& samples : sample_sets(static_cast<std::uint64_t>(seed))) {
                TriangulateOptions options;
                options.duplicates.policy = DuplicatePolicy::First;
                const auto [tin, report] = triangulate(samples, options);
                REQUIRE(check_mesh(tin.mesh).is_clean());
                REQUIRE(check_tin(tin).is_clean());
                REQUIRE(check_delaunay(tin).is_clean());
                REQUIRE(report.samples == samples.size());
                REQUIRE(report.duplicates.equal + report.duplicates.conflicting + tin.vertex_count() ==
                        samples.size());
                REQUIRE(report.faces == tin.mesh.count_terrain());
                REQUIRE((report.bounds == tin.bounds() || !tin.lattice.is_exact()));
                // Euler: h hull vertices, n vertices, 2n - 2 - h faces.
                REQUIRE(report.faces + report.hull_vertices == 2 * tin.vertex_count() - 2);
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    const Point3& sample = samples[tin.sample[v]];
                    if (tin.lattice.is_exact()) {
                        REQUIRE(tin.position({v}) == sample);
                    } else {
                        REQUIRE(std::abs(tin.position({v}).x - sample.x) <= tin.lattice.quantum() / 2);
                        REQUIRE(std::abs(tin.position({v}).y - sample.y) <= tin.lattice.quantum() / 2);
                    }
                }
            }
        }
    }

    TEST_CASE("the hull's vertices are counted with the collinear ones") {
        for (int seed = 0; seed < cases(30); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Point3> samples;
            std::vector<Key2> keys = without_repetitions(
                key_families()[static_cast<std::size_t>(seed % 2 == 0 ? 0 : 6)].make(random, 25));
            if (oracle::convex_hull(keys).size() < 3) {
                continue;
            }
            for (const Key2 key : keys) {
                samples.push_back({key.x, key.y, 0});
            }
            REQUIRE(triangulate(samples).report.hull_vertices == oracle::keys_on_hull(keys).size());
        }
    }

    TEST_CASE("the TIN is the same to the byte whatever the order of samples and number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        for (const std::vector<Point3>& samples : sample_sets(77)) {
            Random random(3);
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            const std::vector<std::uint64_t> expected = words_of(triangulate(samples, options).tin);
            for (const int threads : {0, 2, 4}) {
                CAPTURE(threads);
                options.threads = threads;
                CHECK(words_of(triangulate(shuffled(random, samples), options).tin) == expected);
            }
        }
    }

    TEST_CASE("the border is constrained and nothing else") {
        Random random(4);
        const Tin tin = triangulate(scan_samples(random, 2000)).tin;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                const HalfEdgeId h = half_edge({f}, i);
                REQUIRE(tin.mesh.is_constrained(h) == tin.mesh.is_border(h));
            }
        }
    }

    TEST_CASE("no face keeps an edge above the longest allowed, and no other face is dropped") {
        Random random(5);
        const std::vector<Point3> samples = decimal_samples(random, 1500, 2, 1000, 2000, 100);
        TriangulateOptions options;
        options.duplicates.policy = DuplicatePolicy::First;
        options.max_edge = 5;
        const auto [tin, report] = triangulate(samples, options);
        REQUIRE(check_mesh(tin.mesh).is_clean());
        REQUIRE(check_delaunay(tin).is_clean());
        std::size_t dropped = 0;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            if (tin.mesh.is_ghost({f})) {
                continue;
            }
            double longest = 0;
            for (unsigned i = 0; i < 3; ++i) {
                const Point3 a = tin.position(tin.mesh.vertex({f}, i));
                const Point3 b = tin.position(tin.mesh.vertex({f}, next_corner(i)));
                longest = std::max(longest, std::hypot(a.x - b.x, a.y - b.y));
            }
            if (std::abs(longest - 5) > 1e-9) {
                REQUIRE(tin.mesh.is_terrain({f}) == (longest < 5));
            }
            dropped += tin.mesh.is_terrain({f}) ? 0 : 1;
        }
        CHECK(report.domain.void_faces == dropped);
        CHECK(dropped > 0);
        CHECK(report.faces == tin.mesh.count_terrain());
    }

    TEST_CASE("a trimmed domain keeps every sample on a face") {
        Random random(6);
        TriangulateOptions options;
        options.domain.kind = DomainRule::Kind::Trimmed;
        const auto [tin, report] = triangulate(scan_samples(random, 4000), options);
        REQUIRE(check_mesh(tin.mesh).is_clean());
        std::vector<bool> is_used(tin.vertex_count(), false);
        for (const auto& face : terrain_of(tin.mesh)) {
            for (const std::uint32_t v : face) {
                is_used[v] = true;
            }
        }
        CHECK(std::count(is_used.begin(), is_used.end(), false) == 0);
        CHECK(report.domain.trimmed_faces > 0);
    }

    TEST_CASE("fewer than three locations are refused, repeated ones counted once") {
        const std::string end = "a surface needs three distinct sample locations or more, there ";
        CHECK(refusal_of<InputError>({}) == end + "are 0");
        CHECK(refusal_of<InputError>({{1, 1, 0}}) == end + "is 1");
        CHECK(refusal_of<InputError>({{1, 1, 0}, {1, 1, 0}, {2, 2, 0}, {2, 2, 0}}) == end + "are 2");
    }

    TEST_CASE("collinear locations are refused, on a decimal row too") {
        const std::string text =
            refusal_of<InputError>({{0.1, 0.1, 1}, {0.2, 0.2, 2}, {0.3, 0.3, 3}, {0.7, 0.7, 4}});
        CHECK(text.starts_with("all 4 sample locations lie on one line, for example (0.1"));
        CHECK(text.ends_with("; a surface needs one off the line"));
    }

    TEST_CASE("detail that the lattice would blur is refused") {
        // Two samples 1e-12 apart and one 1000 away: the lattice's step is some 3e-11.
        const double third = 1.0 / 3;
        const std::string text = refusal_of<InputError>(
            {{third, third, 0}, {third + 2e-10, third, 0}, {2500 * third, 0.5, 0}, {7, 9000 * third, 0}});
        CHECK(text.starts_with("the extent of the samples is too large for their detail"));
    }

    TEST_CASE("options out of range are refused as wrong usage") {
        const std::vector<Point3> samples{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        TriangulateOptions options;
        options.threads = -1;
        CHECK(refusal_of<UsageError>(samples, options) == "the number of threads must not be negative");
        options = {};
        options.duplicates.tolerance = -1;
        CHECK(refusal_of<UsageError>(samples, options) == "the duplicate tolerance must be zero or more");
        options = {};
        options.duplicates.tolerance = std::nan("");
        CHECK(refusal_of<UsageError>(samples, options) == "the duplicate tolerance must be zero or more");
        options = {};
        options.domain = {DomainRule::Kind::Concave, 0};
        CHECK(refusal_of<UsageError>(samples, options) ==
              "the length of a concave domain must be above zero");
        options = {};
        options.max_edge = 0;
        CHECK(refusal_of<UsageError>(samples, options) == "the longest edge allowed must be above zero");
        options.max_edge = 0.5;
        CHECK(refusal_of<InputError>(samples, options) ==
              "no face is left: all have an edge longer than --max-edge allows; give a longer one");
    }

    TEST_CASE("progress grows from 0 to 1, and a callback that says stop cancels") {
        Random random(1);
        const std::vector<Point3> samples = scan_samples(random, 500);
        std::vector<double> seen;
        TriangulateOptions options;
        options.progress = [&](double fraction) {
            seen.push_back(fraction);
            return true;
        };
        triangulate(samples, options);
        REQUIRE(seen.size() >= 2);
        CHECK(seen.front() == 0);
        CHECK(seen.back() == 1);
        CHECK(std::is_sorted(seen.begin(), seen.end()));
        for (std::size_t stop = 0; stop < seen.size(); ++stop) {
            std::size_t calls = 0;
            options.progress = [&](double) { return calls++ < stop; };
            CHECK_THROWS_WITH_AS(triangulate(samples, options), "cancelled", Cancelled);
        }
    }
}
