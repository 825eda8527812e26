#include "tinwright/breaklines/line_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Kind = LineConflict::Kind;

Breakline line(std::vector<Point3> points, LineRole role = LineRole::Breakline, std::uint32_t polygon = 0) {
    Breakline made;
    made.points = std::move(points);
    made.role = role;
    made.polygon = polygon;
    return made;
}

/// A closed rectangle at z 0.
Breakline box(double x0, double y0, double x1, double y1, LineRole role = LineRole::Breakline,
              std::uint32_t polygon = 0) {
    return line({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}, {x0, y0, 0}}, role, polygon);
}

std::vector<LineConflict> conflicts_of(const std::vector<Breakline>& lines,
                                       const std::vector<Point3>& samples = {},
                                       const LineCheckOptions& options = {}) {
    return check_lines(lines, samples, options).conflicts;
}

/// The one conflict of lines and samples that have no other.
LineConflict only(const std::vector<LineConflict>& conflicts) {
    REQUIRE(conflicts.size() == 1);
    CHECK(conflicts[0].action == LineConflict::Action::Reported);
    return conflicts[0];
}

LineTraits ring(std::uint32_t polygon) { return {true, polygon, false}; }

}  // namespace

TEST_SUITE("breaklines/line_check") {
    TEST_CASE("lines that share points with one z have no conflict") {
        SUBCASE("an end at an end") {
            CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 2}}), line({{10, 0, 2}, {10, 10, 3}})}).empty());
        }
        SUBCASE("a closed ring") { CHECK(conflicts_of({box(0, 0, 10, 10)}).empty()); }
        SUBCASE("a crossing at a point of both") {
            CHECK(conflicts_of(
                      {line({{0, 0, 0}, {5, 5, 0}, {10, 10, 0}}), line({{0, 10, 0}, {5, 5, 0}, {10, 0, 0}})})
                      .empty());
        }
        SUBCASE("an end at a point between ends") {
            CHECK(conflicts_of({line({{0, 0, 0}, {5, 0, 0}, {10, 0, 0}}), line({{5, 0, 0}, {5, 9, 0}})})
                      .empty());
        }
        SUBCASE("nothing at all") { CHECK(conflicts_of({}).empty()); }
        SUBCASE("samples alone") { CHECK(conflicts_of({}, {{0, 0, 1}, {1, 0, 2}, {1, 0, 2}}).empty()); }
    }

    TEST_CASE("a crossing is listed with both z even where they agree") {
        const LineConflict found =
            only(conflicts_of({line({{0, 0, 1}, {10, 10, 1}}), line({{0, 10, 1}, {10, 0, 1}})}));
        CHECK(found.kind == Kind::Crossing);
        CHECK(found.location == Point2{5, 5});
        CHECK(found.line_a == 0);
        CHECK(found.line_b == 1);
        CHECK(found.z_a == 1);
        CHECK(found.z_b == 1);
    }

    TEST_CASE("a touch is listed with both z, and a clash of elevations too") {
        const auto found = conflicts_of({line({{0, 0, 1}, {10, 0, 3}}), line({{5, 0, 7}, {5, 9, 7}})});
        REQUIRE(found.size() == 2);
        CHECK(found[0].kind == Kind::Touch);
        CHECK(found[0].location == Point2{5, 0});
        CHECK(found[0].z_a == 2);
        CHECK(found[0].z_b == 7);
        CHECK(found[1].kind == Kind::ElevationClash);
        LineCheckOptions options;
        options.crossing_tolerance = 5;
        CHECK(only(conflicts_of({line({{0, 0, 1}, {10, 0, 3}}), line({{5, 0, 7}, {5, 9, 7}})}, {}, options))
                  .kind == Kind::Touch);
    }

    TEST_CASE("a line is compared with itself") {
        CHECK(only(conflicts_of({line({{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 10, 0}})})).kind ==
              Kind::SelfCrossing);
        SUBCASE("through a point that both passages have there is none") {
            CHECK(conflicts_of({line({{0, 0, 0}, {5, 5, 0}, {10, 10, 0}, {10, 0, 0}, {5, 5, 0}, {0, 10, 0}})})
                      .empty());
        }
        SUBCASE("a stretch run along twice") {
            const LineConflict found = only(conflicts_of(
                {line({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {20, 9, 0}, {10, 0, 0}, {0, 0, 0}, {0, 9, 0}})}));
            CHECK(found.kind == Kind::Overlap);
            CHECK(found.line_b == 0);
        }
    }

    TEST_CASE("overlaps and duplicates of lines are conflicts even from point to point") {
        const Breakline whole = line({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}});
        CHECK(only(conflicts_of({whole, line({{10, 0, 0}, {20, 0, 0}, {20, 9, 0}})})).kind == Kind::Overlap);
        const LineConflict twice = only(conflicts_of({whole, line({{20, 0, 0}, {10, 0, 0}, {0, 0, 0}})}));
        CHECK(twice.kind == Kind::Duplicate);
        CHECK(twice.line_b == 1);
    }

    TEST_CASE("polygons may share edges, from corner to corner of both") {
        LineCheckOptions options;
        options.traits = {ring(1), ring(2)};
        CHECK(conflicts_of({box(0, 0, 10, 10), box(10, 0, 20, 10)}, {}, options).empty());
        SUBCASE("not from corner to corner they touch and overlap") {
            const auto found = conflicts_of({box(0, 0, 10, 10), box(10, 2, 20, 8)}, {}, options);
            CHECK(std::count_if(found.begin(), found.end(), [](const LineConflict& conflict) {
                      return conflict.kind == Kind::Overlap;
                  }) == 1);
        }
        SUBCASE("the same polygon twice is a duplicate") {
            CHECK(only(conflicts_of({box(0, 0, 10, 10), box(0, 0, 10, 10)}, {}, options)).kind ==
                  Kind::Duplicate);
        }
        SUBCASE("a polygon that fills another one's hole is none") {
            options.traits = {ring(1), ring(1), ring(2)};
            CHECK(conflicts_of({box(0, 0, 30, 30), box(10, 10, 20, 20), box(10, 10, 20, 20)}, {}, options)
                      .empty());
        }
        SUBCASE("a line along the edge is an overlap") {
            options.traits = {ring(1), {}};
            CHECK(
                only(conflicts_of({box(0, 0, 10, 10), line({{10, 0, 0}, {10, 10, 0}})}, {}, options)).kind ==
                Kind::Overlap);
        }
        SUBCASE("a line along an edge of two is an overlap") {
            options.traits = {ring(1), ring(2), {}};
            const LineConflict found = only(conflicts_of(
                {box(0, 0, 10, 10), box(10, 0, 20, 10), line({{10, 0, 0}, {10, 10, 0}})}, {}, options));
            CHECK(found.kind == Kind::Overlap);
            CHECK(found.line_b == 2);
        }
    }

    TEST_CASE("a boundary may run along a breakline, from point to point of both") {
        CHECK(conflicts_of({box(0, 0, 10, 10, LineRole::Boundary), line({{10, 0, 0}, {10, 10, 0}})}).empty());
        CHECK_FALSE(
            conflicts_of({box(0, 0, 10, 10, LineRole::Boundary), line({{10, 0, 0}, {10, 5, 0}})}).empty());
    }

    TEST_CASE("points at one location in succession are listed once, with the z that differs") {
        const LineConflict found =
            only(conflicts_of({line({{0, 0, 1}, {5, 0, 2}, {5, 0, 2}, {5, 0, 4}, {9, 0, 1}})}));
        CHECK(found.kind == Kind::ZeroLength);
        CHECK(found.location == Point2{5, 0});
        CHECK(found.z_a == 2);
        CHECK(found.z_b == 4);
        SUBCASE("a whole line of them") {
            const std::vector<Point3> same(5000, Point3{1, 2, 3});
            CHECK(only(conflicts_of({line(same)})).kind == Kind::ZeroLength);
        }
    }

    TEST_CASE("a line that turns back on itself has a spike") {
        const auto spike_of = [](const std::vector<Point3>& points) {
            const LineConflict found = only(conflicts_of({line(points)}));
            CHECK(found.kind == Kind::Spike);
            return found.location;
        };
        CHECK(spike_of({{0, 0, 0}, {10, 0, 0}, {10, 9, 0}, {10, 0, 0}, {20, 0, 0}}) == Point2{10, 9});
        CHECK(spike_of({{0, 0, 0}, {10, 0, 0}, {7, 0, 0}, {7, 10, 0}}) == Point2{10, 0});
        CHECK(spike_of({{0, 0, 0}, {10, 0, 0}, {4, 0, 0}}) == Point2{10, 0});
        CHECK(spike_of({{0, 0, 0}, {10, 0, 0}, {20, 5, 0}, {10, 0, 0}, {0, 0, 0}}) == Point2{20, 5});
        SUBCASE("at the place where a ring is closed") {
            CHECK(spike_of({{0, 9, 0}, {0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {0, 5, 0}, {0, 9, 0}}) ==
                  Point2{0, 9});
        }
        SUBCASE("a tip narrower than the snapping distance is one too") {
            LineCheckOptions options;
            options.snap = 0.1;
            CHECK(only(conflicts_of({line({{0, 0, 0}, {10, 0, 0}, {4, 0.05, 0}, {4, 9, 0}})}, {}, options))
                      .kind == Kind::Spike);
            options.snap = 0.01;
            CHECK(
                conflicts_of({line({{0, 0, 0}, {10, 0, 0}, {4, 0.05, 0}, {4, 9, 0}})}, {}, options).empty());
        }
    }

    TEST_CASE("near misses count up to the snapping distance") {
        LineCheckOptions options;
        options.snap = 0.5;
        options.dangling = 0;
        const Breakline base = line({{0, 0, 1}, {100, 0, 3}});
        SUBCASE("a point near a segment") {
            const LineConflict found =
                only(conflicts_of({line({{50, 0.5, 7}, {50, 9, 7}}), base}, {}, options));
            CHECK(found.kind == Kind::NearMiss);
            CHECK(found.location == Point2{50, 0.5});
            CHECK(found.z_a == 7);
            CHECK(found.z_b == 2);
            CHECK(conflicts_of({line({{50, 0.51, 7}, {50, 9, 7}}), base}, {}, options).empty());
        }
        SUBCASE("two points near each other are one near miss") {
            CHECK(only(conflicts_of({base, line({{100.3, 0.4, 3}, {120, 5, 0}})}, {}, options)).location ==
                  Point2{100, 0});
        }
        SUBCASE("points that other points are at miss nothing") {
            CHECK(
                conflicts_of({base, line({{100, 0, 3}, {100.3, 0.2, 0}, {120, 5, 0}})}, {}, options).size() ==
                1);
            CHECK(conflicts_of({base, line({{100, 0, 3}, {120, 5, 0}})}, {}, options).empty());
        }
        SUBCASE("the ends of one line") {
            const LineConflict found =
                only(conflicts_of({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0.3, 5}})}, {}, options));
            CHECK(found.kind == Kind::NearMiss);
            CHECK(found.line_a == found.line_b);
        }
        SUBCASE("the distance that is taken by default is told") {
            const LineCheckReport report = check_lines(std::vector{base}, {});
            CHECK(report.snap == doctest::Approx(0.1));
            CHECK(report.dangling == doctest::Approx(5));
        }
    }

    TEST_CASE("an end just short of a line dangles") {
        LineCheckOptions options;
        options.snap = 0.01;
        options.dangling = 1;
        const Breakline base = line({{0, 0, 0}, {100, 0, 0}});
        const LineConflict found = only(conflicts_of({base, line({{50, 0.9, 7}, {50, 20, 7}})}, {}, options));
        CHECK(found.kind == Kind::Dangling);
        CHECK(found.line_a == 1);
        CHECK(found.line_b == 0);
        CHECK(found.z_a == 7);
        SUBCASE("not where it does not point at the other line") {
            CHECK(conflicts_of({base, line({{50, 0.9, 7}, {80, 0.9, 7}})}, {}, options).empty());
        }
        SUBCASE("not where it touches another one") {
            CHECK(conflicts_of({base, line({{50, 0.9, 7}, {50, 20, 7}}), line({{50, 0.9, 7}, {60, 8, 7}})},
                               {}, options)
                      .empty());
        }
        SUBCASE("not beyond the distance") {
            CHECK(conflicts_of({base, line({{50, 1.1, 7}, {50, 20, 7}})}, {}, options).empty());
        }
    }

    TEST_CASE("samples on lines are compared in z, samples near lines are listed when asked for") {
        const Breakline base = line({{0, 0, 1}, {100, 0, 3}});
        const std::vector<Point3> samples = {{50, 0, 2}, {25, 0, 9}, {100, 0, 4}, {10, 0.2, 5}, {10, 3, 5}};
        const auto found = conflicts_of({base}, samples);
        REQUIRE(found.size() == 2);
        CHECK(found[0].kind == Kind::SampleOnLine);
        CHECK(found[0].sample + found[1].sample == 1 + 2);
        CHECK(std::max(found[0].z_b, found[1].z_b) == 9);
        LineCheckOptions options;
        options.line_tolerance = 0.25;
        const auto near = conflicts_of({base}, samples, options);
        REQUIRE(near.size() == 3);
        CHECK(near[2].kind == Kind::SampleNearLine);
        CHECK(near[2].sample == 3);
        CHECK(near[2].z_a == doctest::Approx(1.2));
    }

    TEST_CASE("rounding of elevations between points is no conflict") {
        const Breakline base = line({{0.1, 0.1, 100.1}, {3.1, 3.1, 103.7}});
        CHECK(conflicts_of({base}, {{1.1, 1.1, 101.3}, {2.1, 2.1, 102.5}}).empty());
    }

    TEST_CASE("two samples at one location clash when their z differ") {
        const LineConflict found = only(conflicts_of({}, {{1, 1, 5}, {2, 2, 0}, {1, 1, 5}, {1, 1, 6}}));
        CHECK(found.kind == Kind::ElevationClash);
        CHECK(found.other_sample == 0);
        CHECK(found.sample == 3);
        CHECK(found.z_a == 5);
        CHECK(found.z_b == 6);
    }

    TEST_CASE("z that is missing is listed once a run, unless it is to be draped") {
        const std::vector<Breakline> lines = {
            line({{0, 0, kDraped}, {5, 0, kDraped}, {9, 0, 1}, {12, 0, kDraped}})};
        const auto found = conflicts_of(lines);
        REQUIRE(found.size() == 2);
        CHECK(found[0].kind == Kind::MissingZ);
        LineCheckOptions options;
        options.traits = {{false, 0, true}};
        CHECK(conflicts_of(lines, {}, options).empty());
        SUBCASE("beyond the samples nothing can be draped") {
            CHECK(conflicts_of(lines, {{-1, -1, 0}, {20, -1, 0}, {20, 9, 0}, {-1, 9, 0}}, options).empty());
            const LineConflict outside =
                only(conflicts_of(lines, {{-1, -1, 0}, {10, -1, 0}, {10, 9, 0}, {-1, 9, 0}}, options));
            CHECK(outside.kind == Kind::OutsideSamples);
            CHECK(outside.location == Point2{12, 0});
        }
    }

    TEST_CASE("rings that are not closed are listed") {
        CHECK(only(conflicts_of({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}}, LineRole::Hole)})).kind ==
              Kind::OpenRing);
        LineCheckOptions options;
        options.traits = {ring(0)};
        CHECK(only(conflicts_of({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}})}, {}, options)).kind ==
              Kind::OpenRing);
        CHECK(conflicts_of({line({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}})}).empty());
    }

    TEST_CASE("what no boundary covers is outside, part by part") {
        const Breakline outer = box(0, 0, 100, 100, LineRole::Boundary, 1);
        const Breakline island = box(40, 40, 60, 60, LineRole::Boundary, 1);
        const auto outside = [&](const Breakline& made) {
            std::vector<LineConflict> found = conflicts_of({outer, island, made});
            std::erase_if(
                found, [](const LineConflict& conflict) { return conflict.kind != Kind::OutsideBoundary; });
            return found;
        };
        CHECK(outside(line({{10, 10, 0}, {30, 30, 0}})).empty());
        CHECK(outside(line({{0, 0, 0}, {100, 0, 0}})).empty());
        CHECK(outside(line({{0, 50, 0}, {40, 50, 0}})).empty());
        SUBCASE("two ends stick out") {
            const auto found = outside(line({{-5, 20, 1}, {110, 20, 2}}));
            REQUIRE(found.size() == 2);
            CHECK(std::abs(found[0].location.x - found[1].location.x) == 115);
        }
        SUBCASE("the middle of a piece stands for a part without a point outside") {
            const LineConflict found = only(outside(line({{40, 50, 0}, {60, 50, 0}})));
            CHECK(found.location == Point2{50, 50});
        }
        SUBCASE("a hole is looked at too") {
            CHECK(only(outside(box(90, 90, 120, 99, LineRole::Hole, 2))).line_a == 2);
        }
    }

    TEST_CASE("options out of range are refused") {
        LineCheckOptions options;
        options.snap = -1;
        CHECK(message_of<UsageError>([&] { static_cast<void>(conflicts_of({}, {}, options)); }) ==
              "the snapping distance must be a distance of at least 0");
    }

    TEST_CASE("the report depends neither on threads nor, but for numbers, on the order of lines") {
        Random random(7);
        for (const LineFamily& family : line_families()) {
            CAPTURE(family.name);
            const LineSet set = family.make(random, 60);
            const auto places = [](const LineCheckReport& report) {
                std::vector<std::array<double, 3>> list;
                for (const LineConflict& conflict : report.conflicts) {
                    list.push_back(
                        {static_cast<double>(conflict.kind), conflict.location.x, conflict.location.y});
                }
                std::sort(list.begin(), list.end());
                return list;
            };
            const LineCheckReport report = check_lines(set.lines, set.samples);
            LineCheckReport alone;
            {
                const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                alone = check_lines(set.lines, set.samples);
            }
            REQUIRE(alone.conflicts.size() == report.conflicts.size());
            CHECK(places(alone) == places(report));
            for (std::size_t i = 0; i < report.conflicts.size(); ++i) {
                CHECK(report.conflicts[i].line_a == alone.conflicts[i].line_a);
                CHECK(report.conflicts[i].line_b == alone.conflicts[i].line_b);
            }
        }
    }

    TEST_CASE("near misses and samples at lines are those that a slow search finds") {
        // Whole coordinates, so that squared distances are exact in double precision.
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto coordinate = [&] { return static_cast<double>(random.integer(0, 60)); };
            std::vector<Breakline> lines;
            std::vector<Point3> samples;
            for (int i = 0; i < 12; ++i) {
                lines.push_back(line({{coordinate(), coordinate(), 0}, {coordinate(), coordinate(), 0}}));
                if (lines.back().points[0] == lines.back().points[1]) {
                    lines.pop_back();
                }
            }
            for (int i = 0; i < 60; ++i) {
                samples.push_back({coordinate(), coordinate(), 1.0 + i});
            }
            constexpr double kDistance = 2;
            LineCheckOptions options;
            options.snap = kDistance;
            options.dangling = 0;
            options.line_tolerance = kDistance;
            // The squared distance of a point to a segment times the segment's squared length.
            const auto scaled = [](const Point3& p, const Breakline& made) {
                const double dx = made.points[1].x - made.points[0].x;
                const double dy = made.points[1].y - made.points[0].y;
                const double px = p.x - made.points[0].x;
                const double py = p.y - made.points[0].y;
                const double length = dx * dx + dy * dy;
                const double along = px * dx + py * dy;
                if (along <= 0) {
                    return std::array{(px * px + py * py) * length, length};
                }
                if (along >= length) {
                    const double qx = px - dx;
                    const double qy = py - dy;
                    return std::array{(qx * qx + qy * qy) * length, length};
                }
                return std::array{(dx * py - dy * px) * (dx * py - dy * px), length};
            };
            std::size_t on = 0;
            std::size_t near = 0;
            for (const Point3& sample : samples) {
                for (const Breakline& made : lines) {
                    const auto [distance, length] = scaled(sample, made);
                    on += distance == 0 ? 1 : 0;
                    near += distance > 0 && distance < kDistance * kDistance * length ? 1 : 0;
                }
            }
            std::vector<bool> has_miss(lines.size() * lines.size());
            for (std::size_t i = 0; i < lines.size(); ++i) {
                for (std::size_t j = 0; j < lines.size(); ++j) {
                    for (const Point3& end : lines[i].points) {
                        const auto [distance, length] = scaled(end, lines[j]);
                        if (i != j && distance > 0 && distance <= kDistance * kDistance * length) {
                            has_miss[std::min(i, j) * lines.size() + std::max(i, j)] = true;
                        }
                    }
                }
            }
            std::size_t found_on = 0;
            std::size_t found_near = 0;
            std::vector<bool> found_miss(has_miss.size());
            for (const LineConflict& conflict : conflicts_of(lines, samples, options)) {
                found_on += conflict.kind == Kind::SampleOnLine ? 1 : 0;
                found_near += conflict.kind == Kind::SampleNearLine ? 1 : 0;
                if (conflict.kind == Kind::NearMiss) {
                    found_miss[conflict.line_a * lines.size() + conflict.line_b] = true;
                }
            }
            CHECK(found_on == on);
            CHECK(found_near == near);
            CHECK(found_miss == has_miss);
        }
    }
}
