#include "tinwright/surface/gridding.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/surface/linear.hpp"
#include "tinwright/surface/nearest.hpp"
#include "tinwright/surface/scan_conversion.hpp"

#include "support/point_sets.hpp"
#include "support/tins.hpp"
#include "surface/filled_rasters.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// Samples on a wavy hill, with decimals.
Tin hill(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    std::vector<Point3> samples = decimal_samples(random, count, 2, 500000, 5400000, 100);
    for (Point3& sample : samples) {
        sample.z = 5 * std::sin(sample.x / 9) + 3 * std::cos(sample.y / 7);
    }
    return tin_of_samples(samples);
}

GridGeometry grid_over(const Tin& tin, std::int64_t columns, std::int64_t rows) {
    const Box box = tin.bounds();
    return {box.x_min - 1,
            box.y_max + 1,
            (box.x_max - box.x_min + 2) / static_cast<double>(columns),
            (box.y_max - box.y_min + 2) / static_cast<double>(rows),
            columns,
            rows};
}

}  // namespace

TEST_SUITE("surface/gridding") {
    TEST_CASE("the linear surface read cell by cell is the one that scan conversion writes") {
        const Tin tin = hill(1, 400);
        const GridGeometry grid = grid_over(tin, 90, 70);
        const auto surface = make_linear(tin);
        std::int64_t covered = 0;
        const auto read = fill_all(tin, surface.get(), grid, 70, {}, &covered);
        const auto scanned = fill_all(tin, nullptr, grid, 70, {});
        std::int64_t with_value = 0;
        for (std::size_t i = 0; i < read[0].size(); ++i) {
            REQUIRE(std::isnan(read[0][i]) == std::isnan(scanned[0][i]));
            if (!std::isnan(read[0][i])) {
                ++with_value;
                REQUIRE(std::abs(read[0][i] - scanned[0][i]) < 1e-12);
            }
        }
        CHECK(with_value == covered);
        CHECK(covered > 4000);
    }

    TEST_CASE("faces have the slope, aspect and gradient of their planes") {
        Tin tin = hill(2, 100);
        for (std::size_t v = 0; v < tin.z.size(); ++v) {
            const Point2 p = tin.lattice.position(tin.keys[v]);
            tin.z[v] = 3 * (p.x - 500000) + 4 * (p.y - 5400000);
        }
        GriddingOptions options;
        options.products = {Product::Slope, Product::GradientX, Product::GradientY, Product::Aspect};
        options.slope_unit = SlopeUnit::Percent;
        options.z_factor = 0.1;
        const auto values = fill_all(tin, nullptr, grid_over(tin, 20, 20), 20, options);
        for (std::size_t i = 0; i < values[0].size(); ++i) {
            if (!std::isnan(values[0][i])) {
                REQUIRE(values[0][i] == doctest::Approx(50).epsilon(1e-6));
                REQUIRE(values[1][i] == doctest::Approx(0.3).epsilon(1e-6));
                REQUIRE(values[2][i] == doctest::Approx(0.4).epsilon(1e-6));
                REQUIRE(values[3][i] == doctest::Approx(180 + 36.86989764584402).epsilon(1e-6));
            }
        }
    }

    TEST_CASE("level ground has a slope and no aspect") {
        Tin tin = hill(3, 50);
        std::fill(tin.z.begin(), tin.z.end(), 7.0);
        GriddingOptions options;
        options.products = {Product::Slope, Product::Aspect};
        std::int64_t covered = 0;
        const auto values = fill_all(tin, nullptr, grid_over(tin, 20, 20), 20, options, &covered);
        CHECK(std::count(values[0].begin(), values[0].end(), 0.0) == covered);
        CHECK(
            std::all_of(values[1].begin(), values[1].end(), [](double value) { return std::isnan(value); }));
    }

    TEST_CASE("cells know their face and the distance to the closest sample") {
        const Tin tin = hill(4, 200);
        const GridGeometry grid = grid_over(tin, 40, 30);
        GriddingOptions options;
        options.products = {Product::FaceNumber, Product::NearestDistance};
        const auto values = fill_all(tin, nullptr, grid, 30, options);
        // Number of the face, by counting terrain faces.
        std::vector<FaceId> terrain;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            if (tin.mesh.is_terrain({f})) {
                terrain.push_back({f});
            }
        }
        for (std::int64_t row = 0; row < grid.rows; ++row) {
            for (std::int64_t column = 0; column < grid.columns; ++column) {
                const auto i = static_cast<std::size_t>(row * grid.columns + column);
                if (std::isnan(values[0][i])) {
                    continue;
                }
                const Point2 at = grid.centre(column, row);
                const auto corners = tin.mesh.face(terrain.at(static_cast<std::size_t>(values[0][i]))).vertex;
                double x_min = 1e300;
                double x_max = -1e300;
                double least = 1e300;
                for (const VertexId v : corners) {
                    x_min = std::min(x_min, tin.position(v).x);
                    x_max = std::max(x_max, tin.position(v).x);
                }
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    const Point3 p = tin.position({v});
                    least = std::min(least, std::hypot(p.x - at.x, p.y - at.y));
                }
                REQUIRE(at.x >= x_min - 1e-6);
                REQUIRE(at.x <= x_max + 1e-6);
                REQUIRE(values[1][i] == doctest::Approx(least).epsilon(1e-6));
            }
        }
    }

    TEST_CASE("neither the number of threads nor the height of bands changes a bit") {
        const Tin tin = hill(5, 3000);
        const GridGeometry grid = grid_over(tin, 200, 150);
        GriddingOptions options;
        for (const auto& [name, product] : kProducts) {
            options.products.push_back(product);
        }
        options.products.erase(options.products.begin());
        for (const bool is_linear : {true, false}) {
            const auto surface = is_linear ? make_linear(tin) : make_nearest(tin);
            std::vector<std::vector<double>> alone;
            tbb::task_arena one(1);
            one.execute([&] { alone = fill_all(tin, surface.get(), grid, 150, options); });
            const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
            tbb::task_arena four(4);
            four.execute([&] {
                for (const std::int64_t band_rows : {1, 7, 150}) {
                    const auto together = fill_all(tin, surface.get(), grid, band_rows, options);
                    for (std::size_t p = 0; p < options.products.size(); ++p) {
                        CAPTURE(p);
                        CHECK(are_same(alone[p], together[p]));
                    }
                }
            });
        }
    }

    TEST_CASE("asking for more products does not change the elevations") {
        const Tin tin = hill(6, 500);
        const GridGeometry grid = grid_over(tin, 60, 60);
        GriddingOptions options;
        options.products = {Product::Slope, Product::Elevation};
        CHECK(
            are_same(fill_all(tin, nullptr, grid, 60, {})[0], fill_all(tin, nullptr, grid, 60, options)[1]));
    }
}
