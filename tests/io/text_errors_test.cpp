#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "reading.hpp"

using tinwright::InputError;
using tinwright::IoError;
using tinwright::UsageError;
using tinwright::io::ReadOptions;
using tinwright_tests::MemoryFile;
using tinwright_tests::message_of;
using tinwright_tests::read;
using tinwright_tests::read_text;

namespace {

const std::string file = R"(file "/vsimem/t.txt")";
const std::string go_on = "; --skip-bad goes on without it";

std::string input_error(const std::string& text, const std::string& keys = "") {
    return message_of<InputError>([&] { read_text(text, keys); });
}

}  // namespace

TEST_SUITE("io/text_errors") {
    TEST_CASE("an unusable row is named with its line and what is wrong") {
        CHECK(input_error("1 2 3\n4 5\n") == file + ", line 2: z (column 3) is missing" + go_on);
        CHECK(input_error("x,y,z\n1,2,3\n4,,6\n") == file + ", line 3: y (column 2) is missing" + go_on);
        CHECK(input_error("1 2 3\n4 5 six\n") ==
              file + R"(, line 2: z (column 3) is no number: "six")" + go_on);
        CHECK(input_error("1 2 3\n4 5 6m\n") ==
              file + R"(, line 2: z (column 3) is no number: "6m")" + go_on);
        CHECK(input_error("1,2,3\n4,nan,6\n") ==
              file + R"(, line 2: y (column 2) is not finite: "nan")" + go_on);
        CHECK(input_error("1,2,3\n-inf,5,6\n") ==
              file + R"(, line 2: x (column 1) is not finite: "-inf")" + go_on);
        CHECK(input_error("1,2,3\n1e400,5,6\n") ==
              file + R"(, line 2: x (column 1) is not finite: "1e400")" + go_on);
        CHECK(input_error("NaN 2 3\n4 5 6\n") ==
              file + R"(, line 1: x (column 1) is not finite: "NaN")" + go_on);
        CHECK(input_error("1 2 3\n4 5 6 7\n") ==
              file + ", line 2: 4 columns where the rows before have 3" + go_on);
        CHECK(input_error("x,y,z\n1,2,3,4\n") ==
              file + ", line 2: 4 columns where the rows before have 3" + go_on);
        CHECK(input_error("x,y,z,d,e\n1,2,3,a,5\n1,2,3,\"a,5\n") ==
              file + ", line 3: a quoted column does not end on its line" + go_on);
        CHECK(input_error("1;2;3\n1,5;2;x\n") ==
              file + R"(, line 2: x (column 1) is no number: "1,5")" + go_on);
        CHECK(input_error("1 2 3\n\x1b[2J 5 6\n") ==
              file + R"(, line 2: x (column 1) is no number: "\x1b[2J")" + go_on);
    }

    TEST_CASE("the first unusable row is the one named, with any number of threads") {
        std::string text;
        for (int i = 0; i < 400000; ++i) {
            text += i == 150000 || i == 390000 ? "1 2\n" : "1 2 " + std::to_string(i) + "\n";
        }
        for (const int threads : {1, 2, 4}) {
            ReadOptions options;
            options.threads = threads;
            CHECK(message_of<InputError>([&] { read_text(text, "", options); }) ==
                  file + ", line 150001: z (column 3) is missing" + go_on);
        }
    }

    TEST_CASE("columns that cannot be told are asked for") {
        CHECK(input_error("foo,bar,baz\n1,2,3\n") ==
              file +
                  ", line 1: the header names no x and y; give xfield=, yfield= and z= (the columns are "
                  R"("foo", "bar", "baz"))");
        CHECK(input_error("x,y\n1,2\n") ==
              file + R"(: no column with z; give z=COLUMN or z=NUMBER (the columns are "x", "y"))");
        CHECK(input_error("1,2\n3,4\n") ==
              file +
                  ": no column with z; give z=COLUMN or z=NUMBER (the file has no header and 2 columns, "
                  "numbered from 1)");
        CHECK(input_error("x,y,z\n1,2,3\n", ",z=height") ==
              file + R"(: no column "height" for z=; the columns are "x", "y", "z")");
        CHECK(input_error("1,2,3\n", ",xfield=4") ==
              file + R"(: no column "4" for xfield=; the file has no header and 3 columns, numbered from 1)");
        CHECK(message_of<UsageError>([] { read_text("x,y,z\n1,2,3\n", ",z=x"); }) ==
              file + ": x, y and z must be different columns; check xfield=, yfield= and z=");
    }

    TEST_CASE("a file without rows says so") {
        CHECK(input_error("") == file + ": no rows with coordinates");
        CHECK(input_error("# only\n# comments\n") == file + ": no rows with coordinates");
        CHECK(input_error("x,y,z\n") ==
              file + R"(, line 1: no rows of numbers follow "x,y,z"; samples need x, y and z in columns)");
        CHECK(input_error("Dear Sir,\nhow are you?\n") ==
              file +
                  R"(, line 1: no rows of numbers follow "Dear Sir,"; samples need x, y and z in columns)");
    }

    TEST_CASE("what is no text is told from text") {
        CHECK(input_error(std::string("1 2 3\n\0\n", 8)) ==
              file + ": has bytes that no text has; if it is UTF-16 save it as UTF-8");
    }

    TEST_CASE("when all rows are unusable, skipping them does not help") {
        ReadOptions options;
        options.skip_bad = true;
        CHECK(message_of<InputError>([&] { read_text("x,y,z\n1,2,\n3,4,\n1,x,2\n", "", options); })
                  .starts_with(file + ": nothing usable; 3 skipped, the first is " + file +
                               ", line 2: z (column 3) is missing"));
    }

    TEST_CASE("a file that is not there is an IoError, with a hint at misspelt keys") {
        CHECK(message_of<IoError>([] { read("/vsimem/none.xyz"); }) ==
              R"(cannot open file "/vsimem/none.xyz": no such file)");
        CHECK(message_of<IoError>([] { read("/vsimem/none.xyz,bnd=2"); }) ==
              R"(cannot open file "/vsimem/none.xyz,bnd=2": no such file; "bnd" is no key of a source)");
        CHECK(message_of<IoError>([] { read("/vsimem/none.gpkg"); }) ==
              R"(cannot open file "/vsimem/none.gpkg": no such file)");
    }

    TEST_CASE("a damaged archive is an IoError, not a shorter file") {
        std::string rows;
        for (int i = 0; i < 50000; ++i) {
            rows += std::to_string(i * 7919 % 100003) + " 2 3\n";
        }
        VSILFILE* out = VSIFOpenL("/vsigzip//vsimem/cut.xyz.gz", "wb");
        VSIFWriteL(rows.data(), 1, rows.size(), out);
        VSIFCloseL(out);
        vsi_l_offset size = 0;
        const GByte* const bytes = VSIGetMemFileBuffer("/vsimem/cut.xyz.gz", &size, FALSE);
        const std::string half(bytes, bytes + size / 2);
        VSIUnlink("/vsimem/cut.xyz.gz");
        const MemoryFile cut("half.xyz.gz", half);
        CHECK_THROWS_AS(read(cut.path()), IoError);
    }

    TEST_CASE("keys of layers and bands do not go with format=") {
        CHECK(message_of<UsageError>([] { read_text("1 2 3\n", ",format=xyz,band=1"); }) ==
              R"(source "/vsimem/t.txt": format= is for text, which has no layers, bands or open options)");
        CHECK(
            message_of<UsageError>([] { read_text("1 2 3\n", ",layer=a,band=1"); }) ==
            R"(source "/vsimem/t.txt": band= and stride= are for rasters, layer=, where=, sql=, vertices=, )"
            "xfield= and yfield= for tables");
    }
}
