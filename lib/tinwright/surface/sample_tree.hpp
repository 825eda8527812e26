#ifndef TINWRIGHT_SURFACE_SAMPLE_TREE_HPP
#define TINWRIGHT_SURFACE_SAMPLE_TREE_HPP

#include <cstddef>
#include <optional>
#include <vector>

#include "tinwright/mesh/box_tree.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// The vertices of a TIN that were given, samples and points of lines, ready to be asked for the nearest one;
/// all vertices where none was given. Vertices come in the order of a curve, so runs of eight of them, and of
/// eight runs, make a tree of small boxes without any sorting.
class SampleTree {
  public:
    /// `tin` must outlive it. O(n); 5 bytes a vertex.
    explicit SampleTree(const Tin& tin);

    /// The vertex nearest to a place; of several, the one of smallest id. Exact. `near`: a vertex to start
    /// from, the closer the better, which the answer does not depend on. O(log n) for spread-out samples.
    /// Empty for a TIN without vertices.
    [[nodiscard]] std::optional<VertexId> nearest(Key2 at, std::optional<VertexId> near = std::nullopt) const;
    /// Distance of a place to a vertex, CRS units.
    [[nodiscard]] double distance(Key2 at, VertexId v) const;

  private:
    static constexpr std::size_t kRun = 8;

    struct Search;
    void visit(std::size_t level, std::size_t node, Search& search) const;
    [[nodiscard]] bool is_given(VertexId v) const;

    const Tin& tin_;
    QueryLattice lattice_;
    bool are_all_made_ = false;
    std::vector<std::vector<KeyBox>> levels_;  // level 0: one box for eight vertices; last level: one box
};

}  // namespace tinwright

#endif
