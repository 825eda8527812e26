#include "tinwright/io/source.hpp"

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/messages.hpp"

using tinwright::UsageError;
using tinwright::io::parse_source;
using tinwright::io::Source;
using tinwright_tests::message_of;

namespace {

std::string refusal(const std::string& text) {
    return message_of<UsageError>([&] { parse_source(text); });
}

}  // namespace

TEST_SUITE("io/source") {
    TEST_CASE("a path alone is a source") {
        const Source source = parse_source("survey.gpkg");
        CHECK(source.path == "survey.gpkg");
        Source expected;
        expected.path = "survey.gpkg";
        CHECK(source == expected);
    }

    TEST_CASE("every key is understood") {
        const Source source = parse_source(
            "a.gpkg,layer=points,where=kind = 'ground',z=h,xfield=e,yfield=n,vertices=yes,band=2,stride=10,"
            "crs=EPSG:3067,format=pnezd,as=samples,across=smooth,oo=A=1,oo=B=x,y");
        CHECK(source.path == "a.gpkg");
        CHECK(source.layer == "points");
        CHECK(source.where == "kind = 'ground'");
        CHECK(source.z == "h");
        CHECK(source.x_field == "e");
        CHECK(source.y_field == "n");
        CHECK(source.vertices);
        CHECK(source.band == 2);
        CHECK(source.stride == 10);
        CHECK(source.crs == "EPSG:3067");
        CHECK(source.format == Source::Format::Pnezd);
        CHECK(source.as == Source::Kind::Samples);
        CHECK(source.across == "smooth");
        CHECK(source.open_options == std::vector<std::string>{"A=1", "B=x,y"});
    }

    TEST_CASE("a comma splits only before a known key") {
        CHECK(parse_source("a,b.csv").path == "a,b.csv");
        CHECK(parse_source("a,foo=1.csv").path == "a,foo=1.csv");
        CHECK(parse_source("a.csv,Z=1").path == "a.csv,Z=1");
        CHECK(parse_source("a.csv,").path == "a.csv,");
        CHECK(parse_source("a.gpkg,sql=SELECT a, b FROM t WHERE c IN (1,2)").sql ==
              "SELECT a, b FROM t WHERE c IN (1,2)");
        CHECK(parse_source("a.gpkg,layerz=1").path == "a.gpkg,layerz=1");
    }

    TEST_CASE("a doubled comma is a literal one") {
        CHECK(parse_source("a,,z=1.csv").path == "a,z=1.csv");
        CHECK(parse_source("a,,,z=1").path == "a,");
        CHECK(parse_source("a,,,z=1").z == "1");
        CHECK(parse_source("a.gpkg,where=b IN (1,,z=2)").where == "b IN (1,z=2)");
    }

    TEST_CASE("values are whole: an equals sign in them is theirs") {
        CHECK(parse_source("a.gpkg,where=x=1").where == "x=1");
        CHECK(parse_source("a.gpkg,crs=+proj=utm +zone=35").crs == "+proj=utm +zone=35");
    }

    TEST_CASE("yes and no have their usual spellings") {
        for (const char* const yes : {"yes", "true", "on", "1"}) {
            CHECK(parse_source(std::string("a,vertices=") + yes).vertices);
        }
        for (const char* const no : {"no", "false", "off", "0"}) {
            CHECK_FALSE(parse_source(std::string("a,vertices=") + no).vertices);
        }
    }

    TEST_CASE("what cannot be is refused with its reason") {
        CHECK(refusal("") == R"(source "": the path is missing; write PATH[,key=value...])");
        CHECK(refusal(",z=1") == R"(source ",z=1": the path is missing; write PATH[,key=value...])");
        CHECK(refusal("a,z=1,z=2") == R"(source "a,z=1,z=2": z= is given twice)");
        CHECK(refusal("a,layer=") == R"(source "a,layer=": layer= has no value)");
        CHECK(refusal("a,band=0") == R"(source "a,band=0": band= takes a whole number from 1, not "0")");
        CHECK(refusal("a,stride=1.5") ==
              R"(source "a,stride=1.5": stride= takes a whole number from 1, not "1.5")");
        CHECK(refusal("a,stride=99999999999") ==
              R"(source "a,stride=99999999999": stride= takes a whole number from 1, not "99999999999")");
        CHECK(refusal("a,vertices=maybe") ==
              R"(source "a,vertices=maybe": vertices= takes yes or no, not "maybe")");
        CHECK(refusal("a,format=las") ==
              R"(source "a,format=las": format= takes xyz, pnezd or csv, not "las")");
        CHECK(refusal("a,as=grid") == R"(source "a,as=grid": as= takes tin or samples, not "grid")");
        CHECK(refusal("a,oo=x") == R"(source "a,oo=x": oo= takes NAME=VALUE, not "x")");
        CHECK(refusal("a,oo==x") == R"(source "a,oo==x": oo= takes NAME=VALUE, not "=x")");
        CHECK(
            refusal("a,sql=SELECT 1,layer=b") ==
            R"(source "a,sql=SELECT 1,layer=b": sql= and layer= exclude each other; name the layer in the SQL)");
        CHECK(refusal("a\n\x1b[31m,z=1,z=2") == R"(source "a\n\x1b[31m,z=1,z=2": z= is given twice)");
    }
}
