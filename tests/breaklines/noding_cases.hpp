#ifndef TINWRIGHT_TESTS_BREAKLINES_NODING_CASES_HPP
#define TINWRIGHT_TESTS_BREAKLINES_NODING_CASES_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/breaklines/noding.hpp"

#include "support/cases.hpp"
#include "support/line_sets.hpp"

/// Lines with their lattice, noded, and what the oracle says of them.
namespace tinwright_tests {

struct NodingCase {
    std::vector<tinwright::Breakline> lines;
    tinwright::Lattice lattice;
};

/// A set of a family on its own lattice, or on one that is a random number of bits finer.
NodingCase make_case(const LineFamily& family, Random& random, std::size_t size);
/// Lines on the lattice of their own points.
NodingCase make_case(std::vector<tinwright::Breakline> lines);

/// Elevations may differ by a metre: lines that rounding moves together on a coarse lattice do not clash.
tinwright::NodingOptions tolerant();
/// With chains; `threads` 0: in whatever arena there is.
tinwright::NodedLines node(const NodingCase& input, int threads = 0,
                           tinwright::NodingOptions options = tolerant());

using KeyChain = std::vector<tinwright::Key2>;

/// Calls `body(random, input)` for cases of every family, in a loop that doctest tells of.
template <class Body>
void for_each_case(int usual, std::size_t size, const Body& body) {
    for (const LineFamily& family : line_families()) {
        CAPTURE(std::string(family.name));
        for (int seed = 0; seed < cases(usual); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const NodingCase input = make_case(family, random, size);
            body(random, input);
        }
    }
}

/// By the oracle, from the lines' segments.
struct ExpectedChains {
    std::vector<tinwright::Key2> vertices;  ///< in lexicographic order
    std::vector<KeyChain> chains;           ///< one a line
};
ExpectedChains expected_chains(const NodingCase& input);

std::vector<tinwright::Key2> sorted_keys(const tinwright::NodedLines& noded);
std::vector<KeyChain> chains_of(const tinwright::NodedLines& noded);

/// Which edges meet other than at their ends, or nothing.
std::string find_improper_edge(const tinwright::NodedLines& noded);
/// Checks keys, chains against pieces, that pieces meet at ends only and stay by their lines; says what is
/// wrong, or nothing.
std::string find_fault(const NodingCase& input, const tinwright::NodedLines& noded);

/// Same vertices, elevations bit for bit, and edges.
bool has_same_geometry(const tinwright::NodedLines& a, const tinwright::NodedLines& b);

/// A line of two points for each edge, and one without length for each vertex that has none.
std::vector<tinwright::Breakline> lines_of_pieces(const tinwright::NodedLines& noded,
                                                  const tinwright::Lattice& lattice);

/// A conflict a text; without line numbers and elevations.
std::vector<std::string> conflict_texts(const tinwright::NodedLines& noded);
std::vector<std::string> conflict_places(const tinwright::NodedLines& noded);

}  // namespace tinwright_tests

#endif
