#include "tinwright/water/raster_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/surface/facets.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/interpolation.hpp"
#include "tinwright/water/river_cells.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"
#include "water/rasters.hpp"
#include "water/river_sets.hpp"
#include "water/water_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;
using Kind = WaterFinding::Kind;

namespace {

/// Values of z(column, row), in cells of one unit from (0, rows) on.
template <class Z>
Raster raster_of(std::int64_t columns, std::int64_t rows, const Z& z) {
    Raster raster{{0, static_cast<double>(rows), 1, 1, columns, rows}, {}};
    for (std::int64_t row = 0; row < rows; ++row) {
        for (std::int64_t column = 0; column < columns; ++column) {
            raster.values.push_back(z(column, row));
        }
    }
    return raster;
}

/// Lines that are as they should be: each river one reach.
Water water_of(const std::vector<Breakline>& lines) {
    Water water;
    water.lines = lines;
    water.origin.resize(lines.size());
    std::iota(water.origin.begin(), water.origin.end(), 0U);
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
        if (lines[line].role == LineRole::River) {
            Reach reach;
            reach.line = line;
            reach.points = lines[line].points;
            water.report.reaches.push_back(reach);
        }
    }
    return water;
}

/// One row of cells, and a river through their middles from x = 0.5 on.
RasterCheckReport check_row(const std::vector<double>& values, double tolerance = 0,
                            bool is_reversed = false) {
    const auto columns = static_cast<std::int64_t>(values.size());
    std::vector<Breakline> lines = {river({{0.5, 0.5, 9}, {static_cast<double>(columns) - 0.5, 0.5, 1}})};
    Water water = water_of(lines);
    if (is_reversed) {
        std::reverse(lines[0].points.begin(), lines[0].points.end());
        water.lines = lines;
        water.report.reaches[0].is_reversed = true;
    }
    const Raster raster = raster_of(columns, 1, [&](std::int64_t column, std::int64_t) {
        return values[static_cast<std::size_t>(column)];
    });
    return raster.check(lines, water, tolerance);
}

/// Ways downstream over the rivers' edges, each vertex once, as reaches.
std::vector<Reach> random_ways(Random& random, const Rivers& rivers) {
    const auto falls = falls_of(rivers);
    std::vector<Reach> ways;
    for (int i = 0; i < 20 && !falls.empty(); ++i) {
        std::vector<VertexId> way = {
            falls[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(falls.size()) - 1))]
                .first};
        for (;;) {
            std::vector<VertexId> next;
            for (const auto& [from, to] : falls) {
                if (from == way.back() && std::find(way.begin(), way.end(), to) == way.end()) {
                    next.push_back(to);
                }
            }
            if (next.empty()) {
                break;
            }
            way.push_back(next[static_cast<std::size_t>(
                random.integer(0, static_cast<std::int64_t>(next.size()) - 1))]);
        }
        Reach reach;
        for (const VertexId v : way) {
            reach.points.push_back(rivers.tin.position(v));
        }
        ways.push_back(reach);
    }
    return ways;
}

}  // namespace

TEST_SUITE("water/raster_check") {
    TEST_CASE("along a river that falls nothing is found, and level cells are no rise") {
        const RasterCheckReport report = check_row({9, 8, 8, 8, 7.5, 7.5, 1, -3});
        CHECK(report.findings.empty());
        CHECK(report.rivers == 1);
        CHECK(report.river_cells == 8);
        CHECK(report.highest_rise == 0);
        CHECK(report.empty_cells == 0);
    }

    TEST_CASE("a rise is one finding, from where it leaves the lowest to where it comes back") {
        for (const bool is_reversed : {false, true}) {
            CAPTURE(is_reversed);
            const RasterCheckReport report =
                check_row({10, 9, 8, 8.5, 8.75, 8.25, 8, 6, 6, 7}, 0, is_reversed);
            REQUIRE(report.findings.size() == 2);
            const WaterFinding& rise = report.findings[is_reversed ? 1 : 0];
            CHECK(rise.kind == Kind::RasterRises);
            CHECK(rise.line == 0);
            CHECK(rise.z == 8.75);
            CHECK(rise.other_z == 8);
            CHECK(rise.amount == 0.75);
            CHECK(rise.length == doctest::Approx(3));
            CHECK(rise.location.x == doctest::Approx(6));
            CHECK(rise.location.y == 0.5);
            CHECK(rise.chainage == doctest::Approx(is_reversed ? 3.5 : 5.5));
            // The other one is open: it lasts as long as the reach.
            const WaterFinding& end = report.findings[is_reversed ? 0 : 1];
            CHECK(end.amount == 1);
            CHECK(end.length == doctest::Approx(0.5));
            CHECK(end.location.x == doctest::Approx(9.5));
            CHECK(end.chainage == doctest::Approx(is_reversed ? 0 : 9));
            CHECK(report.highest_rise == 1);
        }
    }

    TEST_CASE("what rises by no more than the tolerance does not count, step by step or at once") {
        CHECK(check_row({5, 5.25, 5.5}, 0.5).findings.empty());
        CHECK(check_row({5, 5.25, 5.5}, 0.5).highest_rise == 0.5);
        CHECK(check_row({5, 5.25, 5.5}, 0.25).findings.size() == 1);
        CHECK(check_row({5, 5.25, 5.5}, 0.25).findings[0].amount == 0.5);
        CHECK(message_of<UsageError>([] {
                  check_row({1, 2}, -1);
              }) == "the tolerance of the raster must be zero or more");
    }

    TEST_CASE("cells without a value are passed over and counted") {
        const RasterCheckReport report = check_row({9, kNone, 8, kNone, kNone, 8.5});
        REQUIRE(report.findings.size() == 1);
        CHECK(report.findings[0].amount == 0.5);
        CHECK(report.empty_cells == 3);
        CHECK(report.river_cells == 3);
        CHECK(check_row({kNone, kNone}).rivers == 0);
    }

    TEST_CASE("what is passed for less than a hundredth of a cell is passed over") {
        const Raster raster = raster_of(4, 4, [](std::int64_t column, std::int64_t row) {
            return column == row ? 10.0 - static_cast<double>(column) : 50.0;
        });
        // Down the diagonal: through corners, or beside them by a little.
        for (const double shift : {0.0, 1e-12, -1e-9, 0.006, -0.006}) {
            CAPTURE(shift);
            const std::vector<Breakline> lines = {river({{0.2 + shift, 3.8, 10}, {3.8 + shift, 0.2, 1}})};
            CHECK(raster.check(lines, water_of(lines)).findings.empty());
        }
        const std::vector<Breakline> lines = {river({{0.22, 3.8, 10}, {3.82, 0.2, 1}})};
        CHECK(raster.check(lines, water_of(lines)).findings.size() == 3);
    }

    TEST_CASE("rivers may leave the raster, and pieces of a line within a cell are one passage") {
        const Raster raster = raster_of(
            6, 2, [](std::int64_t column, std::int64_t) { return 6.0 - static_cast<double>(column); });
        Breakline line = river({{-5, 7, 9}, {0.5, 1.5, 8}});
        for (int i = 0; i <= 200; ++i) {
            line.points.push_back({0.505 + 0.02 * i, 1.5, 8});
        }
        line.points.push_back({4.6, -9, 1});
        line.points.push_back({5.5, -9, 1});
        line.points.push_back({5.5, 0.5, 1});
        const std::vector<Breakline> lines = {line};
        const RasterCheckReport report = raster.check(lines, water_of(lines));
        CHECK(report.findings.empty());
        CHECK(report.river_cells == 7);
    }

    TEST_CASE("cells of a lake are equal, but for those of its islands and on its shore") {
        const auto z = [](std::int64_t column, std::int64_t row) {
            const bool is_island = column >= 4 && column <= 5 && row >= 4 && row <= 5;
            const bool is_lake = column >= 1 && column <= 8 && row >= 1 && row <= 8;
            return is_island ? 9.0 : is_lake ? 5.0 : 7.0;
        };
        Raster raster = raster_of(10, 10, z);
        const std::vector<Breakline> lines = {rectangle(LineRole::Lake, 7, 1, 1, 9, 9, 5),
                                              rectangle(LineRole::Lake, 7, 4, 4, 6, 6, 5),
                                              rectangle(LineRole::Bank, 7, 0, 0, 1, 10, 5)};
        RasterCheckReport report = raster.check(lines, water_of(lines));
        CHECK(report.findings.empty());
        CHECK(report.lakes == 1);
        CHECK(report.lake_cells == 60);
        raster.values[2 * 10 + 3] = kNone;
        raster.values[2 * 10 + 4] = 5.25;
        raster.values[7 * 10 + 1] = 4.5;
        report = raster.check(lines, water_of(lines));
        CHECK(report.lake_cells == 59);
        CHECK(report.empty_cells == 1);
        REQUIRE(report.findings.size() == 1);
        CHECK(report.findings[0].kind == Kind::RasterLakeUneven);
        CHECK(report.findings[0].line == 0);
        CHECK(report.findings[0].z == 5.25);
        CHECK(report.findings[0].other_z == 4.5);
        CHECK(report.findings[0].amount == 0.75);
        CHECK(report.findings[0].location == Point2{4.5, 7.5});
        CHECK(raster.check(lines, water_of(lines), 0.75).findings.empty());
        CHECK(raster.check(lines, water_of(lines), 0.75).widest_range == 0.75);
        // A shore through centres: those on it are passed over.
        const std::vector<Breakline> wide = {rectangle(LineRole::Lake, 7, 0.5, 0.5, 9.5, 9.5, 5),
                                             rectangle(LineRole::Lake, 7, 3.5, 3.5, 6.5, 6.5, 5)};
        const Raster other = raster_of(10, 10, z);
        CHECK(other.check(wide, water_of(wide)).findings.empty());
        CHECK(other.check(wide, water_of(wide)).lake_cells == 48);
        // Off the raster, or smaller than a cell.
        const std::vector<Breakline> far = {rectangle(LineRole::Lake, 1, -50, -50, -1, 60, 5),
                                            rectangle(LineRole::Lake, 2, 2.6, 2.6, 2.9, 2.9, 5)};
        CHECK(raster.check(far, water_of(far)).lakes == 0);
    }

    TEST_CASE("cells on water, and a river's way there, say nothing of the river") {
        // Cells rise over a lake from column 3 to 6 and fall again; the river beside it is the lower one.
        const std::vector<double> values = {9, 8, 7, 8.5, 8.5, 8.5, 6, 5};
        const Raster raster = raster_of(8, 1, [&](std::int64_t column, std::int64_t) {
            return values[static_cast<std::size_t>(column)];
        });
        for (const LineRole role : {LineRole::Lake, LineRole::Bank}) {
            const std::vector<Breakline> lines = {
                river({{0.5, 0.5, 9}, {3, 0.5, 7}, {6, 0.5, 7}, {7.5, 0.5, 5}}),
                rectangle(role, 0, 3, 0, 6, 1, 7)};
            const RasterCheckReport report = raster.check(lines, water_of(lines));
            CHECK(report.findings.empty());
            CHECK(report.river_cells == 5);
        }
        std::vector<Breakline> dry = {river({{0.5, 0.5, 9}, {3, 0.5, 7}, {6, 0.5, 7}, {7.5, 0.5, 5}})};
        CHECK(raster.check(dry, water_of(dry)).findings.size() == 1);
        Water between = water_of(dry);
        between.report.reaches[0].is_between_banks = true;
        CHECK(raster.check(dry, between).rivers == 0);
    }

    TEST_CASE(
        "rasters with rivers' elevations in their cells pass along every way downstream, without tolerance") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(150)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const Rivers rivers = make_rivers(random, 0.01 * static_cast<double>(random.integer(1, 100)));
            const double size = 0.02 * std::pow(10.0, 3 * random.real());
            const auto count = static_cast<std::int64_t>(std::min(150.0, 80 / size)) + 1;
            const GridGeometry grid{-0.1 * random.real(), 20 * random.real(), size, size * 0.7, count, count};
            const auto cells = find_river_cells(rivers.tin, rivers.is_river_line, {}, grid);
            const std::vector<Breakline> lines = {river({{0, 0, 0}, {1, 1, 1}})};
            Water water = water_of(lines);
            water.report.reaches = random_ways(random, rivers);
            for (const bool is_float : {false, true}) {
                const Raster raster = grid_of(rivers.tin, nullptr, grid, cells, is_float);
                const RasterCheckReport report = raster.check(lines, water);
                REQUIRE(report.findings.empty());
                REQUIRE(report.highest_rise == 0);
            }
        }
    }

    TEST_CASE("lakes are level in rasters of every method, without tolerance") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(4)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            std::vector<Point3> samples;
            for (int i = 0; i < 400; ++i) {
                samples.push_back({50 * random.real(), 50 * random.real(), 100 + 8 * random.real()});
            }
            std::vector<Breakline> lines;
            std::vector<Point3> shore;
            std::vector<Point3> island;
            const double level = 101 + random.real();
            for (int i = 0; i < 12; ++i) {
                const double turn = 2 * 3.14159 * i / 12;
                const double radius = 9 + 9 * random.real();
                shore.push_back({25 + radius * std::cos(turn), 25 + radius * std::sin(turn), level});
                if (i % 4 == 0) {
                    island.push_back({25 + 6 * std::cos(turn), 25 + 6 * std::sin(turn), level});
                }
            }
            lines.push_back(ring(LineRole::Lake, 3, shore));
            lines.push_back(ring(LineRole::Lake, 3, island));
            const Tin tin = triangulate(samples, lines).tin;
            const std::vector<bool> is_water = find_water_faces(tin, lines);
            const GridGeometry grid{0, 50, 0.5, 0.5, 100, 100};
            for (const auto& named : kInterpolationMethods) {
                const std::string_view name = named.first;
                CAPTURE(std::string(name));
                const auto surface = keep_facets(
                    tin, make_interpolator(tin, SharpEdges(tin, {}), {.method = named.second}), is_water);
                for (const bool is_float : {false, true}) {
                    const RasterCheckReport report =
                        grid_of(tin, surface.get(), grid, {}, is_float).check(lines, water_of(lines));
                    REQUIRE(report.findings.empty());
                    REQUIRE(report.lakes == 1);
                    REQUIRE(report.lake_cells > 500);
                    REQUIRE(report.widest_range == 0);
                }
            }
        }
    }
}
