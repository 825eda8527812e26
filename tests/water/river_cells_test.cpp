#include "tinwright/water/river_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/domain.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/gridding.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"
#include "water/river_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Cell = std::pair<std::int64_t, std::int64_t>;  // column, row

std::vector<CellPassage> passages_of(Point2 a, Point2 b, const GridGeometry& grid) {
    std::vector<CellPassage> passages;
    visit_cells(a, b, grid, [&](const CellPassage& passage) { passages.push_back(passage); });
    return passages;
}

/// The part of a segment that is in a closed cell, by clipping, in long double; empty if begin > end.
struct Part {
    long double begin = 0;
    long double end = 1;
};

void clip(Part& part, long double from, long double to, long double low, long double high) {
    if (from == to) {
        if (from < low || from > high) {
            part = {1, 0};
        }
        return;
    }
    const long double s = (low - from) / (to - from);
    const long double t = (high - from) / (to - from);
    part.begin = std::max(part.begin, std::min(s, t));
    part.end = std::min(part.end, std::max(s, t));
}

Part part_in(Point2 a, Point2 b, const GridGeometry& grid, std::int64_t column, std::int64_t row) {
    Part part;
    const long double x = grid.x_min + static_cast<long double>(column) * grid.cell_width;
    const long double y = grid.y_max - static_cast<long double>(row) * grid.cell_height;
    clip(part, a.x, b.x, x, x + grid.cell_width);
    clip(part, a.y, b.y, y - grid.cell_height, y);
    return part;
}

/// A segment between points of quarters of cells, so that edges and corners are met often and numbers are
/// exact; some far outside.
std::pair<Point2, Point2> quarter_segment(Random& random, const GridGeometry& grid) {
    const std::int64_t room = random.integer(0, 9) == 0 ? 4000 : 8;
    const auto point = [&] {
        return Point2{grid.x_min + grid.cell_width * 0.25 *
                                       static_cast<double>(random.integer(-room, 4 * grid.columns + room)),
                      grid.y_max - grid.cell_height * 0.25 *
                                       static_cast<double>(random.integer(-room, 4 * grid.rows + room))};
    };
    Point2 a = point();
    Point2 b = point();
    switch (random.integer(0, 5)) {
        case 0:
            b.x = a.x;
            break;
        case 1:
            b.y = a.y;
            break;
        case 2: {  // diagonal
            const double cells = 0.25 * static_cast<double>(random.integer(0, 40));
            b = {a.x + (random.integer(0, 1) == 0 ? cells : -cells) * grid.cell_width,
                 a.y + (random.integer(0, 1) == 0 ? cells : -cells) * grid.cell_height};
            break;
        }
        default:
            break;
    }
    return {a, b};
}

/// The cell that a point belongs to, right of edges and below.
Cell cell_of(Point2 p, const GridGeometry& grid) {
    return {static_cast<std::int64_t>(std::floor((p.x - grid.x_min) / grid.cell_width)),
            static_cast<std::int64_t>(std::floor((grid.y_max - p.y) / grid.cell_height))};
}

bool passes_by_a_hair(const Rivers& rivers, const GridGeometry& grid) {
    bool is_hair = false;
    for (const auto& [from, to] : falls_of(rivers)) {
        const Point3 a = rivers.tin.position(from);
        const Point3 b = rivers.tin.position(to);
        visit_cells({a.x, a.y}, {b.x, b.y}, grid, [&](const CellPassage& passage) {
            is_hair = is_hair || (passage.begin < passage.end && passage.end - passage.begin < 1e-9);
        });
    }
    return is_hair;
}

/// Follows every way downstream by brute force: for each cell passed for more than a point the lowest
/// elevation of the river there, then lowered until no fall has a higher cell after a lower one. The order of
/// cells along an edge comes from clipping the edge with all cells.
std::map<Cell, double> expected_cells(const Rivers& rivers, const GridGeometry& grid) {
    struct Way {
        VertexId from;
        VertexId to;
        std::vector<Cell> cells;
    };
    std::vector<Way> ways;
    std::map<Cell, double> z_of;
    std::map<std::uint32_t, double> z_at;  // by vertex: lowest that can come from upstream
    for (const auto& [from, to] : falls_of(rivers)) {
        const Point3 a = rivers.tin.position(from);
        const Point3 b = rivers.tin.position(to);
        std::vector<std::pair<long double, Cell>> passed;
        for (std::int64_t row = 0; row < grid.rows; ++row) {
            for (std::int64_t column = 0; column < grid.columns; ++column) {
                const Part part = part_in({a.x, a.y}, {b.x, b.y}, grid, column, row);
                const long double middle = (part.begin + part.end) / 2;
                const Point2 p{static_cast<double>(a.x + middle * (b.x - a.x)),
                               static_cast<double>(a.y + middle * (b.y - a.y))};
                if (part.end - part.begin > 1e-12L && cell_of(p, grid) == Cell{column, row}) {
                    passed.emplace_back(part.end, Cell{column, row});
                }
            }
        }
        std::sort(passed.begin(), passed.end());
        Way way{from, to, {}};
        for (const auto& [end, cell] : passed) {
            const auto z = static_cast<double>(a.z + end * (b.z - a.z));
            const auto [place, is_new] = z_of.try_emplace(cell, z);
            place->second = std::min(place->second, z);
            way.cells.push_back(cell);
        }
        ways.push_back(way);
        z_at.try_emplace(from.value, a.z);
        z_at.try_emplace(to.value, b.z);
    }
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        for (const Way& way : ways) {
            double lowest = z_at[way.from.value];
            const auto lower = [&](double& z) {
                is_changed = is_changed || z > lowest;
                lowest = std::min(z, lowest);
                z = lowest;
            };
            for (const Cell& cell : way.cells) {
                lower(z_of[cell]);
            }
            lower(z_at[way.to.value]);
        }
    }
    return z_of;
}

}  // namespace

TEST_SUITE("water/river_cells") {
    TEST_CASE("the passages of a segment are its parts in the cells, one after the other") {
        const GridGeometry grid{-3, 11, 2, 0.5, 7, 9};
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(2000)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const auto [a, b] = quarter_segment(random, grid);
            const std::vector<CellPassage> passages = passages_of(a, b, grid);
            std::map<Cell, Part> found;
            for (std::size_t i = 0; i < passages.size(); ++i) {
                const CellPassage& passage = passages[i];
                const Part part = part_in(a, b, grid, passage.column, passage.row);
                REQUIRE(passage.begin <= passage.end);
                REQUIRE(std::abs(static_cast<double>(part.begin) - passage.begin) < 1e-12);
                REQUIRE(std::abs(static_cast<double>(part.end) - passage.end) < 1e-12);
                REQUIRE(found.try_emplace({passage.column, passage.row}).second);
                REQUIRE((i == 0 || passages[i - 1].end == passage.begin));  // the raster is convex
            }
            for (std::int64_t row = 0; row < grid.rows; ++row) {
                for (std::int64_t column = 0; column < grid.columns; ++column) {
                    const Part part = part_in(a, b, grid, column, row);
                    const long double middle = (part.begin + part.end) / 2;
                    const Point2 p{static_cast<double>(a.x + middle * (b.x - a.x)),
                                   static_cast<double>(a.y + middle * (b.y - a.y))};
                    // Points that belong to a cell are its own; others only touch it.
                    const bool is_passed =
                        part.end - part.begin > 1e-12L && cell_of(p, grid) == Cell{column, row};
                    if (is_passed) {
                        REQUIRE(found.count({column, row}) == 1);
                    } else if (part.begin > part.end + 1e-12L) {
                        REQUIRE(found.count({column, row}) == 0);
                    }
                }
            }
        }
    }

    TEST_CASE("a point between cells belongs to the one to the right, or below") {
        const GridGeometry grid{0, 4, 1, 1, 4, 4};
        const auto cells = [&](Point2 a, Point2 b) {
            std::vector<Cell> visited;
            for (const CellPassage& passage : passages_of(a, b, grid)) {
                visited.emplace_back(passage.column, passage.row);
            }
            return visited;
        };
        CHECK(cells({2, 3.5}, {2, 2.5}) == std::vector<Cell>{{2, 0}, {2, 1}});
        CHECK(cells({0.5, 2}, {1.5, 2}) == std::vector<Cell>{{0, 2}, {1, 2}});
        CHECK(cells({0.5, 3.5}, {1.5, 2.5}) == std::vector<Cell>{{0, 0}, {1, 1}});
        CHECK(cells({1.5, 2.5}, {0.5, 3.5}) == std::vector<Cell>{{1, 1}, {0, 0}});
        CHECK(cells({0.5, 2.5}, {1.5, 3.5}) == std::vector<Cell>{{0, 1}, {1, 1}, {1, 0}});
        CHECK(cells({1.5, 3.5}, {0.5, 2.5}) == std::vector<Cell>{{1, 0}, {1, 1}, {0, 1}});
        CHECK(cells({1.5, 3.5}, {2, 3.5}) == std::vector<Cell>{{1, 0}, {2, 0}});
        CHECK(cells({2, 3.5}, {1.5, 3.5}) == std::vector<Cell>{{2, 0}, {1, 0}});
        CHECK(cells({2, 2}, {2, 2}) == std::vector<Cell>{{2, 2}});
        CHECK(cells({4, 2.5}, {4, 1.5}).empty());
        CHECK(cells({-9e9, 2.5}, {9e9, 2.5}).size() == 4);
        CHECK(cells({-9e9, 9e9}, {-1, 2.5}).empty());
    }

    TEST_CASE("river cells are the lowest of the river there and upstream, as following every way finds") {
        int compared = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(60)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const Rivers rivers = make_rivers(random, 0.25);
            const double size =
                std::vector<double>{0.5, 1, 4, 40}[static_cast<std::size_t>(random.integer(0, 3))];
            const auto count = static_cast<std::int64_t>(20 / std::max(1.0, size)) + 1;
            const GridGeometry grid{0, static_cast<double>(count) * size, size, size, count, count};
            // Where lines cross is not in whole quarters: a corner may be passed by a hair or just touched.
            if (passes_by_a_hair(rivers, grid)) {
                continue;
            }
            ++compared;
            const std::map<Cell, double> expected = expected_cells(rivers, grid);
            const std::vector<CellElevation> found =
                find_river_cells(rivers.tin, rivers.is_river_line, {}, grid);
            REQUIRE(found.size() == expected.size());
            for (const CellElevation& cell : found) {
                const double z = expected.at({cell.cell % grid.columns, cell.cell / grid.columns});
                REQUIRE(std::abs(z - cell.z) < 1e-9);
            }
            REQUIRE(std::is_sorted(
                found.begin(), found.end(),
                [](const CellElevation& a, const CellElevation& b) { return a.cell < b.cell; }));
        }
        CHECK(compared * 2 > cases(60));
    }

    TEST_CASE("cells never rise along any way downstream, as floats too, and are never above the river") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(300)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const Rivers rivers = make_rivers(random, 0.01 * static_cast<double>(random.integer(1, 100)));
            const double size = 0.01 * std::pow(10.0, 4 * random.real());
            const auto count = static_cast<std::int64_t>(std::min(200.0, 80 / size)) + 1;
            const GridGeometry grid{-0.1 * random.real(), 20 * random.real(), size, size * 0.7, count, count};
            std::map<Cell, double> z_of;
            for (const CellElevation& cell : find_river_cells(rivers.tin, rivers.is_river_line, {}, grid)) {
                z_of[{cell.cell % grid.columns, cell.cell / grid.columns}] = cell.z;
            }
            for (const auto& [from, to] : falls_of(rivers)) {
                const Point3 a = rivers.tin.position(from);
                const Point3 b = rivers.tin.position(to);
                std::optional<double> before;
                visit_cells({a.x, a.y}, {b.x, b.y}, grid, [&](const CellPassage& passage) {
                    // Seen from its other end, a level edge may pass a corner on the other side by a hair.
                    if (passage.end - passage.begin < (a.z == b.z ? 1e-9 : 1e-300)) {
                        return;
                    }
                    const double z = z_of.at({passage.column, passage.row});
                    REQUIRE(z <= a.z);
                    if (before) {
                        REQUIRE(z <= *before);
                        REQUIRE((a.z != b.z || z == *before));
                        REQUIRE(static_cast<float>(z) <= static_cast<float>(*before));
                    }
                    before = z;
                });
            }
        }
    }

    TEST_CASE("a bend that leaves a cell and comes back makes the cells between equal") {
        std::vector<Breakline> lines(1);
        lines[0].role = LineRole::River;
        // In cell (0, 0), out into (1, 0) and (2, 0), back into (0, 0) through (1, 1) and (0, 1), on to (0,
        // 1).
        lines[0].points = {{0.5, 3.5, 10}, {2.5, 3.5, 9}, {2.5, 3.1, 8}, {0.5, 3.1, 7}, {0.5, 0.5, 2}};
        const std::vector<Point3> samples = {{-1, -1, 20}, {5, -1, 20}, {5, 5, 20}, {-1, 5, 20}};
        const Tin tin = triangulate(samples, lines).tin;
        const auto cells = find_river_cells(tin, {true}, {}, {0, 4, 1, 1, 4, 4});
        REQUIRE(cells.size() == 6);
        const double z = cells[0].z;  // where the river leaves (0, 0) for good: a tenth above its edge
        CHECK(z == doctest::Approx(7 - 5 * 0.1 / 2.6));
        CHECK(cells[1] == CellElevation{1, z});
        CHECK(cells[2] == CellElevation{2, z});
        CHECK(cells[3].cell == 4);
        CHECK(cells[3].z < z);
        CHECK(cells[5] == CellElevation{12, 2});
    }

    TEST_CASE("confluences, braids and what comes back into the raster run down from cell to cell") {
        std::vector<Breakline> lines(3, {{}, LineRole::River});
        lines[0].points = {{1.5, 5.5, 30}, {2.5, 3.5, 20}, {-2.5, 2.5, 15}, {2.5, 1.5, 10}};
        lines[1].points = {{3.5, 5.5, 22}, {2.5, 3.5, 20}};
        lines[2].points = {{2.5, 3.5, 20}, {3.5, 2.5, 19}, {2.5, 1.5, 10}};
        const std::vector<Point3> samples = {{-5, -5, 50}, {9, -5, 50}, {9, 9, 50}, {-5, 9, 50}};
        const Tin tin = triangulate(samples, lines).tin;
        const GridGeometry grid{0, 6, 1, 1, 5, 6};
        std::map<std::int64_t, double> z;
        for (const CellElevation& cell : find_river_cells(tin, {true, true, true}, {}, grid)) {
            z[cell.cell] = cell.z;
        }
        CHECK(z.at(2 * 5 + 2) <= 20);  // the confluence
        CHECK(z.at(2 * 5 + 2) > 17);   // and nothing else
        CHECK(z.at(4 * 5 + 0) < z.at(2 * 5 + 0));
        CHECK(z.at(4 * 5 + 2) == 10);
        CHECK(z.at(3 * 5 + 3) > 10);
    }

    TEST_CASE("cells whose centre is on water are left as they are, lines without a river too") {
        std::vector<Breakline> lines(3);
        lines[0] = {{{2, 2, 5}, {4, 2, 5}, {4, 4, 5}, {2, 4, 5}, {2, 2, 5}}, LineRole::Lake};
        lines[1] = {{{0.5, 2.5, 8}, {2, 2.6, 5}}, LineRole::River};
        lines[2] = {{{0.5, 0.5, 8}, {5.5, 0.5, 5}}};
        const std::vector<Point3> samples = {{0, 0, 10}, {6, 0, 10}, {6, 6, 10}, {0, 6, 10}};
        const Tin tin = triangulate(samples, lines).tin;
        const std::vector<bool> is_water = find_water_faces(tin, lines);
        // The middle of the second column is in the lake, the river's end is in that column too.
        const GridGeometry grid{0.3, 6, 1.2, 1, 4, 6};
        const auto all = find_river_cells(tin, {false, true, false}, {}, grid);
        const auto dry = find_river_cells(tin, {false, true, false}, is_water, grid);
        REQUIRE(all.size() == 2);
        CHECK(all[0].cell == 3 * 4);
        CHECK(all[1] == CellElevation{3 * 4 + 1, 5});
        REQUIRE(dry.size() == 1);
        CHECK(dry[0] == all[0]);
        CHECK(find_river_cells(tin, {}, is_water, grid).empty());
    }

    TEST_CASE("a raster has the river's elevations in its cells, on the terrain only, whatever the bands") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(20)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const Rivers rivers = make_rivers(random, 0.25);
            const GridGeometry grid{-30, 60, 1.3, 1.1, 70, 80};
            GriddingOptions options;
            const bool is_alone = random.integer(0, 1) == 0;
            if (!is_alone) {
                options.products = {Product::Slope, Product::Elevation, Product::Elevation};
            }
            const std::size_t elevation = is_alone ? 0 : 2;
            const auto fill = [&](std::int64_t rows, double nodata) {
                SurfaceGridder gridder(rivers.tin, nullptr, grid, rows, options);
                const auto size = static_cast<std::size_t>(grid.columns * grid.rows);
                std::vector<std::vector<double>> values(options.products.size(), std::vector<double>(size));
                std::int64_t covered = 0;
                for (std::int64_t band = 0; band < gridder.band_count(); ++band) {
                    const auto [first, end] = gridder.band_rows(band);
                    std::vector<std::span<double>> spans;
                    for (std::vector<double>& of_product : values) {
                        spans.push_back(std::span(of_product)
                                            .subspan(static_cast<std::size_t>(first * grid.columns),
                                                     static_cast<std::size_t>((end - first) * grid.columns)));
                    }
                    covered += gridder.fill(band, spans, nodata);
                }
                return std::pair(values, covered);
            };
            const auto [plain, covered] = fill(80, -9999);
            options.cells = find_river_cells(rivers.tin, rivers.is_river_line, {}, grid);
            std::vector<double> expected = plain[elevation];
            for (const CellElevation& cell : options.cells) {
                double& z = expected[static_cast<std::size_t>(cell.cell)];
                z = z == -9999 ? z : cell.z;
            }
            for (const std::int64_t rows : {80, 7, 1}) {
                const auto [burnt, covered_too] = fill(rows, -9999);
                REQUIRE(burnt[elevation] == expected);
                REQUIRE(covered == covered_too);
                REQUIRE((is_alone || burnt[0] == plain[0]));
            }
        }
    }

    TEST_CASE("a terrain at the elevation of nodata is terrain") {
        const Tin tin = tin_of_samples({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
        GriddingOptions options;
        options.cells = {{12, 7}, {3, 7}};
        std::sort(options.cells.begin(), options.cells.end(),
                  [](const CellElevation& a, const CellElevation& b) { return a.cell < b.cell; });
        const GridGeometry grid{0, 4, 1, 1, 4, 4};
        SurfaceGridder gridder(tin, nullptr, grid, 4, options);
        std::vector<float> values(16);
        const std::vector<std::span<float>> spans{values};
        gridder.fill(0, spans, 0.0F);
        CHECK(values[12] == 7);
        CHECK(values[3] == 0);
    }
}
