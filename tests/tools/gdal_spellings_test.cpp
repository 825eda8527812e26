#include "gdal_spellings.hpp"

#include <doctest/doctest.h>

namespace {

using tinwright::tools::rewrite_gdal_spellings;
using Tokens = std::vector<std::string>;

}  // namespace

TEST_SUITE("tools/gdal_spellings") {
    TEST_CASE("each of GDAL's spellings becomes our long option") {
        CHECK(rewrite_gdal_spellings({"-of", "GTiff", "-co", "A=B", "-oo", "C=D", "-lco", "E=F"}) ==
              Tokens{"--of", "GTiff", "--co", "A=B", "--oo", "C=D", "--lco", "E=F"});
        CHECK(rewrite_gdal_spellings({"-te", "1", "2", "3", "4", "-ts", "5", "6", "-tap", "-ot", "Int16"}) ==
              Tokens{"--extent", "1", "2", "3", "4", "--size", "5", "6", "--tap", "--ot", "Int16"});
        CHECK(rewrite_gdal_spellings({"-a_srs", "EPSG:4326", "-a_nodata", "0", "-nln", "x", "-overwrite"}) ==
              Tokens{"--source-crs", "EPSG:4326", "--nodata", "0", "--layer-name", "x", "--overwrite"});
    }

    TEST_CASE("only exact tokens are rewritten") {
        CHECK(rewrite_gdal_spellings({"-o", "f.tif", "-ofoo", "of", "--of"}) ==
              Tokens{"-o", "f.tif", "-ofoo", "of", "--of"});
    }

    TEST_CASE("a resolution takes a second value only when it is a number") {
        CHECK(rewrite_gdal_spellings({"-tr", "5", "2.5", "a.csv"}) ==
              Tokens{"--resolution", "5,2.5", "a.csv"});
        CHECK(rewrite_gdal_spellings({"-tr", "5", "a.csv"}) == Tokens{"--resolution", "5", "a.csv"});
        CHECK(rewrite_gdal_spellings({"--resolution", "5"}) == Tokens{"--resolution", "5"});
        CHECK(rewrite_gdal_spellings({"--resolution=5", "2", "a.csv"}) ==
              Tokens{"--resolution=5,2", "a.csv"});
        CHECK(rewrite_gdal_spellings({"--resolution"}) == Tokens{"--resolution"});
        CHECK(rewrite_gdal_spellings({"--resolution", "x", "2"}) == Tokens{"--resolution", "x", "2"});
    }

    TEST_CASE("negative numbers without a leading zero get one") {
        CHECK(rewrite_gdal_spellings({"-te", "-.5", "-.25", "1", "1"}) ==
              Tokens{"--extent", "-0.5", "-0.25", "1", "1"});
        CHECK(rewrite_gdal_spellings({"-.x"}) == Tokens{"-.x"});
    }

    TEST_CASE("what follows two dashes is left alone") {
        CHECK(rewrite_gdal_spellings({"-tap", "--", "-tap", "-of"}) == Tokens{"--tap", "--", "-tap", "-of"});
    }
}
