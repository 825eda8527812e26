#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/mesh/tin_check.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/water/water.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "water/water_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr int kSize = 60;

double whole(Random& random, int low, int high) { return static_cast<double>(random.integer(low, high)); }

// Rivers that meet, cross, run along each other and in circles; lakes and banks here and there.
std::vector<Breakline> random_water(Random& random, bool has_z) {
    std::vector<Breakline> lines;
    const std::int64_t rivers = random.integer(1, 8);
    for (std::int64_t i = 0; i < rivers; ++i) {
        Breakline line;
        line.role = LineRole::River;
        const std::int64_t points = random.integer(2, 7);
        for (std::int64_t k = 0; k < points; ++k) {
            const Point3 point{whole(random, 1, kSize - 1), whole(random, 1, kSize - 1),
                               has_z ? whole(random, 0, 40) / 4 : kDraped};
            const bool repeats =
                !line.points.empty() && line.points.back().x == point.x && line.points.back().y == point.y;
            if (!repeats) {
                line.points.push_back(point);
            }
        }
        if (i > 0 && random.integer(0, 2) == 0) {
            line.points.push_back(lines[static_cast<std::size_t>(random.integer(0, i - 1))].points.front());
        }
        if (line.points.size() > 1) {
            lines.push_back(line);
        }
    }
    std::uint32_t polygon = 0;
    for (std::int64_t i = random.integer(0, 3); i > 0; --i) {
        const double x = whole(random, 1, kSize - 12);
        const double y = whole(random, 1, kSize - 12);
        const double z = has_z && random.integer(0, 1) == 0 ? whole(random, 0, 10) : kDraped;
        lines.push_back(rectangle(LineRole::Lake, polygon++, x, y, x + whole(random, 2, 10),
                                  y + whole(random, 2, 10), z));
    }
    if (random.integer(0, 2) == 0) {
        const double y = whole(random, 5, kSize - 10);
        std::vector<Point3> points;
        for (int x = 2; x <= kSize - 2; x += 4) {
            points.push_back(
                {static_cast<double>(x), y + whole(random, 0, 1), has_z ? whole(random, 0, 9) : kDraped});
        }
        for (int x = kSize - 2; x >= 2; x -= 4) {
            points.push_back(
                {static_cast<double>(x), y + 4 + whole(random, 0, 1), has_z ? whole(random, 0, 9) : kDraped});
        }
        lines.push_back(ring(LineRole::Bank, polygon++, points));
    }
    return lines;
}

WaterOptions random_options(Random& random) {
    WaterOptions options;
    options.keeps_faults = true;
    options.flow = random.integer(0, 1) == 0 ? FlowRule::Digitized : FlowRule::Auto;
    options.river_fit = random.integer(0, 2) == 0 ? RiverFit::Min : RiverFit::Isotonic;
    options.shore_width = 2;
    return options;
}

// Reaches never rise, and where they meet they agree.
void check_reaches(const Water& water) {
    std::map<std::pair<double, double>, double> level_at;
    for (const Reach& reach : water.report.reaches) {
        for (std::size_t i = 0; i < reach.points.size(); ++i) {
            const Point3& point = reach.points[i];
            REQUIRE(std::isfinite(point.z));
            if (i > 0) {
                CHECK(point.z <= reach.points[i - 1].z);
            }
            if (!reach.is_between_banks) {
                const auto [place, is_new] = level_at.try_emplace({point.x, point.y}, point.z);
                CHECK(place->second == point.z);
            }
        }
    }
}

}  // namespace

TEST_SUITE("water/water") {
    TEST_CASE("random networks run downhill everywhere, and lakes are level in the TIN") {
        const int count = cases(300);
        for (int seed = 0; seed < count; ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const bool has_z = random.integer(0, 2) > 0;
            const std::vector<Breakline> lines = random_water(random, has_z);
            const auto samples = lattice_samples(0, 0, kSize, kSize, 3, [&random](double x, double y) {
                return 20 - x / 8 + y / 16 + whole(random, 0, 8) / 8;
            });
            const bool has_own_lakes = std::any_of(lines.begin(), lines.end(), [](const Breakline& line) {
                return line.role == LineRole::Lake && !std::isnan(line.points.front().z);
            });
            const Water water = level_water(samples, lines, random_options(random));
            // Lakes with levels of their own may be out of order: rivers between them cannot fall.
            const auto counts = count_findings(water.report.findings);
            const bool can_fall =
                !has_own_lakes || counts[static_cast<std::size_t>(WaterFinding::Kind::LakesOutOfOrder)] == 0;
            const bool overlaps = counts[static_cast<std::size_t>(WaterFinding::Kind::WaterOverlaps)] > 0;
            if (can_fall) {
                check_reaches(water);
            }
            if (overlaps) {
                continue;
            }
            Triangulated made;
            TriangulateOptions options;
            options.duplicates.policy = DuplicatePolicy::Mean;
            REQUIRE_NOTHROW(made = triangulate(samples, water.lines, options));
            const std::vector<bool> is_water = find_water_faces(made.tin, water.lines);
            std::map<std::uint32_t, double> level_of;  // by line
            for (const LakeLevel& lake : water.report.lakes) {
                level_of[lake.line] = lake.level;
            }
            for (const LineTrace& trace : made.tin.traces) {
                const auto level = level_of.find(trace.line);
                if (level != level_of.end()) {
                    CHECK(made.tin.z[trace.a.value] == level->second);
                    CHECK(made.tin.z[trace.b.value] == level->second);
                }
                if (water.lines[trace.line].role == LineRole::Section) {
                    CHECK(made.tin.z[trace.a.value] == made.tin.z[trace.b.value]);
                }
            }
            CHECK(is_water.empty() == std::none_of(lines.begin(), lines.end(), [](const Breakline& line) {
                      return is_cleared_role(line.role);
                  }));
        }
    }

    TEST_CASE(
        "levels do not depend on the order of lines and samples, nor, where the flow is found, on "
        "directions") {
        const int count = cases(60);
        for (int seed = 0; seed < count; ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed) + 1000);
            const std::vector<Breakline> lines = random_water(random, seed % 2 == 0);
            auto samples = lattice_samples(0, 0, kSize, kSize, 3, [&random](double x, double y) {
                return 20 - x / 8 + y / 16 + whole(random, 0, 8) / 8;
            });
            const WaterOptions options = random_options(random);
            const Water water = level_water(samples, lines, options);
            std::vector<std::uint32_t> order;
            for (std::uint32_t i = 0; i < lines.size(); ++i) {
                order.push_back(i);
            }
            order = shuffled(random, order);
            std::vector<Breakline> mixed;
            for (const std::uint32_t i : order) {
                mixed.push_back(lines[i]);
            }
            const Water again = level_water(shuffled(random, samples), mixed, options);
            for (std::size_t i = 0; i < order.size(); ++i) {
                const std::vector<Point3>& before = water.lines[order[i]].points;
                const std::vector<Point3>& after = again.lines[i].points;
                REQUIRE(before.size() == after.size());
                for (std::size_t k = 0; k < before.size(); ++k) {
                    CHECK(before[k].x == after[k].x);
                    CHECK(before[k].z == doctest::Approx(after[k].z).epsilon(1e-9));
                }
            }
        }
    }

    TEST_CASE("rivers that end on shores up to the rounding of doubles can be triangulated") {
        std::size_t near = 0;  // points of water that the lattice hardly tells apart
        for (int k = 0; k < 20; ++k) {
            CAPTURE(k);
            const double angle = 0.1 + 0.07 * k;
            const auto turn = [angle](const Point3& p) {
                return Point3{500000 + std::cos(angle) * p.x - std::sin(angle) * p.y,
                              6000000 + std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
            };
            auto samples = lattice_samples(0, 0, kSize, kSize, 3,
                                           [](double x, double y) { return 20 - x / 8 + y / 16; });
            std::transform(samples.begin(), samples.end(), samples.begin(), turn);
            std::vector<Breakline> lines = {rectangle(LineRole::Lake, 0, 10, 10, 24, 31, 12),
                                            rectangle(LineRole::Bank, 1, 30, 20, 58, 27, kDraped),
                                            river({{1, 20, kDraped}, {10, 20.5, kDraped}}),
                                            river({{24, 20.5, kDraped}, {30, 23.5, kDraped}}),
                                            river({{41, 41, kDraped}, {44, 27, kDraped}})};
            for (Breakline& line : lines) {
                std::transform(line.points.begin(), line.points.end(), line.points.begin(), turn);
            }
            const Water water = level_water(samples, lines);
            for (const Breakline& line : water.lines) {
                for (std::size_t i = 1; i < line.points.size(); ++i) {
                    near += std::hypot(line.points[i].x - line.points[i - 1].x,
                                       line.points[i].y - line.points[i - 1].y) < 5e-8
                                ? 1U
                                : 0U;
                }
            }
            CHECK_NOTHROW(triangulate(samples, water.lines));
        }
        CHECK(near > 0);
    }
}
