#include "tinwright/surface/smooth.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/smooth_reader.hpp"
#include "tinwright/surface/spline_store.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Terrain = std::function<double(double x, double y)>;

double hill(double x, double y) { return 50 * std::sin(x / 40) * std::cos(y / 55) + 0.1 * x; }

/// Samples of a terrain on a square 200 wide, its corners among them, in UTM metres where `is_far`.
std::vector<Point3> samples_of(Random& random, const Terrain& terrain, int count, bool is_far = false) {
    std::vector<Point3> samples;
    const double east = is_far ? 500000 : 0;
    const double north = is_far ? 5400000 : 0;
    for (int i = 0; i < count; ++i) {
        double x = std::round(20000 * random.real()) / 100;
        double y = std::round(20000 * random.real()) / 100;
        if (i < 4) {
            x = i % 2 == 0 ? 0 : 200;
            y = i < 2 ? 0 : 200;
        }
        samples.push_back({east + x, north + y, terrain(x, y)});
    }
    return samples;
}

Tin tin_with(const std::vector<Point3>& samples, const std::vector<Breakline>& lines) {
    TriangulateOptions options;
    options.duplicates.policy = DuplicatePolicy::Mean;
    return triangulate(samples, lines, options).tin;
}

struct Surface {
    SharpEdges sharp;
    SurfaceLocator locator;
    std::unique_ptr<Interpolator> interpolator;
    std::unique_ptr<SurfaceReader> reader;

    explicit Surface(const Tin& tin, const SmoothOptions& options = {}, bool are_lines_sharp = true)
        : sharp(tin, std::vector<bool>(64, are_lines_sharp)),
          locator(tin),
          interpolator(make_smooth(tin, sharp, options)),
          reader(interpolator->make_reader()) {}

    [[nodiscard]] double z(double x, double y) const {
        const auto place = locator.find(Point2{x, y});
        REQUIRE(place.has_value());
        return reader->elevation(*place);
    }
};

/// The same place as seen from the other face at one of its edges: `share` of the way along it.
struct EdgePlace {
    SurfacePlace near;
    SurfacePlace far;
};
std::vector<EdgePlace> places_on_inner_edges(const Tin& tin, const SharpEdges& sharp) {
    const QueryLattice lattice(tin);
    std::vector<EdgePlace> places;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const FaceId beyond = face_of(tin.mesh.twin(h));
            if (tin.mesh.is_terrain({f}) && tin.mesh.is_terrain(beyond) && !sharp.is_sharp(h)) {
                const Key2 a = lattice.scaled(tin.key(tin.mesh.origin(h)));
                const Key2 b = lattice.scaled(tin.key(tin.mesh.destination(h)));
                const Key2 at{std::nearbyint(0.7 * a.x + 0.3 * b.x), std::nearbyint(0.7 * a.y + 0.3 * b.y)};
                places.push_back({{{f}, at}, {beyond, at}});
            }
        }
    }
    return places;
}

std::string refusal(const SmoothOptions& options) {
    return message_of<UsageError>([&] { check_smooth(options); });
}

}  // namespace

TEST_SUITE("surface/smooth") {
    TEST_CASE("errors on a smooth terrain fall about with the square of the spacing") {
        for (const bool is_c1 : {false, true}) {
            CAPTURE(is_c1);
            std::array<double, 2> errors{};
            for (const std::size_t step : {std::size_t{0}, std::size_t{1}}) {
                const int side = step == 0 ? 17 : 33;
                Random random(3);
                std::vector<Point3> samples;
                for (int i = 0; i < side * side; ++i) {
                    const double spacing = 200.0 / (side - 1);
                    const auto shift = [&](int k) {
                        const bool is_rim = k == 0 || k == side - 1;
                        return spacing * (k + (is_rim ? 0 : 0.4 * (random.real() - 0.5)));
                    };
                    const double x = shift(i % side);
                    const double y = shift(i / side);
                    samples.push_back({x, y, hill(x, y)});
                }
                const Tin tin = tin_with(samples, {});
                SmoothOptions options;
                options.is_c1 = is_c1;
                const Surface surface(tin, options);
                for (int i = 0; i < 400; ++i) {
                    const double x = 60 + 80 * random.real();
                    const double y = 60 + 80 * random.real();
                    errors[step] += std::pow(surface.z(x, y) - hill(x, y), 2);
                }
            }
            CHECK(std::sqrt(errors[0] / errors[1]) > 3.5);
        }
    }

    TEST_CASE("the surface is nearer to its vertices than any tolerance asks, beside them too") {
        for (int seed = 1; seed <= cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = tin_with(samples_of(random, hill, 200, true), {});
            const QueryLattice lattice(tin);
            SmoothOptions options;
            options.is_c1 = seed % 2 == 0;
            const Surface surface(tin, options);
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                    const VertexId v = tin.mesh.vertex({f}, i);
                    const Key2 key = lattice.scaled(tin.key(v));
                    REQUIRE(surface.reader->elevation({{f}, key}) == tin.z[v.value]);
                    const Key2 beside{key.x + 1, key.y - 1};
                    REQUIRE(std::abs(surface.reader->elevation({{f}, beside}) - tin.z[v.value]) < 1e-7);
                }
            }
        }
    }

    TEST_CASE("smooth:c1 has one gradient on both sides of an edge, smooth has one elevation") {
        for (int seed = 1; seed <= cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = tin_with(samples_of(random, hill, 300), {});
            SmoothOptions options;
            options.guard = std::numeric_limits<double>::infinity();
            const Surface creased(tin, options);
            options.is_c1 = true;
            const Surface surface(tin, options);
            std::size_t jumps = 0;
            const std::vector<EdgePlace> places = places_on_inner_edges(tin, surface.sharp);
            for (const EdgePlace& place : places) {
                const SurfaceReading near = surface.reader->read(place.near);
                const SurfaceReading far = surface.reader->read(place.far);
                REQUIRE(std::abs(near.z - far.z) < 1e-9);
                REQUIRE(std::abs(creased.reader->elevation(place.near) -
                                 creased.reader->elevation(place.far)) < 1e-9);
                const double jump =
                    std::hypot(near.gradient.x - far.gradient.x, near.gradient.y - far.gradient.y);
                jumps += jump > 1e-6 ? 1 : 0;
            }
            CHECK(jumps * 200 <= places.size());  // an edge far shorter than the faces at it are long
        }
    }

    TEST_CASE("a guard of zero keeps the surface within the samples, none lets it out") {
        Random random(8);
        const Tin tin = tin_with(samples_of(
                                     random, [](double x, double) { return x < 100 ? 0.0 : 10.0; }, 400),
                                 {});
        SmoothOptions options;
        options.guard = 0;
        const Surface guarded(tin, options);
        options.guard = std::numeric_limits<double>::infinity();
        const Surface free(tin, options);
        double lowest = 0;
        for (int i = 0; i < 2000; ++i) {
            const double x = 80 + 40 * random.real();
            const double y = 200 * random.real();
            const double z = guarded.z(x, y);
            REQUIRE(z >= -1e-12);
            REQUIRE(z <= 10 + 1e-12);
            lowest = std::min(lowest, free.z(x, y));
        }
        CHECK(lowest < -0.1);
    }

    TEST_CASE("sharp lines stay straight, and nothing on one side changes the other") {
        const Breakline ridge{{{0, 100, 20}, {70, 100, 26}, {200, 100, 40}}};
        for (const bool is_c1 : {false, true}) {
            CAPTURE(is_c1);
            Random random(4);
            std::vector<Point3> samples = samples_of(random, hill, 300);
            std::erase_if(samples, [](const Point3& p) { return p.y == 100; });
            const Tin before = tin_with(samples, {ridge});
            for (Point3& p : samples) {
                p.z += p.y > 100 ? 30 * random.real() : 0;
            }
            const Tin after = tin_with(samples, {ridge});
            SmoothOptions options;
            options.is_c1 = is_c1;
            const Surface first(before, options);
            const Surface second(after, options);
            for (int i = 0; i < 500; ++i) {
                const double x = 200 * random.real();
                const double straight = x < 70 ? 20 + 6 * x / 70 : 26 + 14 * (x - 70) / 130;
                REQUIRE(std::abs(first.z(x, 100) - straight) < 1e-7);
                const double y = 100 * random.real();
                REQUIRE(first.z(x, y) == second.z(x, y));
            }
        }
    }

    TEST_CASE("a smooth line lets the surface look across") {
        const Breakline crest{{{0, 100, 20}, {200, 100, 40}}};
        Random random(4);
        std::vector<Point3> samples = samples_of(random, hill, 300);
        const Tin tin = tin_with(samples, {crest});
        const Surface sharp(tin, {});
        const Surface smooth(tin, {}, false);
        CHECK(std::abs(sharp.z(130, 90) - smooth.z(130, 90)) > 1e-3);
    }

    TEST_CASE("three or four samples make a surface, and so do samples in a row with one beside it") {
        const std::vector<Point3> three{{0, 0, 1}, {10, 0, 2}, {0, 10, 3}};
        const Tin triangle = tin_with(three, {});
        CHECK(Surface(triangle).z(2, 3) == doctest::Approx(1 + 0.2 + 0.6));
        std::vector<Point3> row;
        for (int i = 0; i < 40; ++i) {
            row.push_back({1.0 * i, 0, 1.0 * (i % 3)});
        }
        row.push_back({20, 1e-3, 5});
        const Tin needles = tin_with(row, {});
        const Surface surface(needles);
        for (int i = 0; i < 39; ++i) {
            const double z = surface.z(i + 0.5, 0);
            CHECK(z >= -1.25);
            CHECK(z <= 6.25);
        }
    }

    TEST_CASE("samples next to each other that disagree harm nobody far away") {
        Random random(9);
        std::vector<Point3> samples = samples_of(random, hill, 200);
        samples.push_back({100, 100, 0});
        samples.push_back({100.0001, 100, 20});
        samples.push_back({100, 100.0001, -20});
        const Tin tin = tin_with(samples, {});
        const Surface surface(tin);
        for (int i = 0; i < 500; ++i) {
            const double x = 200 * random.real();
            const double y = 200 * random.real();
            REQUIRE(std::abs(surface.z(x, y)) < 120);
        }
    }

    TEST_CASE(
        "splines are the same whenever they are fitted, dropped and fitted again, by one thread or two") {
        Random random(6);
        const Tin tin = tin_with(samples_of(random, hill, 1500), {});
        const SharpEdges sharp;
        const std::vector<HalfEdgeId> starts = find_spline_starts(tin.mesh);
        const SmoothOptions options;
        const SplineSources sources{tin, sharp, starts, options};
        const QueryLattice lattice(tin);
        const SurfaceLocator locator(tin);
        std::vector<SurfacePlace> places;
        for (int i = 0; i < 2000; ++i) {
            const auto place = locator.find(Point2{200 * random.real(), 200 * random.real()});
            REQUIRE(place.has_value());
            places.push_back(*place);
        }
        const auto read = [&](SplineStore& store, std::size_t first, std::size_t last) {
            SmoothReader reader(sources, lattice, store);
            std::vector<std::uint64_t> bits;
            for (std::size_t i = first; i < last; ++i) {
                bits.push_back(std::bit_cast<std::uint64_t>(reader.elevation(places[i])));
            }
            return bits;
        };
        SplineStore roomy(sources);
        const std::vector<std::uint64_t> expected = read(roomy, 0, places.size());
        SplineStore narrow(sources, 2);
        CHECK(read(narrow, 0, places.size()) == expected);
        SplineStore shared(sources, 3);
        std::array<std::vector<std::uint64_t>, 2> halves;
        tbb::task_arena arena(2);
        arena.execute([&] {
            tbb::parallel_for(0, 2, [&](int half) {
                const std::size_t middle = places.size() / 2;
                halves[static_cast<std::size_t>(half)] =
                    half == 0 ? read(shared, 0, middle) : read(shared, middle, places.size());
            });
        });
        halves[0].insert(halves[0].end(), halves[1].begin(), halves[1].end());
        CHECK(halves[0] == expected);
        CHECK(roomy.bytes() < 500 * tin.vertex_count());
    }

    TEST_CASE("the surface does not depend on the order of faces, hubs included") {
        Random random(7);
        std::vector<Point3> samples = samples_of(random, hill, 200);
        for (int i = 0; i < 400; ++i) {  // around a vertex in the middle
            const double angle = i * std::acos(-1.0) / 200;
            const double radius = 500 + 20 * random.real();
            samples.push_back({std::round(100 + radius * std::cos(angle)),
                               std::round(100 + radius * std::sin(angle)), radius});
        }
        std::erase_if(samples, [](const Point3& p) { return std::hypot(p.x - 100, p.y - 100) < 300; });
        samples.push_back({100, 100, 50});
        const Tin tin = tin_with(samples, {});
        std::vector<std::uint32_t> corners;
        for (const auto& face : terrain_of(tin.mesh)) {
            corners.insert(corners.end(), face.begin(), face.end());
        }
        Tin other = tin;
        other.mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
        const Surface surface(tin);
        const Surface of_other(other);
        for (int i = 0; i < 500; ++i) {
            const double x = 300 * random.real();
            const double y = 300 * random.real();
            REQUIRE(std::bit_cast<std::uint64_t>(surface.z(x, y)) ==
                    std::bit_cast<std::uint64_t>(of_other.z(x, y)));
        }
    }

    TEST_CASE("parts that touch in a point only know nothing of each other") {
        Random random(8);
        std::vector<Point3> samples{{200, 200, 0}};
        for (int i = 0; i < 80; ++i) {
            samples.push_back({std::round(200 * random.real()), std::round(200 * random.real()), 1});
        }
        for (int i = 0; i < 80; ++i) {
            const double x = 200 + std::round(200 * random.real());
            samples.push_back({x, 200 + std::round(200 * random.real()), x - 200});
        }
        Tin tin = tin_with(samples, {});
        std::vector<std::uint32_t> corners;
        for (const auto& face : terrain_of(tin.mesh)) {
            const auto in_part = [&](double sign) {
                return std::all_of(face.begin(), face.end(), [&](std::uint32_t v) {
                    const Point3 p = tin.position({v});
                    return sign * p.x >= sign * 200 && sign * p.y >= sign * 200;
                });
            };
            if (in_part(1) || in_part(-1)) {
                corners.insert(corners.end(), face.begin(), face.end());
            }
        }
        tin.mesh = mesh_of(tin.vertex_count(), corners);
        // The lower part is level, the upper one a plane: each as its own faces have it.
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
            const Point3 p = tin.position({v});
            tin.z[v] = p.x < 200 || p.y < 200 ? 0 : p.x - 200;
        }
        const Surface surface(tin);
        int read = 0;
        for (int i = 0; i < 2000; ++i) {
            const double x = 400 * random.real();
            const double y = 400 * random.real();
            if (surface.locator.find(Point2{x, y})) {
                ++read;
                REQUIRE(std::abs(surface.z(x, y) - (x < 200 ? 0 : x - 200)) < 1e-9);
            }
        }
        CHECK(read > 500);
    }

    TEST_CASE("options out of range are refused in words") {
        CHECK(refusal({}).empty());
        SmoothOptions options;
        options.neighbors = 7;
        CHECK(refusal(options) == "a smooth surface takes 8 to 200 neighbours of a vertex, not 7");
        options = {};
        options.guard = -0.5;
        CHECK(refusal(options) == "the guard of a smooth surface must be zero or more, or infinite for none");
        options.guard = std::numeric_limits<double>::quiet_NaN();
        CHECK_FALSE(refusal(options).empty());
        options = {};
        options.kernels.clear();
        CHECK(refusal(options) == "a smooth surface takes 1 to 32 kernels, not 0");
        for (const double exponent : {-1.0, 2.0, 4.0}) {
            options.kernels = {{exponent, 1, 1}};
            CHECK(refusal(options).find("the exponent of a kernel must be above 0, below 4 and not 2") == 0);
        }
        options.kernels = {{1.5, 0.5, 1}};
        CHECK(refusal(options) == "the stretch of a kernel must be from 1 to 1000, not 0.5");
        options.kernels = {{1.5, 1, 0}};
        CHECK(refusal(options) == "the handicap of a kernel must be a number above 0, not 0");
        options.kernels = {{1, 4, 1}};
        CHECK(refusal(options).empty());
        options.is_c1 = true;
        CHECK(refusal(options) ==
              "smooth:c1 needs a kernel with an exponent of 1.5 or more: smaller ones have a crease");
    }
}
