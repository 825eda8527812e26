#ifndef TINWRIGHT_DELAUNAY_BLOCKING_DISKS_HPP
#define TINWRIGHT_DELAUNAY_BLOCKING_DISKS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/box_tree.hpp"

/// The blocking phase of [tan1993, Sec. 6.2.2]: disks without vertices that form one connected set.
/// Nothing here is exact: what follows from it is rounded to the lattice anyway.
namespace tinwright {

/// A vector in steps of the lattice, not whole ones.
struct Offset {
    double x = 0;
    double y = 0;
};

/// One of the disks D_j, with its circle through vertex j and its centre on the tree's edge from j to i_j.
struct BlockingDisk {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    VertexId vertex{};    ///< j
    VertexId towards{};   ///< i_j
    Offset center;        ///< from the key of `vertex`
    double radius = 0;    ///< steps of the lattice
    bool is_full = true;  ///< whether the circle goes through `towards`, too
    /// An earlier disk that this one touches, kNone for the first: at `towards` if it is full, else where
    /// the segment between the two centres leaves this disk.
    std::uint32_t touched = kNone;
};

/// The part of an edge of a line within one disk: shares of the way from its first to its second end.
struct Chord {
    double from = 0;
    double to = 0;
    std::uint32_t disk = 0;
};

/// n - 1 disks for n vertices such that (1) none holds a vertex, (2) they are disjoint, (3) their closures
/// are connected and (4) have every vertex, all this but for rounding: by a share of 10^-12 or so of the
/// lengths that meet, and 2^-50 of a key.
class BlockingDisks {
  public:
    /// `keys`: n distinct, n >= 2. `tree`: their minimum spanning tree, whose edges' own disks hold no
    /// vertex. Vertices are labelled breadth first from vertex 0, neighbours ascending. O(n log n).
    BlockingDisks(std::span<const Key2> keys, std::span<const GraphEdge> tree);

    [[nodiscard]] const std::vector<BlockingDisk>& disks() const { return disks_; }
    /// A disk whose circle goes through the vertex.
    [[nodiscard]] std::uint32_t disk_at(VertexId v) const { return disk_at_[v.value]; }

    /// Where the segment between two vertices passes through disks: ascending, disjoint, within 0 to 1;
    /// chords shorter than a step of the lattice are left out. O(log n) and once more for each disk near.
    [[nodiscard]] std::vector<Chord> find_chords(std::span<const Key2> keys, VertexId p, VertexId q) const;

    /// Where a disk that is not full touches the one before it that it names, from the key of its vertex.
    [[nodiscard]] Offset touching_point(std::span<const Key2> keys, std::uint32_t disk) const;

  private:
    BlockingDisks(std::span<const Key2> keys, std::vector<BlockingDisk> disks);
    void grow(std::span<const Key2> keys, std::uint32_t disk);

    std::vector<BlockingDisk> disks_;
    std::vector<std::uint32_t> disk_at_;
    BoxTree index_;  // over the disks of the tree's edges, which are full
};

}  // namespace tinwright

#endif
