// Rivers in rasters that do not lie in the plane of the TIN.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/water/river_cells.hpp"
#include "tinwright/water/water.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "water/rasters.hpp"
#include "water/river_sets.hpp"
#include "water/water_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// A raster whose system is the plane turned a quarter, twice as large and elsewhere: (x, y) is at
/// (-2 y + 1024, 2 x). No number is rounded.
RasterPlacing turned(const GridGeometry& grid) {
    RasterPlacing placing;
    placing.to_raster = [](std::span<Point2> positions) {
        for (Point2& position : positions) {
            position = {1024 - 2 * position.y, 2 * position.x};
        }
    };
    placing.find_places = [grid](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
        for (CellPlace& place : places) {
            const Point2 at = grid.centre(first++, row);
            place = {{at.y / 2, (1024 - at.x) / 2}, {1, 0}};
        }
    };
    return placing;
}

/// One river without crossings in quarters of a unit, on a terrain with a lake at its end.
struct RiverAndLake {
    Tin tin;
    std::vector<bool> is_river_line{true, false};
    std::vector<bool> is_water_face;
};

RiverAndLake river_and_lake() {
    std::vector<Breakline> lines(2);
    lines[0] = {{{1.25, 14.5, 9}, {3.75, 12.25, 8}, {9.5, 13.75, 7}, {12.25, 6.5, 6}, {4.25, 4.25, 5}},
                LineRole::River};
    lines[1] = {{{2, 1, 5}, {8, 1, 5}, {8, 5, 5}, {2, 5, 5}, {2, 1, 5}}, LineRole::Lake};
    const std::vector<Point3> samples = {{0, 0, 20}, {16, 0, 20}, {16, 16, 20}, {0, 16, 20}};
    RiverAndLake made;
    made.tin = triangulate(samples, lines).tin;
    made.is_water_face = find_water_faces(made.tin, lines);
    return made;
}

}  // namespace

TEST_SUITE("water/river_cells") {
    TEST_CASE("a raster that is turned has the turned cells, cells on water left out") {
        const RiverAndLake scene = river_and_lake();
        const GridGeometry plane{0, 16, 0.5, 0.5, 32, 32};
        const auto expected = find_river_cells(scene.tin, scene.is_river_line, scene.is_water_face, plane);
        REQUIRE(expected.size() > 20);
        // (0..16, 0..16) is at (992..1024, 0..32).
        const GridGeometry grid{992, 32, 1, 1, 32, 32};
        const auto cells =
            find_river_cells(scene.tin, scene.is_river_line, scene.is_water_face, grid, turned(grid));
        REQUIRE(cells.size() == expected.size());
        for (const CellElevation& cell : cells) {
            const std::int64_t column = 31 - cell.cell / 32;
            const std::int64_t row = cell.cell % 32;
            const auto found =
                std::find_if(expected.begin(), expected.end(),
                             [&](const CellElevation& other) { return other.cell == row * 32 + column; });
            REQUIRE(found != expected.end());
            REQUIRE(found->z == doctest::Approx(cell.z).epsilon(1e-12));
        }
    }

    TEST_CASE("edges to vertices that have no place in the raster's system are left out") {
        const RiverAndLake scene = river_and_lake();
        const GridGeometry grid{0, 16, 0.5, 0.5, 32, 32};
        RasterPlacing placing;
        placing.to_raster = [](std::span<Point2> positions) {
            for (Point2& position : positions) {
                if (position.x > 12) {
                    position = {std::numeric_limits<double>::quiet_NaN(), 0};
                }
            }
        };
        const auto all = find_river_cells(scene.tin, scene.is_river_line, {}, grid);
        const auto some = find_river_cells(scene.tin, scene.is_river_line, {}, grid, placing);
        CHECK(!some.empty());
        CHECK(some.size() < all.size());
        for (const CellElevation& cell : some) {
            REQUIRE((cell.z >= 7 || cell.cell / 32 > 22));
        }
    }

    TEST_CASE("where x is periodic, rivers go the short way, wherever the raster begins") {
        const RiverAndLake scene = river_and_lake();
        const GridGeometry plane{0, 16, 0.5, 0.5, 32, 32};
        const auto expected = find_river_cells(scene.tin, scene.is_river_line, {}, plane);
        for (const double west : {-188.0, -180.0, -172.0, 172.0, 175.5, 352.0}) {
            CAPTURE(west);
            const GridGeometry grid{west, 16, 0.5, 0.5, 32, 32};
            RasterPlacing placing;
            placing.period = 360;
            placing.to_raster = [west](std::span<Point2> positions) {
                for (Point2& position : positions) {
                    position.x += west;
                    position.x -= 360 * std::floor((position.x + 180) / 360);
                }
            };
            const auto cells = find_river_cells(scene.tin, scene.is_river_line, {}, grid, placing);
            REQUIRE(cells.size() == expected.size());
            for (std::size_t i = 0; i < cells.size(); ++i) {
                REQUIRE(cells[i].cell == expected[i].cell);
                REQUIRE(cells[i].z == doctest::Approx(expected[i].z).epsilon(1e-12));
            }
        }
        // All around: the river crosses the raster's own edge.
        const GridGeometry around{-180, 16, 0.5, 0.5, 720, 32};
        RasterPlacing placing;
        placing.period = 360;
        placing.to_raster = [](std::span<Point2> positions) {
            for (Point2& position : positions) {
                position.x += position.x < 8 ? 172 : -188;
            }
        };
        const auto cells = find_river_cells(scene.tin, scene.is_river_line, {}, around, placing);
        REQUIRE(cells.size() == expected.size());
        for (const CellElevation& cell : cells) {
            const std::int64_t column = (cell.cell % 720 + 16) % 720;
            const auto found = std::find_if(
                expected.begin(), expected.end(),
                [&](const CellElevation& other) { return other.cell == cell.cell / 720 * 32 + column; });
            REQUIRE(found != expected.end());
            REQUIRE(found->z == doctest::Approx(cell.z).epsilon(1e-12));
        }
    }

    TEST_CASE("rasters of levelled water in another system pass the check without tolerance") {
        std::size_t rivers = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(30)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            std::vector<Point3> samples;
            for (int i = 0; i < 250; ++i) {
                const double x = 0.25 * static_cast<double>(random.integer(-100, 220));
                const double y = 0.25 * static_cast<double>(random.integer(-100, 220));
                samples.push_back({x, y, 60 - 0.1 * x + 4 * std::sin(x / 7) + 3 * random.real()});
            }
            const std::vector<Breakline> lines = wandering_rivers(random, 0.25);
            WaterOptions water_options;
            water_options.keeps_faults = true;
            water_options.meeting_levels = CrossingPolicy::Min;
            Water water = level_water(samples, lines, water_options);
            for (const auto& [sample, z] : water.lifted) {
                samples[sample].z = z;
            }
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            const Tin tin = triangulate(samples, water.lines, options).tin;
            std::vector<bool> is_river;
            for (const Breakline& line : water.lines) {
                is_river.push_back(line.role == LineRole::River);
            }
            // Askew, of another scale, and bent as much as meridians are over a few kilometres.
            const auto to_raster = [](Point2 p) {
                return Point2{3 + 0.008 * p.x - 0.006 * p.y + 1e-9 * p.x * p.y,
                              50 + 0.003 * p.x + 0.004 * p.y - 1e-9 * p.x * p.x};
            };
            RasterPlacing placing;
            placing.to_raster = [&](std::span<Point2> positions) {
                for (Point2& position : positions) {
                    position = to_raster(position);
                }
            };
            const double size = 0.001 * std::pow(10.0, 2 * random.real());
            const GridGeometry grid{2.7,
                                    50.4,
                                    size,
                                    size,
                                    static_cast<std::int64_t>(0.7 / size) + 1,
                                    static_cast<std::int64_t>(0.5 / size) + 1};
            placing.find_places = [&](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
                for (CellPlace& place : places) {
                    const Point2 to = grid.centre(first++, row);
                    Point2 at{};
                    for (int i = 0; i < 20; ++i) {  // Newton's, but for the bend
                        const Point2 is = to_raster(at);
                        const Point2 d{to.x - is.x, to.y - is.y};
                        at.x += (0.004 * d.x + 0.006 * d.y) / 5e-5;
                        at.y += (0.008 * d.y - 0.003 * d.x) / 5e-5;
                    }
                    place = {at, {0, 1}};
                }
            };
            const auto cells = find_river_cells(tin, is_river, {}, grid, placing);
            std::vector<Breakline> lines_there = lines;
            const auto move = [&](std::vector<Point3>& points) {
                for (Point3& point : points) {
                    const Point2 there = to_raster({point.x, point.y});
                    point = {there.x, there.y, point.z};
                }
            };
            for (std::size_t i = 0; i < lines.size(); ++i) {
                move(lines_there[i].points);
            }
            for (Breakline& line : water.lines) {
                move(line.points);
            }
            for (Reach& reach : water.report.reaches) {
                move(reach.points);
            }
            for (const bool is_float : {false, true}) {
                const Raster raster = grid_of(tin, nullptr, grid, cells, is_float, placing.find_places);
                const RasterCheckReport report = raster.check(lines_there, water);
                REQUIRE(report.findings.empty());
                REQUIRE(report.highest_rise == 0);
                rivers += report.rivers;
            }
        }
        CHECK(rivers > 0);
    }
}
