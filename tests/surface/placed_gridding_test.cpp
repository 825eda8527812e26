// Rasters whose cells are told where they are in the surface's plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/natural_neighbor.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"
#include "surface/filled_rasters.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Samples at quarters in a square around (0, 0), so that cells meet vertices and edges; some faces are not
/// terrain.
Tin quarters(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    std::vector<Point3> samples;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 0.25 * static_cast<double>(random.integer(-40, 40));
        const double y = 0.25 * static_cast<double>(random.integer(-40, 40));
        samples.push_back({x, y, 4 * std::sin(x / 3) + 0.25 * static_cast<double>(random.integer(0, 8))});
    }
    Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f}) && random.integer(0, 9) == 0) {
            tin.mesh.set_terrain({f}, false);
        }
    }
    return tin;
}

const GridGeometry kGrid{-11, 11, 0.5, 0.5, 44, 44};

/// The places of a raster that is turned by quarter turns counter-clockwise about the origin, its own
/// coordinates being those of `grid`.
FindCellPlaces quarter_turned(const GridGeometry& grid, int turns) {
    return [grid, turns](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
        for (CellPlace& place : places) {
            Point2 at = grid.centre(first++, row);
            Point2 north{0, 1};
            for (int i = 0; i < turns; ++i) {
                at = {-at.y, at.x};
                north = {-north.y, north.x};
            }
            place = {at, north};
        }
    };
}

GriddingOptions all_products() {
    GriddingOptions options;
    options.products.clear();
    for (const auto& [name, product] : kProducts) {
        options.products.push_back(product);
    }
    return options;
}

std::size_t index_of(Product product) {
    return static_cast<std::size_t>(std::find_if(kProducts.begin(), kProducts.end(),
                                                 [&](const auto& entry) { return entry.second == product; }) -
                                    kProducts.begin());
}

std::vector<FaceId> terrain_of(const Tin& tin) {
    std::vector<FaceId> terrain;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            terrain.push_back({f});
        }
    }
    return terrain;
}

bool closure_holds(const Tin& tin, FaceId face, const QueryLattice& lattice, Key2 at) {
    std::array<Key2, 3> corner{};
    for (unsigned i = 0; i < 3; ++i) {
        corner[i] = lattice.scaled(tin.key(tin.mesh.vertex(face, i)));
    }
    return orient2d(corner[0], corner[1], at) >= 0 && orient2d(corner[1], corner[2], at) >= 0 &&
           orient2d(corner[2], corner[0], at) >= 0;
}

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_SUITE("surface/placed_gridding") {
    TEST_CASE(
        "cells placed where they are get the same values, bit for bit, wherever they get the same face") {
        std::size_t same = 0;
        std::size_t on_edges = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(20)); ++seed) {
            CAPTURE(seed);
            const Tin tin = quarters(seed, 30 + 10 * seed);
            const QueryLattice lattice(tin);
            const std::vector<FaceId> terrain = terrain_of(tin);
            const auto surface =
                seed % 2 == 0 ? make_linear(tin) : make_natural_neighbor(tin, SharpEdges(tin, {}));
            GriddingOptions options = all_products();
            std::int64_t covered = 0;
            const auto expected = fill_all(tin, surface.get(), kGrid, 44, options, &covered);
            options.find_places = quarter_turned(kGrid, 0);
            std::int64_t placed_covered = 0;
            const auto placed = fill_all(tin, surface.get(), kGrid, 44, options, &placed_covered);
            REQUIRE(covered == placed_covered);
            const std::size_t faces = index_of(Product::FaceNumber);
            for (std::size_t i = 0; i < placed[0].size(); ++i) {
                REQUIRE(std::isnan(expected[faces][i]) == std::isnan(placed[faces][i]));
                if (std::isnan(placed[faces][i])) {
                    continue;
                }
                if (expected[faces][i] == placed[faces][i]) {
                    for (std::size_t p = 0; p < placed.size(); ++p) {
                        REQUIRE(is_same(expected[p][i], placed[p][i]));
                    }
                    ++same;
                    continue;
                }
                // On an edge between two faces or at a vertex: the two ways take another of them.
                const auto cell = static_cast<std::int64_t>(i);
                const Key2 at = lattice.at(kGrid.centre(cell % kGrid.columns, cell / kGrid.columns));
                for (const auto* const values : {&expected, &placed}) {
                    const FaceId face = terrain[static_cast<std::size_t>((*values)[faces][i])];
                    REQUIRE(closure_holds(tin, face, lattice, at));
                }
                REQUIRE(placed[faces][i] < expected[faces][i]);
                REQUIRE(std::abs(placed[0][i] - expected[0][i]) < 1e-12);
                ++on_edges;
            }
        }
        CHECK(same > 10000);
        CHECK(on_edges > 100);
    }

    TEST_CASE("the face is the locator's, whatever cells come before") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(10)); ++seed) {
            CAPTURE(seed);
            const Tin tin = quarters(seed, 300);
            const SurfaceLocator locator(tin);
            const std::vector<FaceId> terrain = terrain_of(tin);
            Random random(seed);
            std::vector<Point2> positions;
            for (std::size_t i = 0; i < static_cast<std::size_t>(kGrid.columns * kGrid.rows); ++i) {
                const double x = 0.125 * static_cast<double>(random.integer(-90, 90));
                positions.push_back({x, 0.125 * static_cast<double>(random.integer(-90, 90))});
            }
            GriddingOptions options;
            options.products = {Product::FaceNumber};
            options.find_places = [&](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
                for (CellPlace& place : places) {
                    place = {positions[static_cast<std::size_t>(row * kGrid.columns + first++)], {0, 1}};
                }
            };
            const auto numbers = fill_all(tin, nullptr, kGrid, 44, options);
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const auto place = locator.find(positions[i]);
                REQUIRE(place.has_value() == !std::isnan(numbers[0][i]));
                if (place) {
                    REQUIRE(terrain[static_cast<std::size_t>(numbers[0][i])] == place->face);
                }
            }
        }
    }

    TEST_CASE("gradients, aspect and light are told by the raster's own north, exactly for quarter turns") {
        const Tin tin = quarters(3, 200);
        const auto surface = make_linear(tin);
        for (int turns = 0; turns < 4; ++turns) {
            CAPTURE(turns);
            GriddingOptions options = all_products();
            options.find_places = quarter_turned(kGrid, turns);
            const auto turned = fill_all(tin, surface.get(), kGrid, 44, options);
            // The same places by cells of the plane; light from where the raster has its north-west.
            options.find_places = quarter_turned(kGrid, 0);
            options.light.azimuth = 315 - 90 * turns + (turns == 3 ? 360 : 0);
            if (options.light.azimuth < 0) {
                options.light.azimuth += 360;
            }
            const auto plane = fill_all(tin, surface.get(), kGrid, 44, options);
            std::size_t with_aspect = 0;
            for (std::int64_t row = 0; row < kGrid.rows; ++row) {
                for (std::int64_t column = 0; column < kGrid.columns; ++column) {
                    // The raster's cell turned into the plane.
                    std::int64_t c = column;
                    std::int64_t r = row;
                    for (int i = 0; i < turns; ++i) {
                        const std::int64_t left = r;
                        r = kGrid.columns - 1 - c;
                        c = left;
                    }
                    const auto i = static_cast<std::size_t>(row * kGrid.columns + column);
                    const auto j = static_cast<std::size_t>(r * kGrid.columns + c);
                    const auto value = [&](const auto& values, Product product, std::size_t cell) {
                        return values[index_of(product)][cell];
                    };
                    for (const Product product : {Product::Elevation, Product::Slope,
                                                  Product::NearestDistance, Product::FaceNumber}) {
                        REQUIRE(is_same(value(turned, product, i), value(plane, product, j)));
                    }
                    if (std::isnan(value(plane, Product::Elevation, j))) {
                        continue;
                    }
                    Point2 gradient{value(plane, Product::GradientX, j), value(plane, Product::GradientY, j)};
                    for (int k = 0; k < turns; ++k) {
                        gradient = {gradient.y, -gradient.x};
                    }
                    REQUIRE(value(turned, Product::GradientX, i) == gradient.x);
                    REQUIRE(value(turned, Product::GradientY, i) == gradient.y);
                    REQUIRE(value(turned, Product::Hillshade, i) ==
                            doctest::Approx(value(plane, Product::Hillshade, j)).epsilon(1e-9));
                    const double aspect = value(plane, Product::Aspect, j);
                    REQUIRE(std::isnan(aspect) == std::isnan(value(turned, Product::Aspect, i)));
                    if (!std::isnan(aspect)) {
                        const double difference = value(turned, Product::Aspect, i) - aspect - 90 * turns;
                        REQUIRE(std::abs(std::remainder(difference, 360)) < 1e-9);
                        ++with_aspect;
                    }
                }
            }
            CHECK(with_aspect > 500);
        }
    }

    TEST_CASE("a slope along the raster's north is a gradient along y, whatever way that points") {
        Tin tin = quarters(4, 100);
        const Point2 north{0.6, 0.8};
        for (std::size_t v = 0; v < tin.z.size(); ++v) {
            const Point2 p = tin.lattice.position(tin.keys[v]);
            tin.z[v] = 0.5 * (north.x * p.x + north.y * p.y) + 0.25 * (north.y * p.x - north.x * p.y);
        }
        GriddingOptions options;
        options.products = {Product::GradientX, Product::GradientY};
        options.z_factor = 2;
        options.find_places = [&](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
            for (CellPlace& place : places) {
                place = {kGrid.centre(first++, row), north};
            }
        };
        const auto values = fill_all(tin, nullptr, kGrid, 44, options);
        for (std::size_t i = 0; i < values[0].size(); ++i) {
            if (!std::isnan(values[0][i])) {
                REQUIRE(values[0][i] == doctest::Approx(0.5).epsilon(1e-12));
                REQUIRE(values[1][i] == doctest::Approx(1).epsilon(1e-12));
            }
        }
    }

    TEST_CASE("cells that are nowhere or far away have no value") {
        const Tin tin = quarters(5, 200);
        for (const Point2 nowhere : {Point2{kNone, 0}, Point2{0, kNone}, Point2{1e300, 0},
                                     Point2{std::numeric_limits<double>::infinity(), 1}, Point2{1e9, 1e9}}) {
            GriddingOptions options = all_products();
            const auto everywhere = fill_all(tin, nullptr, kGrid, 44, [&] {
                GriddingOptions all = options;
                all.find_places = quarter_turned(kGrid, 0);
                return all;
            }());
            options.find_places = [&](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
                quarter_turned(kGrid, 0)(row, first, places);
                for (CellPlace& place : places) {
                    if ((row + first++) % 3 == 0) {
                        place.position = nowhere;
                    }
                }
            };
            const auto some = fill_all(tin, nullptr, kGrid, 44, options);
            for (std::size_t i = 0; i < some[0].size(); ++i) {
                const auto cell = static_cast<std::int64_t>(i);
                const bool is_nowhere = (cell / kGrid.columns + cell % kGrid.columns) % 3 == 0;
                for (std::size_t p = 0; p < some.size(); ++p) {
                    REQUIRE(is_same(some[p][i], is_nowhere ? kNone : everywhere[p][i]));
                }
            }
        }
    }

    TEST_CASE("cells with elevations of their own get them on the terrain, and there only") {
        const Tin tin = quarters(6, 60);
        GriddingOptions options;
        options.find_places = quarter_turned(kGrid, 1);
        const auto before = fill_all(tin, nullptr, kGrid, 5, options);
        for (std::int64_t cell = 0; cell < kGrid.columns * kGrid.rows; cell += 3) {
            options.cells.push_back({cell, 1000.0 + static_cast<double>(cell)});
        }
        const auto after = fill_all(tin, nullptr, kGrid, 5, options);
        for (std::size_t i = 0; i < before[0].size(); ++i) {
            const bool is_set = i % 3 == 0 && !std::isnan(before[0][i]);
            REQUIRE(is_same(after[0][i], is_set ? 1000.0 + static_cast<double>(i) : before[0][i]));
        }
    }

    TEST_CASE("neither threads nor bands change a bit of a raster that lies askew") {
        Random random(7);
        std::vector<Point3> samples = decimal_samples(random, 3000, 2, 0, 0, 100);
        const Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
        const GridGeometry grid{-150, 150, 0.5, 1, 600, 300};
        GriddingOptions options = all_products();
        options.find_places = [&](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
            for (CellPlace& place : places) {
                const Point2 at = grid.centre(first++, row);
                place = {{0.6 * at.x - 0.8 * at.y + 0.001 * at.x * at.y, 0.8 * at.x + 0.6 * at.y},
                         {-0.8, 0.6}};
            }
        };
        std::vector<std::vector<double>> alone;
        tbb::task_arena one(1);
        one.execute([&] { alone = fill_all(tin, nullptr, grid, 300, options); });
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
        tbb::task_arena four(4);
        four.execute([&] {
            for (const std::int64_t band_rows : {1, 7, 50, 300}) {
                const auto together = fill_all(tin, nullptr, grid, band_rows, options);
                for (std::size_t p = 0; p < options.products.size(); ++p) {
                    CAPTURE(p);
                    CHECK(are_same(alone[p], together[p]));
                }
            }
        });
        CHECK(std::count_if(alone[0].begin(), alone[0].end(), [](double z) { return !std::isnan(z); }) >
              10000);
    }
}
