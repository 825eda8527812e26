#ifndef TINWRIGHT_WATER_FLAT_AXES_HPP
#define TINWRIGHT_WATER_FLAT_AXES_HPP

#include <cstdint>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/water/flat_regions.hpp"

/// Private to `remove_flat_faces`: where points belong in flat regions, and how high they are.
namespace tinwright::internal {

/// A place for a point: the middle of an edge that leads across a flat region or out of it, or of a face
/// where the region branches or that is all of it. Lengths are in steps of the lattice.
struct AxisNode {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    VertexId a{};  ///< ends of the edge; of the middle of a face: its corners
    VertexId b{};
    VertexId c = kGhostVertex;       ///< third corner; ghost: on an edge
    VertexId outlet = kGhostVertex;  ///< of an edge that leads out: the vertex across it
    FaceId face{};                   ///< a flat face that it belongs to
    double x = 0;
    double y = 0;
    bool is_single = false;  ///< the only place in the only face of its region
    double half_width = 0;   ///< distance of the nearest wall that was looked at
    double end = 0;          ///< distance of the farthest dead end in a face of it
    /// Of the walls in its faces, each wall counted once, those with dry terrain behind that is not flat:
    /// sums of length times the fall to the vertex behind, of the same with falls made positive, and of twice
    /// the areas of the faces behind.
    double fall = 0;
    double steepness = 0;
    double area = 0;
    double wall_length = 0;

    [[nodiscard]] bool is_on_edge() const { return c == kGhostVertex; }
};

struct AxisLink {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double length = 0;
};

/// The medial axes of all flat regions, as the edges across them tell them.
struct FlatAxes {
    std::vector<AxisNode> nodes;
    std::vector<AxisLink> links;  ///< within a face, both directions; ascending
};

/// In the order of faces. O(n log n).
FlatAxes find_flat_axes(const Tin& tin, const FlatRegions& regions);

/// The elevation of each node, NaN where nothing tells which way the terrain goes on.
///
/// In regions that lead out: from that of the contour, kept at dead ends, to that of the vertex across the
/// way out, linear along the way, of several ways the nearest [ware1998; thibault2000]. Where ways from the
/// same side meet there is a pass, as high as that of a hyperbolic paraboloid between the two contours would
/// be. Strictly between the two contours, and monotone along the axis from the way out to each dead end.
/// In closed regions: a dome, up if the terrain behind the walls is lower, by length, else a basin. At its
/// widest place it is as high as the mean slope behind the walls would take it at small widths, and never as
/// high as half the mean difference to the vertices behind. O(n log n).
std::vector<double> find_axis_elevations(const Tin& tin, const FlatAxes& axes);

/// Forgets the elevations of those that a swap will do for: way out and region are one face.
void leave_out_single_faces(const FlatAxes& axes, std::vector<double>& z);

}  // namespace tinwright::internal

#endif
