#include "json_value.hpp"

#include <limits>

#include <doctest/doctest.h>

using tinwright::tools::JsonValue;

TEST_SUITE("tools/json_value") {
    TEST_CASE("keys keep their order and numbers their shortest form") {
        const std::string text = JsonValue::object().set("b", 0.1).set("a", 3).set("c", true).text();
        CHECK(text == "{\n  \"b\": 0.1,\n  \"a\": 3,\n  \"c\": true\n}\n");
    }

    TEST_CASE("numbers that are not finite, and no value, are null") {
        CHECK(JsonValue(std::numeric_limits<double>::infinity()).text() == "null\n");
        CHECK(JsonValue().text() == "null\n");
    }

    TEST_CASE("text is escaped, and kept valid") {
        CHECK(JsonValue("a\"b\\c\n/d").text() == "\"a\\\"b\\\\c\\n/d\"\n");
        CHECK(JsonValue("caf\xC3\xA9").text() == "\"caf\xC3\xA9\"\n");
        CHECK(JsonValue("caf\xE9").text() == "\"caf?\"\n");
    }

    TEST_CASE("values are shared, not moved") {
        const JsonValue one = JsonValue::array_of(std::vector<double>{1, 2.5});
        JsonValue two = JsonValue::object();
        two.set("x", one).set("y", one);
        CHECK(one.text() == "[\n  1,\n  2.5\n]\n");
        CHECK(two.text().find("\"y\"") != std::string::npos);
    }
}
