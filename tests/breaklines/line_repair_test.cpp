#include "tinwright/breaklines/line_repair.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Kind = LineConflict::Kind;
using Parts = std::vector<std::vector<Point3>>;

Breakline line(std::vector<Point3> points, LineRole role = LineRole::Breakline, std::uint32_t polygon = 0) {
    Breakline made;
    made.points = std::move(points);
    made.role = role;
    made.polygon = polygon;
    return made;
}

LineRepair repair(const std::vector<Breakline>& lines, const std::vector<Point3>& samples = {},
                  const LineRepairOptions& options = {}) {
    return repair_lines(lines, samples, options);
}

/// What the parts of repaired lines are as lines again.
std::vector<Breakline> as_lines(const LineRepair& repaired, const std::vector<Breakline>& source) {
    std::vector<Breakline> lines;
    for (std::size_t i = 0; i < source.size(); ++i) {
        for (const std::vector<Point3>& part : repaired.lines[i]) {
            lines.push_back(line(part, source[i].role, source[i].polygon));
            lines.back().is_sharp = source[i].is_sharp;
        }
    }
    return lines;
}

double length_of(const std::vector<Point3>& points) {
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
    }
    return length;
}

bool has_repairable(const LineCheckReport& report) {
    return std::any_of(report.conflicts.begin(), report.conflicts.end(), is_repairable);
}

}  // namespace

TEST_SUITE("breaklines/line_repair") {
    TEST_CASE("lines without conflicts stay as they are") {
        const std::vector<Breakline> lines = {line({{0, 0, 1}, {5.25, 3, 2}, {9, 0, 1}}),
                                              line({{9, 0, 1}, {20, 0.5, 3}})};
        const LineRepair repaired = repair(lines);
        CHECK(repaired.found.conflicts.empty());
        CHECK(repaired.left.conflicts.empty());
        CHECK(repaired.lines == std::vector<Parts>{{lines[0].points}, {lines[1].points}});
    }

    TEST_CASE("a crossing becomes a point of both lines with one z") {
        const std::vector<Breakline> lines = {line({{0, 0, 1}, {10, 10, 1}}), line({{0, 10, 3}, {10, 0, 3}})};
        LineRepairOptions options;
        const auto z_with = [&](CrossingPolicy policy) {
            options.crossing_z = policy;
            const LineRepair repaired = repair(lines, {}, options);
            CHECK(repaired.left.conflicts.empty());
            REQUIRE(repaired.lines[0].size() == 1);
            REQUIRE(repaired.lines[0][0].size() == 3);
            CHECK(repaired.lines[0][0][1] == repaired.lines[1][0][1]);
            return repaired.lines[0][0][1].z;
        };
        CHECK(z_with(CrossingPolicy::Mean) == 2);
        CHECK(z_with(CrossingPolicy::Min) == 1);
        CHECK(z_with(CrossingPolicy::Max) == 3);
        CHECK(z_with(CrossingPolicy::First) == 1);
        options.crossing_z = CrossingPolicy::Error;
        CHECK(message_of<BreaklineError>([&] { static_cast<void>(repair(lines, {}, options)); }) ==
              "lines with z 1 and 3 at (5, 5); choose one with --crossing-z mean, first, min or max");
    }

    TEST_CASE("what is there twice is there once") {
        const Breakline whole = line({{0, 0, 0}, {30, 0, 0}});
        SUBCASE("a repeated line is left out") {
            const LineRepair repaired = repair({whole, line({{30, 0, 0}, {0, 0, 0}})});
            CHECK(repaired.lines == std::vector<Parts>{{whole.points}, {}});
        }
        SUBCASE("a stretch is cut out of the later line") {
            const LineRepair repaired = repair({line({{10, 0, 0}, {20, 0, 0}}), whole});
            CHECK(repaired.lines[1] == Parts{{{0, 0, 0}, {10, 0, 0}}, {{20, 0, 0}, {30, 0, 0}}});
            CHECK(repaired.left.conflicts.empty());
        }
        SUBCASE("a closed line is not cut where it begins") {
            const LineRepair repaired =
                repair({line({{9, 9, 0}, {0, 9, 0}}),
                        line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}})});
            CHECK(repaired.lines[1] == Parts{{{0, 9, 0}, {0, 0, 0}, {9, 0, 0}, {9, 9, 0}}});
        }
        SUBCASE("a polygon is left out as a whole or not at all") {
            LineRepairOptions options;
            options.check.traits = {{true, 1, false}, {true, 2, false}, {true, 3, false}};
            const auto box = [](double x) {
                return line({{x, 0, 0}, {x + 9, 0, 0}, {x + 9, 9, 0}, {x, 9, 0}, {x, 0, 0}});
            };
            const LineRepair repaired = repair({box(0), box(9), box(0)}, {}, options);
            CHECK(repaired.lines == std::vector<Parts>{{box(0).points}, {box(9).points}, {}});
            CHECK(repaired.left.conflicts.empty());
        }
    }

    TEST_CASE("points without extent and spikes go") {
        const LineRepair repaired =
            repair({line({{0, 0, 0}, {5, 0, 2}, {5, 0, 4}, {5, 9, 0}, {5, 0, 3}, {9, 0, 0}}),
                    line({{1, 1, 1}, {1, 1, 1}}), line({{50, 0, 0}, {60, 0, 0}, {55, 0, 0}})});
        CHECK(repaired.lines[0] == Parts{{{0, 0, 0}, {5, 0, 3}, {9, 0, 0}}});
        CHECK(repaired.lines[1].empty());
        CHECK(repaired.lines[2] == Parts{{{50, 0, 0}, {60, 0, 0}}});
        CHECK(repaired.left.conflicts.empty());
    }

    TEST_CASE("near misses within the snapping distance are joined") {
        LineRepairOptions options;
        options.check.snap = 0.5;
        options.check.dangling = 0;
        SUBCASE("a line is led through the point near it") {
            const LineRepair repaired =
                repair({line({{0, 0, 0}, {100, 0, 0}}), line({{50, 0.25, 0}, {50, 9, 0}})}, {}, options);
            CHECK(repaired.lines[0] == Parts{{{0, 0, 0}, {50, 0.25, 0}, {100, 0, 0}}});
            CHECK(repaired.left.conflicts.empty());
        }
        SUBCASE("points become one") {
            const LineRepair repaired =
                repair({line({{0, 0, 0}, {100, 0, 2}}), line({{100.25, 0.25, 4}, {120, 9, 0}})}, {}, options);
            CHECK(repaired.lines[0][0].back() == repaired.lines[1][0].front());
            CHECK(repaired.lines[0][0].back().z == 3);
            CHECK(repaired.left.conflicts.empty());
        }
        SUBCASE("a ring is closed") {
            const LineRepair repaired =
                repair({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0.25, 0, 0}}, LineRole::Hole)}, {}, options);
            CHECK(repaired.lines[0] == Parts{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0, 0}}});
        }
    }

    TEST_CASE("a wide gap of a ring is closed by a straight line") {
        const LineRepair repaired = repair({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}}, LineRole::Boundary)});
        CHECK(repaired.lines[0] == Parts{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0, 0}}});
        CHECK(repaired.left.conflicts.empty());
    }

    TEST_CASE("z that is missing is draped where that can be done, and left where not") {
        const std::vector<Breakline> lines = {line({{0, 0, kDraped}, {10, 0, kDraped}})};
        const std::vector<Point3> samples = {{0, -5, 1}, {10, -5, 1}, {5, 0, 7}, {0, 5, 1}, {10, 5, 1}};
        SUBCASE("left") {
            const LineRepair repaired = repair(lines, samples);
            REQUIRE(repaired.left.conflicts.size() == 1);
            CHECK(repaired.left.conflicts[0].kind == Kind::MissingZ);
            CHECK(std::isnan(repaired.lines[0][0][0].z));
        }
        SUBCASE("draped, with the samples on it") {
            LineRepairOptions options;
            options.drape = [](Point2 location) { return 100 + location.x; };
            const LineRepair repaired = repair(lines, samples, options);
            CHECK(repaired.left.conflicts.empty());
            CHECK(repaired.lines[0] == Parts{{{0, 0, 100}, {5, 0, 7}, {10, 0, 110}}});
        }
    }

    TEST_CASE("what only its owner can put right is left and named by the line as it came") {
        LineRepairOptions options;
        options.check.snap = 0.01;
        options.check.dangling = 1;
        const LineRepair repaired = repair({line({{-9, 50, 0}, {-9, 50, 0}}), line({{0, 0, 0}, {100, 0, 0}}),
                                            line({{50, 0.5, 0}, {50, 20, 0}})},
                                           {{25, 0, 3}}, options);
        REQUIRE(repaired.left.conflicts.size() == 2);
        CHECK(repaired.left.conflicts[0].kind == Kind::SampleOnLine);
        CHECK(repaired.left.conflicts[0].line_a == 1);
        CHECK(repaired.left.conflicts[1].kind == Kind::Dangling);
        CHECK(repaired.left.conflicts[1].line_a == 2);
        CHECK(repaired.left.conflicts[1].line_b == 1);
    }

    TEST_CASE("what has been repaired passes the audit and stays as it is, for every family of lines") {
        for (int seed = 0; seed < cases(12); ++seed) {
            for (const LineFamily& family : line_families()) {
                CAPTURE(seed);
                CAPTURE(family.name);
                Random random(static_cast<std::uint64_t>(seed));
                const LineSet set = family.make(random, 40);
                const LineRepair repaired = repair(set.lines, set.samples);
                CHECK_FALSE(has_repairable(repaired.left));
                const std::vector<Breakline> lines = as_lines(repaired, set.lines);
                CHECK_FALSE(has_repairable(check_lines(lines, set.samples)));
                const LineRepair again = repair(lines, set.samples);
                REQUIRE(again.lines.size() == lines.size());
                for (std::size_t i = 0; i < lines.size(); ++i) {
                    CHECK(again.lines[i] == Parts{lines[i].points});
                }
            }
        }
    }

    TEST_CASE("nothing is lost: what lines cover they cover afterwards") {
        // Without overlaps, spikes and snapping each line keeps its length.
        for (int seed = 0; seed < cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Breakline> lines;
            for (int i = 0; i < 15; ++i) {
                lines.push_back(line({}));
                for (int p = 0; p < 3; ++p) {
                    lines.back().points.push_back(
                        survey_point(random.integer(0, 100000), random.integer(0, 100000)));
                }
            }
            LineRepairOptions options;
            options.check.snap = 0;
            const LineRepair repaired = repair(lines, {}, options);
            CHECK_FALSE(has_repairable(repaired.left));
            for (std::size_t i = 0; i < lines.size(); ++i) {
                REQUIRE(repaired.lines[i].size() == 1);
                CHECK(length_of(repaired.lines[i][0]) ==
                      doctest::Approx(length_of(lines[i].points)).epsilon(1e-9));
                CHECK(repaired.lines[i][0].front() == lines[i].points.front());
                CHECK(repaired.lines[i][0].back() == lines[i].points.back());
            }
        }
    }
}
