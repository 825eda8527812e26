#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/decimal.hpp"

#include "breaklines/noding_cases.hpp"
#include "support/line_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Texts = std::vector<std::string>;

Breakline line(std::vector<Point3> points) {
    Breakline made;
    made.points = std::move(points);
    return made;
}

std::string text_of(const LineConflict& conflict) {
    constexpr std::array kKinds{"Crossing",     "SelfCrossing", "Touch",      "Overlap",
                                "Duplicate",    "ZeroLength",   "NearMiss",   "ElevationClash",
                                "SampleOnLine", "SampleNear",   "OutsideTin", "OutsideBoundary",
                                "Dangling",     "Spike",        "MissingZ",   "OpenRing"};
    constexpr std::array kActions{"Noded", "Merged", "Dropped", "Snapped", "Chosen", "Clamped", "Reported"};
    const auto number = [](std::uint32_t n) { return n == LineConflict::kNone ? "-" : std::to_string(n); };
    return std::string(kKinds[static_cast<std::size_t>(conflict.kind)]) + " " +
           kActions[static_cast<std::size_t>(conflict.action)] + " " + number(conflict.line_a) + " " +
           number(conflict.line_b) + " " + location_text(conflict.location);
}

Texts conflicts_of(const std::vector<Breakline>& lines) {
    Texts texts;
    for (const LineConflict& conflict : node(make_case(lines)).conflicts) {
        texts.push_back(text_of(conflict));
    }
    return texts;
}

}  // namespace

TEST_SUITE("breaklines/noding: conflicts") {
    TEST_CASE("lines that share points that both have are no conflict") {
        CHECK(conflicts_of({line({{0, 0, 1}, {5, 5, 1}, {9, 0, 1}}), line({{5, 5, 1}, {5, 9, 1}}),
                            line({{0, 9, 1}, {5, 5, 1}, {9, 9, 1}})}) == Texts{});
    }

    TEST_CASE("a ring that repeats its first point, and a line that ends in its own point, are no conflict") {
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 0, 1}})}) == Texts{});
        CHECK(conflicts_of({line({{-9, 9, 1}, {0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 0, 1}})}) == Texts{});
    }

    TEST_CASE("two lines that cross are named with what they say there") {
        const NodedLines noded =
            node(make_case({line({{0, 0, 10}, {10, 10, 10}}), line({{0, 10, 10}, {10, 0, 10}})}));
        REQUIRE(noded.conflicts.size() == 1);
        CHECK(text_of(noded.conflicts[0]) == "Crossing Noded 0 1 (5, 5)");
        CHECK(noded.conflicts[0].z_a == 10);
        CHECK(noded.conflicts[0].z_b == 10);
        CHECK(noded.keys.size() == 5);
        CHECK(noded.pieces.size() == 4);
        CHECK_FALSE(noded.is_rounded);
    }

    TEST_CASE("a crossing off the lattice is rounded") {
        const NodedLines noded =
            node(make_case({line({{0, 0, 1}, {10, 10, 1}}), line({{0, 1, 1}, {10, 0, 1}})}));
        CHECK(noded.is_rounded);
        CHECK(noded.pieces.size() == 4);
    }

    TEST_CASE("many lines through one place are one conflict, of the two smallest numbers") {
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 10, 1}}), line({{0, 10, 1}, {10, 0, 1}}),
                            line({{5, 0, 1}, {5, 10, 1}}), line({{0, 5, 1}, {10, 5, 1}})}) ==
              Texts{"Crossing Noded 0 1 (5, 5)"});
    }

    TEST_CASE("a point of a line inside another is a touch, whether end or not") {
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}}), line({{5, 0, 1}, {5, 5, 1}})}) ==
              Texts{"Touch Noded 0 1 (5, 0)"});
        CHECK(conflicts_of({line({{0, 5, 1}, {5, 0, 1}, {10, 5, 1}}), line({{0, 0, 1}, {10, 0, 1}})}) ==
              Texts{"Touch Noded 0 1 (5, 0)"});
    }

    TEST_CASE("a line through itself is a self-crossing") {
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}, {5, 5, 1}, {5, -5, 1}})}) ==
              Texts{"SelfCrossing Noded 0 0 (5, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}, {5, 5, 1}, {5, 0, 1}})}) ==
              Texts{"SelfCrossing Noded 0 0 (5, 0)"});
    }

    TEST_CASE("lines along the same stretch overlap once, however many vertices it has") {
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}}), line({{4, 0, 1}, {20, 0, 1}})}) ==
              Texts{"Overlap Merged 0 1 (4, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {2, 0, 1}, {4, 0, 1}, {6, 0, 1}, {8, 8, 1}}),
                            line({{0, 0, 1}, {6, 0, 1}, {8, -8, 1}})}) == Texts{"Overlap Merged 0 1 (0, 0)"});
    }

    TEST_CASE("two stretches of the same lines are two overlaps") {
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {6, 5, 1}, {8, 0, 1}, {12, 0, 1}}),
                            line({{0, 0, 1}, {4, 0, 1}, {6, -5, 1}, {8, 0, 1}, {12, 0, 1}})}) ==
              Texts{"Overlap Merged 0 1 (0, 0)", "Overlap Merged 0 1 (8, 0)"});
    }

    TEST_CASE("a line that turns back overlaps itself") {
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}, {4, 0, 1}})}) == Texts{"Overlap Merged 0 0 (4, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {10, 0, 1}, {0, 0, 1}})}) == Texts{"Overlap Merged 0 0 (0, 0)"});
    }

    TEST_CASE("a whole line again is a duplicate, in either direction, closed ones from any point on") {
        const Breakline way = line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}});
        const Breakline back = line({{4, 4, 1}, {4, 0, 1}, {0, 0, 1}});
        CHECK(conflicts_of({way, back, way}) ==
              Texts{"Duplicate Merged 0 1 (0, 0)", "Duplicate Merged 0 2 (0, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 0, 1}}),
                            line({{4, 0, 1}, {0, 0, 1}, {4, 4, 1}, {4, 0, 1}})}) ==
              Texts{"Duplicate Merged 0 1 (0, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 0, 1}}),
                            line({{4, 0, 1}, {0, 0, 1}, {4, 4, 1}})}) == Texts{"Overlap Merged 0 1 (0, 0)"});
    }

    TEST_CASE("what a duplicate crosses is a conflict of the line that it repeats") {
        const Breakline way = line({{0, 0, 1}, {10, 10, 1}});
        CHECK(conflicts_of({line({{0, 10, 1}, {10, 0, 1}}), way, way}) ==
              Texts{"Duplicate Merged 1 2 (0, 0)", "Crossing Noded 0 1 (5, 5)"});
    }

    TEST_CASE("points at one place are merged, a line without length is dropped but for its vertex") {
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 0, 1}, {4, 0, 1}, {8, 0, 1}})}) ==
              Texts{"ZeroLength Merged 0 - (4, 0)"});
        const NodedLines noded =
            node(make_case({line({{3, 0, 1}, {3, 0, 1}}), line({{0, 0, 1}, {2, 0, 1}})}));
        REQUIRE(noded.conflicts.size() == 1);
        CHECK(text_of(noded.conflicts[0]) == "ZeroLength Dropped 0 - (3, 0)");
        CHECK(noded.keys.size() == 3);
        CHECK(noded.pieces.size() == 1);
    }

    TEST_CASE("neighbours that share a side overlap along it, rings that touch in a point touch") {
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}, {0, 0, 1}}),
                            line({{4, 0, 1}, {8, 0, 1}, {8, 4, 1}, {4, 4, 1}, {4, 0, 1}})}) ==
              Texts{"Overlap Merged 0 1 (4, 0)"});
        CHECK(conflicts_of({line({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}, {0, 0, 1}}),
                            line({{4, 2, 1}, {8, 0, 1}, {8, 4, 1}, {4, 2, 1}})}) ==
              Texts{"Touch Noded 0 1 (4, 2)"});
    }

    TEST_CASE("no lines, and lines without points, give nothing") {
        CHECK(node({{}, Lattice::decimal(0, {0, 0})}).keys.empty());
        const NodedLines noded = node({{Breakline{}, Breakline{}}, Lattice::decimal(0, {0, 0})});
        CHECK(noded.keys.empty());
        CHECK(noded.conflicts.empty());
        CHECK(noded.chain_start == std::vector<std::uint32_t>{0, 0, 0});
    }

    TEST_CASE("thousands of lines along one edge, and through one place, are done in no time") {
        std::vector<Breakline> lines;
        for (int i = 0; i < 2000; ++i) {
            const double off = i + 1;
            lines.push_back(line({{-off, 7, 0}, {0, 0, 0}, {100, 0, 0}, {100 + off, -9, 0}}));
            lines.push_back(line({{50 - off, -1e6, 0}, {50 + off, 1e6, 0}}));
        }
        const NodedLines noded = node(make_case(lines));
        CHECK(noded.keys.size() >= 4 * 2000);
    }
}
