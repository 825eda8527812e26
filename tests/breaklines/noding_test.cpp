#include "tinwright/breaklines/noding.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "breaklines/noding_cases.hpp"
#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/noding_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

TEST_SUITE("breaklines/noding") {
    TEST_CASE("noding gives what its definition gives, by comparing all with all") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(40); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const NodingCase input = make_case(family, random, 2 + static_cast<std::size_t>(seed % 12));
                const NodedLines noded = node(input);
                const ExpectedChains expected = expected_chains(input);
                CHECK(sorted_keys(noded) == expected.vertices);
                CHECK(chains_of(noded) == expected.chains);
            }
        }
    }

    TEST_CASE("pieces meet at their ends only, and stay within half a step of their lines") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const NodingCase input = make_case(family, random, 60);
                const NodedLines noded = node(input);
                CHECK(find_fault(input, noded) == "");
            }
        }
    }

    TEST_CASE("vertices, elevations and pieces depend on no order, direction or number of threads") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                NodingCase input = make_case(family, random, 120);
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
        }
    }

    TEST_CASE("noding what is noded changes nothing") {
        for (const LineFamily& family : line_families()) {
            CAPTURE(std::string(family.name));
            for (int seed = 0; seed < cases(6); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const NodingCase input = make_case(family, random, 120);
                const NodedLines once = node(input);
                const NodedLines again = node({lines_of_pieces(once, input.lattice), input.lattice});
                CHECK(has_same_geometry(once, again));
                CHECK_FALSE(again.is_rounded);
                CHECK(again.conflicts.empty());
            }
        }
    }
}
