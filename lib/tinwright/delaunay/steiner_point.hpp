#ifndef TINWRIGHT_DELAUNAY_STEINER_POINT_HPP
#define TINWRIGHT_DELAUNAY_STEINER_POINT_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// Puts new vertices into a constrained Delaunay TIN, which stays one. While it is at work, new vertices
/// stand behind the old ones, out of the curve's order; `finish` sorts them in.
class SteinerInserter {
  public:
    /// `tin`: as `make_conforming` takes it; must outlive this object and not be changed by others.
    explicit SteinerInserter(Tin& tin);

    [[nodiscard]] const Tin& tin() const { return tin_; }
    /// Number of vertices that were there before.
    [[nodiscard]] std::size_t old_vertex_count() const { return old_count_; }

    /// The half-edge from a to b. O(degree of a).
    [[nodiscard]] std::optional<HalfEdgeId> find_half_edge(VertexId a, VertexId b) const;
    /// A half-edge that starts at v, of a face that is no ghost where there is one.
    [[nodiscard]] HalfEdgeId some_half_edge(VertexId v) const { return start_[v.value]; }

    /// The edge of a line, as it was before any insertion, that an edge between a and b is part of: index
    /// into `line_edges()`. The edge must be constrained.
    [[nodiscard]] std::uint32_t line_edge_of(VertexId a, VertexId b) const;
    /// The distinct edges of lines before any insertion: (a, b) with a < b, ascending.
    [[nodiscard]] const std::vector<std::pair<VertexId, VertexId>>& line_edges() const { return line_edges_; }

    /// Splits the constrained edge of `h`, which must not be on the hull, near the place `t` of the way from
    /// its origin to its destination, 0 < t < 1: at the nearest lattice point within half a step, in x or in
    /// y, of the line's edge as it was. z is linear along that edge. Empty, and nothing done, when no such
    /// lattice point keeps all faces counter-clockwise.
    std::optional<VertexId> split(HalfEdgeId h, double t);
    /// Puts a free vertex with elevation z at a lattice point strictly inside the hull; empty when the point
    /// is a vertex already or on a constrained edge. The walk to it starts at `near`.
    std::optional<VertexId> insert(Key2 key, double z, VertexId near);
    /// The same with the elevation of the face that the point lies in.
    std::optional<VertexId> insert(Key2 key, VertexId near);

    /// Half-edges of the constrained edges of faces that the last insertion made or changed, those of the
    /// vertex itself included, in no special order; an edge may be there more than once, and others with it.
    [[nodiscard]] const std::vector<HalfEdgeId>& touched() const { return touched_; }

    /// Sorts the new vertices into the curve's order and cuts the traces at them. The object is done with.
    void finish();

    static constexpr std::uint32_t kFree = 0xFFFFFFFFU;

  private:
    /// A lattice point that an edge could be split at.
    struct Place {
        double distance;  ///< from the line's edge, times that edge's length
        double offset;    ///< from where it was wanted
        Key2 key;
    };

    void find_places(std::uint32_t line_edge, Key2 from, Key2 to, double t);
    [[nodiscard]] bool keeps_faces(HalfEdgeId h, Key2 place) const;
    [[nodiscard]] HalfEdgeId locate(Key2 key, VertexId near) const;
    VertexId add_vertex(Key2 key, double z, std::uint32_t line_edge);
    void take_starts(FaceId f);
    /// Restores the constrained Delaunay property around the faces of a new vertex.
    void settle(VertexId v);
    std::vector<VertexId> sort_in();

    Tin& tin_;
    std::size_t old_count_;
    std::vector<HalfEdgeId> start_;
    std::vector<std::pair<VertexId, VertexId>> line_edges_;
    std::vector<std::uint32_t> line_edge_;  // of the vertices made, in the order they were made
    std::vector<HalfEdgeId> touched_;
    std::vector<HalfEdgeId> unsettled_;  // both kept for their memory
    std::vector<Place> places_;
};

}  // namespace tinwright

#endif
