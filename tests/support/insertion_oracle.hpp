#ifndef TINWRIGHT_TESTS_SUPPORT_INSERTION_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_INSERTION_ORACLE_HPP

#include <optional>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/mesh/tin.hpp"

/// Whether a single edge insertion improves a TIN, by trying all of them.
namespace tinwright_tests::oracle {

/// The insertion of q s replaces faces of which the worst has badness `before` by better ones.
struct BetterInsertion {
    tinwright::VertexId q{};
    tinwright::VertexId s{};
    long double before = 0;
};

/// Tries all pairs of vertices that can be joined without crossing constrained edges, vertices or what is not
/// terrain: the faces crossed are taken away, and the polygons on both sides are filled by dynamic
/// programming with faces better, by more than 1e-9 of it, than the worst that was crossed. Only pairs are
/// looked at that cross a face of badness `least` or more. The first improvement found, if there is one.
/// O(n^2) pairs, cubic in the number of edges crossed.
std::optional<BetterInsertion> find_better_insertion(const tinwright::Tin& tin,
                                                     tinwright::Criterion criterion, long double least);

}  // namespace tinwright_tests::oracle

#endif
