#include "tinwright/breaklines/breakline.hpp"

#include <string>

#include <doctest/doctest.h>

using tinwright::LineRole;

TEST_SUITE("breaklines/breakline") {
    TEST_CASE("every role has a name of its own, and water is told from the rest") {
        CHECK(std::string(role_name(LineRole::Lake)) == "lake");
        CHECK(std::string(role_name(LineRole::Section)) == "section");
        CHECK(is_water_role(LineRole::River));
        CHECK_FALSE(is_water_role(LineRole::Hole));
        CHECK_FALSE(is_polygon_role(LineRole::River));
        CHECK(is_polygon_role(LineRole::Bank));
        CHECK(is_cleared_role(LineRole::Lake));
        CHECK_FALSE(is_cleared_role(LineRole::Boundary));
    }
}
