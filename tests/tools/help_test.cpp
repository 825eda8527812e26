#include <algorithm>
#include <sstream>

#include <doctest/doctest.h>

#include "command.hpp"
#include "command_registry.hpp"

namespace {

using namespace tinwright::tools;

std::string help_of(const CommandEntry& entry) {
    try {
        entry.make()->setup({"--help"});
    } catch (const HelpRequest& help) {
        return help.text;
    }
    return {};
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// The long options that a help screen lists, without their dashes.
std::vector<std::string> options_of(const std::string& help) {
    std::vector<std::string> options;
    for (const std::string& line : lines_of(help)) {
        const std::size_t begin = line.find("--");
        if (line.starts_with("  ") && begin == 6) {
            options.push_back(line.substr(begin + 2, line.find_first_of(" ,", begin) - begin - 2));
        }
    }
    return options;
}

}  // namespace

TEST_SUITE("tools/help") {
    TEST_CASE("help fits on one tall screen and ends with examples") {
        for (const CommandEntry& entry : all_commands()) {
            CAPTURE(entry.name);
            const std::vector<std::string> lines = lines_of(help_of(entry));
            CHECK(lines.size() >= 10);
            CHECK(lines.size() <= 56);
            CHECK(
                std::all_of(lines.begin(), lines.end(), [](const std::string& l) { return l.size() <= 80; }));
            CHECK(lines.back().starts_with("  tinwright " + std::string(entry.name) + " "));
        }
        CHECK(lines_of(overview()).size() <= 24);
    }

    TEST_CASE("the overview names every command") {
        for (const CommandEntry& entry : all_commands()) {
            CHECK(overview().find("\n  " + std::string(entry.name) + " ") != std::string::npos);
        }
    }

    TEST_CASE("every option stands in the manual page of its command") {
        for (const CommandEntry& entry : all_commands()) {
            CAPTURE(entry.name);
            const std::string page = manual_page(entry.name);
            for (const std::string& option : options_of(help_of(entry))) {
                CAPTURE(option);
                CHECK((option == "help" || page.find("--" + option) != std::string::npos));
            }
        }
    }

    TEST_CASE("manual pages have the sections that people look for") {
        for (const CommandEntry& entry : all_commands()) {
            CAPTURE(entry.name);
            const std::string page = manual_page(entry.name);
            CHECK(page.starts_with("NAME\n\ntinwright-" + std::string(entry.name) + " - "));
            for (const char* section :
                 {"\nSYNOPSIS\n", "\nOPTIONS\n", "\nDIAGNOSTICS\n", "\nMEMORY USAGE\n", "\nEXAMPLES\n"}) {
                CHECK(page.find(section) != std::string::npos);
            }
        }
    }

    TEST_CASE("there is no page for what is no command") {
        CHECK_THROWS_WITH(static_cast<void>(manual_page("water")),
                          "no manual page for \"water\": \"tinwright --help\" lists the commands");
    }
}
