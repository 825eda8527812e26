#include "tinwright/breaklines/noding.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "breaklines/noding_cases.hpp"
#include "support/cases.hpp"
#include "support/line_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

void check_against_definition(const NodingCase& input) {
    const NodedLines noded = node(input);
    const ExpectedChains expected = expected_chains(input);
    CHECK(sorted_keys(noded) == expected.vertices);
    CHECK(chains_of(noded) == expected.chains);
}

void check_invariance(Random& random, NodingCase input) {
    const NodedLines once = node(input, 1);
    const NodedLines parallel = node(input, 4);
    CHECK(has_same_geometry(once, parallel));
    CHECK(once.pieces == parallel.pieces);
    CHECK(conflict_texts(once) == conflict_texts(parallel));
    input.lines = shuffled_and_reversed(random, std::move(input.lines));
    const NodedLines again = node(input);
    CHECK(has_same_geometry(once, again));
    CHECK(conflict_places(once) == conflict_places(again));
}

void check_idempotence(const NodingCase& input) {
    const NodedLines once = node(input);
    const NodedLines again = node({lines_of_pieces(once, input.lattice), input.lattice});
    CHECK(has_same_geometry(once, again));
    CHECK_FALSE(again.is_rounded);
    CHECK(std::all_of(again.conflicts.begin(), again.conflicts.end(), [](const LineConflict& conflict) {
        return conflict.kind == LineConflict::Kind::ZeroLength;
    }));
}

}  // namespace

TEST_SUITE("breaklines/noding") {
    TEST_CASE("noding gives what its definition gives, by comparing all with all") {
        for (const std::size_t size : {2U, 3U, 5U, 8U, 13U}) {
            CAPTURE(size);
            for_each_case(30, size, [](Random& /*random*/, const NodingCase& input) {
                check_against_definition(input);
            });
        }
    }

    TEST_CASE("pieces meet at their ends only, and stay within half a step of their lines") {
        for_each_case(6, 60, [](Random& /*random*/, const NodingCase& input) {
            CHECK(find_fault(input, node(input)) == "");
        });
    }

    TEST_CASE("vertices, elevations and pieces depend on no order, direction or number of threads") {
        for_each_case(6, 120,
                      [](Random& random, const NodingCase& input) { check_invariance(random, input); });
    }

    TEST_CASE("noding what is noded changes nothing") {
        for_each_case(6, 120, [](Random& /*random*/, const NodingCase& input) { check_idempotence(input); });
    }

    TEST_CASE("nor does it with a thousand segments of every kind: fans, hubs, parallels a unit apart") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            // Lines that all cross each other at tiny angles take time.
            const std::size_t size = std::string(family.name) == "hair crossings" ? 300 : 1000;
            Random random(1);
            check_idempotence(make_case(family, random, size));
        }
    }
}
