#include "progress.hpp"

#include <sstream>

#include <doctest/doctest.h>

using tinwright::tools::ProgressLine;

TEST_SUITE("tools/progress") {
    TEST_CASE("progress reads as GDAL's does") {
        std::ostringstream out;
        ProgressLine line(&out);
        line.show(0);
        CHECK(out.str() == "0");
        line.show(0.1);
        CHECK(out.str() == "0...10");
        line.show(0.05);
        CHECK(out.str() == "0...10");
        line.finish();
        CHECK(out.str() == "0...10...20...30...40...50...60...70...80...90...100 - done.\n");
    }

    TEST_CASE("stages divide the line, and fractions out of range are taken to the ends") {
        std::ostringstream out;
        ProgressLine line(&out);
        const auto first = line.stage(0, 0.2);
        const auto second = line.stage(0.2, 1);
        CHECK(first(-1));
        CHECK(first(2));
        CHECK(out.str() == "0...10...20");
        CHECK(second(0.125));
        CHECK(out.str() == "0...10...20...30");
    }

    TEST_CASE("a line that is broken off is ended") {
        std::ostringstream out;
        {
            ProgressLine line(&out);
            line.show(0.1);
        }
        CHECK(out.str() == "0...10\n");
    }

    TEST_CASE("nothing is shown without a stream") {
        ProgressLine line(nullptr);
        CHECK(line.stage(0, 1)(0.5));
        line.finish();
    }
}
