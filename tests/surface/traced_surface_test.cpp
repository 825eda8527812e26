#include "tinwright/surface/traced_surface.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/surface/contouring.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "surface/contour_pieces.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Formula = double (*)(double x, double y);

/// A surface given by a formula, whatever the TIN's faces.
class FormulaSurface : public Interpolator {
  public:
    FormulaSurface(const Tin& tin, Formula formula) : lattice_(tin), formula_(formula) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        class Reader : public SurfaceReader {
          public:
            explicit Reader(const FormulaSurface& surface) : surface_(surface) {}
            double elevation(const SurfacePlace& place) override {
                const Point2 p = surface_.lattice_.position(place.at);
                return surface_.formula_(p.x, p.y);
            }
            SurfaceReading read(const SurfacePlace& place) override { return {elevation(place), {}}; }
            void find_weights(const SurfacePlace& /*place*/, std::vector<VertexWeight>& weights) override {
                weights.clear();
            }

          private:
            const FormulaSurface& surface_;
        };
        return std::make_unique<Reader>(*this);
    }

  private:
    QueryLattice lattice_;
    Formula formula_;
};

double bowl(double x, double y) { return (x - 50) * (x - 50) / 100 + (y - 50) * (y - 50) / 100; }
double waves(double x, double y) { return 5 * std::sin(x / 7) * std::cos(y / 9) + x / 20; }

/// Places in a square of 100, with its corners, on a surface.
Tin tin_on(Random& random, std::size_t count, Formula formula) {
    std::vector<Point3> samples{{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
    for (const Point3& p : decimal_samples(random, count, 2, 0, 0, 100)) {
        samples.push_back(p);
    }
    for (Point3& p : samples) {
        p.x = std::min(100.0, std::max(0.0, p.x));
        p.y = std::min(100.0, std::max(0.0, p.y));
        p.z = formula(p.x, p.y);
    }
    return tin_of_samples(samples, DuplicatePolicy::First);
}

struct Worst {
    double at_points = 0;
    double at_middles = 0;
};

Worst worst_of(const Contours& contours, Formula formula) {
    Worst worst;
    for (std::size_t level = 0; level < contours.levels.size(); ++level) {
        const double z = contours.levels[level].elevation;
        for (std::size_t i = 0; i < contours.lines[level].count(); ++i) {
            const auto line = contours.lines[level].line(i);
            for (std::size_t k = 0; k < line.size(); ++k) {
                worst.at_points = std::max(worst.at_points, std::abs(formula(line[k].x, line[k].y) - z));
                if (k > 0) {
                    const double x = (line[k].x + line[k - 1].x) / 2;
                    const double y = (line[k].y + line[k - 1].y) / 2;
                    worst.at_middles = std::max(worst.at_middles, std::abs(formula(x, y) - z));
                }
            }
        }
    }
    return worst;
}

}  // namespace

TEST_SUITE("surface/traced_surface") {
    TEST_CASE("every point of every line, and the middle of each segment, is within the tolerance") {
        for (int seed = 0; seed < cases(6); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const Formula formula : {bowl, waves}) {
                const Tin tin = tin_on(random, 80, formula);
                const FormulaSurface surface(tin, formula);
                for (const double tolerance : {0.3, 0.02}) {
                    CAPTURE(tolerance);
                    ContourOptions options;
                    options.request.interval = 1;
                    options.surface = &surface;
                    options.is_surface_bounded = false;
                    options.tolerance = tolerance;
                    const Contours contours = contour(tin, options);
                    REQUIRE(contours.tracing.has_value());
                    CHECK(contours.tracing->unresolved == 0);
                    CHECK(contours.tracing->largest_error <= tolerance);
                    const Worst worst = worst_of(contours, formula);
                    CHECK(worst.at_points <= tolerance);
                    CHECK(worst.at_middles <= tolerance);
                    CHECK(worst.at_points > 0);
                }
            }
        }
    }

    TEST_CASE("levels below every vertex are found where the surface goes there") {
        // The bowl's bottom lies between the corners of the faces.
        const Tin tin =
            tin_of_samples({{0, 0, 50}, {100, 0, 50}, {100, 100, 50}, {0, 100, 50}, {50, 90, 16}});
        const FormulaSurface surface(tin, bowl);
        ContourOptions options;
        options.request.levels = {2};
        options.surface = &surface;
        options.is_surface_bounded = false;
        options.tolerance = 0.01;
        const Contours contours = contour(tin, options);
        REQUIRE(contours.lines.size() == 1);
        REQUIRE(contours.lines[0].count() == 1);
        const auto line = contours.lines[0].line(0);
        CHECK(line.front() == line.back());
        for (const Point2 p : line) {
            CHECK(std::hypot(p.x - 50, p.y - 50) == doctest::Approx(std::sqrt(200)).epsilon(0.005));
        }
    }

    TEST_CASE("the finer mesh is sound and covers what the TIN does") {
        for (int seed = 0; seed < cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = tin_on(random, 40, waves);
            if (seed % 2 == 1) {
                make_voids_at_random(random, tin, 4);
            }
            const FormulaSurface surface(tin, waves);
            const std::vector<double> levels{-2, 0, 1, 2.5};
            const TracedSurface traced = trace_surface(tin, surface, levels, 0.05);
            CHECK(check_mesh(traced.mesh).is_clean());
            CHECK(traced.vertices.size() == traced.mesh.vertex_count());
            CHECK(traced.mesh.count_terrain() > tin.mesh.count_terrain());
            const auto area_of = [](const TriangleMesh& mesh, const auto& position) {
                double area = 0;
                for (const auto& face : terrain_of(mesh)) {
                    const Point3 a = position(face[0]);
                    const Point3 b = position(face[1]);
                    const Point3 c = position(face[2]);
                    const double of_face = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                    CHECK(of_face > 0);
                    area += of_face / 2;
                }
                return area;
            };
            CHECK(area_of(traced.mesh, [&](std::uint32_t v) { return traced.vertices[v]; }) ==
                  doctest::Approx(area_of(tin.mesh, [&](std::uint32_t v) { return tin.position({v}); })));
        }
    }

    TEST_CASE("lines do not depend on the order of faces or on threads") {
        Random random(3);
        const Tin tin = tin_on(random, 60, waves);
        std::vector<std::uint32_t> corners;
        for (const auto& face : terrain_of(tin.mesh)) {
            corners.insert(corners.end(), face.begin(), face.end());
        }
        Tin other = tin;
        other.mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
        const FormulaSurface surface(tin, waves);
        ContourOptions options;
        options.request.interval = 1;
        options.surface = &surface;
        const Contours expected = contour(tin, options);
        options.threads = 1;
        const Contours found = contour(other, options);
        REQUIRE(found.lines.size() == expected.lines.size());
        for (std::size_t i = 0; i < found.lines.size(); ++i) {
            CHECK(found.lines[i].points == expected.lines[i].points);
        }
    }

    TEST_CASE("a tolerance is needed") {
        Random random(3);
        const Tin tin = tin_on(random, 10, bowl);
        const FormulaSurface surface(tin, bowl);
        const std::vector<double> levels{1};
        CHECK(message_of<UsageError>([&] { trace_surface(tin, surface, levels, 0); }) ==
              "the tolerance of contours must be above zero, not 0");
    }
}
