// From lakes and rivers as they came to rasters: what is promised of cells holds to the bit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/facets.hpp"
#include "tinwright/surface/gridding.hpp"
#include "tinwright/surface/interpolation.hpp"
#include "tinwright/water/raster_check.hpp"
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

std::vector<Point3> rough_samples(Random& random) {
    std::vector<Point3> samples;
    for (int i = 0; i < 250; ++i) {
        const double x = 0.25 * static_cast<double>(random.integer(-100, 220));
        const double y = 0.25 * static_cast<double>(random.integer(-100, 220));
        samples.push_back({x, y, 60 - 0.1 * x + 4 * std::sin(x / 7) * std::cos(y / 5) + 3 * random.real()});
    }
    return samples;
}

/// Rivers with or without z that go uphill where they like, lakes to be measured.
std::vector<Breakline> rough_water(Random& random) {
    std::vector<Breakline> lines = wandering_rivers(random, 0.25);
    for (Breakline& line : lines) {
        const bool has_z = random.integer(0, 1) == 0;
        for (Point3& point : line.points) {
            point.z = has_z ? point.z + 4 * random.real() : kDraped;
        }
    }
    std::uint32_t polygon = 0;
    for (std::int64_t i = random.integer(0, 2); i > 0; --i) {
        const double x = 0.25 * static_cast<double>(random.integer(-10, 60));
        const double y = 0.25 * static_cast<double>(random.integer(-10, 60));
        const double side = 0.25 * static_cast<double>(random.integer(2, 30));
        lines.push_back(rectangle(LineRole::Lake, polygon++, x, y, x + side, y + 0.75 * side, kDraped));
    }
    return lines;
}

}  // namespace

TEST_SUITE("water/water_rasters") {
    TEST_CASE(
        "rasters of levelled water pass the check without tolerance, whatever the cells and the method") {
        std::size_t rivers = 0;
        std::size_t lakes = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(60)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            std::vector<Point3> samples = rough_samples(random);
            const std::vector<Breakline> lines = rough_water(random);
            WaterOptions water_options;
            water_options.keeps_faults = true;
            water_options.meeting_levels = CrossingPolicy::Min;
            const Water water = level_water(samples, lines, water_options);
            for (const auto& [sample, z] : water.lifted) {
                samples[sample].z = z;
            }
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            const Tin tin = triangulate(samples, water.lines, options).tin;
            const std::vector<bool> is_water = find_water_faces(tin, water.lines);
            std::vector<bool> is_river;
            for (const Breakline& line : water.lines) {
                is_river.push_back(line.role == LineRole::River);
            }
            const double size = 0.1 * std::pow(10.0, 2 * random.real());
            const auto count = static_cast<std::int64_t>(std::min(120.0, 60 / size)) + 1;
            const GridGeometry grid{-2.5 * random.real(), 25 * random.real(), size, 0.8 * size, count, count};
            const auto cells = find_river_cells(tin, is_river, is_water, grid);
            const auto smooth = keep_facets(
                tin,
                make_interpolator(tin, SharpEdges(tin, {}),
                                  {.method = seed % 2 == 0 ? InterpolationMethod::CloughTocher
                                                           : InterpolationMethod::NaturalNeighbor}),
                is_water);
            const std::array<const Interpolator*, 2> surfaces{nullptr, smooth.get()};
            for (const Interpolator* const surface : surfaces) {
                for (const bool is_float : {false, true}) {
                    const Raster raster = grid_of(tin, surface, grid, cells, is_float);
                    const RasterCheckReport report = raster.check(lines, water);
                    REQUIRE(report.findings.empty());
                    REQUIRE(report.highest_rise == 0);
                    REQUIRE(report.widest_range == 0);
                    rivers += report.rivers;
                    lakes += report.lakes;
                }
            }
        }
        CHECK(rivers > 0);
        CHECK(lakes > 0);
    }
}
