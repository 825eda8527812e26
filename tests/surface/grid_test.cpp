#include "tinwright/surface/grid.hpp"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

Tin rectangle(double x_min, double y_min, double x_max, double y_max) {
    return tin_of_samples({{x_min, y_min, 0}, {x_max, y_min, 0}, {x_min, y_max, 0}, {x_max, y_max, 0}});
}

std::string refusal_of(const Tin& tin, const GridRequest& request) {
    return message_of<UsageError>([&] { choose_grid(tin, request); });
}

}  // namespace

TEST_SUITE("surface/grid") {
    TEST_CASE("the bounds grow to whole cells from the north-west corner") {
        const Tin tin = rectangle(1000.1, 2000, 1010.4, 2020);
        const GridGeometry grid = choose_grid(tin, {.resolution = Point2{3, 6}});
        CHECK(grid == GridGeometry{1000.1, 2020, 3, 6, 4, 4});
        CHECK(grid.extent() == Box{1000.1, 1996, 1012.1, 2020});
    }

    TEST_CASE("rounding noise adds no cell") {
        // 0.3 / 0.1 is above 3 in doubles, (1000.3 - 1000) / 0.1 below.
        CHECK(choose_grid(rectangle(0, 0, 0.3, 0.3), {.resolution = Point2{0.1, 0.1}}).columns == 3);
        CHECK(choose_grid(rectangle(1000, 0, 1000.3, 0.3), {.resolution = Point2{0.1, 0.1}}).columns == 3);
        CHECK(choose_grid(rectangle(0, 0, 0.31, 0.3), {.resolution = Point2{0.1, 0.1}}).columns == 4);
        // A third of a metre is no decimal number, three of them make the metre all the same.
        CHECK(choose_grid(rectangle(0, 0, 1, 1), {.resolution = Point2{1.0 / 3, 1.0 / 3}}).columns == 3);
    }

    TEST_CASE("an extent and a size give the resolution") {
        GridRequest request{.extent = Box{100.1, 0, 100.3, 5}, .size = GridRequest::Size{2, 10}};
        CHECK(choose_grid(rectangle(0, 0, 1, 1), request) == GridGeometry{100.1, 5, 0.1, 0.5, 2, 10});
        request.extent.reset();
        CHECK(choose_grid(rectangle(0, 0, 1, 1), request) == GridGeometry{0, 1, 0.5, 0.1, 2, 10});
    }

    TEST_CASE("a size and a resolution make the extent") {
        const GridRequest request{.resolution = Point2{2, 2}, .size = GridRequest::Size{7, 9}};
        CHECK(choose_grid(rectangle(5, 5, 6, 6), request) == GridGeometry{5, 6, 2, 2, 7, 9});
    }

    TEST_CASE("an aligned grid has its edges at multiples of the resolution") {
        const GridRequest request{.resolution = Point2{0.2, 0.2}, .align_to_resolution = true};
        CHECK(choose_grid(rectangle(-0.3, 0.1, 0.6, 0.7), request) ==
              GridGeometry{-0.4, 0.8, 0.2, 0.2, 5, 4});
        CHECK(choose_grid(rectangle(0.2, 0.4, 0.6, 0.8), request) == GridGeometry{0.2, 0.8, 0.2, 0.2, 2, 2});
    }

    TEST_CASE("half the median spacing is rounded to 1, 2 or 5 times a power of ten") {
        const auto resolution = [](double spacing) {
            std::vector<Point3> samples;
            for (int i = 0; i < 5; ++i) {
                for (int j = 0; j < 5; ++j) {
                    samples.push_back({i * spacing, j * spacing, 0});
                }
            }
            const Tin tin = tin_of_samples(samples);
            CHECK(median_spacing(tin) == doctest::Approx(spacing));
            return choose_grid(tin, {}).cell_width;
        };
        CHECK(resolution(10) == 5);
        CHECK(resolution(5) == 2);
        CHECK(resolution(2) == 1);
        CHECK(resolution(0.5) == 0.2);
        CHECK(resolution(15) == 10);
        CHECK(resolution(0.125) == 0.05);
    }

    TEST_CASE("requests that cannot be are refused in one line") {
        const Tin tin = rectangle(0, 0, 1, 1);
        CHECK(refusal_of(tin, {.align_to_resolution = true}) ==
              "--tap aligns the grid with multiples of the resolution; add --resolution");
        CHECK(refusal_of(tin, {.resolution = Point2{0, 1}}) == "--resolution 0 1 must be greater than zero");
        CHECK(refusal_of(tin, {.size = GridRequest::Size{0, 5}}) == "--size 0 5 must be at least 1 1");
        CHECK(refusal_of(tin, {.extent = Box{5, 0, 4, 1}}) ==
              "--extent 5 0 4 1 is empty; give xmin ymin xmax ymax with xmin < xmax and ymin < ymax");
        CHECK(refusal_of(tin, {.extent = Box{0, 0, 10, 10},
                               .resolution = Point2{1, 1},
                               .size = GridRequest::Size{5, 5}}) ==
              "--size 5 5 contradicts --extent and --resolution, which make 10 by 10 cells; drop one of the "
              "three");
        CHECK(refusal_of(tin, {.resolution = Point2{1e-12, 1}}) ==
              "a resolution of 1e-12 by 1 makes a raster of 1000000000000 by 1 cells, more than 2147483647 a "
              "side; "
              "give a coarser --resolution or a smaller --extent");
    }
}

TEST_SUITE("geometry/decimal") {
    TEST_CASE("a double means its shortest decimal") {
        const Decimal decimal = shortest_decimal(-1000.25);
        CHECK(decimal.digits == -100025);
        CHECK(decimal.exponent == -2);
        CHECK(shortest_decimal(3e8).digits == 3);
        CHECK(shortest_decimal(3e8).exponent == 8);
        CHECK(shortest_decimal(-0.0).digits == 0);
        CHECK(shortest_decimal(5e-324).exponent == -324);
    }

    TEST_CASE("scaling by a power of ten is rounded once") {
        CHECK(scaled_decimal(0.57, 2) == 57);  // 0.57 * 100 is not
        CHECK(scaled_decimal(0.07, 2) == 7);
        CHECK(scaled_decimal(57, -2) == 0.57);
        CHECK(from_steps(-123, -1) == -12.3);
        CHECK(from_steps(0, -400) == 0);
    }

    TEST_CASE("whole steps are exact or refused") {
        CHECK(whole_steps({5, 2}, 0) == std::optional<Int128>(500));
        CHECK(whole_steps({500, 0}, 2) == std::optional<Int128>(5));
        CHECK_FALSE(whole_steps({501, 0}, 2));
        CHECK_FALSE(whole_steps({501, 0}, -35));
    }
}
