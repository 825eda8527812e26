#ifndef TINWRIGHT_TESTS_SUPPORT_INSERTION_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_INSERTION_ORACLE_HPP

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/mesh/tin.hpp"

/// Whether a single edge insertion improves a TIN, by trying all of them.
namespace tinwright_tests::oracle {

/// What an edge q s that is not there yet crosses.
struct Corridor {
    std::vector<tinwright::FaceId> faces;                     ///< from q on
    std::vector<std::array<tinwright::VertexId, 2>> crossed;  ///< edges, right end first
    std::vector<tinwright::VertexId> left;                    ///< polygons on both sides, counter-clockwise
    std::vector<tinwright::VertexId> right;
};

/// Walks from vertex to vertex of one TIN.
class Crossings {
  public:
    explicit Crossings(const tinwright::Tin& tin);
    /// Empty if q and s cannot be joined without crossing constrained edges, vertices or what is not terrain,
    /// or are joined already.
    [[nodiscard]] std::optional<Corridor> find(tinwright::VertexId q, tinwright::VertexId s) const;

  private:
    const tinwright::Tin& tin_;
    std::vector<std::vector<tinwright::HalfEdgeId>> corners_;  ///< of terrain faces, by vertex
};

using IsGood = std::function<bool(tinwright::VertexId, tinwright::VertexId, tinwright::VertexId)>;
/// Whether a polygon can be cut into counter-clockwise faces that are all good. A polygon whose faces are all
/// counter-clockwise is covered by them once, cracks or not.
bool can_fill(const tinwright::Tin& tin, const std::vector<tinwright::VertexId>& polygon,
              const IsGood& is_good);

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
