#ifndef TINWRIGHT_OPTIMAL_WALL_POLYGON_HPP
#define TINWRIGHT_OPTIMAL_WALL_POLYGON_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/delaunay/corner_view.hpp"
#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright::internal {

using VertexPair = std::pair<VertexId, VertexId>;

/// Which edges of a mesh are walls, and what the corners of its polygons are numbered.
struct Walls {
    /// Of each half-edge, by `HalfEdgeId::value`. Border edges of the terrain are walls.
    std::vector<std::uint8_t> is_wall;
    /// Of each half-edge the position, in the ring of its polygon, of the corner that it starts from.
    /// Polygons have no corner in common, so threads can work on different ones.
    std::vector<std::uint32_t> position;
};

/// A polygon that walls cut out of the terrain, as a ring of corners, counter-clockwise; a wall that ends
/// within it (a crack, [tan1993, Fig. 3.1]) is in the ring once in each direction.
///
/// "Seen" means seen within the polygon. A line of sight or side p q is *empty* to its left if no vertex
/// there that p and q both see is in their lune (`LengthOrder::is_in_lune`); it is then an edge of the
/// relative neighbourhood graph as far as that side is concerned.
class WallPolygon {
  public:
    /// A corner seen from another, p.
    struct Sight {
        std::uint32_t position;
        VertexId vertex;
        bool is_left_empty = true;   ///< of the line from p to it
        bool is_right_empty = true;  ///< likewise
    };

    WallPolygon(const TriangleMesh& mesh, const LengthOrder& order, Walls& walls)
        : mesh_(&mesh), order_(&order), walls_(&walls), view_(mesh, order.keys()) {}

    /// Takes the polygon to the left of a wall.
    void trace(HalfEdgeId wall);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(sides_.size()); }
    [[nodiscard]] const LengthOrder& order() const { return *order_; }
    [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
    /// The half-edge from the corner at that position to the next.
    [[nodiscard]] HalfEdgeId side(std::uint32_t position) const { return sides_[position]; }
    [[nodiscard]] VertexId vertex(std::uint32_t position) const { return mesh_->origin(sides_[position]); }
    [[nodiscard]] std::uint32_t after(std::uint32_t position) const {
        return position + 1 == size() ? 0 : position + 1;
    }
    /// Its faces, size() - 2 of them.
    [[nodiscard]] std::span<const FaceId> faces() const { return faces_; }

    /// The corners that the one at `position` sees and whose distance comes before that of a pair of
    /// vertices, in counter-clockwise order, which is that of their positions. O(size) at most, less if much
    /// is farther away. Valid until the next call with the same `space`.
    ///
    /// What is empty is found by a scan with a stack [tan1993, Sec. 5.6.1, step 1]: only vertices that p sees
    /// matter, since if there is one in the half-lune the first vertex on the shortest way to it from the
    /// other end is seen from both and is in it as well.
    std::span<const Sight> look(std::uint32_t position, VertexPair before, std::vector<Sight>& space);
    /// Until the next polygon, what a corner sees nearer than this pair is found once and kept, and `look`
    /// gives all of it, no matter how much is asked for. Memory for all that is seen: for few sides.
    void keep_sights(VertexPair before);

  private:
    void find_sights(std::uint32_t position, VertexPair before, std::vector<Sight>& sights);
    void find_empty_sides(VertexId eye, std::vector<Sight>& sights);
    template <class Iterator>
    void scan(VertexId eye, Iterator begin, Iterator end, int turn, bool Sight::*is_empty);

    const TriangleMesh* mesh_;
    const LengthOrder* order_;
    Walls* walls_;
    CornerView view_;
    std::vector<HalfEdgeId> sides_;
    std::vector<FaceId> faces_;
    std::vector<Sight*> pending_;
    std::optional<VertexPair> kept_before_;
    std::vector<std::vector<Sight>> kept_;  // by position
    std::vector<bool> is_kept_;
};

}  // namespace tinwright::internal

#endif
