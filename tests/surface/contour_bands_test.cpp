#include "tinwright/surface/contour_bands.hpp"

#include <set>
#include <utility>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/surface/contour.hpp"

#include "support/cases.hpp"
#include "surface/contour_pieces.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// Twice the area of a closed ring, exactly.
oracle::Rational twice_area(const BandRing& ring) {
    oracle::Rational sum = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        sum += oracle::Rational(ring[i - 1].x) * oracle::Rational(ring[i].y) -
               oracle::Rational(ring[i].x) * oracle::Rational(ring[i - 1].y);
    }
    return sum;
}

bool is_inside(const BandRing& ring, double x, double y) {
    bool inside = false;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        const Point2 a = ring[i - 1];
        const Point2 b = ring[i];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside;
}

bool is_inside(const BandPolygon& polygon, double x, double y) {
    bool inside = false;
    for (const BandRing& ring : polygon) {
        inside = inside != is_inside(ring, x, y);
    }
    return inside;
}

}  // namespace

TEST_SUITE("surface/contour_bands") {
    TEST_CASE("a pyramid has a frame and a square") {
        const Tin tin = tin_of_samples({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 2}});
        const std::vector<double> levels{1};
        const std::vector<Band> bands = make_bands(tin, levels);
        REQUIRE(bands.size() == 2);
        CHECK(bands[0].low == 0);
        CHECK(bands[0].high == 1);
        CHECK(bands[1].low == 1);
        CHECK(bands[1].high == 2);
        REQUIRE(bands[0].polygons.size() == 1);
        CHECK(bands[0].polygons[0] == BandPolygon{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}},
                                                  {{1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}});
        REQUIRE(bands[1].polygons.size() == 1);
        CHECK(bands[1].polygons[0] == BandPolygon{{{1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}}});
    }

    TEST_CASE("a level valley at the level leaves no slit") {
        // The valley runs along y = 1 between two slopes, all above it.
        const Tin tin = tin_of_samples({{0, 0, 2}, {3, 0, 2}, {0, 2, 2}, {3, 2, 2}, {1, 1, 1}, {2, 1, 1}});
        const std::vector<double> levels{1};
        const std::vector<Band> bands = make_bands(tin, levels);
        REQUIRE(bands.size() == 1);
        REQUIRE(bands[0].polygons.size() == 1);
        CHECK(bands[0].polygons[0] == BandPolygon{{{0, 0}, {3, 0}, {3, 2}, {0, 2}, {0, 0}}});
        CHECK(make_contours(tin, levels)[0].count() == 1);  // once around the valley's floor
    }

    TEST_CASE("bands cover the terrain without gap or overlap, and each place is in its band") {
        for (int seed = 0; seed < cases(400); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = contour_tin(random, static_cast<std::size_t>(seed));
            if (tin.vertex_count() == 0 || tin.mesh.count_terrain() == 0) {
                continue;
            }
            const std::vector<double> levels = contour_levels_for(random, tin);
            const std::vector<Band> bands = make_bands(tin, levels);
            oracle::Rational terrain = 0;
            for (const auto& face : terrain_of(tin.mesh)) {
                BandRing ring;
                double x = 0;
                double y = 0;
                double z = 0;
                std::array<double, 3> shares{0.05 + random.real(), 0.05 + random.real(),
                                             0.05 + random.real()};
                const double sum = shares[0] + shares[1] + shares[2];
                for (std::size_t i = 0; i < 3; ++i) {
                    const Point3 p = tin.position({face[i]});
                    ring.push_back({p.x, p.y});
                    x += shares[i] / sum * p.x;
                    y += shares[i] / sum * p.y;
                    z += shares[i] / sum * p.z;
                }
                ring.push_back(ring.front());
                terrain += twice_area(ring);
                std::size_t holders = 0;
                for (const Band& band : bands) {
                    for (const BandPolygon& polygon : band.polygons) {
                        if (is_inside(polygon, x, y)) {
                            ++holders;
                            CHECK(z >= band.low - 1e-9 * (1 + std::abs(z)));
                            CHECK(z <= band.high + 1e-9 * (1 + std::abs(z)));
                        }
                    }
                }
                CHECK(holders == 1);
            }
            oracle::Rational covered = 0;
            for (const Band& band : bands) {
                for (const BandPolygon& polygon : band.polygons) {
                    for (std::size_t i = 0; i < polygon.size(); ++i) {
                        const oracle::Rational area = twice_area(polygon[i]);
                        CHECK((area > 0) == (i == 0));
                        covered += area;
                    }
                }
            }
            // Only crossings of the border may be off it, by the rounding of their coordinates.
            const double extent = extent_of(tin);
            const auto off = static_cast<double>(oracle::Rational(covered - terrain));
            CHECK(std::abs(off) <= 1e-14 * extent * extent);
        }
    }

    TEST_CASE("rings repeat no point, and every inner side is the other way round in another band or part") {
        for (int seed = 0; seed < cases(200); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = contour_tin(random, static_cast<std::size_t>(seed));
            if (tin.vertex_count() == 0) {
                continue;
            }
            using Ends = std::array<double, 4>;
            std::multiset<Ends> sides;
            std::size_t repeated = 0;
            for (const Band& band : make_bands(tin, contour_levels_for(random, tin))) {
                for (const BandPolygon& polygon : band.polygons) {
                    for (const BandRing& ring : polygon) {
                        CHECK(ring.size() >= 4);
                        CHECK(ring.front() == ring.back());
                        std::set<std::pair<double, double>> points;
                        for (std::size_t i = 1; i < ring.size(); ++i) {
                            repeated += points.emplace(ring[i].x, ring[i].y).second ? 0U : 1U;
                            sides.insert({ring[i - 1].x, ring[i - 1].y, ring[i].x, ring[i].y});
                        }
                    }
                }
            }
            CHECK(repeated == 0);
            // What has no opposite is on the border: as many sides as the border has edges and crossings,
            // each within a border edge.
            for (const Ends& side : sides) {
                CHECK(sides.count(side) == 1);
                if (sides.contains({side[2], side[3], side[0], side[1]})) {
                    continue;
                }
                const double x = (side[0] + side[2]) / 2;
                const double y = (side[1] + side[3]) / 2;
                bool is_on_border = false;
                for (std::uint32_t h = 0; h < 4 * tin.mesh.slot_count(); ++h) {
                    if (h % 4 == 3 || !tin.mesh.is_border({h})) {
                        continue;
                    }
                    const Point3 a = tin.position(tin.mesh.origin({h}));
                    const Point3 b = tin.position(tin.mesh.destination({h}));
                    const double length = std::hypot(b.x - a.x, b.y - a.y);
                    const double off = std::abs((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / length;
                    const double along = ((b.x - a.x) * (x - a.x) + (b.y - a.y) * (y - a.y)) / length;
                    const double slack = 1e-9 * (1 + std::abs(x) + std::abs(y));
                    is_on_border =
                        is_on_border || (off <= slack && along >= -slack && along <= length + slack);
                }
                CHECK(is_on_border);
            }
        }
    }

    TEST_CASE("the bands do not depend on the order of faces or on threads") {
        for (int seed = 0; seed < cases(30); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = tied_grid(random, 9, 7, 3);
            std::vector<std::uint32_t> corners;
            for (const auto& face : terrain_of(tin.mesh)) {
                corners.insert(corners.end(), face.begin(), face.end());
            }
            Tin other = tin;
            other.mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
            const std::vector<double> levels{0, 0.5, 1, 2, 2.25};
            const std::vector<Band> expected = make_bands(tin, levels);
            std::vector<Band> found;
            tbb::task_arena arena(1);
            arena.execute([&] { found = make_bands(other, levels); });
            REQUIRE(found.size() == expected.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                CHECK(found[i].polygons == expected[i].polygons);
            }
        }
    }
}
