#include "tinwright/water/water.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"
#include "water/water_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;
using Kind = WaterFinding::Kind;

namespace {

std::vector<double> levels(const Breakline& line) {
    std::vector<double> z;
    for (const Point3& point : line.points) {
        z.push_back(point.z);
    }
    return z;
}

std::size_t count(const Water& water, Kind kind) {
    return count_findings(water.report.findings)[static_cast<std::size_t>(kind)];
}

const WaterFinding& first(const Water& water, Kind kind) {
    const auto found = std::find_if(water.report.findings.begin(), water.report.findings.end(),
                                    [kind](const WaterFinding& finding) { return finding.kind == kind; });
    REQUIRE(found != water.report.findings.end());
    return *found;
}

double slope_west(double x, double y) { return 100 - x / 10 + 0 * y; }

}  // namespace

TEST_SUITE("water/water") {
    TEST_CASE("a bump is levelled by what lies before and behind it, weighted by length") {
        const std::vector<Breakline> lines = {river({{0, 0, 10}, {10, 0, 8}, {20, 0, 9}, {40, 0, 6}})};
        const Water water = level_water({}, lines);
        // Half the lengths beside the points: 10 and 15 m.
        const double pooled = (10 * 8.0 + 15 * 9.0) / 25;
        REQUIRE(water.lines.size() == 1);
        const std::vector<double> z = levels(water.lines[0]);
        CHECK(z[0] == 10);
        CHECK(z[1] == doctest::Approx(pooled).epsilon(1e-12));
        CHECK(z[2] == z[1]);
        CHECK(z[3] == 6);
        REQUIRE(count(water, Kind::RunsUphill) == 1);
        const WaterFinding& rise = first(water, Kind::RunsUphill);
        CHECK(rise.amount == 1);
        CHECK(rise.location.x == 20);
        CHECK(rise.chainage == 20);
        CHECK(rise.length == 10);
        CHECK(rise.z == 9);
        CHECK(rise.other_z == 8);
        CHECK(water.report.reaches.size() == 1);
        CHECK(water.report.reaches[0].most_lifted == doctest::Approx(pooled - 8));
        CHECK(water.report.reaches[0].most_dug == doctest::Approx(9 - pooled));
    }

    TEST_CASE("under the fit min nothing is lifted") {
        const std::vector<Breakline> lines = {river({{0, 0, 10}, {10, 0, 8}, {20, 0, 9}, {40, 0, 6}})};
        WaterOptions options;
        options.river_fit = RiverFit::Min;
        CHECK(levels(level_water({}, lines, options).lines[0]) == std::vector<double>{10, 8, 8, 6});
    }

    TEST_CASE("a tributary ends at the trunk, at the lower of both, and is not below it") {
        const std::vector<Breakline> lines = {river({{0, 0, 10}, {50, 0, 7}, {100, 0, 4}}),
                                              river({{50, 60, 9}, {50, 30, 6}, {50, 0, 8}})};
        const Water water = level_water({}, lines);
        const double pooled = 6 + 65.0 / (65 + 30);  // half the lengths around: 65 and 30 m
        CHECK(levels(water.lines[0])[1] == doctest::Approx(pooled));
        CHECK(levels(water.lines[1])[1] == levels(water.lines[0])[1]);
        CHECK(levels(water.lines[1])[2] == levels(water.lines[0])[1]);
    }

    TEST_CASE("where lines cross between their points they share a level") {
        const std::vector<Breakline> lines = {river({{0, 0, 10}, {100, 0, 4}}),
                                              river({{50, 50, 9}, {50, -50, 3}})};
        const Water water = level_water({}, lines);
        REQUIRE(water.lines[0].points.size() == 3);
        REQUIRE(water.lines[1].points.size() == 3);
        CHECK(water.lines[0].points[1].z == 6);
        CHECK(water.lines[1].points[1].z == 6);
        CHECK(water.report.reaches.size() == 4);
    }

    TEST_CASE("a lake is level, and rivers fit in") {
        const std::vector<Breakline> lines = {rectangle(LineRole::Lake, 0, 40, -20, 60, 20, 5),
                                              river({{0, 0, 4}, {50, 0, 4.5}, {100, 0, 7}, {120, 0, 3}})};
        const Water water = level_water({}, lines);
        CHECK(water.report.lakes.size() == 1);
        CHECK(water.report.lakes[0].level == 5);
        CHECK(water.report.lakes[0].is_own);
        CHECK(water.report.lakes[0].shore_length == 120);
        for (const Point3& point : water.lines[0].points) {
            CHECK(point.z == 5);
        }
        // Above the lake, in it, below it.
        CHECK(levels(water.lines[1]) == std::vector<double>{5, 5, 5, 5, 5, 3});
        CHECK(count(water, Kind::RiverThroughLake) == 1);
        CHECK(first(water, Kind::RiverThroughLake).amount == doctest::Approx(0.6));
    }

    TEST_CASE("a lake that is not level says so and takes the percentile") {
        Breakline lake = rectangle(LineRole::Lake, 0, 0, 0, 10, 10, 5);
        lake.points[2].z = 5.4;
        WaterOptions options;
        options.lake_level = {LevelRule::Kind::Mean, 0};
        const Water water = level_water({}, std::vector<Breakline>{lake}, options);
        CHECK(water.report.lakes[0].level == doctest::Approx(5.08));
        CHECK(first(water, Kind::LakeNotLevel).amount == doctest::Approx(0.4));
        CHECK(level_water({}, std::vector<Breakline>{lake}).report.lakes[0].level == 5);
    }

    TEST_CASE("a lake without z is measured beside its shore, on both sides, and the low shore is told of") {
        const std::vector<Breakline> lines = {rectangle(LineRole::Lake, 0, 95, 95, 205, 205, kDraped)};
        const auto samples = lattice_samples(0, 0, 300, 300, 10, [](double x, double y) {
            const bool is_inside = x > 95 && x < 205 && y > 95 && y < 205;
            const bool is_deep = x > 120 && x < 180 && y > 120 && y < 180;
            return is_deep ? 1.0 : is_inside ? 20.0 : x < 20 ? 1.0 : x > 205 && y == 150 ? 18.5 : 30.0;
        });
        WaterOptions options;
        options.shore_width = 8;
        const Water water = level_water(samples, lines, options);
        const LakeLevel& lake = water.report.lakes[0];
        CHECK(lake.level == 20);
        CHECK_FALSE(lake.is_own);
        CHECK(lake.samples_inside == 121);
        CHECK(lake.samples_under == 1);
        const WaterFinding& low = first(water, Kind::ShoreUnderWater);
        CHECK(samples[low.sample].x == 210);
        CHECK(low.amount == 1.5);
        CHECK(water.lifted.empty());
        options.shore_clearance = 0.25;
        const Water lifted = level_water(samples, lines, options);
        REQUIRE(lifted.lifted.size() == 1);
        CHECK(lifted.lifted[0].second == 20.25);
        options.lake_level = {LevelRule::Kind::Min, 0};
        CHECK(level_water(samples, lines, options).report.lakes[0].level == 18.5);
    }

    TEST_CASE("lakes that touch must agree, or be told how to") {
        const std::vector<Breakline> lines = {rectangle(LineRole::Lake, 0, 0, 0, 10, 10, 5),
                                              rectangle(LineRole::Lake, 1, 10, 2, 20, 8, 6)};
        CHECK(message_of<BreaklineError>([&] { level_water({}, lines); }) ==
              "lakes that touch or overlap have different levels, 5 and 6, near (10, 2); give them one, or "
              "say which "
              "to take with --crossing-z mean|first|min|max");
        WaterOptions options;
        options.meeting_levels = CrossingPolicy::Max;
        const Water water = level_water({}, lines, options);
        CHECK(water.report.lakes[0].level == 6);
        CHECK(water.report.lakes[1].level == 6);
        CHECK(first(water, Kind::LakesMeet).amount == 1);
    }

    TEST_CASE("measured lakes come into the order of flow, given ones are reported") {
        const auto lake = [](std::uint32_t number, double x, double z) {
            return rectangle(LineRole::Lake, number, x, -10, x + 20, 10, z);
        };
        const auto terrain = [](double x, double) { return x < 50 ? 10.0 : 12.0; };
        const auto samples = lattice_samples(-30, -30, 130, 30, 5, terrain);
        std::vector<Breakline> lines = {lake(0, 0, kDraped), lake(1, 60, kDraped),
                                        river({{10, 0, 11}, {70, 0, 11}, {120, 0, 9}})};
        WaterOptions options;
        options.shore_width = 6;
        const Water measured = level_water(samples, lines, options);
        CHECK(count(measured, Kind::LakesOutOfOrder) == 1);
        CHECK(measured.report.lakes[0].level == 11);
        CHECK(measured.report.lakes[1].level == 11);
        lines[0] = lake(0, 0, 10);
        lines[1] = lake(1, 60, 12);
        const Water given = level_water(samples, lines, options);
        CHECK(first(given, Kind::LakesOutOfOrder).amount == 2);
        CHECK(given.report.lakes[0].level == 10);
        CHECK(given.report.lakes[1].level == 12);
    }

    TEST_CASE("limits are kept, and what would go beyond is reported") {
        const std::vector<Breakline> lines = {
            river({{0, 0, 10}, {10, 0, 8}, {20, 0, 8.4}, {30, 0, 7}, {40, 0, 5}, {50, 0, 8}, {60, 0, 4}})};
        WaterOptions options;
        options.max_drop = 0.5;
        options.max_lift = 0.5;
        const Water water = level_water({}, lines, options);
        const std::vector<double> z = levels(water.lines[0]);
        CHECK(z[1] == z[2]);
        for (std::size_t i = 0; i < z.size(); ++i) {
            CHECK(std::abs(z[i] - lines[0].points[i].z) <= 0.5 + 1e-12);
        }
        CHECK(count(water, Kind::BeyondLimit) == 1);
        CHECK(level_water({}, lines).lines[0].points[4].z == level_water({}, lines).lines[0].points[5].z);
    }

    TEST_CASE("a braid is known, and both arms fall") {
        const std::vector<Breakline> lines = {
            river({{0, 0, 10}, {20, 0, 8}}), river({{20, 0, 8}, {40, 20, 9}, {60, 0, 5}}),
            river({{20, 0, 8}, {40, -20, 6}, {60, 0, 5}}), river({{60, 0, 5}, {90, 0, 4}})};
        const Water water = level_water({}, lines);
        CHECK(count(water, Kind::Braid) == 1);
        CHECK(count(water, Kind::Loop) == 0);
        CHECK_FALSE(is_fault(first(water, Kind::Braid)));
        for (const Breakline& line : water.lines) {
            const std::vector<double> z = levels(line);
            CHECK(std::is_sorted(z.rbegin(), z.rend()));
        }
    }

    TEST_CASE("water in a circle becomes level") {
        const std::vector<Breakline> lines = {river({{0, 0, 5}, {10, 0, 4}, {10, 10, 3}, {0, 0, 5}}),
                                              river({{-20, 0, 8}, {0, 0, 5}})};
        const Water water = level_water({}, lines);
        CHECK(count(water, Kind::Loop) == 1);
        const std::vector<double> z = levels(water.lines[0]);
        CHECK(std::count(z.begin(), z.end(), z[0]) == 4);
    }

    TEST_CASE("a river drawn uphill is named, and turned where the flow is to be found") {
        const std::vector<Breakline> lines = {river({{0, 0, 1}, {10, 0, 2}, {20, 0, 3}})};
        const Water water = level_water({}, lines);
        CHECK(first(water, Kind::WrongDirection).amount == 2);
        CHECK(count(water, Kind::RunsUphill) == 0);
        CHECK(levels(water.lines[0]) == std::vector<double>{2, 2, 2});
        WaterOptions options;
        options.flow = FlowRule::Auto;
        const Water turned = level_water({}, lines, options);
        CHECK(levels(turned.lines[0]) == std::vector<double>{1, 2, 3});
        CHECK(turned.report.rivers_turned == 1);
        CHECK(turned.report.reaches[0].is_reversed);
        CHECK(turned.report.reaches[0].points.front().x == 20);
    }

    TEST_CASE("rivers without z take the lowest sample near them, and run downhill over an embankment") {
        const auto samples = lattice_samples(0, 0, 200, 100, 10, [](double x, double y) {
            const double valley = 50 - x / 10 + std::abs(y - 50) / 5;
            return x == 100 ? valley + 8 : valley;
        });
        Breakline line = river({{5, 50, kDraped}, {195, 50, kDraped}});
        WaterOptions options;
        options.river_width = 3;
        options.station_spacing = 5;
        options.river_fit = RiverFit::Min;
        const Water water = level_water(samples, std::vector<Breakline>{line}, options);
        CHECK(water.lines[0].points.size() == 39);
        const std::vector<double> z = levels(water.lines[0]);
        CHECK(std::is_sorted(z.rbegin(), z.rend()));
        CHECK(count(water, Kind::RunsUphill) == 1);
        CHECK(first(water, Kind::RunsUphill).location.x == 100);
        CHECK(water.report.reaches[0].most_dug == 7);
        CHECK(water.report.reaches[0].most_lifted == 0);
    }

    TEST_CASE("burning lowers what the fit gives, and does not go with levelling") {
        const std::vector<Breakline> lines = {river({{0, 0, 10}, {10, 0, 8}})};
        WaterOptions options;
        options.burn = 1.5;
        CHECK(levels(level_water({}, lines, options).lines[0]) == std::vector<double>{8.5, 6.5});
        CHECK(message_of<UsageError>([&] {
                  level_water({}, std::vector<Breakline>{rectangle(LineRole::Lake, 0, 0, 0, 1, 1, 2)},
                              options);
              }) == "burning rivers in and levelling lakes or banks are kept apart: do one of them");
    }

    TEST_CASE("a river that ends inside the terrain dangles") {
        const auto samples = lattice_samples(0, 0, 200, 200, 10, slope_west);
        const std::vector<Breakline> lines = {river({{5, 50, 99}, {100, 50, 89}}),
                                              river({{5, 90, 99}, {198, 90, 79}})};
        const Water water = level_water(samples, lines);
        REQUIRE(count(water, Kind::DanglingReach) == 1);
        CHECK(first(water, Kind::DanglingReach).location.x == 100);
        CHECK(first(water, Kind::DanglingReach).line == 0);
    }

    TEST_CASE("water without elevation and without samples is refused") {
        CHECK(message_of<InputError>([] {
                  level_water({}, std::vector<Breakline>{river({{0, 0, kDraped}, {9, 0, kDraped}})});
              }).find("water without z cannot be measured") == 0);
    }

    TEST_CASE("lines that are no water come back as they were") {
        Breakline line;
        line.points = {{0, 0, 1}, {5, 5, 2}};
        const Water water = level_water({}, std::vector<Breakline>{line});
        CHECK(water.lines.size() == 1);
        CHECK(levels(water.lines[0]) == std::vector<double>{1, 2});
        CHECK(water.report.findings.empty());
    }

    TEST_CASE("banks of different heights give level sections that fall downstream") {
        std::vector<Point3> points;
        for (int x = 0; x <= 100; x += 10) {
            points.push_back({static_cast<double>(x), 0, 50 - x / 20.0});
        }
        for (int x = 100; x >= 0; x -= 10) {
            points.push_back({static_cast<double>(x), 20, 51 - x / 20.0 + (x == 50 ? 3 : 0)});
        }
        const std::vector<Breakline> lines = {ring(LineRole::Bank, 0, points)};
        const Water water = level_water({}, lines);
        REQUIRE(water.report.banks.size() == 1);
        CHECK(water.report.banks[0].sections >= 8);
        CHECK(water.report.banks[0].mean_width == doctest::Approx(20).epsilon(0.2));
        CHECK(count(water, Kind::BanksNotLevel) >= 8);
        REQUIRE(water.lines.size() == 1 + water.report.banks[0].sections);
        for (std::size_t i = 1; i < water.lines.size(); ++i) {
            const Breakline& section = water.lines[i];
            CHECK(section.role == LineRole::Section);
            CHECK(water.origin[i] == 0);
            REQUIRE(section.points.size() == 2);
            CHECK(section.points[0].z == section.points[1].z);
        }
        REQUIRE(water.report.reaches.size() == 1);
        CHECK(water.report.reaches[0].is_between_banks);
        const std::vector<Point3>& middle = water.report.reaches[0].points;
        CHECK(std::is_sorted(middle.rbegin(), middle.rend(),
                             [](const Point3& a, const Point3& b) { return a.z < b.z; }));
        CHECK(middle.front().x < middle.back().x);
    }

    TEST_CASE("rivers that end between banks are no outlets unless they come along the water") {
        const auto samples = lattice_samples(-20, 0, 120, 100, 5, slope_west);
        const Breakline banks = rectangle(LineRole::Bank, 0, 0, 40, 100, 50, kDraped);
        const Breakline tributary = river({{30, 90, kDraped}, {30, 45, kDraped}});
        const Breakline middle = river({{0, 45, kDraped}, {100, 45, kDraped}});
        const Breakline other_banks = rectangle(LineRole::Bank, 1, 30, 52, 35, 53, kDraped);
        for (const std::vector<Breakline>& lines :
             {std::vector{banks, tributary}, {banks, tributary, middle}, {banks, other_banks, middle}}) {
            const Water water = level_water(samples, lines);
            CHECK(water.report.banks[0].z_up > 99.3);
            CHECK(water.report.banks[0].z_down < 90.7);
        }
    }

    TEST_CASE("water between banks runs the way that a river from bank to bank was drawn") {
        const auto samples = lattice_samples(-20, 0, 120, 100, 5, slope_west);
        const Breakline banks = rectangle(LineRole::Bank, 0, 0, 40, 100, 50, kDraped);
        // In two parts, the second one short.
        const Water water =
            level_water(samples, std::vector{banks, river({{100, 45, kDraped}, {3, 45, kDraped}}),
                                             river({{3, 45, kDraped}, {0, 45, kDraped}})});
        REQUIRE(water.report.reaches.size() == 1);
        CHECK(water.report.reaches[0].points.front().x > water.report.reaches[0].points.back().x);
        const std::vector<double> z = levels(water.lines[1]);
        CHECK(std::is_sorted(z.rbegin(), z.rend()));
    }

    TEST_CASE("two lakes keep their levels when banks tie them together at a weir") {
        const auto samples = lattice_samples(0, 0, 100, 100, 5, slope_west);
        for (const double top : {52.0, 60.0}) {
            const Water water =
                level_water(samples, std::vector{rectangle(LineRole::Lake, 0, 10, 40, 40, 60, 15),
                                                 rectangle(LineRole::Lake, 1, 44, 40, 70, 60, 20),
                                                 rectangle(LineRole::Bank, 2, 40, 48, 44, top, kDraped)});
            for (const double z : levels(water.lines[0])) {
                CHECK(z == 15);
            }
            for (const double z : levels(water.lines[1])) {
                CHECK(z == 20);
            }
            for (std::size_t i = 3; i < water.lines.size(); ++i) {
                CHECK(water.lines[i].points[0].z == water.lines[i].points[1].z);
            }
            CHECK((count(water, Kind::BanksNotLevel) > 0) == (top == 60));
        }
    }

    TEST_CASE("lakes above a long river are found in order, each with the next lakes below") {
        // Lakes 0 and 1 drain to a braid that ends in lake 2, from which water runs to lake 3.
        const auto samples = lattice_samples(0, 0, 100, 100, 5, slope_west);
        const std::vector<Breakline> lines = {rectangle(LineRole::Lake, 0, 5, 10, 10, 20, 50),
                                              rectangle(LineRole::Lake, 1, 5, 60, 10, 70, 40),
                                              rectangle(LineRole::Lake, 2, 60, 30, 70, 50, 45),
                                              rectangle(LineRole::Lake, 3, 80, 30, 90, 50, 46),
                                              river({{10, 15, 50}, {20, 40, 49}, {40, 40, 48}, {60, 40, 47}}),
                                              river({{10, 65, 50}, {20, 40, 49}, {40, 45, 48}, {60, 40, 47}}),
                                              river({{70, 40, 45}, {80, 40, 45}})};
        const Water water = level_water(samples, lines);
        REQUIRE(count(water, Kind::LakesOutOfOrder) == 2);
        const WaterFinding& above = first(water, Kind::LakesOutOfOrder);
        CHECK(above.line == 1);
        CHECK(above.other_line == 2);
        CHECK(above.amount == 5);
    }

    TEST_CASE("a ring of banks without an area is refused") {
        const Breakline spike = ring(LineRole::Bank, 0, {{20, 5, 1}, {22, 5, 1}});
        for (const std::vector<Breakline>& lines :
             {std::vector{rectangle(LineRole::Bank, 0, 0, 0, 50, 10, 1), spike}, {spike}}) {
            const std::string message = message_of<BreaklineError>([&] { level_water({}, lines); });
            CHECK(message == "a ring of banks has no area, at (20, 5); remove it");
        }
    }

    TEST_CASE("banks that rise along the water are told of, and fall afterwards") {
        std::vector<Point3> points;
        for (int x = 0; x <= 100; x += 10) {
            points.push_back({static_cast<double>(x), 0, 50 - x / 20.0 + (x == 50 ? 2 : 0)});
        }
        for (int x = 100; x >= 0; x -= 10) {
            points.push_back({static_cast<double>(x), 20, 50 - x / 20.0 + (x == 50 ? 2 : 0)});
        }
        const Water water = level_water({}, std::vector<Breakline>{ring(LineRole::Bank, 0, points)});
        REQUIRE(count(water, Kind::RunsUphill) == 1);
        CHECK(first(water, Kind::RunsUphill).amount == doctest::Approx(1.5));
        CHECK(first(water, Kind::RunsUphill).location.x == 50);
        const std::vector<Point3>& middle = water.report.reaches[0].points;
        CHECK(std::is_sorted(middle.rbegin(), middle.rend(),
                             [](const Point3& a, const Point3& b) { return a.z < b.z; }));
    }

    TEST_CASE("a canal that leaves a river in its middle does not turn the river below it around") {
        std::vector<Point3> points;
        for (int x = 0; x <= 100; x += 10) {
            points.push_back({static_cast<double>(x), 0, 50 - x / 20.0});
        }
        for (int x = 100; x >= 0; x -= 10) {
            points.push_back({static_cast<double>(x), 20, 50 - x / 20.0});
        }
        const std::vector<Breakline> lines = {ring(LineRole::Bank, 0, points),
                                              river({{50, 20, 47.5}, {50, 60, 46}})};
        const Water water = level_water({}, lines);
        CHECK(count(water, Kind::RunsUphill) == 0);
        CHECK(water.report.banks[0].z_up == 49.5);
        CHECK(water.report.banks[0].z_down == 45.5);
    }

    TEST_CASE("banks with an island that touches them are refused") {
        const std::vector<Breakline> lines = {rectangle(LineRole::Bank, 0, 0, 0, 100, 20, 7),
                                              ring(LineRole::Bank, 0, {{40, 0, 7}, {45, 5, 7}, {45, 8, 7}})};
        CHECK(
            message_of<BreaklineError>([&] { level_water({}, lines); }) ==
            "banks touch or cross themselves at (40, 0); move the rings apart there, or make an island that "
            "touches part of the bank");
    }

    TEST_CASE("a lake inside banks is refused, unless it is said what counts") {
        const std::vector<Breakline> lines = {rectangle(LineRole::Bank, 0, 0, 0, 100, 20, 7),
                                              rectangle(LineRole::Lake, 1, 40, 5, 60, 15, 5)};
        CHECK(
            message_of<BreaklineError>([&] { level_water({}, lines); }) ==
            "banks overlap a lake or other banks at (40, 5), where the water cannot have both their levels; "
            "cut one off at the other's shore, or say which elevation to take with --crossing-z "
            "mean|first|min|max");
        WaterOptions options;
        options.keeps_faults = true;
        CHECK(count(level_water({}, lines, options), Kind::WaterOverlaps) == 1);
    }
}
