#include "tinwright/optimal/length_certificate.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "optimal/length_checks.hpp"
#include "support/cases.hpp"
#include "support/ring_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

LengthCertificate certify_in(Norm norm, const Tin& tin) {
    return certify_length(tin, {.norm = norm, .largest_polygon = {}, .progress = {}});
}

/// The length that has this rank.
double length_at(const oracle::LengthRanks& ranks, std::uint32_t rank, const Tin& tin, Norm norm) {
    const auto n = static_cast<std::uint32_t>(ranks.size());
    for (std::uint32_t a = 0; a < n; ++a) {
        for (std::uint32_t b = a + 1; b < n; ++b) {
            if (ranks.rank(a, b) == rank) {
                return tin.lattice.quantum() * length(norm, tin.keys[a], tin.keys[b]);
            }
        }
    }
    return 0;
}

/// The certificate of a TIN whose least longest edge has the rank `least`.
void check_certificate(const LengthCertificate& certificate, const Tin& tin, Norm norm,
                       const oracle::LengthRanks& ranks, std::uint32_t least) {
    const std::uint32_t longest = oracle::longest_edge(tin, ranks);
    REQUIRE(certificate.edge[0] < certificate.edge[1]);
    REQUIRE(edges_of(tin, false).contains({certificate.edge[0].value, certificate.edge[1].value}));
    REQUIRE(ranks.rank(certificate.edge[0].value, certificate.edge[1].value) == longest);
    REQUIRE(certificate.longest == length_at(ranks, longest, tin, norm));
    REQUIRE(certificate.left_out == 0);
    REQUIRE(certificate.is_optimal == (longest == least));
    REQUIRE(certificate.attainable.has_value() == (longest > least));
    if (certificate.attainable) {
        REQUIRE(*certificate.attainable == length_at(ranks, least, tin, norm));
    }
}

/// A ring of a near circle: Delaunay has diagonals longer than need be, in one complete polygon.
Tin round_tin(std::size_t sides) {
    Random random(5);
    return tin_of_ring(ring_families()[0].make(random, sides));
}

}  // namespace

TEST_SUITE("optimal/length_certificate") {
    TEST_CASE("what is proven and what is attainable are as all triangulations have it") {
        int refuted = 0;
        for (const Norm norm : length_norms()) {
            CAPTURE(norm_name(norm));
            for (int seed = 0; seed < cases(1500); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = any_small_tin(static_cast<std::uint64_t>(seed), 12);
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                const oracle::LengthRanks ranks(norm, tin.keys);
                const std::uint32_t least = oracle::least_longest_edge(oracle::terrain_sites(tin), ranks);
                CAPTURE(describe(tin));
                check_certificate(certify_in(norm, tin), tin, norm, ranks, least);
                flip_at_random(random, tin, 20);
                const LengthCertificate certificate = certify_in(norm, tin);
                check_certificate(certificate, tin, norm, ranks, least);
                refuted += certificate.is_optimal ? 0 : 1;
            }
        }
        CHECK(refuted > cases(1500));
    }

    TEST_CASE("what the engine makes is proven, by other means") {
        std::size_t polygons = 0;
        for (const TinFamily& family : all_tin_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(10); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin start = family.make(random, 150);
                if (start.mesh.count_terrain() == 0) {
                    continue;
                }
                if (seed % 2 == 1) {
                    add_segments_at_random(random, start, 10);
                    make_voids_at_random(random, start, static_cast<int>(random.integer(0, 6)));
                }
                for (const Norm norm : length_norms()) {
                    CAPTURE(norm_name(norm));
                    Tin tin = start;
                    optimize_length(tin, norm);
                    const LengthCertificate certificate = certify_in(norm, tin);
                    REQUIRE(certificate.is_optimal);
                    polygons += certificate.polygons;
                    const LengthCertificate before = certify_in(norm, start);
                    REQUIRE(before.is_optimal == !before.attainable.has_value());
                    REQUIRE(before.attainable.value_or(before.longest) == certificate.longest);
                }
            }
        }
        CHECK(polygons > 0);
    }

    TEST_CASE("polygons, of any shape") {
        for (const RingFamily& family : ring_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(10); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = tin_of_ring(family.make(random, static_cast<std::size_t>(random.integer(4, 50))));
                const auto regions = oracle::regions_of(tin, {});
                REQUIRE(regions.size() == 1);
                for (const Norm norm : length_norms()) {
                    CAPTURE(norm_name(norm));
                    const oracle::LengthRanks ranks(norm, tin.keys);
                    const auto least = oracle::least_longest_edge(tin.keys, regions[0].ring, ranks);
                    REQUIRE(least.has_value());
                    check_certificate(certify_in(norm, tin), tin, norm, ranks, *least);
                }
            }
        }
    }

    TEST_CASE("a constrained edge, or one of the border, that is as long as any proves at once") {
        Tin tin = tin_of_faces({{{0, 0}, 0}, {{1000, 10}, 0}, {{500, 300}, 0}, {{500, 100}, 0}},
                               {0, 1, 3, 1, 2, 3, 2, 0, 3});
        const LengthCertificate certificate = certify_in({}, tin);
        CHECK(certificate.is_optimal);
        CHECK(certificate.polygons == 0);
        CHECK(certificate.longest == length({}, {0, 0}, {1000, 10}));
    }

    TEST_CASE("a polygon with too many sides is left out, and nothing is proven") {
        const Tin start = round_tin(40);
        Tin best = start;
        optimize_length(best);
        REQUIRE(longest_of(best, {}) < longest_of(start, {}));
        for (const Tin* tin : {&start, static_cast<const Tin*>(&best)}) {
            const LengthCertificate certificate =
                certify_length(*tin, {.norm = {}, .largest_polygon = 39, .progress = {}});
            CHECK_FALSE(certificate.is_optimal);
            CHECK_FALSE(certificate.attainable.has_value());
            CHECK(certificate.left_out == 1);
            CHECK(certificate.polygons == 0);
        }
        CHECK(certify_length(best, {.norm = {}, .largest_polygon = 40, .progress = {}}).is_optimal);
        CHECK(certify_length(start, {.norm = {}, .largest_polygon = 40, .progress = {}}).attainable ==
              certify_in({}, best).longest);
    }

    TEST_CASE("where a polygon is left out, it is still known what Delaunay can do with") {
        Random random(7);
        Tin tin = round_tin(40);
        const double delaunay = certify_in({}, tin).longest;
        flip_at_random(random, tin, 300);
        const LengthCertificate certificate =
            certify_length(tin, {.norm = {}, .largest_polygon = 39, .progress = {}});
        REQUIRE(certificate.longest > delaunay);
        CHECK_FALSE(certificate.is_optimal);
        CHECK(certificate.attainable == delaunay);
        CHECK(certificate.left_out == 1);
    }

    TEST_CASE("vertices that no terrain face has do not count") {
        Random random(5);
        const std::vector<Key2> ring = ring_families()[0].make(random, 40);
        const Tin tin = tin_of_ring(ring);
        const Tin framed = tin_of_ring(ring, {{1, 1}, {40001, 0}, {40000, 40003}, {2, 40000}});
        REQUIRE(framed.vertex_count() == 44);
        const LengthCertificate certificate = certify_in({}, tin);
        const LengthCertificate of_framed = certify_in({}, framed);
        REQUIRE(certificate.attainable.has_value());
        CHECK(of_framed.attainable == certificate.attainable);
        CHECK(of_framed.longest == certificate.longest);
        for (const std::size_t i : {0U, 1U}) {
            CHECK(framed.key(of_framed.edge[i]) == tin.key(certificate.edge[i]));
        }
    }

    TEST_CASE("the progress callback can stop it") {
        int calls = 0;
        const Tin tin = round_tin(60);
        const LengthCertificateOptions counting{
            .norm = {}, .largest_polygon = {}, .progress = [&calls](double) { return ++calls > 0; }};
        certify_length(tin, counting);
        REQUIRE(calls > 1);
        for (const int stop_at : {1, 2, calls}) {
            CAPTURE(stop_at);
            int asked = 0;
            const LengthCertificateOptions stopping{
                .norm = {}, .largest_polygon = {}, .progress = [&asked, stop_at](double) {
                    return ++asked < stop_at;
                }};
            CHECK_THROWS_AS(certify_length(tin, stopping), Cancelled);
        }
    }
}
