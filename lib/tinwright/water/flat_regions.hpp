#ifndef TINWRIGHT_WATER_FLAT_REGIONS_HPP
#define TINWRIGHT_WATER_FLAT_REGIONS_HPP

#include <cstdint>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"

/// Private to `remove_flat_faces`: which faces are flat without reason, and what their edges are.
namespace tinwright::internal {

/// Of an edge of a flat face that is to be treated.
enum class FlatEdge : std::uint8_t {
    Wall,    ///< constrained, taken for a piece of a contour, or at what stays as it is
    Inner,   ///< to another such face
    Opening  ///< to a face that is not flat
};

/// Flat faces that contours made, and their edges. Answers hold while edges are flipped, but for those of
/// faces that are flat no more.
///
/// A contour that came in as a line is constrained, and an edge between vertices of lines is not one, unless
/// the line has a gap. One that came in as samples is guessed: an edge whose opposite angles are together
/// less than a right angle is a piece of a curve through the samples [gold1999]. On the rim of a region that
/// must agree with the terrain: it goes on one way behind all pieces of the contour and the other way behind
/// all ways out. Where it does not agree, the longer part of the rim, walls twice, is the contour. A vertex
/// on no line that has flat faces all around, and is not on a curve by that rule, with two pieces at it, says
/// that the terrain itself is flat: its faces are not treated.
class FlatRegions {
  public:
    /// `tin`: must outlive this object. `is_water`: by face slot; slots beyond its end are none. O(n log n).
    FlatRegions(const Tin& tin, const std::vector<bool>& is_water);

    /// Whether a face is flat and to be treated.
    [[nodiscard]] bool is_treated(FaceId f) const;
    /// `h`: of a face that is treated.
    [[nodiscard]] FlatEdge kind(HalfEdgeId h) const;
    /// Terrain that is not water.
    [[nodiscard]] bool is_dry(FaceId f) const {
        return tin_.mesh.is_terrain(f) && (f.value >= is_water_.size() || !is_water_[f.value]);
    }

  private:
    using Edge = std::pair<VertexId, VertexId>;  // the smaller first

    /// Whether the terrain goes up (> 0) or down beyond a contour, as its walls say, and as the whole rim
    /// does.
    struct Beyond {
        double of_walls;
        double of_all;
    };

    void find_measured();
    void find_contour_pieces();
    [[nodiscard]] bool is_uncertain(HalfEdgeId h) const;
    void find_rim(FaceId first, std::vector<bool>& is_seen, std::vector<HalfEdgeId>& rim) const;
    /// From the vertices of an edge to the one behind it; zero where no dry terrain is.
    [[nodiscard]] double rise_beyond(HalfEdgeId h) const;
    [[nodiscard]] Beyond look_beyond(const std::vector<HalfEdgeId>& rim) const;
    void judge_rim(const std::vector<HalfEdgeId>& rim, std::vector<Edge>& pieces) const;
    void sort_pieces();

    const Tin& tin_;
    const std::vector<bool>& is_water_;
    std::vector<bool> is_on_line_;      // by vertex
    std::vector<bool> is_measured_;     // by vertex: flat all around
    std::vector<Edge> contour_pieces_;  // that are not constrained; ascending
};

/// Whether the three vertices of a face that is no ghost have one elevation.
bool is_flat(const Tin& tin, FaceId f);

}  // namespace tinwright::internal

#endif
