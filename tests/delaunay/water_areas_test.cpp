#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr double kLevel = 7.25;

Breakline line_of(LineRole role, std::vector<Point3> points, std::uint32_t polygon = 0) {
    Breakline line;
    line.points = std::move(points);
    line.role = role;
    line.polygon = polygon;
    return line;
}

Breakline square_lake(double x_min, double y_min, double x_max, double y_max, double z = kLevel,
                      std::uint32_t polygon = 0) {
    return line_of(
        LineRole::Lake,
        {{x_min, y_min, z}, {x_max, y_min, z}, {x_max, y_max, z}, {x_min, y_max, z}, {x_min, y_min, z}},
        polygon);
}

std::vector<Point3> tilted_lattice(int size) {
    std::vector<Point3> samples;
    for (int y = 0; y <= size; ++y) {
        for (int x = 0; x <= size; ++x) {
            samples.push_back({static_cast<double>(x), static_cast<double>(y), 20 + 0.5 * x + 0.25 * y});
        }
    }
    return samples;
}

// Elevation of the vertex at a place; NaN where there is none.
double z_at(const Tin& tin, double x, double y) {
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const Point3 p = tin.position({v});
        if (p.x == x && p.y == y) {
            return p.z;
        }
    }
    return std::nan("");
}

// Where a place is, against a ring: by the winding of 128-bit integers in centimetres. +1 inside, 0 on it.
int side_of_ring(const std::vector<Point3>& ring, double x, double y) {
    const auto whole = [](double value) { return static_cast<std::int64_t>(std::llround(value * 100)); };
    const std::int64_t px = whole(x);
    const std::int64_t py = whole(y);
    int winding = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        const std::int64_t ax = whole(ring[i - 1].x) - px;
        const std::int64_t ay = whole(ring[i - 1].y) - py;
        const std::int64_t bx = whole(ring[i].x) - px;
        const std::int64_t by = whole(ring[i].y) - py;
        const std::int64_t cross = ax * by - ay * bx;
        if (cross == 0 && ax * bx <= 0 && ay * by <= 0) {
            return 0;
        }
        if (ay <= 0 && by > 0 && cross > 0) {
            ++winding;
        } else if (by <= 0 && ay > 0 && cross < 0) {
            --winding;
        }
    }
    return winding != 0 ? 1 : -1;
}

}  // namespace

TEST_SUITE("delaunay/water_areas") {
    TEST_CASE("inside a lake nothing counts, and the shore has its level whatever the samples say") {
        const std::vector<Breakline> lines = {square_lake(2, 2, 8, 6),
                                              line_of(LineRole::Breakline, {{0.5, 4.5, 50}, {9.5, 4.5, 50}})};
        const ConstrainedTin made = make_constrained_tin(tilted_lattice(10), lines);
        CHECK(made.lines.cleared_samples == 5 * 3);
        CHECK(made.lines.cleared_pieces == 1);
        CHECK(z_at(made.tin, 2, 2) == kLevel);
        CHECK(z_at(made.tin, 5, 2) == kLevel);
        CHECK(z_at(made.tin, 2, 4.5) == kLevel);
        CHECK(z_at(made.tin, 0.5, 4.5) == 50);
        CHECK(std::isnan(z_at(made.tin, 5, 4.5)));
        CHECK(std::any_of(
            made.lines.conflicts.begin(), made.lines.conflicts.end(), [](const LineConflict& conflict) {
                return conflict.kind == LineConflict::Kind::ElevationClash && conflict.location.x == 2;
            }));
    }

    TEST_CASE("lines that are no water still need a policy where they clash") {
        const std::vector<Breakline> lines = {square_lake(2, 2, 8, 6),
                                              line_of(LineRole::Breakline, {{0, 9, 50}, {10, 9, 50}}),
                                              line_of(LineRole::Breakline, {{4.5, 7, 30}, {4.5, 11, 30}})};
        CHECK_THROWS_AS(make_constrained_tin(std::vector<Point3>{{0, 0, 1}, {12, 0, 1}, {0, 12, 1}}, lines),
                        BreaklineError);
    }

    TEST_CASE("islands are terrain") {
        Breakline island = square_lake(4, 4, 6, 6);
        const std::vector<Breakline> lines = {square_lake(1, 1, 9, 9), island};
        const ConstrainedTin made = make_constrained_tin(tilted_lattice(10), lines);
        CHECK(made.lines.cleared_samples == 7 * 7 - 9);
        CHECK(z_at(made.tin, 5, 5) == 20 + 2.5 + 1.25);
    }

    TEST_CASE("sections between banks stay, breaklines and rivers there go") {
        const std::vector<Breakline> lines = {
            line_of(LineRole::Bank, {{1, 4, 6}, {9, 4, 5}, {9, 6, 5}, {1, 6, 6}, {1, 4, 6}}),
            line_of(LineRole::Section, {{5, 4, 5.5}, {5, 6, 5.5}}),
            line_of(LineRole::River, {{1, 5, 6}, {9, 5, 5}}),
            line_of(LineRole::Breakline, {{3.5, 3.5, 40}, {3.5, 6.5, 40}})};
        const ConstrainedTin made = make_constrained_tin(tilted_lattice(10), lines);
        CHECK(made.lines.cleared_samples == 7);
        CHECK(made.lines.cleared_pieces == 5);
        CHECK(z_at(made.tin, 5, 4) == 5.5);
        CHECK(z_at(made.tin, 3.5, 4) == 5.6875);
        CHECK(z_at(made.tin, 3.5, 3.5) == 40);
        const auto has_trace = [&](std::uint32_t line) {
            return std::any_of(made.tin.traces.begin(), made.tin.traces.end(),
                               [line](const LineTrace& trace) { return trace.line == line; });
        };
        CHECK(has_trace(1));
        CHECK_FALSE(has_trace(2));
    }

    TEST_CASE("a border through a lake is as high as the lake, draped or not") {
        for (const double z : {99.0, kDraped}) {
            const std::vector<Breakline> lines = {
                square_lake(2, 2, 8, 6),
                line_of(LineRole::Boundary,
                        {{0.5, 0.5, z}, {5.5, 0.5, z}, {5.5, 9.5, z}, {0.5, 9.5, z}, {0.5, 0.5, z}}),
                line_of(LineRole::Hole, {{3, 3, z}, {5, 3, z}, {5, 5, z}, {3, 5, z}, {3, 3, z}})};
            const ConstrainedTin made = make_constrained_tin(tilted_lattice(10), lines);
            for (std::uint32_t v = 0; v < made.tin.vertex_count(); ++v) {
                const Point3 p = made.tin.position({v});
                if (p.x >= 2 && p.x <= 8 && p.y >= 2 && p.y <= 6) {
                    CHECK(p.z == kLevel);
                }
            }
        }
    }

    TEST_CASE("random lakes among random samples and lines are level, corner and side") {
        const int count = cases(150);
        for (int seed = 0; seed < count; ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const double x = 500000;
            const double y = 5400000;
            const std::vector<Point3> samples = decimal_samples(random, 200, seed % 3, x, y, 100);
            std::vector<Point3> shore;
            const std::int64_t corners = random.integer(3, 14);
            for (std::int64_t i = 0; i < corners; ++i) {
                const double turn =
                    2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(corners);
                const double radius = 10 + 60 * random.real();
                shore.push_back({x + std::round(100 * (radius * std::cos(turn))) / 100,
                                 y + std::round(100 * (radius * std::sin(turn))) / 100, kLevel});
            }
            shore.push_back(shore.front());
            std::vector<Breakline> lines = {line_of(LineRole::Lake, shore)};
            for (int i = 0; i < 4; ++i) {
                const std::vector<Point3> ends = decimal_samples(random, 3, 2, x, y, 90);
                lines.push_back(line_of(LineRole::Breakline, ends));
            }
            ConstrainedTinOptions options;
            options.noding.crossing_z = CrossingPolicy::Mean;
            options.duplicates.policy = DuplicatePolicy::Mean;
            const ConstrainedTin made = make_constrained_tin(samples, lines, options);
            std::size_t level = 0;
            for (std::uint32_t v = 0; v < made.tin.vertex_count(); ++v) {
                const Point3 p = made.tin.position({v});
                const bool is_given =
                    std::round(p.x * 100) / 100 == p.x && std::round(p.y * 100) / 100 == p.y;
                if (is_given && side_of_ring(shore, p.x, p.y) > 0) {
                    FAIL_CHECK("a vertex inside");
                }
                level += p.z == kLevel ? 1U : 0U;
            }
            CHECK(level >= static_cast<std::size_t>(corners));
            for (const LineTrace& trace : made.tin.traces) {
                if (trace.line == 0) {
                    CHECK(made.tin.z[trace.a.value] == kLevel);
                    CHECK(made.tin.z[trace.b.value] == kLevel);
                }
            }
        }
    }
}
