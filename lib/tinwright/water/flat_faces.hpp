#ifndef TINWRIGHT_WATER_FLAT_FACES_HPP
#define TINWRIGHT_WATER_FLAT_FACES_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tinwright/mesh/tin.hpp"

/// Faces whose three vertices have one elevation where the terrain has not: terraces and flat tops that
/// contours make.
namespace tinwright {

enum class FlatFaces : std::uint8_t {
    Keep,
    Swap,   ///< edges are swapped where that leaves fewer flat faces
    Insert  ///< and ridge and valley points are put into what is still flat
};

struct FlatFacesReport {
    std::size_t before = 0;  ///< flat terrain faces that are not water
    std::size_t swapped = 0;
    std::size_t inserted = 0;  ///< vertices
    std::size_t after = 0;
    double seconds = 0;
};

/// Removes flatness from a (constrained) Delaunay TIN. `is_water`: by face slot, faces that are rightly flat;
/// empty: none. Swap: an edge between a flat face and one that is not, not constrained, its quadrilateral
/// strictly convex, becomes the other diagonal where that leaves fewer flat faces, steepest way out first,
/// until there is none. Insert: what is still flat afterwards falls into regions of faces that share edges;
/// each gets vertices along its medial axis (middles of the edges that lead across it, and of faces where it
/// branches), with elevations between that of its contour and that of what it opens to, along the axis; a
/// region closed on itself, a top or a bottom, goes on as the faces around it rise, up to half the
/// difference of neighbouring contours. Inserted vertices have `Tin::kInserted` as their sample. Vertices are
/// renumbered along the curve as everywhere. No constrained edge changes. Deterministic. O(n log n).
FlatFacesReport remove_flat_faces(Tin& tin, FlatFaces how, const std::vector<bool>& is_water = {},
                                  bool keeps_delaunay = false);

/// Number of flat terrain faces that are not water. O(slots).
std::size_t count_flat_faces(const Tin& tin, const std::vector<bool>& is_water = {});

}  // namespace tinwright

#endif
