#ifndef TINWRIGHT_OPTIMAL_POLYGON_OPTIMIZER_HPP
#define TINWRIGHT_OPTIMAL_POLYGON_OPTIMIZER_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/expandable_edge.hpp"
#include "tinwright/optimal/incomplete_polygon.hpp"
#include "tinwright/optimal/wall_polygon.hpp"

namespace tinwright::internal {

/// A polygon that is yet to be looked at, and what became of it.
struct PolygonTask {
    HalfEdgeId wall{};     ///< one of its sides
    HalfEdgeId longest{};  ///< its longest diagonal, longer than its sides
    std::uint32_t size = 0;
    bool is_incomplete = false;
    bool is_done = false;
    VertexPair optimum;  ///< a longest edge that it can do with, as good as any; sides not counted
    std::vector<FaceId> slots;
    std::vector<CavityFace> faces;  ///< in their place; empty: they are as good as any
};

/// Makes the longest edge of a polygon as short as it can be, one polygon after the other.
///
/// A polygon is complete if all its sides are empty towards its inside [tan1993, Sec. 5.3]: its shortest
/// expandable 2-edge divides it in two parts (Sec. 5.6). Otherwise one of the sides that are not is the base
/// of it all (Sec. 5.4): the shortest, so that no diagonal is longer.
class PolygonOptimizer {
  public:
    /// `in_graph`: of each half-edge whether its edge is known to be empty on both sides.
    PolygonOptimizer(const TriangleMesh& mesh, const LengthOrder& order, Walls& walls,
                     std::span<const std::uint8_t> in_graph)
        : order_(order), in_graph_(in_graph), polygon_(mesh, order, walls), walls_(walls) {}

    /// Works `task` out; it stays undone if stopped. O(n^2) for n sides.
    void run(PolygonTask& task, const Poll& poll);
    /// 2-edges that came into question, over all polygons.
    [[nodiscard]] std::size_t candidates() const { return search_.candidates(); }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return order_.keys()[v.value]; }
    [[nodiscard]] VertexPair ends(HalfEdgeId h) const {
        return {polygon_.mesh().origin(h), polygon_.mesh().destination(h)};
    }
    [[nodiscard]] bool is_shorter(VertexPair x, VertexPair y) const {
        return order_.is_shorter(x.first, x.second, y.first, y.second);
    }
    [[nodiscard]] bool is_really_shorter(VertexPair x, VertexPair y) const {
        return order_.compare(x.first, x.second, y.first, y.second) < 0;
    }
    [[nodiscard]] std::optional<VertexPair> bound_without(HalfEdgeId longest, const Poll& poll) const;
    [[nodiscard]] std::optional<std::uint32_t> find_shortest_long_side();
    bool improve_complete(PolygonTask& task, const Poll& poll);

    const LengthOrder& order_;
    std::span<const std::uint8_t> in_graph_;
    WallPolygon polygon_;
    const Walls& walls_;
    ExpandableEdgeSearch search_{polygon_};
    IncompletePolygon parts_{polygon_};
    std::vector<WallPolygon::Sight> space_;
};

}  // namespace tinwright::internal

#endif
