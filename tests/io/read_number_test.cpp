#include "tinwright/io/read_number.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "support/cases.hpp"

using tinwright::io::parse_number;
using tinwright::io::read_short_decimal;

namespace {

std::string random_digits(std::mt19937_64& random, int count) {
    std::string digits;
    for (int i = 0; i < count; ++i) {
        digits += static_cast<char>('0' + random() % 10);
    }
    return digits;
}

/// Anything that a survey file may call a number.
std::string random_decimal(std::mt19937_64& random) {
    std::string text(random() % 2, '-');
    const int before = static_cast<int>(random() % 12);
    const int after = static_cast<int>(random() % 12) + (before == 0 ? 1 : 0);
    text += random_digits(random, before);
    if (after > 0 || random() % 4 == 0) {
        text += '.';
        text += random_digits(random, after);
    }
    if (random() % 8 == 0) {
        text += random() % 2 == 0 ? "e" : "E-";
        text += std::to_string(random() % 25);
    }
    return text;
}

}  // namespace

TEST_SUITE("io/read_number") {
    TEST_CASE("both ways read what strtod reads, bit for bit") {
        constexpr unsigned seed = 20240611;
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        int short_ones = 0;
        const int cases = tinwright_tests::cases(200000);
        for (int i = 0; i < cases; ++i) {
            const std::string text = random_decimal(random);
            const double expected = std::strtod(text.c_str(), nullptr);
            const auto value = parse_number(text);
            CAPTURE(text);
            REQUIRE(value.has_value());
            REQUIRE(std::bit_cast<std::uint64_t>(*value) == std::bit_cast<std::uint64_t>(expected));
            double quick = 0;
            const char* p = text.c_str();
            if (read_short_decimal(p, '.', quick)) {
                ++short_ones;
                REQUIRE(p == text.c_str() + text.size());
                REQUIRE(std::bit_cast<std::uint64_t>(quick) == std::bit_cast<std::uint64_t>(expected));
            }
        }
        CHECK(short_ones > cases / 2);
    }

    TEST_CASE("signs, bare points and blanks are part of numbers") {
        CHECK(parse_number("+1.5") == 1.5);
        CHECK(parse_number(" -1.5\t") == -1.5);
        CHECK(parse_number("5.") == 5.0);
        CHECK(parse_number(".5") == 0.5);
        CHECK(parse_number("1e3") == 1000.0);
    }

    TEST_CASE("the decimal mark may be a comma, and then a point is none") {
        CHECK(parse_number("1234,5", ',') == 1234.5);
        CHECK_FALSE(parse_number("1.5", ','));
        CHECK_FALSE(parse_number("1,5"));
        CHECK_FALSE(parse_number("1,2,3", ','));
    }

    TEST_CASE("what is no number is none") {
        for (const char* const text :
             {"", " ", "-", "+", ".", "e5", "1.5m", "1 2", "0x10", "+-1", "--1", "1e", "one"}) {
            CAPTURE(text);
            CHECK_FALSE(parse_number(text));
        }
    }

    TEST_CASE("what is not finite is a number, but not finite") {
        for (const char* const text : {"nan", "NaN", "-nan", "inf", "-Infinity", "1e999", "-1e999"}) {
            CAPTURE(text);
            const auto value = parse_number(text);
            REQUIRE(value.has_value());
            CHECK_FALSE(std::isfinite(*value));
        }
    }

    TEST_CASE("what is too small to tell from zero is zero") {
        CHECK(parse_number("1e-999") == 0.0);
        CHECK(parse_number("0." + std::string(400, '0') + "1") == 0.0);
    }

    TEST_CASE("the short way leaves alone what it cannot read exactly") {
        for (const char* const text :
             {"9007199254740993", "12345678901234567890", "1e5", "", "-", ".", "x"}) {
            double value = 7;
            const char* p = text;
            CAPTURE(text);
            CHECK_FALSE(read_short_decimal(p, '.', value));
            CHECK(p == text);
        }
    }
}
