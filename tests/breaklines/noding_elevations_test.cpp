#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/error.hpp"

#include "breaklines/noding_cases.hpp"
#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/messages.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

Breakline line(std::vector<Point3> points) {
    Breakline made;
    made.points = std::move(points);
    return made;
}

NodingOptions with_policy(CrossingPolicy policy, double tolerance = 0) {
    NodingOptions options;
    options.crossing_z = policy;
    options.crossing_tolerance = tolerance;
    return options;
}

/// Elevation of the vertex at a location.
double z_at(const NodingCase& input, const NodedLines& noded, Point2 location) {
    const auto found = std::find(noded.keys.begin(), noded.keys.end(), input.lattice.key(location));
    REQUIRE(found != noded.keys.end());
    return noded.z[static_cast<std::size_t>(found - noded.keys.begin())];
}

double crossing_z(std::vector<Breakline> lines, const NodingOptions& options) {
    const NodingCase input = make_case(std::move(lines));
    return z_at(input, node(input, 0, options), {5, 5});
}

/// Crossing at (5, 5) with elevations 10 and 16.
const std::vector<Breakline>& clashing() {
    static const std::vector<Breakline> lines{line({{0, 0, 8}, {10, 10, 12}}),
                                              line({{0, 10, 20}, {10, 0, 12}})};
    return lines;
}

}  // namespace

TEST_SUITE("breaklines/noding: elevations") {
    TEST_CASE("each policy chooses among the linear elevations where lines cross") {
        CHECK(crossing_z(clashing(), with_policy(CrossingPolicy::Mean)) == 13);
        CHECK(crossing_z(clashing(), with_policy(CrossingPolicy::First)) == 10);
        CHECK(crossing_z(clashing(), with_policy(CrossingPolicy::Min)) == 10);
        CHECK(crossing_z(clashing(), with_policy(CrossingPolicy::Max)) == 16);
        CHECK(crossing_z({clashing()[1], clashing()[0]}, with_policy(CrossingPolicy::First)) == 16);
        CHECK(crossing_z(clashing(), with_policy(CrossingPolicy::Error, 6)) == 13);
    }

    TEST_CASE("a clash is reported with both elevations beside the crossing") {
        const NodedLines noded = node(make_case(clashing()), 0, with_policy(CrossingPolicy::Max));
        REQUIRE(noded.conflicts.size() == 2);
        const LineConflict& clash = noded.conflicts[1];
        CHECK(clash.kind == LineConflict::Kind::ElevationClash);
        CHECK(clash.action == LineConflict::Action::Chosen);
        CHECK(clash.line_a == 0);
        CHECK(clash.line_b == 1);
        CHECK(clash.z_a == 10);
        CHECK(clash.z_b == 16);
        CHECK(clash.location == Point2{5, 5});
    }

    TEST_CASE("policy error names the number of places, the first, both elevations and what to try") {
        const auto text_for = [](const std::vector<Breakline>& lines) {
            return message_of<BreaklineError>(
                [&] { node(make_case(lines), 0, with_policy(CrossingPolicy::Error, 0.5)); });
        };
        CHECK(text_for(clashing()) ==
              "lines have different elevations at 1 place, (5, 5) with z 10 and 16; say which to take with "
              "--crossing-z mean|first|min|max, or allow for the difference with --crossing-tolerance");
        std::vector<Breakline> more = clashing();
        more.push_back(line({{20, 0, 1}, {20, 20, 1}}));
        more.push_back(line({{15, 10, 3}, {25, 10, 3}}));
        CHECK(text_for(more) ==
              "lines have different elevations at 2 places, the first (5, 5) with z 10 and 16; say which to "
              "take with --crossing-z mean|first|min|max, or allow for the difference with "
              "--crossing-tolerance");
        try {
            node(make_case({more[2], more[3]}), 0, with_policy(CrossingPolicy::Error));
            FAIL("no error");
        } catch (const BreaklineError& error) {
            CHECK(error.lines() == std::vector<std::size_t>{0, 1});
        }
    }

    TEST_CASE(
        "points of lines keep their elevation, and give it to lines that say the same but for rounding") {
        // A tenth is no double: where the second line says 0.1 * 3 the first one's point says 0.3.
        const std::vector<Breakline> lines{line({{0, 0, 0.3}, {3, 3, 0.3}}), line({{0, 3, 0}, {10, 3, 1}}),
                                           line({{3, 3, 0.3}, {3, 9, 0.7}})};
        const NodingCase input = make_case(lines);
        const NodedLines noded = node(input, 0, with_policy(CrossingPolicy::Error));
        CHECK(z_at(input, noded, {3, 3}) == 0.3);
        CHECK(z_at(input, noded, {10, 3}) == 1);
    }

    TEST_CASE("points that differ at all clash under a tolerance of zero") {
        const std::vector<Breakline> lines{line({{0, 0, 1}, {5, 5, 1}}),
                                           line({{5, 5, std::nextafter(1.0, 2.0)}, {9, 0, 1}})};
        CHECK_THROWS_AS(crossing_z(lines, with_policy(CrossingPolicy::Error)), BreaklineError);
        CHECK(crossing_z(lines, with_policy(CrossingPolicy::Min)) == 1);
    }

    TEST_CASE("a draped line takes the elevation of the other, and none where there is none") {
        const std::vector<Breakline> lines{line({{0, 0, kDraped}, {10, 10, kDraped}}),
                                           line({{0, 10, 4}, {10, 0, 6}})};
        const NodingCase input = make_case(lines);
        const NodedLines noded = node(input, 0, with_policy(CrossingPolicy::Error));
        CHECK(z_at(input, noded, {5, 5}) == 5);
        CHECK(std::isnan(z_at(input, noded, {0, 0})));
        CHECK(std::isnan(z_at(input, noded, {10, 10})));
        const NodingCase both = make_case({lines[0], line({{0, 10, kDraped}, {10, 0, 3}})});
        CHECK(std::isnan(z_at(both, node(both, 0, with_policy(CrossingPolicy::Error)), {5, 5})));
    }

    TEST_CASE("a step in one line at one place is a clash with itself") {
        const std::vector<Breakline> lines{line({{0, 0, 1}, {5, 5, 1}, {5, 5, 3}, {9, 9, 3}})};
        const NodedLines noded = node(make_case(lines), 0, with_policy(CrossingPolicy::Max));
        REQUIRE(noded.conflicts.size() == 2);
        CHECK(noded.conflicts[0].kind == LineConflict::Kind::ZeroLength);
        CHECK(noded.conflicts[1].kind == LineConflict::Kind::ElevationClash);
        CHECK(noded.conflicts[1].line_a == 0);
        CHECK(noded.conflicts[1].line_b == 0);
        CHECK(crossing_z(lines, with_policy(CrossingPolicy::Max)) == 3);
    }

    TEST_CASE("the mean counts each line once") {
        // A ring has its first point twice, and a line through itself says two things.
        const std::vector<Breakline> lines{line({{5, 5, 4}, {9, 5, 4}, {9, 9, 4}, {5, 5, 4}}),
                                           line({{5, 5, 1}, {0, 5, 1}}), line({{5, 5, 1}, {5, 0, 1}})};
        CHECK(crossing_z(lines, with_policy(CrossingPolicy::Mean)) == 2);
    }

    TEST_CASE("on a tilted plane no lines clash once the lattice is fine, whatever crosses") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(4); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Breakline> lines = family.make(random, 60).lines;
                if (std::string(family.name) == "hair crossings") {
                    continue;  // lines at an angle too small for the lattice are moved across the slope
                }
                NodingCase input = make_case(lines);
                input.lattice = input.lattice.refined(input.lattice.refinement_room(0x1p24));
                const NodedLines noded = node(input, 0, with_policy(CrossingPolicy::Error));
                double worst = 0;
                for (std::size_t v = 0; v < noded.keys.size(); ++v) {
                    const Point2 at = input.lattice.position(noded.keys[v]);
                    worst = std::max(worst, std::abs(noded.z[v] - plane_z(at.x, at.y)));
                }
                // The plane rises by less than 0.13, and half a step each way is less than a step.
                CHECK(worst < 0.13 * input.lattice.quantum() + 1e-9);
            }
        }
    }
}
