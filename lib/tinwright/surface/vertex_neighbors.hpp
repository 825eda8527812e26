#ifndef TINWRIGHT_SURFACE_VERTEX_NEIGHBORS_HPP
#define TINWRIGHT_SURFACE_VERTEX_NEIGHBORS_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/vertex_fan.hpp"

namespace tinwright {

/// A vertex that another one's surface is estimated from.
struct VertexNeighbor {
    VertexId vertex{};
    Key2 offset{};         ///< from the other vertex, steps of the TIN's lattice; exact
    double distance2 = 0;  ///< squared length of the offset
};

/// Finds neighbours of vertices on their own side of sharp edges and the border. For one thread: keeps
/// memory from one search to the next, never what was found.
class NeighborSearch {
  public:
    static constexpr unsigned kMostPerOctant = 4;

    /// Both must outlive the search.
    NeighborSearch(const Tin& tin, const SharpEdges& sharp) : tin_(tin), sharp_(sharp) {}

    /// The vertices adjacent to a fan's own, nearest first (equally near ones by id). O(degree log degree).
    void find_ring(const VertexFan& fan, std::vector<VertexNeighbor>& neighbors);

    /// For each of eight octants around a fan's vertex the nearest `per_octant` vertices (1 to
    /// kMostPerOctant; fewer where there are no more) of those within a few edges that it sees; octant by
    /// octant, nearest first in each.
    ///
    /// The mesh is walked outwards, never across a wall, level by level: the second level is left out where
    /// the first fills all octants, further ones where none is empty, and kLevels is the end, normally at the
    /// hull; on ship tracks a level is what leads to the next track. A vertex is seen if the straight line to
    /// it crosses no wall. Touching an end of a wall is not crossing it. O(1) beside the ring: at most
    /// kMostVisits vertices are looked at.
    void find_octants(const VertexFan& fan, unsigned per_octant, std::vector<VertexNeighbor>& neighbors);

    /// Whether a fan's vertex sees another across its own faces.
    [[nodiscard]] bool sees(const VertexFan& fan, VertexId target) const;

  private:
    static constexpr int kLevels = 4;
    static constexpr std::size_t kMostVisits = 256;

    struct Candidate {
        double distance2;
        VertexId vertex;
    };
    struct Octant {
        std::array<Candidate, kMostPerOctant> nearest;
        unsigned count = 0;
    };

    struct Order {
        const VertexFan& fan;
        unsigned per_octant;
        bool is_sight_checked;
    };

    void collect(const VertexFan& fan, unsigned per_octant, bool is_sight_checked);
    void visit_around(HalfEdgeId corner, std::size_t most, const Order& order);
    void visit(HalfEdgeId corner, bool is_adjacent, const Order& order);
    [[nodiscard]] VertexNeighbor neighbor(VertexId vertex) const;
    [[nodiscard]] bool have_octants(unsigned count) const;  ///< each of them at least so many
    bool insert_visited(VertexId vertex);
    void grow_visited();
    void clear_visited();

    const Tin& tin_;
    const SharpEdges& sharp_;
    VertexId center_{};
    std::array<Octant, 8> octants_;
    std::vector<HalfEdgeId> queue_;  // a corner of each visited vertex, of a face that it was found from
    bool has_met_wall_ = false;

    // Set of vertices: open addressing; an entry counts if it has the present epoch.
    struct Visited {
        std::uint32_t vertex;
        std::uint32_t epoch;
    };
    std::vector<Visited> visited_;
    std::size_t visited_count_ = 0;
    std::uint32_t epoch_ = 0;
};

}  // namespace tinwright

#endif
