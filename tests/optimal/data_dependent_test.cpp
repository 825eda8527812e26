#include "tinwright/optimal/data_dependent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/tin_check.hpp"
#include "tinwright/optimal/delaunay_order.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"
#include "support/triangulation_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Vector = std::array<long double, 3>;

Vector position_of(const Tin& tin, VertexId v) {
    const long double quantum = tin.lattice.quantum();
    return {tin.key(v).x * quantum, tin.key(v).y * quantum, tin.z[v.value]};
}

Vector normal_of(const Tin& tin, VertexId a, VertexId b, VertexId c) {
    const Vector p = position_of(tin, a);
    const Vector q = position_of(tin, b);
    const Vector r = position_of(tin, c);
    const Vector u{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    const Vector v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Between a counter-clockwise face a b c and the face b a d.
long double crease_by_definition(const Tin& tin, VertexId a, VertexId b, VertexId c, VertexId d,
                                 CreaseMeasure measure) {
    const Vector m = normal_of(tin, a, b, c);
    const Vector n = normal_of(tin, b, a, d);
    if (measure == CreaseMeasure::NormalAngle) {
        const Vector cross{m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0]};
        return std::atan2(std::hypot(cross[0], cross[1], cross[2]), m[0] * n[0] + m[1] * n[1] + m[2] * n[2]);
    }
    // How far d is above the plane of a b c, over its distance from the line a b.
    const Vector p = position_of(tin, a);
    const Vector q = position_of(tin, b);
    const Vector r = position_of(tin, d);
    const long double above = r[2] - p[2] + (m[0] * (r[0] - p[0]) + m[1] * (r[1] - p[1])) / m[2];
    const long double area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    return std::abs(above * std::hypot(q[0] - p[0], q[1] - p[1]) / area);
}

bool does_count(const TriangleMesh& mesh, HalfEdgeId h) {
    return !mesh.is_constrained(h) && mesh.is_terrain(face_of(h)) && mesh.is_terrain(face_of(mesh.twin(h)));
}

template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (h < mesh.twin(h) && does_count(mesh, h)) {
                visit(h);
            }
        }
    }
}

long double crease_by_definition(const Tin& tin, HalfEdgeId h, CreaseMeasure measure) {
    const TriangleMesh& mesh = tin.mesh;
    const HalfEdgeId t = mesh.twin(h);
    return crease_by_definition(tin, mesh.origin(h), mesh.origin(t), mesh.origin(previous(h)),
                                mesh.origin(previous(t)), measure);
}

long double sum_by_definition(const Tin& tin, CreaseMeasure measure) {
    long double sum = 0;
    for_each_edge(tin.mesh, [&](HalfEdgeId h) { sum += crease_by_definition(tin, h, measure); });
    return sum;
}

/// The corners of the edge's faces: a, b at its ends, c to the left.
struct Corners {
    VertexId a, b, c, d;
};

Corners corners_of(const TriangleMesh& mesh, HalfEdgeId h) {
    const HalfEdgeId t = mesh.twin(h);
    return {mesh.origin(h), mesh.origin(t), mesh.origin(previous(h)), mesh.origin(previous(t))};
}

bool is_flippable(const Tin& tin, HalfEdgeId h) {
    const auto [a, b, c, d] = corners_of(tin.mesh, h);
    return oracle::orient2d(tin.key(d), tin.key(c), tin.key(a)) > 0 &&
           oracle::orient2d(tin.key(c), tin.key(d), tin.key(b)) > 0;
}

int count_inside(const Tin& tin, VertexId a, VertexId b, VertexId c) {
    int count = 0;
    for (const Key2 key : tin.keys) {
        count += oracle::incircle(tin.key(a), tin.key(b), tin.key(c), key) > 0 ? 1 : 0;
    }
    return count;
}

bool is_of_order(const Tin& tin, HalfEdgeId h, std::optional<int> order) {
    const auto [a, b, c, d] = corners_of(tin.mesh, h);
    return !order || count_inside(tin, a, d, c) <= *order || count_inside(tin, b, c, d) <= *order;
}

/// The flip that lowers the whole sum most, one after the other, everything computed anew each time.
void flip_slowly(Tin& tin, CreaseMeasure measure, std::optional<int> order) {
    for (;;) {
        const long double sum = sum_by_definition(tin, measure);
        long double lowest = sum * (1 - 1e-9L);
        std::optional<HalfEdgeId> best;
        for_each_edge(tin.mesh, [&](HalfEdgeId h) {
            if (is_flippable(tin, h) && is_of_order(tin, h, order)) {
                Tin flipped = tin;
                flip_edge(flipped.mesh, h);
                const long double after = sum_by_definition(flipped, measure);
                if (after < lowest) {
                    lowest = after;
                    best = h;
                }
            }
        });
        if (!best) {
            return;
        }
        flip_edge(tin.mesh, *best);
    }
}

std::vector<std::optional<int>> orders() { return {0, 1, 3, std::nullopt}; }

DataDependentOptions options_of(CreaseMeasure measure, std::optional<int> order) {
    DataDependentOptions options;
    options.measure = measure;
    options.delaunay_order = order;
    return options;
}

std::vector<oracle::Edge> constraints_of(const Tin& tin) {
    std::vector<oracle::Edge> edges = sites_of(tin).constraints;
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// The least gain of a flip, as a part of the sum or of 1, that no rounding explains.
constexpr long double kCertainGain = 1e-7L;

}  // namespace

TEST_SUITE("optimal/data_dependent") {
    TEST_CASE("a right-angled ridge has a crease of ninety degrees and a jump of two") {
        const Tin roof =
            tin_of_faces({{{3, 0}, 3}, {{3, 4}, 3}, {{0, 2}, 0}, {{6, 2}, 0}}, {0, 1, 2, 1, 0, 3});
        for_each_edge(roof.mesh, [&](HalfEdgeId h) {
            CHECK(measure_crease(roof, h, CreaseMeasure::NormalAngle) ==
                  doctest::Approx(std::numbers::pi / 2));
            CHECK(measure_crease(roof, h, CreaseMeasure::NormalJump) == doctest::Approx(2));
        });
    }

    TEST_CASE("creases are what their definition says, from both sides alike") {
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const TinFamily& family : general_families()) {
                CAPTURE(family.name);
                const Tin tin = family.make(random, 12);
                for (const auto& named : kCreaseMeasures) {
                    const std::string_view name = named.first;
                    const auto measure = named.second;
                    CAPTURE(name);
                    for_each_edge(tin.mesh, [&, measure = measure](HalfEdgeId h) {
                        const double crease = measure_crease(tin, h, measure);
                        REQUIRE(crease == measure_crease(tin, tin.mesh.twin(h), measure));
                        const auto expected = static_cast<double>(crease_by_definition(tin, h, measure));
                        REQUIRE(crease == doctest::Approx(expected).epsilon(1e-6));
                    });
                }
            }
        }
    }

    TEST_CASE("elevations in another unit give the same creases and the same triangulation") {
        constexpr double kFactor = 0.25;  // a power of two, so that nothing is rounded
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const TinFamily& family : general_families()) {
                CAPTURE(family.name);
                Tin tin = family.make(random, 40);
                Tin other = tin;
                for (double& z : other.z) {
                    z /= kFactor;
                }
                for (const auto& named : kCreaseMeasures) {
                    const CreaseMeasure measure = named.second;
                    for_each_edge(tin.mesh, [&](HalfEdgeId h) {
                        REQUIRE(measure_crease(tin, h, measure) ==
                                measure_crease(other, h, measure, kFactor));
                    });
                    Tin flipped = tin;
                    Tin other_flipped = other;
                    DataDependentOptions options;
                    options.measure = measure;
                    const DataDependentReport report = flip_creases(flipped, options);
                    options.z_factor = kFactor;
                    const DataDependentReport other_report = flip_creases(other_flipped, options);
                    CHECK(report.sum_before == other_report.sum_before);
                    CHECK(report.sum_after == other_report.sum_after);
                    CHECK(report.flips == other_report.flips);
                    CHECK(terrain_of(flipped.mesh) == terrain_of(other_flipped.mesh));
                }
            }
        }
    }

    TEST_CASE("flips are those of a greedy descent that computes the whole sum after every one") {
        for (int seed = 0; seed < cases(6); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const TinFamily& family : general_families()) {
                CAPTURE(family.name);
                const Tin start = family.make(random, static_cast<std::size_t>(random.integer(5, 14)));
                for (const auto& named : kCreaseMeasures) {
                    const std::string_view name = named.first;
                    const auto measure = named.second;
                    CAPTURE(name);
                    for (const std::optional<int> order : orders()) {
                        CAPTURE(order.value_or(-1));
                        Tin tin = start;
                        const DataDependentReport report = flip_creases(tin, options_of(measure, order));
                        Tin expected = start;
                        flip_slowly(expected, measure, order);
                        REQUIRE(terrain_of(tin.mesh) == terrain_of(expected.mesh));
                        REQUIRE(report.sum_before ==
                                doctest::Approx(static_cast<double>(sum_by_definition(start, measure))));
                        REQUIRE(report.sum_after ==
                                doctest::Approx(static_cast<double>(sum_by_definition(tin, measure))));
                        REQUIRE((report.flips == 0) == (report.sum_after == report.sum_before));
                        REQUIRE(report.sum_after <= report.sum_before);
                    }
                }
            }
        }
    }

    TEST_CASE("no flip within the order lowers the sum any more, and constrained edges and voids stay") {
        for (int seed = 0; seed < cases(6); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const auto families : {general_families(), degenerate_families()}) {
                for (const TinFamily& family : families) {
                    CAPTURE(family.name);
                    Tin start = family.make(random, static_cast<std::size_t>(random.integer(5, 30)));
                    if (start.mesh.count_terrain() == 0) {
                        continue;
                    }
                    constrain_at_random(random, start, static_cast<int>(random.integer(0, 4)));
                    make_voids_at_random(random, start, static_cast<int>(random.integer(0, 2)));
                    for (const auto& named : kCreaseMeasures) {
                        const std::string_view name = named.first;
                        const auto measure = named.second;
                        CAPTURE(name);
                        Tin tin = start;
                        flip_creases(tin, options_of(measure, std::nullopt));
                        REQUIRE(is_sound(tin));
                        REQUIRE(constraints_of(tin) == constraints_of(start));
                        const long double sum = sum_by_definition(tin, measure);
                        for_each_edge(tin.mesh, [&, measure = measure](HalfEdgeId h) {
                            if (is_flippable(tin, h)) {
                                Tin flipped = tin;
                                flip_edge(flipped.mesh, h);
                                const long double after = sum_by_definition(flipped, measure);
                                REQUIRE(after >= sum - kCertainGain * std::max({sum, after, 1.0L}));
                            }
                        });
                    }
                }
            }
        }
    }

    TEST_CASE("the sum is never below that of the best of all triangulations, and often equal") {
        int best = 0;
        int all = 0;
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const TinFamily& family : general_families()) {
                CAPTURE(family.name);
                Tin tin = family.make(random, 7);
                std::vector<oracle::Site> sites;
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    sites.push_back(site_of(tin, {v}));
                }
                const DataDependentReport report =
                    flip_creases(tin, options_of(CreaseMeasure::NormalAngle, std::nullopt));
                long double lowest = report.sum_before;
                oracle::for_each_triangulation(sites_of(tin), [&](const std::vector<oracle::Triple>& faces) {
                    std::vector<std::uint32_t> corners;
                    for (const oracle::Triple& face : faces) {
                        corners.insert(corners.end(), face.begin(), face.end());
                    }
                    const Tin other = tin_of_faces(sites, corners);
                    lowest = std::min(lowest, sum_by_definition(other, CreaseMeasure::NormalAngle));
                });
                REQUIRE(report.sum_after >= lowest * (1 - 1e-9L));
                best += report.sum_after <= lowest * (1 + 1e-9L) ? 1 : 0;
                ++all;
            }
        }
        CHECK(2 * best > all);
    }

    TEST_CASE("vertices inside the circle of any face are all found from its corners") {
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const auto families : {general_families(), degenerate_families()}) {
                for (const TinFamily& family : families) {
                    CAPTURE(family.name);
                    Tin tin = family.make(random, static_cast<std::size_t>(random.integer(5, 25)));
                    if (tin.mesh.count_terrain() == 0) {
                        continue;
                    }
                    internal::DelaunayOrder order(tin);
                    flip_at_random(random, tin, 40);
                    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                        if (tin.mesh.is_terrain({f})) {
                            const std::array corner{half_edge({f}, 0), half_edge({f}, 1), half_edge({f}, 2)};
                            const auto& v = tin.mesh.face({f}).vertex;
                            const int inside = count_inside(tin, v[0], v[1], v[2]);
                            REQUIRE(order.is_at_most(tin, corner, inside));
                            REQUIRE((inside == 0 || !order.is_at_most(tin, corner, inside - 1)));
                        }
                    }
                }
            }
        }
    }

    TEST_CASE("vertices behind a breakline do not count against a face, those around its end do") {
        // A wall from (0, 0) to (40, 0); a vertex close below it is inside the circles of faces above it.
        const std::vector<Point3> samples{{20, 4, 0}, {20, -1, 5}, {-9, 20, 0}, {49, 20, 0}, {20, -30, 0}};
        const std::vector<Breakline> wall{{.points = {{0, 0, 0}, {40, 0, 0}}}};
        const Tin tin = triangulate(samples, wall).tin;
        internal::DelaunayOrder order(tin);
        int behind = 0;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            if (tin.mesh.is_terrain({f})) {
                const std::array corner{half_edge({f}, 0), half_edge({f}, 1), half_edge({f}, 2)};
                const auto& v = tin.mesh.face({f}).vertex;
                behind += count_inside(tin, v[0], v[1], v[2]);
                CHECK(order.is_at_most(tin, corner, 0));
            }
        }
        CHECK(behind > 0);
    }

    TEST_CASE("of order zero only co-circular vertices get other edges") {
        for (int seed = 0; seed < cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const TinFamily& family : general_families()) {
                Tin tin = family.make(random, 30);
                CHECK(flip_creases(tin, options_of(CreaseMeasure::NormalAngle, 0)).flips == 0);
            }
            std::vector<oracle::Site> sites;
            for (const Key2 key : grid_keys(6, 6)) {
                sites.push_back({key, random.real()});
            }
            Tin grid = tin_of_sites(sites);
            REQUIRE(flip_creases(grid, options_of(CreaseMeasure::NormalAngle, 0)).flips > 0);
            for_each_edge(grid.mesh, [&](HalfEdgeId h) {
                const auto [a, b, c, d] = corners_of(grid.mesh, h);
                REQUIRE(oracle::incircle(grid.key(a), grid.key(b), grid.key(c), grid.key(d)) <= 0);
            });
        }
    }

    TEST_CASE("a ridge without a breakline is found again") {
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            // Ridge points 3 m apart, others about 2 m apart: many Delaunay edges cross the ridge.
            std::vector<Point3> samples;
            const auto add = [&](double across, double along) {
                samples.push_back({along, across + 0.3 * along, 50 - 0.5 * std::abs(across)});
            };
            for (int i = 0; i <= 40; ++i) {
                add(0, 3 * i);
            }
            for (int i = 0; i < 1500; ++i) {
                add(std::round(300 * (random.real() - 0.5)) / 10, std::round(1200 * random.real()) / 10);
            }
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            const auto crossing = [](const Tin& tin) {
                int count = 0;
                for_each_edge(tin.mesh, [&](HalfEdgeId h) {
                    const Point3 p = tin.position(tin.mesh.origin(h));
                    const Point3 q = tin.position(tin.mesh.destination(h));
                    const double from = p.y - 0.3 * p.x;
                    const double to = q.y - 0.3 * q.x;
                    count += std::min(from, to) < -1e-6 && std::max(from, to) > 1e-6 ? 1 : 0;
                });
                return count;
            };
            const int before = crossing(triangulate(samples, options).tin);
            for (const auto& named : kCreaseMeasures) {
                const std::string_view name = named.first;
                const auto measure = named.second;
                CAPTURE(name);
                options.data_dependent = options_of(measure, 3);
                const int after = crossing(triangulate(samples, options).tin);
                CAPTURE(before);
                REQUIRE(before >= 10);
                REQUIRE(after <= before / 3);
            }
        }
    }

    TEST_CASE("the same samples in any order on any number of threads give the same TIN") {
        for (int seed = 0; seed < cases(4); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Point3> samples = scan_samples(random, 1500);
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            options.data_dependent.emplace();
            const auto expected = words_of(triangulate(samples, options).tin);
            options.threads = 2;
            REQUIRE(words_of(triangulate(shuffled(random, samples), options).tin) == expected);
        }
    }

    TEST_CASE("a budget of nothing and an interrupt leave a valid TIN") {
        Random random(3);
        Tin tin = tin_of_samples(scan_samples(random, 20000), DuplicatePolicy::Mean);
        DataDependentOptions options;
        options.progress = [](double) { return false; };
        const DataDependentReport interrupted = flip_creases(tin, options);
        CHECK(interrupted.stopped_by == StoppedBy::Interrupt);
        CHECK(interrupted.flips > 0);
        CHECK(interrupted.sum_after < interrupted.sum_before);
        CHECK(is_sound(tin));
        options.budget_seconds = 0;
        CHECK(flip_creases(tin, options).stopped_by == StoppedBy::Budget);
        options = options_of(CreaseMeasure::NormalAngle, std::nullopt);
        CHECK(flip_creases(tin, options).stopped_by == StoppedBy::Finished);
        CHECK(flip_creases(tin, options).flips == 0);
    }

    TEST_CASE("options that make no sense are refused") {
        const std::vector<Point3> samples{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        TriangulateOptions options;
        options.data_dependent = options_of(CreaseMeasure::NormalJump, -1);
        CHECK(message_of<UsageError>([&] { triangulate(samples, options); }) ==
              "the Delaunay order must be zero or more");
        options.data_dependent->delaunay_order = 3;
        options.data_dependent->budget_seconds = -1;
        CHECK(message_of<UsageError>([&] { triangulate(samples, options); }) ==
              "the budget must be zero seconds or more");
        options.data_dependent->budget_seconds.reset();
        options.optimize.emplace();
        CHECK(message_of<UsageError>([&] { triangulate(samples, options); }) ==
              "a TIN is made optimal or data-dependent, not both");
    }
}
