#ifndef TINWRIGHT_SURFACE_CONTOUR_BANDS_HPP
#define TINWRIGHT_SURFACE_CONTOUR_BANDS_HPP

#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

/// The terrain between one contour level and the next, as polygons.
namespace tinwright {

/// A ring: three distinct points or more, the last equal to the first, no other two equal.
using BandRing = std::vector<Point2>;

/// A connected part of a band: first its outer ring, counter-clockwise, then its holes, clockwise.
using BandPolygon = std::vector<BandRing>;

/// What lies between two elevations.
struct Band {
    double low = 0;   ///< a level; of the lowest band the lowest elevation of the terrain
    double high = 0;  ///< a level; of the highest band the highest elevation of the terrain
    std::vector<BandPolygon> polygons;
};

/// Divides the terrain of a TIN at levels, ascending and distinct; bands ascend, those without area are left
/// out. A level face at a level belongs to the band below it.
///
/// The bands cover the terrain without gap or overlap: they are made of the same points as the lines of
/// `make_contours` and of the border of the terrain, bit for bit the same in both bands of a line. Polygons
/// are valid as simple features are: rings touch in single points only, and the inside of each polygon is
/// connected, which is decided on faces, not by coordinates. (Coordinates are rounded to doubles: where a
/// level passes a vertex so closely that the crossings of its edges lie within a few units in the last place
/// of each other, a ring may be off by as much.)
///
/// Rings begin at their least point (x, then y); holes and polygons are in the order of their points.
/// O((faces + crossings) log n), parallel inside the caller's task arena. Throws as `make_contours`.
std::vector<Band> make_bands(const Tin& tin, std::span<const double> levels, const Progress& progress = {});
std::vector<Band> make_bands(const TriangleMesh& mesh, std::span<const Point3> vertices,
                             std::span<const double> levels, const Progress& progress = {});

}  // namespace tinwright

#endif
