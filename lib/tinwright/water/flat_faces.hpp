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
    Insert  ///< ridge and valley points are put in, edges swapped where one swap does
};

struct FlatFacesReport {
    std::size_t before = 0;  ///< flat terrain faces that are not water
    std::size_t swapped = 0;
    std::size_t inserted = 0;  ///< vertices
    std::size_t after = 0;
    double seconds = 0;
};

/// Removes flatness that contours made from a (constrained) Delaunay TIN [ware1998]. `is_water`: by face
/// slot, faces that are rightly flat; empty: none. Faces at a vertex, of no line, that is flat all around and
/// not part of what looks like a contour stay too: there the samples say so.
///
/// Swap: an edge between a flat face and one that is not, no piece of a contour, its quadrilateral strictly
/// convex, becomes the other diagonal, the steepest first, until there is none. Each leaves one flat face
/// less. Insert: flat faces that share edges are a region. Those that a swap will do for, of one face with a
/// way out, are swapped; every other one gets vertices along its medial axis: at the middles of the edges
/// that lead across it and out of it, and of faces where it branches, with the elevations of ridges, valleys,
/// passes, tops and bottoms (`flat_axes.hpp`), never beyond half an interval of the contours; except where
/// walls contradict each other. Edges but those along axes are Delaunay again before anything is swapped.
/// With `keeps_delaunay` all are and nothing is swapped: for what is to be optimised. Inserted vertices have
/// `Tin::kInserted` as their sample, on a lattice refined for them where there is room. Vertices are numbered
/// along the curve as everywhere. No constrained edge changes, no face outside the terrain either. From the
/// same TIN always the same. O(n log n).
FlatFacesReport remove_flat_faces(Tin& tin, FlatFaces how, const std::vector<bool>& is_water = {},
                                  bool keeps_delaunay = false);

/// Number of flat terrain faces that are not water. O(slots).
std::size_t count_flat_faces(const Tin& tin, const std::vector<bool>& is_water = {});

}  // namespace tinwright

#endif
