#include "tinwright/io/text_layout.hpp"

#include <doctest/doctest.h>

#include "tinwright/io/column_names.hpp"

using namespace tinwright::io;

namespace {

TextLayout layout_of(const std::string& head, const std::string& keys = "") {
    return find_text_layout(head, parse_source("t.txt" + keys), "file \"t.txt\"");
}

}  // namespace

TEST_SUITE("io/text_layout") {
    TEST_CASE("any separator is found from the rows") {
        CHECK(layout_of("1 2 3\n").splitting == TextSplitting{' ', '.'});
        CHECK(layout_of("  1   2\t3 \n").splitting == TextSplitting{' ', '.'});
        CHECK(layout_of("1,2,3\n").splitting == TextSplitting{',', '.'});
        CHECK(layout_of("1, 2, 3\n").splitting == TextSplitting{',', '.'});
        CHECK(layout_of("1;2;3\n").splitting == TextSplitting{';', '.'});
        CHECK(layout_of("1\t2\t3\n").splitting == TextSplitting{'\t', '.'});
        CHECK(layout_of("1|2|3\n").splitting == TextSplitting{'|', '.'});
    }

    TEST_CASE("a decimal comma is told from a separating one") {
        CHECK(layout_of("1,5;2,5;3,5\n").splitting == TextSplitting{';', ','});
        CHECK(layout_of("1;2;3\n4,5;2,5;3,5\n").splitting == TextSplitting{';', ','});
        CHECK(layout_of("1,5\t2,5\t3,5\n").splitting == TextSplitting{'\t', ','});
        CHECK(layout_of("1,5 2,5 3,5\n").splitting == TextSplitting{' ', ','});
        CHECK(layout_of("1.5,2.5,3.5\n").splitting == TextSplitting{',', '.'});
    }

    TEST_CASE("a header names the columns in any order") {
        const TextLayout layout = layout_of("id,Elevation,Northing,Easting\n7,1,2,3\n");
        CHECK(layout.x == 3);
        CHECK(layout.y == 2);
        CHECK(layout.z == 1);
        CHECK(layout.columns == 4);
        CHECK(layout.first_line == 2);
        CHECK_FALSE(layout.is_lon_lat);
    }

    TEST_CASE("usual spellings are recognised, whatever their case and punctuation") {
        const auto is_xyz = [](const std::vector<std::string>& names) {
            const NamedColumns columns = recognise_columns(names);
            return columns.x == 0U && columns.y == 1U && columns.z == 2U;
        };
        CHECK(is_xyz({"x", "y", "z"}));
        CHECK(is_xyz({"X [m]", "Y [m]", "Z [m]"}));
        CHECK(is_xyz({"x_coord", "Y-Coord", "z coord"}));
        CHECK(is_xyz({"EASTING", "Northing", "elev."}));
        CHECK(is_xyz({"E", "N", "H"}));
        CHECK(is_xyz({"E", "N", "El"}));
        CHECK(is_xyz({"Rechtswert", "Hochwert", "H\xC3\xB6he"}));
        CHECK(is_xyz({"POINT_X", "POINT_Y", "altitude"}));
        CHECK(is_xyz({"longitude", "latitude", "height"}));
        CHECK(recognise_columns({"lon", "lat", "z"}).is_lon_lat);
        CHECK_FALSE(recognise_columns({"a", "b"}).x);
    }

    TEST_CASE("projected columns win over longitude and latitude beside them") {
        const NamedColumns columns = recognise_columns({"lon", "lat", "z", "easting", "northing"});
        CHECK(columns.x == 3U);
        CHECK(columns.y == 4U);
        CHECK_FALSE(columns.is_lon_lat);
    }

    TEST_CASE("a comment that names the columns is a header, any other is none") {
        const TextLayout named = layout_of("# y x z\n1 2 3\n");
        CHECK(named.x == 1);
        CHECK(named.y == 0);
        CHECK(named.first_line == 2);
        CHECK(layout_of("// X Y Z\n1 2 3\n").x == 0);
        CHECK(layout_of("# measured by x y z on foot\n1 2 3\n").x == 0);
    }

    TEST_CASE("without a header the first three numeric columns are x, y, z") {
        const TextLayout layout = layout_of("P1 tree 10 20 30 40\n");
        CHECK(layout.x == 2);
        CHECK(layout.y == 3);
        CHECK(layout.z == 4);
    }

    TEST_CASE("format=pnezd reads point, northing, easting, elevation") {
        const TextLayout layout = layout_of("1,5000.0,200.0,30.5,EP\n", ",format=pnezd");
        CHECK(layout.y == 1);
        CHECK(layout.x == 2);
        CHECK(layout.z == 3);
    }

    TEST_CASE("row numbers in front are warned of, since they may mean PNEZD") {
        CHECK(layout_of("1,50,20,3,A\n2,51,21,4,B\n3,52,22,5,C\n").warnings ==
              std::vector<std::string>{"file \"t.txt\": columns 1 to 3 are read as x, y and z, but column 1 "
                                       "counts the rows; if it is "
                                       "point, northing, easting, elevation give format=pnezd"});
        CHECK(layout_of("1,50,20,3\n2,51,21,4\n3,52,22,5\n", ",format=pnezd").warnings.empty());
        CHECK(layout_of("1,50,20\n2,51,21\n3,52,22\n").warnings.empty());
        CHECK(layout_of("1,50,20,3\n3,51,21,4\n4,52,22,5\n").warnings.empty());
    }

    TEST_CASE("columns are chosen by name, else by number from 1") {
        const TextLayout named = layout_of("a,b,c\n1,2,3\n", ",xfield=c,yfield=A,z=2");
        CHECK(named.x == 2);
        CHECK(named.y == 0);
        CHECK(named.z == 1);
        const TextLayout numbered = layout_of("1,2,3,4\n", ",xfield=4,yfield=3,z=1");
        CHECK(numbered.x == 3);
        CHECK(numbered.y == 2);
        CHECK(numbered.z == 0);
        CHECK(layout_of("x,y,z,2\n1,2,3,4\n", ",z=2").z == 3);  // a name before a number
    }

    TEST_CASE("z may be a constant") {
        CHECK(layout_of("1 2\n", ",z=12.5").z_constant == 12.5);
        CHECK(layout_of("1 2\n", ",z=0").z_constant == 0.0);
        CHECK_FALSE(layout_of("1 2 3\n", ",z=3").z_constant);
    }

    TEST_CASE("rows are cut with quotes taken off") {
        const TextSplitting commas{',', '.'};
        CHECK(*split_row(R"("a ""b"", c", 1 ,"2",)", commas) ==
              std::vector<std::string>{"a \"b\", c", "1", "2", ""});
        CHECK(*split_row("5\" pipe,1", commas) == std::vector<std::string>{"5\" pipe", "1"});
        CHECK_FALSE(split_row("1,\"open", commas));
        CHECK(*split_row("\t1\t\t2\r", {'\t', '.'}) == std::vector<std::string>{"", "1", "", "2"});
        CHECK(*split_row(" a \"b  ", {' ', '.'}) == std::vector<std::string>{"a", "\"b"});
    }

    TEST_CASE("text of unknown name is told from other things") {
        CHECK(looks_like_rows("1 2 3\n4 5 6\n"));
        CHECK(looks_like_rows("x;y;z\n1;2;3\n"));
        CHECK_FALSE(looks_like_rows("Dear Sir,\nplease find\n"));
        CHECK_FALSE(looks_like_rows("{\n[1, 2, 3],\n[1, 2, 3],\n[1, 2, 3]\n"));
        CHECK_FALSE(looks_like_rows("<P>\n1 2 3\n4 5 6\n</P>\n"));
        CHECK_FALSE(looks_like_rows(std::string("1 2 3\n\0\n", 8)));
        CHECK_FALSE(looks_like_rows(""));
    }
}
