#include "tinwright/io/cell_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/coordinate_transform.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright::io;
using namespace tinwright_tests;

namespace {

/// A raster's system, a plane, and where in degrees of the raster's geographic system the raster is.
struct Pair {
    const char* grid_crs;
    const char* plane;
    double west, east, south, north;
};

constexpr auto kPairs = std::to_array<Pair>({
    {"EPSG:4326", "EPSG:32631", 0, 6, -75, 80},      // a zone of UTM
    {"EPSG:4326", "EPSG:32732", 4, 14, -70, -1},     // and beyond its borders
    {"EPSG:4326", "EPSG:3857", -170, 170, -75, 75},  //
    {"EPSG:4326", "EPSG:2154", -4, 9, 42, 51},       // conic
    {"EPSG:4258", "EPSG:3035", -10, 40, 35, 70},     // equal area
    {"EPSG:4326", "EPSG:3413", -180, 180, 61, 89},   // polar
    {"EPSG:4326", "EPSG:3031", -180, 180, -89, -65},
    {"EPSG:4326", "EPSG:32601", 177, 183, -70, 70},  // over the antimeridian, longitudes past 180
    {"EPSG:4326", "EPSG:32660", -183, -177, -70, 70},
    {"EPSG:3857", "EPSG:32633", 12, 18, -60, 70},
    {"EPSG:2154", "EPSG:32631", 0, 6, 43, 50},
    {"EPSG:27572", "EPSG:2154", -3, 7, 43, 50},   // by a grid of shifts: pieces with creases between
    {"EPSG:4807", "EPSG:27572", -3, 5, 43, 50},   // grads from Paris
    {"EPSG:32631", "EPSG:32632", 4, 8, -70, 75},  // neighbours
    {"EPSG:3413", "EPSG:32622", -54, -48, 62, 82},
    {"EPSG:3035", "EPSG:3857", -10, 35, 36, 68},
});

std::size_t index_of(const GridGeometry& grid, std::int64_t row, std::int64_t column) {
    return static_cast<std::size_t>(row * grid.columns + column);
}

std::vector<CellPlace> places_of(const GridGeometry& grid, const FindCellPlaces& find) {
    std::vector<CellPlace> places(static_cast<std::size_t>(grid.columns * grid.rows));
    for (std::int64_t row = 0; row < grid.rows; ++row) {
        find(row, 0,
             std::span(places).subspan(index_of(grid, row, 0), static_cast<std::size_t>(grid.columns)));
    }
    return places;
}

/// A raster of cells of about so many metres somewhere in the pair's area.
GridGeometry raster_in(const Pair& pair, double metres, Random& random) {
    const Crs crs = Crs::parse(pair.grid_crs);
    const Point2 at{pair.west + random.real() * (pair.east - pair.west),
                    pair.south + random.real() * (pair.north - pair.south)};
    GridGeometry grid;
    grid.columns = random.integer(1, 400);
    grid.rows = random.integer(1, 300);
    Point2 center = at;
    double size = metres;
    if (crs.is_geographic()) {
        const double unit = std::string(pair.grid_crs) == "EPSG:4807" ? 0.9 : 1;
        size = metres / 111111 / unit;
        center = {at.x / unit, at.y / unit};
    } else {
        std::array<Point2, 1> position{at};
        CoordinateTransform(crs.geographic(), crs).forward(position);
        center = position[0];
    }
    grid.cell_width = size;
    grid.cell_height = random.integer(0, 2) == 0 ? 0.6 * size : size;
    grid.x_min = center.x - 0.5 * static_cast<double>(grid.columns) * grid.cell_width;
    grid.y_max = center.y + 0.5 * static_cast<double>(grid.rows) * grid.cell_height;
    return grid;
}

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// How far places are off, in units of what is promised; `nowhere` counts those that are said to be so.
struct Misses {
    double position = 0;
    double north = 0;  // radians, of cells that are not at a pole
    std::size_t nowhere = 0;
};

Misses find_misses(const GridGeometry& grid, const std::vector<CellPlace>& places,
                   const CoordinateTransform& transform) {
    Misses misses;
    std::vector<Point2> exact;
    for (std::int64_t row = 0; row < grid.rows; ++row) {
        exact.clear();
        for (std::int64_t column = 0; column < grid.columns; ++column) {
            const Point2 c = grid.centre(column, row);
            const double w = grid.cell_width;
            const double h = grid.cell_height;
            // The centre; a hundredth of a cell around it.
            exact.insert(
                exact.end(),
                {c, {c.x - w / 200, c.y}, {c.x + w / 200, c.y}, {c.x, c.y - h / 200}, {c.x, c.y + h / 200}});
        }
        transform.forward(exact);
        for (std::int64_t column = 0; column < grid.columns; ++column) {
            const CellPlace& place = places[index_of(grid, row, column)];
            const auto i = 5 * static_cast<std::size_t>(column);
            const bool is_nowhere = !std::isfinite(exact[i].x) || !std::isfinite(exact[i].y);
            REQUIRE(is_nowhere == !(std::isfinite(place.position.x) && std::isfinite(place.position.y)));
            misses.nowhere += is_nowhere ? 1 : 0;
            const double width = 100 * distance(exact[i + 1], exact[i + 2]);
            const double height = 100 * distance(exact[i + 3], exact[i + 4]);
            if (is_nowhere || !std::isfinite(width + height)) {
                continue;
            }
            const double side = std::max(std::min(width, height), 0.01 * std::max(width, height));
            const double digits = 4 * std::numeric_limits<double>::epsilon() *
                                  std::max(std::abs(exact[i].x), std::abs(exact[i].y));
            misses.position = std::max(
                misses.position, distance(place.position, exact[i]) / (kCellPlaceError * side + digits));
            REQUIRE(std::abs(std::hypot(place.north.x, place.north.y) - 1) < 1e-14);
            const Point2 up{exact[i + 4].x - exact[i + 3].x, exact[i + 4].y - exact[i + 3].y};
            if (height / 100 > 1e3 * digits) {
                const double sine =
                    (place.north.x * up.y - place.north.y * up.x) / distance(exact[i + 3], exact[i + 4]);
                const double cosine = place.north.x * up.x + place.north.y * up.y;
                misses.north = std::max(misses.north, cosine > 0 ? std::abs(sine) : 4);
            }
        }
    }
    return misses;
}

std::vector<Point3> in_plane(const Crs& from, const Crs& plane, std::vector<Point3> points) {
    REQUIRE(CoordinateTransform(from, plane).forward(points).empty());
    return points;
}

Tin tin_in(const char* plane, const std::vector<Point3>& degrees) {
    std::vector<Point3> samples = in_plane(Crs::parse("EPSG:4326"), Crs::parse(plane), degrees);
    for (Point3& sample : samples) {
        sample = {std::round(sample.x * 1e3) / 1e3, std::round(sample.y * 1e3) / 1e3, sample.z};
    }
    return tin_of_samples(samples, DuplicatePolicy::First);
}

}  // namespace

TEST_SUITE("io/cell_places") {
    TEST_CASE("places are within the bound of exact ones, in all cells of rasters of any size anywhere") {
        double worst = 0;
        double worst_north = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(2)); ++seed) {
            Random random(seed);
            for (const Pair& pair : kPairs) {
                const CoordinateTransform transform(Crs::parse(pair.grid_crs), Crs::parse(pair.plane));
                for (const double metres : {0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0}) {
                    CAPTURE(seed);
                    CAPTURE(std::string(pair.grid_crs));
                    CAPTURE(std::string(pair.plane));
                    CAPTURE(metres);
                    // Large rasters reach beyond the grid of shifts, where another operation may be chosen.
                    if (std::string(pair.grid_crs) == "EPSG:27572" && metres > 100) {
                        continue;
                    }
                    const GridGeometry grid = raster_in(pair, metres, random);
                    const FindCellPlaces find =
                        make_cell_places(grid, Crs::parse(pair.grid_crs), Crs::parse(pair.plane));
                    const Misses misses = find_misses(grid, places_of(grid, find), transform);
                    CHECK(misses.position <= 1);
                    if (std::string(pair.grid_crs) != "EPSG:27572") {
                        CHECK(misses.north < 1e-3);
                        worst_north = std::max(worst_north, misses.north);
                    }
                    worst = std::max(worst, misses.position);
                }
            }
        }
        MESSAGE("worst place: " << worst << " of the bound; worst north: " << worst_north << " rad");
    }

    TEST_CASE("rasters around a pole and past it are exact there and nowhere beyond") {
        for (const double cell : {0.5, 0.05}) {
            CAPTURE(cell);
            const GridGeometry grid{-180,
                                    91,
                                    cell,
                                    cell,
                                    static_cast<std::int64_t>(360 / cell),
                                    static_cast<std::int64_t>(2.5 / cell)};
            const Crs degrees = Crs::parse("EPSG:4326");
            const Crs plane = Crs::parse("EPSG:3413");
            const std::vector<CellPlace> places = places_of(grid, make_cell_places(grid, degrees, plane));
            const Misses misses = find_misses(grid, places, CoordinateTransform(degrees, plane));
            CHECK(misses.position <= 1);
            CHECK(misses.nowhere ==
                  static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(1 / cell));
            // To the pole from everywhere: the plane's middle.
            for (std::int64_t column = 0; column < grid.columns; ++column) {
                const CellPlace& place = places[index_of(grid, grid.rows - 1, column)];
                const double size = std::hypot(place.position.x, place.position.y);
                REQUIRE(place.north.x == doctest::Approx(-place.position.x / size).epsilon(1e-6));
                REQUIRE(place.north.y == doctest::Approx(-place.position.y / size).epsilon(1e-6));
            }
        }
    }

    TEST_CASE("what is asked for first, and by how many threads, changes nothing") {
        const Crs degrees = Crs::parse("EPSG:4326");
        const Crs plane = Crs::parse("EPSG:32631");
        const GridGeometry grid{2, 48, 0.0001, 0.0001, 1500, 3000};
        const std::vector<CellPlace> in_order = places_of(grid, make_cell_places(grid, degrees, plane));
        const FindCellPlaces find = make_cell_places(grid, degrees, plane);
        Random random(1);
        struct Part {
            std::int64_t row, first, count;
        };
        std::vector<Part> parts;
        for (int i = 0; i < 20000; ++i) {
            const std::int64_t first = random.integer(0, grid.columns - 1);
            parts.push_back({random.integer(0, grid.rows - 1), first,
                             random.integer(1, std::min<std::int64_t>(600, grid.columns - first))});
        }
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
        tbb::task_arena four(4);
        std::vector<char> is_same(parts.size());
        four.execute([&] {
            tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
                const auto [row, first, count] = parts[i];
                std::vector<CellPlace> places(static_cast<std::size_t>(count));
                find(row, first, places);
                is_same[i] = static_cast<char>(
                    std::equal(places.begin(), places.end(), in_order.begin() + row * grid.columns + first,
                               [](const CellPlace& a, const CellPlace& b) {
                                   return a.position.x == b.position.x && a.position.y == b.position.y &&
                                          a.north.x == b.north.x && a.north.y == b.north.y;
                               }));
            });
        });
        CHECK(std::count(is_same.begin(), is_same.end(), 0) == 0);
    }

    TEST_CASE("the way to the raster is the way back") {
        const Crs degrees = Crs::parse("EPSG:4326");
        const GridGeometry grid{179.5, 50, 0.01, 0.01, 100, 50};
        const RasterPlacing placing = make_raster_placing(grid, degrees, Crs::parse("EPSG:32601"));
        CHECK(placing.period == 360);
        const std::vector<CellPlace> places = places_of(grid, placing.find_places);
        for (std::int64_t row = 0; row < grid.rows; ++row) {
            for (std::int64_t column = 0; column < grid.columns; ++column) {
                std::array<Point2, 1> position{places[index_of(grid, row, column)].position};
                placing.to_raster(position);
                const Point2 center = grid.centre(column, row);
                REQUIRE(std::abs(std::remainder(position[0].x - center.x, 360)) < 1e-6);
                REQUIRE(std::abs(position[0].y - center.y) < 1e-6);
            }
        }
        CHECK(make_raster_placing(grid, Crs::parse("EPSG:4807"), Crs::parse("EPSG:27572")).period == 400);
        CHECK(
            make_raster_placing({500000, 5e6, 1, 1, 5, 5}, Crs::parse("EPSG:32631"), Crs::parse("EPSG:32632"))
                .period == 0);
    }
}

TEST_SUITE("io/grid_basis") {
    TEST_CASE("bounds hold the terrain closely, and the spacing is that of the ground") {
        Random random(3);
        std::vector<Point3> samples;
        for (int i = 0; i < 2000; ++i) {
            samples.push_back({9 + 0.1 * random.real(), 60 + 0.1 * random.real(), 0});
        }
        const Tin tin = tin_in("EPSG:32632", samples);
        const GridBasis basis = find_grid_basis(tin, Crs::parse("EPSG:32632"), Crs::parse("EPSG:4326"));
        double west = 200;
        double north = 0;
        for (const Point3& sample : samples) {
            west = std::min(west, sample.x);
            north = std::max(north, sample.y);
        }
        CHECK(basis.bounds.x_min <= west + 1e-8);
        CHECK(basis.bounds.x_min >= west - basis.spacing / 1000);
        // The border bulges beyond its vertices.
        CHECK(basis.bounds.y_max >= north - 1e-8);
        CHECK(basis.bounds.y_max == doctest::Approx(north).epsilon(1e-6));
        CHECK(basis.spacing == doctest::Approx(median_spacing(tin) / 111412).epsilon(2e-3));
        // Corners are decimals that can be read.
        CHECK(std::abs(basis.bounds.x_min * 1e9 - std::round(basis.bounds.x_min * 1e9)) < 1e-4);

        const GridBasis mercator = find_grid_basis(tin, Crs::parse("EPSG:32632"), Crs::parse("EPSG:3857"));
        CHECK(mercator.spacing == doctest::Approx(2 * median_spacing(tin)).epsilon(5e-3));
    }

    TEST_CASE("terrain across the antimeridian is in one piece") {
        std::vector<Point3> samples;
        for (double x = 179.5; x < 180.75; x += 0.125) {
            for (double y = -18; y < -17; y += 0.125) {
                samples.push_back({x > 180 ? x - 360 : x, y, 0});
            }
        }
        for (const char* const plane : {"EPSG:32701", "EPSG:32760"}) {
            const GridBasis basis =
                find_grid_basis(tin_in(plane, samples), Crs::parse(plane), Crs::parse("EPSG:4326"));
            // Meridians bend away from edges, on one side outward; else corners are the samples'.
            CHECK(basis.bounds.x_min <= 179.5);
            CHECK(basis.bounds.x_min > 179.49985);
            CHECK(basis.bounds.x_max >= 180.625);
            CHECK(basis.bounds.x_max < 180.62515);
            CHECK((basis.bounds.x_min == 179.5 || basis.bounds.x_max == 180.625));
            CHECK(basis.bounds.y_min == doctest::Approx(-18).epsilon(1e-4));
        }
    }

    TEST_CASE("terrain with a pole goes all around and up to it; with a hole there, up to the hole") {
        std::vector<Point3> samples;
        for (double radius = 1; radius <= 5; ++radius) {
            for (double x = -180; x < 180; x += 10) {
                samples.push_back({x, 90 - radius, 0});
            }
        }
        for (const bool is_south : {false, true}) {
            CAPTURE(is_south);
            const char* const plane = is_south ? "EPSG:32761" : "EPSG:32661";
            std::vector<Point3> there = samples;
            for (Point3& sample : there) {
                sample.y *= is_south ? -1 : 1;
            }
            Tin tin = tin_in(plane, there);
            const Crs degrees = Crs::parse("EPSG:4326");
            const GridBasis all = find_grid_basis(tin, Crs::parse(plane), degrees);
            const auto inward = [&](const Box& box) { return is_south ? -box.y_min : box.y_max; };
            const auto outward = [&](const Box& box) { return is_south ? -box.y_max : box.y_min; };
            CHECK(all.bounds.x_min == -180);
            CHECK(all.bounds.x_max == 180);
            CHECK(inward(all.bounds) == 90);
            CHECK(outward(all.bounds) == doctest::Approx(85).epsilon(1e-5));
            // Faces within the innermost ring are no terrain: the border is its chords.
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                bool is_inner = tin.mesh.is_terrain({f});
                for (unsigned i = 0; is_inner && i < 3; ++i) {
                    const Point3 p = tin.position(tin.mesh.vertex({f}, i));
                    is_inner = std::hypot(p.x - 2e6, p.y - 2e6) < 150000;
                }
                if (is_inner) {
                    tin.mesh.set_terrain({f}, false);
                }
            }
            const GridBasis ring = find_grid_basis(tin, Crs::parse(plane), degrees);
            CHECK(ring.bounds.x_min == -180);
            CHECK(ring.bounds.x_max == 180);
            CHECK(inward(ring.bounds) ==
                  doctest::Approx(90 - std::cos(5 * std::numbers::pi / 180)).epsilon(1e-4));
        }
    }

    TEST_CASE("terrain that a system cannot show is refused") {
        std::vector<Point3> samples{{0, 45, 0}, {1, 45, 0}, {0, 46, 0}};
        const Tin tin = tin_in("EPSG:32631", samples);
        try {
            find_grid_basis(tin, Crs::parse("EPSG:32631"),
                            Crs::parse("+proj=ortho +lat_0=0 +lon_0=180 +datum=WGS84"));
            FAIL("nothing was thrown");
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find("has a place in") != std::string::npos);
        }
    }
}
