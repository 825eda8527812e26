#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "support/cases.hpp"
#include "support/constrained_oracle.hpp"
#include "support/line_sets.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

// A family's lines and samples, and some more samples around them.
LineSet make_case(const LineFamily& family, Random& random, std::size_t size) {
    LineSet set = family.make(random, size);
    std::array<double, 4> box = {1e300, 1e300, -1e300, -1e300};
    for (const Breakline& line : set.lines) {
        for (const Point3& p : line.points) {
            box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x),
                   std::max(box[3], p.y)};
        }
    }
    const auto count = random.integer(3, 40);
    for (std::int64_t i = 0; i < count; ++i) {
        const double x = std::round(100 * (box[0] + random.real() * (box[2] - box[0]))) / 100;
        const double y = std::round(100 * (box[1] + random.real() * (box[3] - box[1]))) / 100;
        set.samples.push_back({x, y, plane_z(x, y)});
    }
    return set;
}

// Lines that run beside each other closer than thousands of lattice steps can need more Steiner points than
// there is room for, or than the budget.
bool is_hair_thin(const LineFamily& family) {
    const std::string name = family.name;
    return name == "hair crossings" || name == "parallel lines" || name == "hub";
}

TriangulateOptions tolerant() {
    TriangulateOptions options;
    options.duplicates = {.policy = DuplicatePolicy::Mean, .tolerance = 0};
    options.noding.crossing_z = CrossingPolicy::Mean;
    return options;
}

bool is_degenerate(const LineSet& set) {
    try {
        triangulate(set.samples, set.lines, tolerant());
        return false;
    } catch (const InputError&) {
        return true;
    }
}

// Lines, faces and elevations without the numbers that depend on the order.
using Place = std::tuple<double, double, double>;
std::vector<std::array<Place, 2>> edges_of(const Tin& tin) {
    std::vector<std::array<Place, 2>> edges;
    for (const LineTrace& trace : tin.traces) {
        std::array<Place, 2> edge;
        for (unsigned i = 0; i < 2; ++i) {
            const Point3 p = tin.position(i == 0 ? trace.a : trace.b);
            edge[i] = {p.x, p.y, p.z};
        }
        edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::vector<Point3> square_samples(int size) {
    std::vector<Point3> samples;
    for (int x = 0; x <= size; ++x) {
        for (int y = 0; y <= size; ++y) {
            samples.push_back({x + 0.0, y + 0.0, 2.0 * x + y});
        }
    }
    return samples;
}

Breakline ring(std::vector<Point3> points, LineRole role, std::uint32_t polygon) {
    points.push_back(points.front());
    return {std::move(points), role, true, polygon};
}

Breakline rectangle(double x0, double y0, double x1, double y1, LineRole role, std::uint32_t polygon) {
    return ring({{x0, y0, kDraped}, {x1, y0, kDraped}, {x1, y1, kDraped}, {x0, y1, kDraped}}, role, polygon);
}

double area_of(const Tin& tin) {
    double area = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            const Point3 a = tin.position(tin.mesh.vertex({f}, 0));
            const Point3 b = tin.position(tin.mesh.vertex({f}, 1));
            const Point3 c = tin.position(tin.mesh.vertex({f}, 2));
            area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
        }
    }
    return area;
}

double area_inside(const std::vector<Breakline>& lines) {
    return area_of(triangulate(square_samples(10), lines, tolerant()).tin);
}

}  // namespace

TEST_SUITE("optimal/triangulate_lines") {
    TEST_CASE("every segment of every line is a chain of edges of a constrained Delaunay triangulation") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 1; seed <= cases(25); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const LineSet set =
                    make_case(family, random, static_cast<std::size_t>(random.integer(1, 60)));
                if (is_degenerate(set)) {
                    continue;
                }
                const Triangulated made = triangulate(set.samples, set.lines, tolerant());
                REQUIRE(constrained_delaunay_defect(made.tin) == "");
                REQUIRE(chain_defect(made.tin, set.lines, made.tin.lattice.refinement() == 0 ? 0 : 0.5) ==
                        "");
            }
        }
    }

    TEST_CASE("the conforming triangulation is Delaunay and all edges of lines have empty disks") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 1; seed <= cases(5); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const LineSet set =
                    make_case(family, random, static_cast<std::size_t>(random.integer(1, 20)));
                if (is_degenerate(set)) {
                    continue;
                }
                for (const ConformingMethod method : {ConformingMethod::Split, ConformingMethod::Blocking}) {
                    CAPTURE(static_cast<int>(method));
                    TriangulateOptions options = tolerant();
                    options.conforming = ConformingOptions{.method = method, .max_steiner = 1000};
                    const Triangulated made = triangulate(set.samples, set.lines, options);
                    REQUIRE(constrained_delaunay_defect(made.tin) == "");
                    REQUIRE(made.report.conforming->open_edges == count_open_edges(made.tin));
                    if (made.report.is_conforming) {
                        REQUIRE(empty_disk_defect(made.tin) == "");
                    } else {
                        const bool is_spent = made.report.conforming->steiner_vertices == 1000;
                        REQUIRE((is_hair_thin(family) || (method == ConformingMethod::Blocking && is_spent)));
                        REQUIRE(empty_disk_defect(made.tin) != "");
                    }
                    REQUIRE(chain_defect(made.tin, set.lines, 1) == "");
                }
            }
        }
    }

    TEST_CASE("the result depends neither on the order nor on the directions of lines and samples") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 1; seed <= cases(5); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const LineSet set = make_case(family, random, 30);
                if (is_degenerate(set)) {
                    continue;
                }
                for (const bool conforming : {false, true}) {
                    TriangulateOptions options = tolerant();
                    if (conforming) {
                        options.conforming.emplace();
                    }
                    const Triangulated made = triangulate(set.samples, set.lines, options);
                    const Triangulated other = triangulate(shuffled(random, set.samples),
                                                           shuffled_and_reversed(random, set.lines), options);
                    REQUIRE(words_of(made.tin) == words_of(other.tin));
                    REQUIRE(edges_of(made.tin) == edges_of(other.tin));
                }
            }
        }
    }

    TEST_CASE("boundaries and holes cut the domain exactly") {
        const Breakline outer = rectangle(1, 1, 9, 9, LineRole::Boundary, 0);
        CHECK(area_inside({outer}) == doctest::Approx(64));
        SUBCASE("a hole is cut out, and one that touches the boundary too") {
            CHECK(area_inside({outer, rectangle(3, 3, 5, 5, LineRole::Hole, 0)}) == doctest::Approx(60));
            CHECK(area_inside({outer, rectangle(1, 3, 5, 5, LineRole::Hole, 0)}) == doctest::Approx(56));
            CHECK(area_inside({outer, rectangle(0, 3, 5, 5, LineRole::Hole, 0)}) == doctest::Approx(56));
        }
        SUBCASE("an inner ring of a hole is an island") {
            CHECK(area_inside({rectangle(2, 2, 8, 8, LineRole::Hole, 4),
                               rectangle(4, 4, 6, 6, LineRole::Hole, 4)}) == doctest::Approx(68));
        }
        SUBCASE("boundaries that overlap or share an edge are united") {
            CHECK(area_inside({outer, rectangle(5, 5, 10, 10, LineRole::Boundary, 1)}) ==
                  doctest::Approx(73));
            CHECK(area_inside({rectangle(0, 0, 5, 10, LineRole::Boundary, 0),
                               rectangle(5, 0, 10, 10, LineRole::Boundary, 1)}) == doctest::Approx(100));
        }
        SUBCASE("holes that overlap are united") {
            CHECK(area_inside({rectangle(2, 2, 6, 6, LineRole::Hole, 0),
                               rectangle(4, 4, 8, 8, LineRole::Hole, 1)}) == doctest::Approx(72));
        }
        SUBCASE("a spike of a ring encloses nothing") {
            CHECK(area_inside({ring({{1, 1, kDraped},
                                     {9, 1, kDraped},
                                     {9, 5, kDraped},
                                     {5, 5, kDraped},
                                     {9, 5, kDraped},
                                     {9, 9, kDraped},
                                     {1, 9, kDraped}},
                                    LineRole::Boundary, 0)}) == doctest::Approx(64));
        }
        SUBCASE("rings between samples cut where they are") {
            CHECK(area_inside({rectangle(1.25, 1.5, 7.75, 9.5, LineRole::Boundary, 0)}) ==
                  doctest::Approx(52));
        }
    }

    TEST_CASE("what is draped beyond the samples adds no terrain") {
        const std::vector<Breakline> lines = {rectangle(-5, 2, 5, 12, LineRole::Boundary, 0)};
        const Triangulated made = triangulate(square_samples(10), lines, tolerant());
        CHECK(area_of(made.tin) == doctest::Approx(40));
        const ConflictCounts counts = count_conflicts(made.report.lines.conflicts);
        CHECK(counts[static_cast<std::size_t>(LineConflict::Kind::OutsideSamples)] == 3);
        for (std::uint32_t v = 0; v < made.tin.vertex_count(); ++v) {
            const Point3 p = made.tin.position({v});
            if (p.x >= 0 && p.x <= 10 && p.y >= 0 && p.y <= 10) {
                REQUIRE(p.z == doctest::Approx(2 * p.x + p.y));
            }
        }
    }

    TEST_CASE("where the terrain ends is no line that others could clash with") {
        // The hull runs from z 0 to z 1 through (5, 0), where a line on it has z 7.
        const std::vector<Point3> samples = {{0, 0, 0}, {10, 0, 1}, {0, 10, 0}, {10, 10, 1}};
        const std::vector<Breakline> lines = {{{{5, 0, 7}, {5, 5, 7}}},
                                              {{{5, 8, kDraped}, {15, 8, kDraped}}}};
        const Triangulated made = triangulate(samples, lines);
        CHECK(area_of(made.tin) == doctest::Approx(100));
        for (std::uint32_t v = 0; v < made.tin.vertex_count(); ++v) {
            const Point3 p = made.tin.position({v});
            if (p.x == 5 && p.y == 0) {
                CHECK(p.z == 7);
            }
        }
    }

    TEST_CASE("lines from another system meet the samples that they go through") {
        std::vector<Point3> samples = square_samples(10);
        for (Point3& p : samples) {
            p.x += 500000;
            p.y += 4000000;
        }
        // A billionth off, as a transformation there and back leaves them.
        const std::vector<Breakline> lines = {
            {{{500001.0000000007, 4000001.0000000005, 3}, {500007.9999999991, 4000007.000000001, 23}}}};
        const Triangulated made = triangulate(samples, lines);
        CHECK(made.tin.vertex_count() == samples.size());
        CHECK(made.tin.lattice.decimals() == 0);
        CHECK(constrained_delaunay_defect(made.tin) == "");
    }

    TEST_CASE("a draped line takes the elevations of the samples' TIN") {
        const std::vector<Breakline> lines = {{{{0.5, 0.5, kDraped}, {7.25, 3.5, kDraped}}}};
        const Triangulated made = triangulate(square_samples(10), lines, tolerant());
        CHECK(made.report.lines.draped_vertices == 2);
        for (std::uint32_t v = 0; v < made.tin.vertex_count(); ++v) {
            const Point3 p = made.tin.position({v});
            REQUIRE(p.z == doctest::Approx(2 * p.x + p.y));
        }
    }

    TEST_CASE("a sample on a line follows the policy for duplicates") {
        const std::vector<Point3> samples = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}, {5, 5, 1}};
        const std::vector<Breakline> lines = {{{{2, 5, 3}, {8, 5, 5}}}};
        TriangulateOptions options;
        const auto z_with = [&](DuplicatePolicy policy) {
            options.duplicates.policy = policy;
            const Triangulated made = triangulate(samples, lines, options);
            CHECK(made.report.duplicates.conflicting == 1);
            REQUIRE(made.report.lines.conflicts.size() == 1);
            CHECK(made.report.lines.conflicts[0].kind == LineConflict::Kind::SampleOnLine);
            const auto at = std::find(made.tin.sample.begin(), made.tin.sample.end(), 4U);
            return made.tin.z[static_cast<std::size_t>(at - made.tin.sample.begin())];
        };
        CHECK(z_with(DuplicatePolicy::First) == 1);
        CHECK(z_with(DuplicatePolicy::Last) == 4);
        CHECK(z_with(DuplicatePolicy::Min) == 1);
        CHECK(z_with(DuplicatePolicy::Max) == 4);
        CHECK(z_with(DuplicatePolicy::Mean) == 2.5);
        options.duplicates.policy = DuplicatePolicy::Error;
        CHECK_THROWS_WITH_AS(
            triangulate(samples, lines, options),
            "1 sample lies on a line that has another elevation there, at (5, 5): z 1 of the "
            "sample, 4 of the line; say which to take with --duplicates "
            "first|last|min|max|mean|median, or allow for the difference with "
            "--duplicate-tolerance",
            BreaklineError);
    }

    TEST_CASE("samples near a line are reported on request") {
        const std::vector<Point3> samples = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {5, 5.25, 1}, {5, 7, 1}};
        const std::vector<Breakline> lines = {{{{2, 5, 3}, {8, 5, 5}}}};
        TriangulateOptions options;
        CHECK(triangulate(samples, lines, options).report.lines.conflicts.empty());
        options.line_tolerance = 0.5;
        const std::vector<LineConflict> conflicts =
            triangulate(samples, lines, options).report.lines.conflicts;
        REQUIRE(conflicts.size() == 1);
        CHECK(conflicts[0].kind == LineConflict::Kind::SampleNearLine);
        CHECK(conflicts[0].sample == 3);
        CHECK(conflicts[0].line_a == 0);
    }

    TEST_CASE("a thousand lines from one point and the lower bound of the thesis are no trouble") {
        TriangulateOptions options = tolerant();
        options.conforming.emplace();
        SUBCASE("all around, gaps of a third of a degree") {
            const std::vector<Breakline> lines = fan(1000, 0.36, 200);
            const Triangulated made = triangulate({}, lines, tolerant());
            CHECK(made.report.lines.conflicts.empty());
            CHECK(constrained_delaunay_defect(made.tin) == "");
            CHECK(made.tin.traces.size() == 1000);
            const Triangulated conforming = triangulate({}, lines, options);
            CHECK(constrained_delaunay_defect(conforming.tin) == "");
            CHECK(conforming.report.is_conforming);
        }
        SUBCASE("[tan1993, Fig. 6.1]: close parallel edges need a point for each pair beside them") {
            const LineSet set = close_parallel_edges(40, 40);
            const Triangulated conforming = triangulate(set.samples, set.lines, options);
            CHECK(conforming.report.is_conforming);
            CHECK(conforming.report.conforming->steiner_vertices >= std::size_t{40} * 40);
            CHECK(conforming.report.conforming->steiner_vertices < std::size_t{3} * 40 * 40);
        }
    }

    TEST_CASE("a budget of Steiner points ends the work with a valid triangulation that says so") {
        const LineSet set = close_parallel_edges(10, 10);
        TriangulateOptions options;
        options.conforming = ConformingOptions{.max_steiner = 7};
        const Triangulated made = triangulate(set.samples, set.lines, options);
        CHECK(made.report.conforming->steiner_vertices == 7);
        CHECK_FALSE(made.report.is_conforming);
        CHECK(made.report.conforming->open_edges == count_open_edges(made.tin));
        CHECK(constrained_delaunay_defect(made.tin) == "");
        CHECK(chain_defect(made.tin, set.lines, 1) == "");
    }

    TEST_CASE("lines alone make a surface, and rings that are open or lines without any z are refused") {
        const std::vector<Breakline> lines = {{{{0, 0, 0}, {10, 0, 0}}}, {{{0, 10, 1}, {10, 10, 1}}}};
        CHECK(triangulate({}, lines).report.faces == 2);
        const std::vector<Breakline> draped = {{{{0, 0, kDraped}, {10, 0, kDraped}}}};
        CHECK_THROWS_WITH_AS(
            triangulate({}, draped),
            "lines without z cannot be draped: there are not three samples to drape them on; "
            "give the lines' z with z=FIELD or z=NUMBER",
            InputError);
        const std::vector<Breakline> open = {{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, LineRole::Boundary}};
        CHECK_THROWS_WITH_AS(triangulate(square_samples(3), open),
                             "the ring of a boundary is not closed: it begins at (0, 0) and ends at "
                             "(10, 10); close it, or give --snap with a distance above the gap",
                             BreaklineError);
        const std::vector<Breakline> nothing_left = {rectangle(-1, -1, 4, 4, LineRole::Hole, 0)};
        CHECK_THROWS_WITH_AS(triangulate(square_samples(3), nothing_left, tolerant()),
                             "no face is left: boundary and holes leave no terrain between the samples",
                             InputError);
    }
}
