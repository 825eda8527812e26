#include "tinwright/io/cell_centers.hpp"

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <doctest/doctest.h>

using tinwright::io::CellCenters;

namespace {

/// The decimal thousandths / 1000 as a double, by the C library.
double decimal(long long ten_thousandths) {
    const std::string sign = ten_thousandths < 0 ? "-" : "";
    const std::string digits = std::to_string(std::llabs(ten_thousandths));
    return std::strtod((sign + digits + "e-4").c_str(), nullptr);
}

}  // namespace

TEST_SUITE("io/cell_centers") {
    TEST_CASE("centres of decimal rasters are the correctly rounded decimals") {
        constexpr unsigned seed = 3;
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        for (int i = 0; i < 20000; ++i) {
            // Origin and steps in thousandths, so that half cells are in ten-thousandths (of 5).
            const auto west = static_cast<long long>(random() % 2000000000) - 1000000000;
            const auto north = static_cast<long long>(random() % 9000000000);
            const auto width = static_cast<long long>(random() % 5000) + 1;
            const auto height = static_cast<long long>(random() % 5000) + 1;
            const auto shear = i % 2 == 0 ? 0LL : static_cast<long long>(random() % 700);
            const CellCenters centers({decimal(10 * west), decimal(10 * width), decimal(10 * shear),
                                       decimal(10 * north), decimal(-10 * shear), decimal(-10 * height)},
                                      20000);
            REQUIRE(centers.are_decimal());
            const auto column = static_cast<int>(random() % 20000);
            const auto row = static_cast<int>(random() % 20000);
            const auto p = centers.center(column, row);
            REQUIRE(p.x == decimal(10 * west + 5 * ((2LL * column + 1) * width + (2LL * row + 1) * shear)));
            REQUIRE(p.y == decimal(10 * north - 5 * ((2LL * column + 1) * shear + (2LL * row + 1) * height)));
        }
    }

    TEST_CASE("other rasters are within a rounding or two") {
        const CellCenters centers({-84.4, 1.0 / 1200, 0, 36.7, 0, -1.0 / 1200}, 400);
        CHECK_FALSE(centers.are_decimal());
        CHECK(std::abs(centers.center(10, 20).x - (-84.4 + 10.5 / 1200)) < 1e-13);
        CHECK(std::abs(centers.center(10, 20).y - (36.7 - 20.5 / 1200)) < 1e-13);
    }
}
