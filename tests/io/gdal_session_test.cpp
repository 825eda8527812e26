#include "tinwright/io/gdal_session.hpp"

#include <thread>

#include <cpl_error.h>
#include <doctest/doctest.h>

using tinwright::io::GdalMessages;
using tinwright::io::quoted;
using tinwright::io::quoted_list;

TEST_SUITE("io/gdal_session") {
    TEST_CASE("quoted text is one line of printable characters") {
        CHECK(quoted("plain text") == "\"plain text\"");
        CHECK(quoted("") == "\"\"");
        CHECK(quoted("a\"b\\c") == R"("a\"b\\c")");
        CHECK(quoted("a\nb\tc\rd") == R"("a\nb\tc\rd")");
        CHECK(quoted(std::string("\0\x1b[2J\x7f", 6)) == R"("\x00\x1b[2J\x7f")");
    }

    TEST_CASE("well-formed UTF-8 stays, everything else is escaped") {
        CHECK(quoted("p\xC3\xA4\xE4\xB8\xAD\xF0\x9F\x8F\x94") == "\"p\xC3\xA4\xE4\xB8\xAD\xF0\x9F\x8F\x94\"");
        CHECK(quoted("\xC3") == R"("\xc3")");
        CHECK(quoted("\xC0\xAF") == R"("\xc0\xaf")");                  // overlong
        CHECK(quoted("\xED\xA0\x80") == R"("\xed\xa0\x80")");          // surrogate
        CHECK(quoted("\xF4\x90\x80\x80") == R"("\xf4\x90\x80\x80")");  // beyond U+10FFFF
        CHECK(quoted("\xC2\x9B") == R"("\xc2\x9b")");                  // a control character
    }

    TEST_CASE("long text is shortened in the middle, between characters") {
        std::string text;
        for (int i = 0; i < 300; ++i) {
            text += "\xC3\xA4";
        }
        const std::string shown = quoted(text);
        CHECK(shown.size() == 2 + 2 * 96 * 2 + 3);
        CHECK(shown.find("...") == 1 + 2 * 96);
        CHECK(quoted(std::string(200, 'a')) == "\"" + std::string(200, 'a') + "\"");
    }

    TEST_CASE("a list is quoted name by name and cut after twenty") {
        CHECK(quoted_list({}).empty());
        CHECK(quoted_list({"a", "b\n"}) == R"("a", "b\n")");
        CHECK(quoted_list(std::vector<std::string>(21, "a")).ends_with(R"("a", "a", ...)"));
    }

    TEST_CASE("GDAL's last error is kept on one line") {
        const GdalMessages messages;
        CHECK(messages.suffix().empty());
        CPLError(CE_Failure, CPLE_AppDefined, "first");
        CPLError(CE_Warning, CPLE_AppDefined, "a warning");
        CPLError(CE_Failure, CPLE_AppDefined, "cannot\n  open it.");
        CHECK(messages.last_error() == "cannot open it");
        CHECK(messages.last_warning() == "a warning");
        CHECK(messages.suffix() == "; GDAL says: cannot open it");
    }

    TEST_CASE("messages go to the youngest object, and back when it is gone") {
        const GdalMessages outer;
        {
            const GdalMessages inner;
            CPLError(CE_Failure, CPLE_AppDefined, "inner");
            CHECK(inner.last_error() == "inner");
        }
        CHECK(outer.last_error().empty());
        CPLError(CE_Failure, CPLE_AppDefined, "outer");
        CHECK(outer.last_error() == "outer");
    }

    TEST_CASE("messages of GDAL's own threads are kept too") {
        const GdalMessages messages;
        std::thread([] { CPLError(CE_Failure, CPLE_AppDefined, "from a worker"); }).join();
        CHECK(messages.last_error() == "from a worker");
    }
}
