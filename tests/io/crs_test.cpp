#include "tinwright/io/crs.hpp"

#include <doctest/doctest.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"

#include "reading.hpp"

using tinwright::UsageError;
using tinwright::io::Crs;
using tinwright_tests::message_of;

TEST_SUITE("io/crs") {
    TEST_CASE("no CRS is a value") {
        const Crs none;
        CHECK_FALSE(none.is_known());
        CHECK_FALSE(none.is_geographic());
        CHECK(none.name() == "none");
        CHECK(none.code().empty());
        CHECK(none.wkt().empty());
        CHECK(none.unit().empty());
        CHECK(none.z_unit().empty());
        CHECK(none.gdal() == nullptr);
        CHECK(none.is_same(Crs()));
        CHECK_FALSE(none.is_same(Crs::parse("EPSG:3067")));
        CHECK_FALSE(Crs::parse("EPSG:3067").is_same(none));
    }

    TEST_CASE("a projected system tells its code, name and unit") {
        const Crs crs = Crs::parse("EPSG:3067");
        CHECK(crs.is_known());
        CHECK_FALSE(crs.is_geographic());
        CHECK(crs.name() == "EPSG:3067 (ETRS89 / TM35FIN(E,N))");
        CHECK(crs.code() == "EPSG:3067");
        CHECK(crs.unit() == "metre");
        CHECK(crs.z_unit().empty());
        CHECK(crs.wkt().starts_with("PROJCRS["));
    }

    TEST_CASE("degrees are geographic, whatever stands beside them") {
        CHECK(Crs::parse("EPSG:4326").is_geographic());
        CHECK(Crs::parse("EPSG:4979").is_geographic());
        CHECK(Crs::parse("EPSG:4978").is_geographic());       // geocentric: no plane either
        CHECK(Crs::parse("EPSG:4326+5773").is_geographic());  // with heights
        CHECK_FALSE(Crs::parse("EPSG:3067+3900").is_geographic());
    }

    TEST_CASE("feet of two lengths are told apart") {
        CHECK(Crs::parse("EPSG:2964").unit() == "US survey foot");
        CHECK(Crs::parse("EPSG:2222").unit() == "foot");
    }

    TEST_CASE("the unit of z comes from a vertical part only") {
        CHECK(Crs::parse("EPSG:3067+3900").z_unit() == "metre");
        CHECK(Crs::parse("EPSG:32612+6360").z_unit() == "US survey foot");
        CHECK(Crs::parse("EPSG:4979").z_unit() == "metre");
        CHECK(Crs::parse("EPSG:4326").z_unit().empty());
    }

    TEST_CASE("axis order and spelling do not make a system another") {
        OGRSpatialReference authority;
        authority.importFromEPSG(3879);  // northing first
        CHECK(Crs::from_gdal(&authority).is_same(Crs::parse("EPSG:3879")));
        CHECK(Crs::parse(Crs::parse("EPSG:3875").wkt()).is_same(Crs::parse("EPSG:3875")));
        CHECK_FALSE(Crs::parse("EPSG:3875").is_same(Crs::parse("EPSG:3876")));
        CHECK_FALSE(Crs::parse("EPSG:3067").is_same(Crs::parse("EPSG:3067+3900")));
    }

    TEST_CASE("x is easting whatever the authority says") {
        const Crs crs = Crs::parse("EPSG:4326");
        CHECK(crs.gdal()->GetDataAxisToSRSAxisMapping() == std::vector<int>{2, 1});
    }

    TEST_CASE("placeholders are no CRS") {
        CHECK_FALSE(Crs::from_gdal(nullptr).is_known());
        for (
            const char* const wkt :
            {R"(LOCAL_CS["Undefined Cartesian SRS"])", R"(LOCAL_CS["unnamed",UNIT["metre",1]])",
             R"(GEOGCS["Undefined geographic SRS",DATUM["unknown",SPHEROID["unknown",6378137,298.257223563]],)"
             R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])",
             R"(ENGCRS["Undefined Cartesian SRS with unknown unit",EDATUM["Unknown engineering datum"],)"
             R"(CS[Cartesian,2],AXIS["x",east],AXIS["y",north],LENGTHUNIT["unknown",0]])"}) {
            OGRSpatialReference system;
            CAPTURE(wkt);
            REQUIRE(system.importFromWkt(wkt) == OGRERR_NONE);
            CHECK_FALSE(Crs::from_gdal(&system).is_known());
        }
    }

    TEST_CASE("a local system with a name of its own is one") {
        OGRSpatialReference system;
        REQUIRE(system.importFromWkt(R"(LOCAL_CS["Site grid",UNIT["metre",1]])") == OGRERR_NONE);
        const Crs crs = Crs::from_gdal(&system);
        CHECK(crs.is_known());
        CHECK(crs.name() == "Site grid");
        CHECK(crs.unit() == "metre");
    }

    TEST_CASE("nonsense is refused on one line") {
        const std::string text = message_of<UsageError>([] { Crs::parse("EPSG:nonsense"); });
        CHECK(text.starts_with(
            R"(CRS "EPSG:nonsense": not understood; give for example EPSG:3067, WKT or a PROJ string)"));
        CHECK(message_of<UsageError>([] { Crs::parse(""); }) ==
              R"(CRS "": not understood; give for example EPSG:3067, WKT or a PROJ string)");
        CHECK(text.find('\n') == std::string::npos);
    }
}
