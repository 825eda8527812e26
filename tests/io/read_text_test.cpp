#include "tinwright/io/read_text.hpp"

#include <charconv>
#include <random>

#include <doctest/doctest.h>

#include "reading.hpp"
#include "support/cases.hpp"

using tinwright::Cancelled;
using tinwright::Point3;
using tinwright::io::ReadOptions;
using tinwright::io::Samples;
using tinwright_tests::MemoryFile;
using tinwright_tests::read;
using tinwright_tests::read_text;

namespace {

const std::vector<Point3> two_points = {{1.5, 2.25, -3}, {4, 5, 6.125}};

std::string shortest(double value) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

TEST_SUITE("io/read_text") {
    TEST_CASE("the same two rows are read in every dress") {
        for (const char* const text : {
                 "1.5 2.25 -3\n4 5 6.125\n",
                 "1.5 2.25 -3\n4 5 6.125",                       // no last line end
                 "1.5,2.25,-3\r\n4,5,6.125\r\n",                 // CRLF
                 "1.5,2.25,-3\r4,5,6.125\r",                     // CR alone
                 "\xEF\xBB\xBFx,y,z\n1.5,2.25,-3\n4,5,6.125\n",  // byte order mark
                 "\xEF\xBB\xBF"
                 "1.5 2.25 -3\n4 5 6.125\n",                             // the same without a header
                 "x;y;z\n1,5;2,25;-3\n4;5;6,125\n",                      // decimal comma
                 "z\ty\tx\n-3\t2.25\t1.5\n6.125\t5\t4\n",                // another order
                 "|x|y|z\n|1.5|2.25|-3\n|4|5|6.125\n",                   // an empty first column
                 "# a comment\n\n1.5 2.25 -3\n\n# more\n4 5 6.125\n\n",  // comments and blank lines
                 "  1.5   2.25\t-3  \n\t4 5 6.125\n",                    // blanks everywhere
                 "+1.5,+2.25,-3.0\n4e0,0.5E1,6125e-3\n",                 // signs and exponents
                 "name,x,y,z\n\"a, b\",1.5,\"2.25\",-3\nc,4,5,6.125\n",  // quotes
                 "P1 1.5 2.25 -3\nP2 4 5 6.125\n",                       // text in front
                 "1.5 2.25 -3 tree\n4 5 6.125 old oak, hollow\n",        // free text behind
                 "1.500000000000000000000 2.25 -3\n4 5 6.125\n",         // more digits than needed
             }) {
            CAPTURE(text);
            CHECK(read_text(text).points == two_points);
        }
    }

    TEST_CASE("PNEZD is read by its header or by format=pnezd") {
        CHECK(read_text("P,N,E,Z,D\n1,2.25,1.5,-3,EP\n2,5,4,6.125,\"TREE, OAK\"\n").points == two_points);
        CHECK(read_text("1,2.25,1.5,-3,EP\n2,5,4,6.125\n", ",format=pnezd").points == two_points);
        CHECK(read_text("point,northing,easting,elevation,description\n1,2.25,1.5,-3,EP\n2,5,4,6.125,a,b\n",
                        ",format=pnezd")
                  .points == two_points);
    }

    TEST_CASE("a .pts file's count of rows is no sample") {
        const MemoryFile file("t.pts", "2\n1.5 2.25 -3 17 255 0 0\n4 5 6.125 18 0 0 0\n");
        CHECK(read(file.path()).points == two_points);
        CHECK(read(file.path()).slices[0].first_id == 2);
    }

    TEST_CASE("ids are line numbers") {
        const Samples samples = read_text("# c\nx y z\n1 2 3\n\n4 5 6\n7 8 9\n");
        REQUIRE(samples.slices.size() == 1);
        CHECK(samples.slices[0].id(0) == 3);
        CHECK(samples.slices[0].id(1) == 5);
        CHECK(samples.slices[0].id(2) == 6);
        CHECK(samples.describe(1) == "file \"/vsimem/t.txt\", line 5");
        CHECK(read_text("1 2 3\n4 5 6\n").slices[0].ids.empty());
    }

    TEST_CASE("--skip-bad counts what cannot be used and keeps the rest") {
        ReadOptions options;
        options.skip_bad = true;
        const Samples samples =
            read_text("x,y,z\n1.5,2.25,-3\n1,2\n1,nan,3\n1,2,3,4\n4,5,6.125\n,,\n", "", options);
        CHECK(samples.points == two_points);
        CHECK(samples.slices[0].skipped == 4);
        CHECK(samples.slices[0].id(1) == 6);
        CHECK(
            samples.warnings ==
            std::vector<std::string>{
                R"(file "/vsimem/t.txt": 4 unusable rows skipped, the first is file "/vsimem/t.txt", line 3: )"
                "z (column 3) is missing"});
    }

    TEST_CASE("compressed and archived text is read through GDAL's file systems") {
        const std::string rows = "1.5 2.25 -3\n4 5 6.125\n";
        for (const char* const path : {"/vsimem/t.xyz.gz", "/vsimem/t.zip/t.xyz"}) {
            const std::string inside =
                (std::string(path).ends_with(".gz") ? "/vsigzip/" : "/vsizip/") + std::string(path);
            VSILFILE* const file = VSIFOpenL(inside.c_str(), "wb");
            REQUIRE(file != nullptr);
            VSIFWriteL(rows.data(), 1, rows.size(), file);
            VSIFCloseL(file);
            CHECK(read(inside).points == two_points);
        }
        CHECK(read("/vsimem/t.xyz.gz").points == two_points);               // the prefix may be left out
        CHECK(read("CSV:/vsigzip//vsimem/t.xyz.gz").points == two_points);  // as GDAL names its driver
        VSIUnlink("/vsimem/t.xyz.gz");
        VSIUnlink("/vsimem/t.zip");
    }

    TEST_CASE("text of any name is read when nothing else claims it") {
        const MemoryFile file("survey.dat", "1.5 2.25 -3\n4 5 6.125\n");
        CHECK(read(file.path()).points == two_points);
        const MemoryFile bare("survey", "1.5,2.25,-3\n4,5,6.125\n");
        CHECK(read(bare.path()).points == two_points);
        CHECK(read(bare.path() + ",format=xyz").points == two_points);
    }

    TEST_CASE("decimals come back bit for bit, in whatever chunks and threads") {
        constexpr unsigned seed = 77;
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        std::string text;
        std::vector<Point3> points;
        std::vector<std::int64_t> lines;
        const int rows = tinwright_tests::cases(200000);  // several megabytes: many chunks
        std::int64_t line = 0;
        std::uniform_int_distribution<int> centimetres(0, 999999999);
        for (int i = 0; i < rows; ++i) {
            Point3 point = {centimetres(random) / 100.0, centimetres(random) / 1000.0,
                            centimetres(random) / 1e6 - 50};
            if (random() % 50 == 0) {
                point.z = std::ldexp(static_cast<double>(random()), -40);  // seventeen digits
            }
            if (random() % 100 == 0) {
                text += random() % 2 == 0 ? "\n" : "# a comment, 1, 2, 3\n";
                ++line;
            }
            text += shortest(point.x) + "," + shortest(point.y) + "," + shortest(point.z) + "\n";
            points.push_back(point);
            lines.push_back(++line);
        }
        for (const int threads : {1, 2, 3}) {
            ReadOptions options;
            options.threads = threads;
            const Samples samples = read_text(text, "", options);
            CAPTURE(threads);
            REQUIRE(samples.points.size() == points.size());
            CHECK(samples.points == points);
            CHECK(samples.slices[0].ids == lines);
        }
    }

    TEST_CASE("progress grows to one, and cancels") {
        std::string text;
        for (int i = 0; i < 300000; ++i) {
            text += std::to_string(i) + " 2 3\n";
        }
        double last = 0;
        int calls = 0;
        ReadOptions options;
        options.progress = [&](double fraction) {
            CHECK(fraction >= last);
            last = fraction;
            ++calls;
            return true;
        };
        read_text(text, "", options);
        CHECK(calls > 1);
        CHECK(last == 1.0);
        options.progress = [](double) { return false; };
        CHECK_THROWS_AS(read_text(text, "", options), Cancelled);
    }
}
