#ifndef TINWRIGHT_DELAUNAY_OCTANT_SEARCH_HPP
#define TINWRIGHT_DELAUNAY_OCTANT_SEARCH_HPP

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/delaunay/corner_view.hpp"
#include "tinwright/delaunay/length_order.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// Finds the relative neighbours of one vertex after the other in a norm that is not the Euclidean one, from
/// a mesh that is Delaunay in the Euclidean one, constrained or not.
///
/// Only the nearest vertices within an octant can be neighbours. They are tried against what the vertex sees
/// in the same corner, on the side of less than 180 degrees: all of that counts, as in HalfLuneSearch.
class OctantSearch {
  public:
    /// Both must outlive the search.
    OctantSearch(const TriangleMesh& mesh, std::span<const Key2> keys, Norm norm, LuneRim rim);

    /// Appends the edges from `p` to neighbours in its octants 0 to 3: of all vertices, every edge once.
    /// `start`: a half-edge from `p`.
    void find(VertexId p, HalfEdgeId start, std::vector<GraphEdge>& edges);

  private:
    struct Candidate {
        std::size_t index;  // among what was seen
        VertexId vertex;
        bool is_last;          // ends the corner
        bool is_wall_between;  // the edge to it is to be found in the two corners that it separates
    };

    struct Range {
        double least;
        double greatest;
    };
    /// The lune of p and a candidate, within bounds of x, y, x + y and x - y from p.
    struct Lune {
        double squared_reach;
        std::array<Range, 4> ranges;
    };

    /// The nearest mesh neighbour in an octant, from p; none is infinitely far.
    struct Blocker {
        Key2 step;
        double distance;
    };

    [[nodiscard]] bool starts_corner(HalfEdgeId h) const;
    void find_in_corner(HalfEdgeId first);
    void look_for_nearest(HalfEdgeId first);
    void look_as_far_as_candidates(HalfEdgeId first);
    void choose_candidates();
    [[nodiscard]] Candidate candidate(std::size_t index) const;
    void drop_blocked();
    [[nodiscard]] bool is_blocked(const Candidate& q) const;

    [[nodiscard]] std::size_t slot(Key2 key) const;
    [[nodiscard]] bool is_worth(HalfEdgeId edge, Key2 right, Key2 left);
    [[nodiscard]] bool is_blocked_behind(HalfEdgeId edge, Key2 right, Key2 left, std::size_t slot) const;
    [[nodiscard]] bool is_blocked_beyond(const Blocker& u, Key2 near, Key2 far) const;
    [[nodiscard]] Key2 octant_ray(std::size_t slot) const;
    [[nodiscard]] Key2 from_eye(Key2 key) const { return {key.x - eye_.x, key.y - eye_.y}; }
    void note_neighbor(Key2 key);
    [[nodiscard]] double reach(Key2 key) const;
    [[nodiscard]] double squared_reach(Key2 key) const;
    [[nodiscard]] Lune lune_of(Key2 key) const;
    [[nodiscard]] bool may_meet(HalfEdgeId edge, const Lune& lune) const;
    [[nodiscard]] bool may_hide(HalfEdgeId edge, double squared_reach) const;

    const TriangleMesh* mesh_;
    std::span<const Key2> keys_;
    LengthOrder lengths_;
    LuneRim rim_;
    double widest_;  // a little above the square of the greatest Euclidean length of what has length 1
    double slant_;   // length of (1, 1) less that of (1, 0)
    CornerView view_;

    VertexId p_{};
    Key2 eye_{};
    Key2 first_{};  // seen in the corner
    int first_octant_ = 0;
    bool is_around_ = false;
    std::array<double, 9> nearest_{};    // squared reach of the nearest seen so far, by slots
    std::array<Blocker, 9> blockers_{};  // by slots
    int looked_ = 0;                     // edges so far, for the nearest
    std::vector<Candidate> candidates_;
    std::vector<Lune> lunes_;
    std::vector<Candidate> found_;
};

}  // namespace tinwright

#endif
