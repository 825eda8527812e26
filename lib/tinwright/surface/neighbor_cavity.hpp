#ifndef TINWRIGHT_SURFACE_NEIGHBOR_CAVITY_HPP
#define TINWRIGHT_SURFACE_NEIGHBOR_CAVITY_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/predicates_internal.hpp"
#include "tinwright/surface/neighbor_mesh.hpp"

/// Natural neighbours of a place and their shares: what a vertex put there would take, and from whom.
///
/// The *cavity* of a place q is what inserting q would empty: the faces with q strictly inside their circles
/// that are reached from the face at q through faces of the cavity and no closed edge. Its corners p_0, p_1,
/// ... in counter-clockwise order are the natural neighbours.
///
/// *The cavity is star-shaped*, whatever the triangulation: every half-edge of its rim has q strictly to its
/// left, but for a closed one that q lies on. Let this hold so far, and let the face beyond rim edge ab, with
/// apex s, be taken in. Then q is inside the circle of a, b, s and beyond the chord ab, so the segment qs
/// passes between a and b: a s and s b have q to their left, and the new face lies in the wedge that ab fills
/// as seen from q. Wedges of different rim edges are apart, so no face is met twice, and none is left out by
/// the order: the cavity is a tree of faces without a vertex inside.
///
/// *Shares.* q is the origin; c_i is the centre of the circle through q, p_i, p_(i+1), and v of a face of the
/// cavity that of its own. The cell of q has the corners c_i. Its side towards p_i is the vector from c_(i-1)
/// to c_i, perpendicular to p_i, and the sides close: with lambda_i = |c_i - c_(i-1)| / |p_i|,
///     sum lambda_i p_i = 0:
/// planes are reproduced by the shares lambda_i, the *Laplace* weights [christ1982; belikov1997]. By the
/// inscribed angles 2 lambda_i is the sum of the cotangents at p_(i+1) in the triangle q p_i p_(i+1) and at
/// p_(i-1) in q p_(i-1) p_i. What q takes from the cell of p_i, a_i, is the signed area of the polygon
/// c_(i-1), the v of the cavity's faces around p_i, c_i: the *Sibson* weight [sibson1981]. All its sides lie
/// on bisectors, where f_i(x) = 2 x p_i - |p_i|^2, the power of p_i, equals that of a neighbour, and on the
/// last f_i = f_q = 0; so integrating the gradient of f_i over polygon i and summing leaves nothing:
///     sum a_i p_i = 0.
/// This holds for any closed polygons on these bisectors, hence for cells cut off by closed edges too.
///
/// *No centre is ever made.* A polygon's area is the sum over its sides of half the length times the signed
/// distance from q, which is (|p_j|^2 - |p_i|^2) / (2 |p_j - p_i|) for the bisector of p_i and p_j, and
/// the sides are cotangents again. For every triangle q p_i p_(i+1), with d = p_i x p_(i+1), this gives
///     8 a_i     += |p_(i+1)|^2 p_i (p_i - p_(i+1)) / d
///     8 a_(i+1) += |p_i|^2 p_(i+1) (p_(i+1) - p_i) / d
/// and for every face x y w of the cavity
///     8 a_x += cot_w |y - x|^2 + cot_y |w - x|^2 + 2 x X (w - y)    (X: the cross product)
/// and so around. Offsets from q are exact, d and the faces' areas are exact where they are small beside
/// their terms, and both sums are finite wherever q is but on a closed edge.
///
/// *On a closed edge* from a to b, q at distance s from a and t from b, d is zero, and the shares of a and b
/// outgrow the rest. Multiplied by the distance from the edge they tend to
///     Sibson s t^2 and s^2 t,  Laplace t and s,
/// so the surface is linear there. The others vanish, but their derivatives across the edge do not: they are
/// the sums above without the triangle q a b (which gives a and b nothing of that order).
///
/// *Signs.* Where the mesh is Delaunay but at closed edges, all lambda_i and all sides of all polygons have
/// non-negative lengths and turn counter-clockwise once, so cells are convex and shares not negative.
///
/// *Continuity.* Faces come and go where q passes their circles only, and take shares of zero with them then.
namespace tinwright {

struct NaturalNeighbor {
    internal::LocalKey at;  ///< seen from the place, steps; exact
    double share = 0;       ///< not negative up to rounding; the sum of all is positive
    VertexId vertex{};
    HalfEdgeId edge{};     ///< to the next neighbour counter-clockwise, of a face of the cavity
    std::uint32_t next{};  ///< index of that neighbour
};

enum class ShareKind : std::uint8_t { Sibson, Laplace };

/// Finds them for one place after another; keeps its arrays.
class NeighborCavity {
  public:
    /// Both must outlive it.
    NeighborCavity(const NeighborMesh& mesh, const QueryLattice& lattice);

    /// `place`: not at a vertex. O(k) for k neighbours, 6 on average.
    void find(const NeighborPlace& place, Key2 at, ShareKind kind);
    /// As `find`, with `gradients()`.
    void find_with_gradients(const NeighborPlace& place, Key2 at, ShareKind kind);

    [[nodiscard]] std::span<const NaturalNeighbor> neighbors() const {
        return std::span(neighbors_).first(count_);
    }
    /// Of the shares, along x and y, per step.
    [[nodiscard]] std::span<const Point2> gradients() const { return gradients_; }
    /// Whether the place is on the edge between the first two neighbours.
    [[nodiscard]] bool is_on_edge() const { return is_on_edge_; }

  private:
    /// A half-edge of a face of the cavity, from neighbour a to neighbour b.
    struct Side {
        HalfEdgeId edge{};
        std::uint32_t a = 0;
        std::uint32_t b = 0;
    };

    void add_neighbor(VertexId v, Key2 at);
    void look_at(const Side& side, Key2 at);
    void make_room(std::size_t count);
    template <bool kAreas>
    void grow(const NeighborPlace& place, Key2 at);
    void correct_areas();
    void set_area_gradients();
    void set_side_gradients();
    void set_edge_shares(ShareKind kind);
    void set_edge_gradients(ShareKind kind);

    const Tin& tin_;
    const SharpEdges& sharp_;
    const FaceCircles& circles_;
    const QueryLattice& lattice_;
    std::vector<NaturalNeighbor> neighbors_;  // the first ones; the rest is room, likewise below
    std::vector<Side> crossed_;
    std::vector<Side> rim_;
    std::size_t count_ = 0;
    std::size_t crossed_count_ = 0;
    std::size_t rim_count_ = 0;
    std::vector<Point2> gradients_;
    std::vector<double> sides_;   // sums of cotangents
    std::vector<double> across_;  // for a place on an edge: derivatives of the shares across it
    bool is_on_edge_ = false;
};

}  // namespace tinwright

#endif
