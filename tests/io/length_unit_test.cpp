#include "tinwright/io/length_unit.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

using tinwright::io::find_length_unit;
using tinwright::io::length_unit_of;
using tinwright::io::LengthUnit;
using tinwright::io::unit_factor;

namespace {

std::string name_of(const char* spelling) {
    const auto unit = find_length_unit(spelling);
    return unit ? unit->name : std::string("none");
}

double metres_of(const char* spelling) {
    const auto unit = find_length_unit(spelling);
    return unit ? unit->metres : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST_SUITE("io/length_unit") {
    TEST_CASE("the spellings of files, authorities and users have one name each") {
        for (const char* const spelling : {"metre", "Metre", "METER", "m", "M", "meters", "metres", " m "}) {
            CAPTURE(spelling);
            CHECK(name_of(spelling) == "metre");
        }
        for (const char* const spelling :
             {"foot", "Foot", "ft", "feet", "FEET", "international foot", "ft_int"}) {
            CAPTURE(spelling);
            CHECK(name_of(spelling) == "foot");
        }
        for (const char* const spelling :
             {"US survey foot", "US Survey Foot", "us-ft", "ftUS", "US_survey_foot", "survey_foot", "Foot_US",
              "USSurveyFoot", "us survey feet"}) {
            CAPTURE(spelling);
            CHECK(name_of(spelling) == "US survey foot");
        }
        CHECK(name_of("km") == "kilometre");
        CHECK(name_of("centimeter") == "centimetre");
        CHECK(name_of("mm") == "millimetre");
        CHECK(name_of("Fathom") == "fathom");
        CHECK(name_of("yards") == "yard");
        CHECK(name_of("clarke's FOOT") == "Clarke's foot");
        CHECK(name_of("ind-ft") != "none");
    }

    TEST_CASE("names of no unit, and of angles, are none") {
        for (const char* const spelling :
             {"", " ", "-", "parsec", "degree", "metre metre", "0 metre", "-1 metre", "inf metre", "metre5",
              "1e999 metre", "nan metre", "5"}) {
            CAPTURE(spelling);
            CHECK(name_of(spelling) == "none");
        }
    }

    TEST_CASE("lengths are those of the definitions") {
        CHECK(metres_of("m") == 1);
        CHECK(metres_of("ft") == 0.3048);
        CHECK(metres_of("us-ft") == 1200.0 / 3937.0);
        CHECK(metres_of("yd") == 0.9144);
        CHECK(metres_of("fathom") == 1.8288);
        CHECK(metres_of("mile") == 1609.344);
        CHECK(metres_of("us-mi") == 5280.0 * 1200.0 / 3937.0);
        CHECK(metres_of("inch") == 0.0254);
        CHECK(metres_of("chain") == 20.1168);
        CHECK(metres_of("link") == 0.201168);
        CHECK(metres_of("mm") == 0.001);
        CHECK(metres_of("Clarke's foot") == doctest::Approx(0.3047972654).epsilon(1e-12));
    }

    TEST_CASE("a unit is recognised by its length, with however many digits") {
        for (const double metres : {0.30480061, 0.3048006096, 0.304800609601219, 0.30480060960121924}) {
            CAPTURE(metres);
            const LengthUnit unit = length_unit_of(metres, "whatever");
            CHECK(unit.name == "US survey foot");
            CHECK(unit.metres == 1200.0 / 3937.0);
        }
        CHECK(length_unit_of(0.3048, "").name == "foot");
        CHECK(length_unit_of(0.30480000001, "feet").name == "foot");
        CHECK(length_unit_of(1, "").name == "metre");
        CHECK(length_unit_of(0.3047972654, "Clarke's foot").name == "Clarke's foot");
        CHECK(length_unit_of(0.3047972654, "ftCla").metres > 0.304797);
    }

    TEST_CASE("a unit without a usual name tells its length by name") {
        const LengthUnit unit = length_unit_of(0.5, "my cubit");
        CHECK(unit.name == "0.5 metre");
        CHECK(unit.metres == 0.5);
        CHECK(name_of("0.5 metre") == "0.5 metre");
        CHECK(metres_of("2e-05 metre") == 2e-05);
        CHECK(name_of("1 metre") == "metre");
        CHECK(unit_factor(unit.name, "metre") == 0.5);
        CHECK(unit_factor("foot", unit.name) == 0.6096);
        const LengthUnit longer = length_unit_of(1.0000135965, "foot");  // the name is not that of the length
        CHECK(longer.name == "1.0000135965 metre");
        CHECK(unit_factor(longer.name, "metre") == 1.0000135965);
    }

    TEST_CASE("conversions between fractions of a metre are the ratio to the nearest double") {
        CHECK(unit_factor("foot", "US survey foot") == 1499997.0 / 1500000.0);
        CHECK(unit_factor("US survey foot", "foot") == 1500000.0 / 1499997.0);
        CHECK(unit_factor("US survey foot", "metre") == 1200.0 / 3937.0);
        CHECK(unit_factor("metre", "US survey foot") == 3937.0 / 1200.0);
        CHECK(unit_factor("metre", "foot") == 1250.0 / 381.0);
        CHECK(unit_factor("foot", "metre") == 0.3048);
        CHECK(unit_factor("US survey mile", "US survey foot") == 5280);
        CHECK(unit_factor("Statute mile", "foot") == 5280);
        CHECK(unit_factor("fathom", "foot") == 6);
        CHECK(unit_factor("chain", "yard") == 22);
        CHECK(unit_factor("yard", "inch") == 36);
        CHECK(unit_factor("kilometre", "millimetre") == 1e6);
        for (const char* const a :
             {"metre", "foot", "US survey foot", "US survey mile", "nautical mile", "link"}) {
            for (const char* const b : {"millimetre", "inch", "US survey link", "Statute mile", "foot"}) {
                CAPTURE(a);
                CAPTURE(b);
                const double there = unit_factor(a, b);
                const double back = unit_factor(b, a);
                CHECK(std::abs(there * back - 1) <= std::numeric_limits<double>::epsilon());
            }
        }
    }

    TEST_CASE("unknown units change nothing") {
        CHECK(unit_factor("", "metre") == 1);
        CHECK(unit_factor("metre", "") == 1);
        CHECK(unit_factor("", "") == 1);
        CHECK(unit_factor("league", "metre") == 1);
        CHECK(unit_factor("foot", "degree") == 1);
        CHECK(unit_factor("league", "league") == 1);
    }
}
