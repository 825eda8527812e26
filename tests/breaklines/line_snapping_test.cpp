#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/noding.hpp"

#include "breaklines/noding_cases.hpp"
#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/noding_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

Breakline line(const std::vector<Point2>& points) {
    Breakline made;
    for (const Point2 point : points) {
        made.points.push_back({point.x, point.y, 0});
    }
    return made;
}

NodingOptions with_snap(double snap) {
    NodingOptions options = tolerant();
    options.crossing_z = CrossingPolicy::Mean;
    options.snap = snap;
    return options;
}

/// Positions along each line.
std::vector<std::vector<Point2>> snapped(const std::vector<Breakline>& lines, double snap) {
    const NodingCase input = make_case(lines);
    std::vector<std::vector<Point2>> ways;
    for (const KeyChain& chain : chains_of(node(input, 0, with_snap(snap)))) {
        ways.emplace_back();
        for (const Key2 key : chain) {
            ways.back().push_back(input.lattice.position(key));
        }
    }
    return ways;
}

using Ways = std::vector<std::vector<Point2>>;

std::size_t count_misses(const NodedLines& noded) {
    return count_conflicts(noded.conflicts)[static_cast<std::size_t>(LineConflict::Kind::NearMiss)];
}

/// The ends of each line stay where they were, but for the distance and a step where they meet another line.
bool are_ends_near(const NodingCase& input, const NodedLines& noded, double snap) {
    const std::vector<KeyChain> chains = chains_of(noded);
    const auto is_near = [&](const Point3& point, Key2 key) {
        const Point2 at = input.lattice.position(key);
        return std::hypot(at.x - point.x, at.y - point.y) <= snap + 2 * input.lattice.quantum();
    };
    for (std::size_t i = 0; i < chains.size(); ++i) {
        if (!is_near(input.lines[i].points.front(), chains[i].front()) ||
            !is_near(input.lines[i].points.back(), chains[i].back())) {
            return false;
        }
    }
    return true;
}

void check_snapping(Random& random, NodingCase input, double snap) {
    const NodedLines once = node(input, 1, with_snap(snap));
    CHECK(find_improper_edge(once) == "");
    CHECK(are_ends_near(input, once, snap));
    input.lines = shuffled_and_reversed(random, std::move(input.lines));
    const NodedLines again = node(input, 0, with_snap(snap));
    CHECK(has_same_geometry(once, again));
    CHECK(conflict_places(once) == conflict_places(again));
}

/// Lines that begin and end within a decimetre of two of 25 points, ten metres apart.
std::vector<Breakline> lines_between_spots(Random& random, int count) {
    std::vector<Breakline> lines;
    for (int i = 0; i < count; ++i) {
        const std::int64_t from = random.integer(0, 24);
        const std::int64_t to = (from + random.integer(1, 24)) % 25;
        const auto end = [&](std::int64_t spot) {
            const std::int64_t row = spot / 5;
            return Point2{static_cast<double>(10 * (spot % 5)) + 0.01 * random.key(10),
                          static_cast<double>(10 * row) + 0.01 * random.key(10)};
        };
        lines.push_back(line({end(from), end(to)}));
    }
    return lines;
}

/// Of different keys.
double least_distance(const std::vector<Key2>& keys) {
    double least = kKeyLimit;
    for (const Key2 p : keys) {
        for (const Key2 q : keys) {
            least = p == q ? least : std::min(least, std::hypot(p.x - q.x, p.y - q.y));
        }
    }
    return least;
}

}  // namespace

TEST_SUITE("breaklines/line_snapping") {
    TEST_CASE("nothing moves without a distance") {
        const std::vector<Breakline> lines{line({{0, 0}, {10, 0}}), line({{10.1, 0}, {20, 0}})};
        CHECK(snapped(lines, 0) == Ways{{{0, 0}, {10, 0}}, {{10.1, 0}, {20, 0}}});
    }

    TEST_CASE("ends nearer than the distance become one, at the place that is first in curve order") {
        const std::vector<Breakline> lines{line({{0, 0}, {10, 0}}), line({{10.1, 0}, {20, 0}})};
        CHECK(snapped(lines, 0.2) == Ways{{{0, 0}, {10, 0}}, {{10, 0}, {20, 0}}});
        CHECK(snapped(lines, 0.1) == Ways{{{0, 0}, {10, 0}}, {{10.1, 0}, {20, 0}}});
        const NodedLines noded = node(make_case(lines), 0, with_snap(0.2));
        REQUIRE(noded.conflicts.size() == 1);
        CHECK(noded.conflicts[0].kind == LineConflict::Kind::NearMiss);
        CHECK(noded.conflicts[0].action == LineConflict::Action::Snapped);
        CHECK(noded.conflicts[0].line_a == 0);
        CHECK(noded.conflicts[0].line_b == 1);
        CHECK(noded.conflicts[0].location == Point2{10, 0});
    }

    TEST_CASE("an end near another line goes onto it, which gets a vertex there") {
        const std::vector<Breakline> lines{line({{0, 0}, {10, 0}}), line({{5, 0.1}, {5, 8}})};
        CHECK(snapped(lines, 0.2) == Ways{{{0, 0}, {5, 0}, {10, 0}}, {{5, 0}, {5, 8}}});
        CHECK(snapped(lines, 0.05) == Ways{{{0, 0}, {10, 0}}, {{5, 0.1}, {5, 8}}});
    }

    TEST_CASE("a line that overshoots keeps its crossing, and its end goes onto the line") {
        const std::vector<Breakline> lines{line({{0, 0}, {10, 0}}), line({{5, -0.1}, {5, 8}})};
        CHECK(snapped(lines, 0.2) == Ways{{{0, 0}, {5, 0}, {10, 0}}, {{5, 0}, {5, 8}}});
    }

    TEST_CASE("a nearly closed line is closed, dense points along it stay") {
        const std::vector<Breakline> gap{line({{0, 0}, {10, 0}, {10, 10}, {0.1, 0.1}})};
        CHECK(snapped(gap, 0.5) == Ways{{{0, 0}, {10, 0}, {10, 10}, {0, 0}}});
        const std::vector<Breakline> dense{line({{0, 0}, {0.1, 0}, {0.2, 0.1}, {0.3, 0.1}, {0.4, 0}})};
        CHECK(snapped(dense, 0.35)[0].size() == 5);
        const std::vector<Breakline> ring{line({{0, 0.1}, {0.1, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0.1}})};
        CHECK(snapped(ring, 0.5)[0].size() == 6);
    }

    TEST_CASE("a shared dense edge of two lines is not shortened") {
        const std::vector<Breakline> lines{line({{5, 5}, {0, 0}, {0.1, 0}, {0.2, 0}, {5, -5}}),
                                           line({{-5, 5}, {0, 0}, {0.1, 0}, {0.2, 0}, {-5, -5}})};
        const Ways ways = snapped(lines, 0.15);
        CHECK(ways[0].size() == 5);
        CHECK(ways[1].size() == 5);
    }

    TEST_CASE("snapped lines are sound, near misses are gone where they were moved, points moved little") {
        for_each_case(6, 60, [](Random& random, const NodingCase& input) {
            check_snapping(random, input, 0.01 * static_cast<double>(random.integer(1, 300)));
        });
    }

    TEST_CASE("ends scattered around common points meet in them") {
        for (int seed = 0; seed < cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const NodingCase input = make_case(lines_between_spots(random, 30));
            const NodedLines noded = node(input, 0, with_snap(0.5));
            std::vector<Key2> ends;
            for (const KeyChain& chain : chains_of(noded)) {
                ends.push_back(chain.front());
                ends.push_back(chain.back());
            }
            CHECK(least_distance(ends) * input.lattice.quantum() > 5);
            CHECK(count_misses(noded) > 0);
        }
    }
}
