#ifndef TINWRIGHT_MESH_TIN_CHECK_HPP
#define TINWRIGHT_MESH_TIN_CHECK_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "tinwright/mesh/tin.hpp"

/// Audit of a TIN's geometry. Connectivity is `check_mesh`'s business and must be clean first.
///
/// Invariants:
///   G1  keys, z and sample have one entry a vertex of the mesh
///   G2  keys are integers from 0 to below kKeyLimit
///   G3  keys are distinct and in the order of the curve
///   G4  elevations are finite
///   G5  every face, terrain or marked outside, is counter-clockwise
///   G6  no two faces overlap
///   G7  the border of all faces, terrain or not, is the convex hull of the vertices of faces
///   G8  every vertex is a corner of a face
///   G9  no vertex lies inside the circle of a face that is its neighbour across an edge, ties broken as
///       `incircle_perturbed` does
namespace tinwright {

struct TinViolation {
    int invariant = 0;     ///< n of the invariant G<n>
    bool is_face = false;  ///< whether `index` is a face slot, else it is a vertex
    std::size_t index = 0;
    Point2 location;   ///< CRS units; of a vertex concerned
    std::string text;  ///< one line
};

struct TinCheckOptions {
    /// Violations that are described; the rest is counted only.
    std::size_t limit = 100;
};

struct TinCheckReport {
    std::vector<TinViolation> violations;  ///< at most `limit`, by invariant
    std::size_t count = 0;                 ///< all of them
    [[nodiscard]] bool is_clean() const { return count == 0; }
};

/// Checks G1 to G6: what holds for every TIN, whatever its border.
///
/// Where the border of all faces is one convex loop that turns once, G6 follows from G5 in O(n): the
/// half-edges between two faces cancel, so the number of faces over a point is the border's winding number
/// around it, which is 0 or 1. Elsewhere faces are compared with those whose boxes they meet, O(n log n)
/// for the sizes found in practice.
/// Exact. `tin.mesh` must be clean under `check_mesh`.
TinCheckReport check_tin(const Tin& tin, const TinCheckOptions& options = {});

/// Checks G1 to G5 and G7 to G9: that the TIN, marks aside, is the Delaunay triangulation of its vertices,
/// with ties broken the canonical way. A convex border, counter-clockwise faces and locally Delaunay edges
/// make a Delaunay triangulation [delaunay1934], and the perturbed predicate leaves only one. O(n), exact.
TinCheckReport check_delaunay(const Tin& tin, const TinCheckOptions& options = {});

}  // namespace tinwright

#endif
