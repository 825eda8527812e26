#include "tinwright/io/crs.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"

#include "reading.hpp"

using tinwright::UsageError;
using tinwright::io::Crs;
using tinwright_tests::message_of;

using Heights = Crs::Heights;

namespace {

constexpr const char* kBound = "+proj=utm +zone=32 +ellps=bessel +towgs84=1,2,3 +type=crs";
constexpr const char* kGeoidGrid =
    "+proj=utm +zone=32 +datum=WGS84 +geoidgrids=egm96_15.gtx +vunits=m +type=crs";
constexpr const char* kSite = R"(LOCAL_CS["Site grid",UNIT["metre",1]])";
constexpr const char* kNoUnit =
    R"(ENGCRS["Site grid",EDATUM["Site datum"],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],)"
    R"(LENGTHUNIT["unknown",0]])";
constexpr const char* kFeetOfUnknownDatum =
    R"(COMPD_CS["x",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)"
    R"(VERT_CS["unknown",VERT_DATUM["unknown",2005],UNIT["foot",0.3048]]])";
constexpr const char* kEllipsoidOfWkt1 =
    R"(COMPD_CS["x",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)"
    R"(VERT_CS["Ellipsoid",VERT_DATUM["Ellipsoid",2002],UNIT["metre",1]]])";

}  // namespace

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

    TEST_CASE("parts keep their codes, and a compound system tells both") {
        const Crs both = Crs::parse("EPSG:25832+5783");
        CHECK(both.code() == "EPSG:25832+5783");
        CHECK(both.name() == "EPSG:25832+5783 (ETRS89 / UTM zone 32N + DHHN92 height)");
        CHECK(both.horizontal().code() == "EPSG:25832");
        CHECK(both.geographic().code() == "EPSG:4258");
        CHECK(Crs::parse("EPSG:7405").code() == "EPSG:7405");
        CHECK(Crs::parse("EPSG:7405").horizontal().code() == "EPSG:27700");
        CHECK(Crs::parse("EPSG:4979").horizontal().code() == "EPSG:4326");
        CHECK(Crs::parse("EPSG:4979").geographic().code() == "EPSG:4326");
        CHECK(Crs::parse("EPSG:4978").geographic().code() == "EPSG:4326");
        CHECK(Crs::parse("EPSG:3067").horizontal().code() == "EPSG:3067");
        CHECK_FALSE(Crs::parse("EPSG:5773").horizontal().is_known());
        CHECK_FALSE(Crs().horizontal().is_known());
        CHECK_FALSE(Crs().geographic().is_known());
    }

    TEST_CASE("what z is measured from") {
        const auto heights = [](const char* text) { return Crs::parse(text).heights(); };
        CHECK(Crs().heights() == Heights::Unknown);
        CHECK(heights("EPSG:3067") == Heights::Unknown);
        CHECK(heights("EPSG:4326") == Heights::Unknown);
        CHECK(heights("EPSG:25832+5783") == Heights::Gravity);
        CHECK(heights("EPSG:32632+5715") == Heights::Gravity);  // depths
        CHECK(heights("EPSG:4979") == Heights::Ellipsoidal);
        CHECK(heights("EPSG:4978") == Heights::Ellipsoidal);
        CHECK(heights(kGeoidGrid) == Heights::Gravity);
        CHECK(heights("+proj=utm +zone=32 +ellps=WGS84 +vunits=us-ft +type=crs") == Heights::Ellipsoidal);
        CHECK(heights(kFeetOfUnknownDatum) == Heights::Unknown);
        CHECK(Crs::parse(kFeetOfUnknownDatum).z_unit() == "foot");
        CHECK(heights(kEllipsoidOfWkt1) == Heights::Ellipsoidal);
    }

    TEST_CASE("heights of another system are put on a horizontal one") {
        const Crs utm = Crs::parse("EPSG:32612");
        const Crs egm96 = utm.with_vertical("EPSG:5773");
        CHECK(egm96.code() == "EPSG:32612+5773");
        CHECK(egm96.is_same(Crs::parse("EPSG:32612+5773")));
        CHECK(egm96.z_unit() == "metre");
        CHECK(egm96.gdal()->GetDataAxisToSRSAxisMapping() == std::vector<int>{1, 2, 3});

        const Crs survey_feet = egm96.with_heights_of(Crs::parse("EPSG:2225+6360"));
        CHECK(survey_feet.code() == "EPSG:32612+6360");
        CHECK(survey_feet.z_unit() == "US survey foot");
        CHECK(Crs::parse("EPSG:25832").with_heights_of(Crs::parse("EPSG:7405")).code() == "EPSG:25832+5701");

        const Crs geoid_grid = utm.with_heights_of(Crs::parse(kGeoidGrid));
        CHECK(geoid_grid.heights() == Heights::Gravity);
        CHECK(geoid_grid.wkt().find("egm96_15.gtx") != std::string::npos);
        CHECK(geoid_grid.horizontal().code() == "EPSG:32612");

        const Crs ellipsoidal = egm96.with_ellipsoidal_heights();
        CHECK(ellipsoidal.heights() == Heights::Ellipsoidal);
        CHECK(ellipsoidal.horizontal().code() == "EPSG:32612");
        CHECK(ellipsoidal.z_unit() == "metre");
        CHECK(utm.with_heights_of(Crs::parse("EPSG:4979")).is_same(ellipsoidal));
        CHECK(Crs::parse("EPSG:4326").with_ellipsoidal_heights().code() == "EPSG:4979");

        CHECK(utm.with_heights_of(Crs()).code() == "EPSG:32612");
        CHECK(egm96.with_heights_of(Crs::parse("EPSG:3067")).code() == "EPSG:32612");
        CHECK_FALSE(Crs().with_heights_of(egm96).is_known());
        CHECK_FALSE(Crs().with_ellipsoidal_heights().is_known());
    }

    TEST_CASE("heights above an ellipsoid keep their unit") {
        const Crs feet = Crs::parse("+proj=utm +zone=32 +ellps=WGS84 +units=m +vunits=us-ft +type=crs");
        REQUIRE(feet.z_unit() == "US survey foot");
        for (const char* const code : {"EPSG:32612", "EPSG:4326", "EPSG:2225"}) {
            CAPTURE(code);
            const Crs crs = Crs::parse(code).with_heights_of(feet);
            CHECK(crs.heights() == Heights::Ellipsoidal);
            CHECK(crs.z_unit() == "US survey foot");
            CHECK(crs.is_same_horizontally(Crs::parse(code)));
            CHECK(crs.unit() == Crs::parse(code).unit());
        }
        const Crs bound = Crs::parse(kBound).with_heights_of(feet);
        CHECK(bound.z_unit() == "US survey foot");
        CHECK(bound.wkt().starts_with("BOUNDCRS["));
        CHECK(bound.horizontal().is_same(Crs::parse(kBound)));
    }

    TEST_CASE("a system's way to WGS 84 stays with its parts") {
        const Crs bound = Crs::parse(kBound);
        CHECK(bound.geographic().wkt().find("Geocentric translations") != std::string::npos);
        const Crs high = bound.with_vertical("EPSG:5773");
        CHECK(high.heights() == Heights::Gravity);
        CHECK(high.wkt().find("Geocentric translations") != std::string::npos);
        CHECK(high.is_same_horizontally(bound));
        CHECK(high.horizontal().is_same(bound));
    }

    TEST_CASE("a turned globe is based on the true one, and a local system on none") {
        const Crs turned = Crs::parse(
            "+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=30 +lon_0=10 +datum=WGS84 +type=crs");
        CHECK(turned.is_geographic());
        CHECK(turned.geographic().is_geographic());
        CHECK_FALSE(turned.geographic().is_same(turned));
        CHECK(turned.geographic().is_same(Crs::parse("OGC:CRS84").horizontal()));

        const Crs site = Crs::parse(kSite);
        CHECK_FALSE(site.geographic().is_known());
        CHECK(site.horizontal().is_same(site));
        CHECK(site.heights() == Heights::Unknown);
        CHECK(site.metres_per_unit() == 1);
        CHECK(site.axis_directions().empty());
        const Crs high = site.with_heights_of(Crs::parse("EPSG:32612+6360"));
        CHECK(high.z_unit() == "US survey foot");
        CHECK(high.is_same_horizontally(site));
        CHECK(site.with_ellipsoidal_heights().heights() == Heights::Unknown);  // there is no ellipsoid
    }

    TEST_CASE("systems are compared without z") {
        CHECK(Crs::parse("EPSG:25832+5783").is_same_horizontally(Crs::parse("EPSG:25832")));
        CHECK(Crs::parse("EPSG:4979").is_same_horizontally(Crs::parse("EPSG:4326+5773")));
        CHECK_FALSE(Crs::parse("EPSG:25832+5783").is_same_horizontally(Crs::parse("EPSG:25833+5783")));
        CHECK(Crs().is_same_horizontally(Crs()));
        CHECK_FALSE(Crs().is_same_horizontally(Crs::parse("EPSG:25832")));
    }

    TEST_CASE("heights are compared without their units") {
        const auto same = [](const char* a, const char* b) {
            const bool is_same = Crs::parse(a).has_same_heights(Crs::parse(b));
            CHECK(is_same == Crs::parse(b).has_same_heights(Crs::parse(a)));
            return is_same;
        };
        CHECK(same("EPSG:25832+5783", "EPSG:4258+5783"));
        CHECK(same("EPSG:26910+5703", "EPSG:2225+6360"));  // NAVD88, metres and survey feet
        CHECK(same("EPSG:27700+5701", "EPSG:7405"));
        CHECK_FALSE(same("EPSG:25832+5783", "EPSG:25832+7837"));
        CHECK_FALSE(same("EPSG:32632+5714", "EPSG:32632+5715"));  // height and depth
        CHECK_FALSE(same("EPSG:25832+5783", "EPSG:4979"));
        CHECK(same("EPSG:4979", kEllipsoidOfWkt1));
        CHECK(same(kGeoidGrid, kGeoidGrid));
        CHECK_FALSE(same(kGeoidGrid, "EPSG:32632+5714"));
        CHECK_FALSE(same("EPSG:25832", "EPSG:25832"));
        CHECK_FALSE(same(kFeetOfUnknownDatum, kFeetOfUnknownDatum));
        CHECK_FALSE(Crs().has_same_heights(Crs()));
    }

    TEST_CASE("only systems of heights are heights") {
        CHECK(message_of<UsageError>([] {
                  static_cast<void>(Crs::parse("EPSG:32612").with_vertical("EPSG:3067"));
              }) == R"(CRS "EPSG:3067": not a vertical system; give for example EPSG:5773)");
        CHECK(message_of<UsageError>(
                  [] { static_cast<void>(Crs::parse("EPSG:4978").with_vertical("EPSG:5773")); }) ==
              "CRS EPSG:4978 (WGS 84) cannot have heights in EPSG:5773 (EGM96 height); give a projected or "
              "geographic system");
        CHECK_THROWS_AS(static_cast<void>(Crs::parse("EPSG:32612").with_vertical("EPSG:nonsense")),
                        UsageError);
    }

    TEST_CASE("axes that are not east and north are told") {
        const auto axes = [](const char* text) { return Crs::parse(text).axis_directions(); };
        CHECK(axes("EPSG:2048") == "x points west and y points south");
        CHECK(axes("EPSG:5513") == "x points south and y points west");
        CHECK(axes("EPSG:2065") == "x points south and y points west");
        for (const char* const usual :
             {"EPSG:5514", "EPSG:3067", "EPSG:3879", "EPSG:6677", "EPSG:2193", "EPSG:4326", "OGC:CRS84",
              "EPSG:31468", "EPSG:3031", "EPSG:3413", "EPSG:32661", "EPSG:32761", "EPSG:4978", "EPSG:5773",
              "EPSG:25832+5783", kSite}) {
            CAPTURE(usual);
            CHECK(axes(usual).empty());
        }
        CHECK(axes("EPSG:2048+5714") == "x points west and y points south");
        CHECK(Crs().axis_directions().empty());
    }

    TEST_CASE("metres in a horizontal unit") {
        const auto metres = [](const char* text) { return Crs::parse(text).metres_per_unit(); };
        CHECK(metres("EPSG:3067") == 1);
        CHECK(metres("EPSG:2225") == 1200.0 / 3937.0);
        CHECK(metres("EPSG:2225+5703") == 1200.0 / 3937.0);
        CHECK(metres("EPSG:2222") == 0.3048);
        CHECK(metres("EPSG:2314") == doctest::Approx(0.3047972654));
        CHECK(Crs::parse("EPSG:2314").unit() == "Clarke's foot");
        CHECK(metres("+proj=utm +zone=32 +ellps=GRS80 +units=km +type=crs") == 1000);
        CHECK(metres("+proj=utm +zone=32 +ellps=GRS80 +to_meter=0.5 +type=crs") == 0.5);
        CHECK(Crs::parse("+proj=utm +zone=32 +ellps=GRS80 +to_meter=0.5 +type=crs").unit() == "0.5 metre");
        CHECK(std::isnan(metres("EPSG:4326")));
        CHECK(std::isnan(Crs().metres_per_unit()));
        const Crs no_unit = Crs::parse(kNoUnit);
        CHECK(no_unit.is_known());
        CHECK(no_unit.unit().empty());
        CHECK(std::isnan(no_unit.metres_per_unit()));
    }

    TEST_CASE("the epoch of coordinates stays with a system and its parts") {
        CHECK_FALSE(Crs::parse("EPSG:4979").epoch().has_value());
        OGRSpatialReference system;
        REQUIRE(system.SetFromUserInput("EPSG:7912") == OGRERR_NONE);
        system.SetCoordinateEpoch(2017.25);
        const Crs crs = Crs::from_gdal(&system);
        CHECK(crs.epoch() == 2017.25);
        CHECK(crs.horizontal().epoch() == 2017.25);
        CHECK(crs.geographic().epoch() == 2017.25);
        CHECK(crs.with_vertical("EPSG:5773").epoch() == 2017.25);
        CHECK(crs.horizontal().with_ellipsoidal_heights().epoch() == 2017.25);
        CHECK_FALSE(Crs().epoch().has_value());
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
