#include "option_values.hpp"

#include <cmath>

#include <doctest/doctest.h>

using namespace tinwright;
using namespace tinwright::tools;

TEST_SUITE("tools/option_values") {
    TEST_CASE("a number is the whole text or nothing") {
        CHECK(find_number("5") == 5.0);
        CHECK(find_number("-1e3") == -1000.0);
        CHECK(find_number("+.5") == 0.5);
        CHECK(std::isnan(find_number("nan").value()));
        CHECK_FALSE(find_number("").has_value());
        CHECK_FALSE(find_number("5m").has_value());
        CHECK_FALSE(find_number(" 5").has_value());
        CHECK_FALSE(find_number("+-5").has_value());
        CHECK_FALSE(find_number("1e999").has_value());
    }

    TEST_CASE("errors name the option and quote the text") {
        CHECK_THROWS_WITH_AS(number_value("--x", "a\nb"), "--x needs a number, not \"a\\nb\"", UsageError);
        CHECK_THROWS_WITH_AS(number_value("--x", "inf"), "--x needs a number, not \"inf\"", UsageError);
        CHECK_THROWS_WITH_AS(positive_value("--x", "0"), "--x needs a number above zero, not \"0\"",
                             UsageError);
        CHECK_THROWS_WITH_AS(whole_value("--x", "1.5", 0), "--x needs a whole number from 0 up, not \"1.5\"",
                             UsageError);
        CHECK_THROWS_WITH_AS(whole_value("--x", "99999999999", 0),
                             "--x needs a whole number from 0 up, not \"99999999999\"", UsageError);
    }

    TEST_CASE("a choice names what there is") {
        constexpr auto kChoices =
            std::to_array<std::pair<std::string_view, int>>({{"a", 1}, {"b", 2}, {"c", 3}});
        CHECK(choice_value("--x", "b", kChoices) == 2);
        CHECK(choice_name(3, kChoices) == "c");
        CHECK_THROWS_WITH_AS(choice_value("--x", "d", kChoices), "--x takes a, b or c, not \"d\"",
                             UsageError);
    }
}
