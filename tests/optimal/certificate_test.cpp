#include "tinwright/optimal/certificate.hpp"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

namespace {

using namespace tinwright;
using namespace tinwright_tests;

Certificate certify_all(const Tin& tin, Criterion criterion) {
    return certify(
        tin, {.criterion = criterion, .faces = {}, .until_improvable = false, .reach = {}, .progress = {}});
}

/// A kite cut along its long diagonal: both faces are obtuse, the lower one (0) more than the upper one (1).
Tin kite() {
    return tin_of_faces({{{0, 10}, 0}, {{50, 0}, 0}, {{100, 10}, 0}, {{50, 30}, 0}}, {0, 1, 2, 0, 2, 3});
}

HalfEdgeId edge_between(const TriangleMesh& mesh, Key2 a, Key2 b, const Tin& tin) {
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && !mesh.is_ghost({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (tin.key(mesh.origin(h)) == a && tin.key(mesh.destination(h)) == b) {
                return h;
            }
        }
    }
    FAIL("no such edge");
    return {};
}

/// Whether an edge from `q` to `s` may be tried for a face with this measure, by looking at the whole mesh.
bool is_admissible(const Tin& tin, Criterion criterion, double limit, VertexId q, VertexId s) {
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        if (oracle::is_inside_segment(tin.keys[v], tin.key(q), tin.key(s))) {
            return false;
        }
    }
    const bool is_less_worse = criterion_traits(criterion).is_greater_better;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && !tin.mesh.is_ghost({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (!oracle::do_cross(tin.key(q), tin.key(s), tin.key(tin.mesh.origin(h)),
                                  tin.key(tin.mesh.destination(h)))) {
                continue;
            }
            const double measure = measure_face(tin, {f}, criterion);
            const bool is_worse = is_less_worse ? measure < limit : measure > limit;
            if (!tin.mesh.is_terrain({f}) || tin.mesh.is_constrained(h) || tin.mesh.is_border(h) ||
                is_worse) {
                return false;
            }
        }
    }
    return true;
}

/// How many edges there are to be tried in a TIN without improvements, for criteria of obtuse angles.
std::size_t count_edges(const Tin& tin, Criterion criterion) {
    std::size_t edges = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        const double measure = measure_face(tin, {f}, criterion);
        for (unsigned i = 0; i < 3; ++i) {
            const VertexId q = tin.mesh.vertex({f}, i);
            const VertexId a = tin.mesh.vertex({f}, next_corner(i));
            const VertexId b = tin.mesh.vertex({f}, previous_corner(i));
            const Key2 u{tin.key(a).x - tin.key(q).x, tin.key(a).y - tin.key(q).y};
            const Key2 v{tin.key(b).x - tin.key(q).x, tin.key(b).y - tin.key(q).y};
            for (std::uint32_t s = 0; s < tin.vertex_count() && u.x * v.x + u.y * v.y < 0; ++s) {
                edges += oracle::do_cross(tin.key(q), tin.key({s}), tin.key(a), tin.key(b)) &&
                                 is_admissible(tin, criterion, measure, q, {s})
                             ? 1U
                             : 0U;
            }
        }
    }
    return edges;
}

}  // namespace

TEST_SUITE("optimal/certificate") {
    TEST_CASE("a wrong diagonal is refuted with the right one") {
        const Tin tin = kite();
        for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
            CAPTURE(name_of(criterion));
            const Certificate certificate = certify_all(tin, criterion);
            CHECK(certificate.faces == 2);
            REQUIRE_FALSE(certificate.improvements.empty());
            const Improvement& first = certificate.improvements.front();
            const std::array<Key2, 2> ends{tin.key(first.anchor), tin.key(first.apex)};
            CHECK(std::min(ends[0].y, ends[1].y) == 0);
            CHECK(std::max(ends[0].y, ends[1].y) == 30);
            CHECK(first.measure == certificate.worst.all);
        }
        // The largest angle is twice arctan 5, at (50, 0); the right diagonal halves it.
        const Improvement angle = certify_all(tin, Criterion::Angle).improvements.front();
        CHECK(angle.measure == doctest::Approx(157.380135).epsilon(1e-8));
        CHECK(angle.improved == doctest::Approx(78.690068).epsilon(1e-8));
    }

    TEST_CASE("a worse face is an obstacle") {
        // Looked at from the upper face, the lower one is worse; so one edge is tried, not two.
        const Certificate certificate = certify_all(kite(), Criterion::Angle);
        CHECK(certificate.edges == 1);
        REQUIRE(certificate.improvements.size() == 1);
        CHECK(certificate.improvements.front().measure == certificate.worst.all);
    }

    TEST_CASE("constrained edges and what is not terrain are obstacles") {
        Tin tin = kite();
        const HalfEdgeId diagonal = edge_between(tin.mesh, {0, 10}, {100, 10}, tin);
        SUBCASE("constrained") { tin.mesh.set_constrained(diagonal, true); }
        SUBCASE("void") { tin.mesh.set_terrain(face_of(diagonal), false); }
        const Certificate certificate = certify_all(tin, Criterion::Angle);
        CHECK(certificate.faces == tin.mesh.count_terrain());
        CHECK(certificate.edges == 0);
        CHECK(certificate.improvements.empty());
    }

    TEST_CASE("of length what it lists is an improvement, but what it does not find may be there") {
        int caught = 0;
        const auto families = general_families();
        for (int seed = 0; seed < 400; ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = families[static_cast<std::size_t>(seed) % families.size()].make(random, 9);
            flip_at_random(random, tin, static_cast<int>(random.integer(0, 6)));
            const Certificate certificate = certify_all(tin, Criterion::Length);
            const long double longest = badnesses_of(tin, Criterion::Length, Faces::All).front();
            const long double least = oracle::best_badnesses(sites_of(tin), Criterion::Length).front();
            for (const Improvement& improvement : certificate.improvements) {
                REQUIRE(improvement.improved < improvement.measure);
                if (improvement.measure == certificate.worst.all) {
                    REQUIRE(longest > least);
                }
            }
            caught += certificate.improvements.empty() && !are_close(longest, least) ? 1 : 0;
        }
        CHECK(caught > 0);
    }

    TEST_CASE("a TIN is refuted if and only if it is not the best of all triangulations") {
        int refuted = 0;
        int confirmed = 0;
        const auto families = general_families();
        for (int seed = 0; seed < cases(2000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = families[static_cast<std::size_t>(seed) % families.size()].make(
                random, static_cast<std::size_t>(random.integer(4, 9)));
            flip_at_random(random, tin, static_cast<int>(random.integer(0, 6)));
            constrain_at_random(random, tin, static_cast<int>(random.integer(0, 2)));
            make_voids_at_random(random, tin, static_cast<int>(random.integer(0, 1)));
            CAPTURE(describe(tin));
            for (const Criterion criterion : kInsertionCriteria) {
                CAPTURE(name_of(criterion));
                const bool is_best = are_close(badnesses_of(tin, criterion, Faces::All),
                                               oracle::best_badnesses(sites_of(tin), criterion));
                const Certificate certificate = certify_all(tin, criterion);
                REQUIRE(certificate.improvements.empty() == is_best);
                REQUIRE(certificate.worst.all == find_worst(tin, criterion).all);
                (is_best ? confirmed : refuted) += 1;
                for (const Improvement& improvement : certificate.improvements) {
                    REQUIRE(improvement.measure == measure_face(tin, improvement.face, criterion));
                    REQUIRE((criterion_traits(criterion).is_greater_better
                                 ? improvement.improved > improvement.measure
                                 : improvement.improved < improvement.measure));
                }
            }
        }
        CHECK(refuted > cases(2000) / 2);
        CHECK(confirmed > cases(2000) / 2);
    }

    TEST_CASE("no edge improves what edge insertion returns") {
        for (const Criterion criterion : kInsertionCriteria) {
            CAPTURE(name_of(criterion));
            for (int seed = 0; seed < cases(24); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const auto families = general_families();
                Tin tin = families[static_cast<std::size_t>(seed) % families.size()].make(random, 200);
                Tin other = tin;
                optimize_to(kVectorScope, criterion, tin);
                const Certificate certificate = certify_all(tin, criterion);
                CHECK(certificate.faces == tin.mesh.count_terrain());
                CHECK(certificate.improvements.empty());

                optimize_to(kMaxScope, criterion, other);
                const Certificate worst = certify(other, {.criterion = criterion,
                                                          .faces = 1,
                                                          .until_improvable = false,
                                                          .reach = {},
                                                          .progress = {}});
                CHECK(worst.faces == 1);
                CHECK(worst.improvements.empty());
                CHECK(worst.worst.all == certificate.worst.all);
            }
        }
    }

    TEST_CASE("as many edges are tried as a look at every vertex and face admits") {
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto families = seed % 2 == 0 ? degenerate_families() : general_families();
            Tin tin = families[static_cast<std::size_t>(seed / 2) % families.size()].make(random, 40);
            if (tin.mesh.count_terrain() == 0) {
                continue;
            }
            constrain_at_random(random, tin, 5);
            make_voids_at_random(random, tin, 1);
            for (const Criterion criterion : {Criterion::Angle, Criterion::Height, Criterion::Eccentricity}) {
                CAPTURE(name_of(criterion));
                optimize_to(kVectorScope, criterion, tin);
                const Certificate certificate = certify_all(tin, criterion);
                REQUIRE(certificate.improvements.empty());
                CHECK(certificate.edges == count_edges(tin, criterion));
            }
        }
    }

    TEST_CASE("edges beyond the reach are not tried, and that is told") {
        const Tin tin = kite();
        const auto reach_to = [&tin](std::size_t reach) {
            return certify(tin, {.criterion = Criterion::Angle,
                                 .faces = {},
                                 .until_improvable = false,
                                 .reach = reach,
                                 .progress = {}});
        };
        CHECK(reach_to(2).improvements.size() == 1);
        CHECK(reach_to(2).cut == 0);
        CHECK(reach_to(1).improvements.empty());
        CHECK(reach_to(1).edges == 0);
        CHECK(reach_to(1).cut == 1);

        Random random(5);
        Tin optimal = general_families().front().make(random, 200);
        optimize_to(kVectorScope, Criterion::Height, optimal);
        const Certificate all = certify_all(optimal, Criterion::Height);
        CHECK(all.cut == 0);
        std::size_t edges = 0;
        for (const std::size_t reach : {1U, 2U, 4U, 8U, 16U, 400U}) {
            const Certificate some = certify(optimal, {.criterion = Criterion::Height,
                                                       .faces = {},
                                                       .until_improvable = false,
                                                       .reach = reach,
                                                       .progress = {}});
            CHECK(some.edges >= edges);
            CHECK((some.cut == 0) == (some.edges == all.edges));
            edges = some.edges;
        }
        CHECK(edges == all.edges);
    }

    TEST_CASE("faces without an anchor are counted and not tried") {
        Tin grid = delaunay_tin(grid_keys(7, 5));
        for (const Criterion criterion : kInsertionCriteria) {  // right angles only, and level
            CAPTURE(name_of(criterion));
            const Certificate certificate = certify_all(grid, criterion);
            CHECK(certificate.faces == 48);
            CHECK(certificate.anchorless == 48);
            CHECK(certificate.edges == 0);
        }
    }

    TEST_CASE("on a slanted plane no difference of slopes is more than rounding") {
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<oracle::Site> sites;
            for (int i = 0; i < 60; ++i) {
                const Key2 key{random.key(1e6), random.key(seed % 2 == 0 ? 1e6 : 10)};
                sites.push_back({key, 0.1 * key.x - 0.3 * key.y + 1234.5});
            }
            Tin tin = tin_of_sites(sites);
            flip_at_random(random, tin, 30);
            CHECK(certify_all(tin, Criterion::Slope).improvements.empty());
        }
    }

    TEST_CASE("the worst faces are examined, worst first") {
        Random random(7);
        Tin tin = general_families().front().make(random, 100);
        flip_at_random(random, tin, 60);
        const Certificate all = certify_all(tin, Criterion::Slope);
        const Certificate some = certify(tin, {.criterion = Criterion::Slope,
                                               .faces = 50,
                                               .until_improvable = false,
                                               .reach = {},
                                               .progress = {}});
        CHECK(some.faces == 50);
        REQUIRE(some.improvements.size() > 5);
        REQUIRE(some.improvements.size() <= all.improvements.size());
        for (std::size_t i = 0; i < some.improvements.size(); ++i) {
            CHECK(some.improvements[i].face == all.improvements[i].face);
            CHECK(some.improvements[i].improved == all.improvements[i].improved);
            CHECK((i == 0 || some.improvements[i].measure <= some.improvements[i - 1].measure));
        }
        const Certificate first = certify(tin, {.criterion = Criterion::Slope,
                                                .faces = {},
                                                .until_improvable = true,
                                                .reach = {},
                                                .progress = {}});
        REQUIRE(first.improvements.size() == 1);
        CHECK(first.improvements[0].face == all.improvements[0].face);
        CHECK(first.faces < all.faces);
        const Certificate most = certify(tin, {.criterion = Criterion::Slope,
                                               .faces = 100000,
                                               .until_improvable = false,
                                               .reach = {},
                                               .progress = {}});
        CHECK(most.faces == tin.mesh.count_terrain());
        CHECK(certify(tin, {.criterion = Criterion::Slope,
                            .faces = 0,
                            .until_improvable = false,
                            .reach = {},
                            .progress = {}})
                  .faces == 0);
    }

    TEST_CASE("it shows progress and can be stopped") {
        Random random(8);
        const Tin tin = general_families().front().make(random, 50);
        double last = -1;
        static_cast<void>(certify(tin, {.criterion = Criterion::Angle,
                                        .faces = {},
                                        .until_improvable = false,
                                        .reach = {},
                                        .progress = [&](double done) {
                                            CHECK(done >= last);
                                            last = done;
                                            return true;
                                        }}));
        CHECK(last == 1);
        CHECK_THROWS_AS(static_cast<void>(certify(tin, {.criterion = Criterion::Angle,
                                                        .faces = {},
                                                        .until_improvable = false,
                                                        .reach = {},
                                                        .progress = [](double) { return false; }})),
                        Cancelled);
    }
}
