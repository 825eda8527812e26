#ifndef TINWRIGHT_SURFACE_TRACED_SURFACE_HPP
#define TINWRIGHT_SURFACE_TRACED_SURFACE_HPP

#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// A finer mesh that follows a surface wherever levels pass: contours are cut from its faces.
struct TracedSurface {
    TriangleMesh mesh;
    std::vector<Point3> vertices;  ///< those of the TIN first, then new ones in the order of their positions
    /// The greatest distance in elevation, at the places checked, of lines from the surface.
    double largest_error = 0;
    /// Faces that are left with errors above the tolerance, being too small to be divided: the surface has a
    /// step there.
    std::size_t unresolved = 0;
};

/// Divides faces of a TIN until the lines that levels cut from them keep to a surface within `tolerance`.
///
/// Faces are halved at their longest edges, both faces of an edge at once [rivara1984], so they fit together,
/// and no angle gets smaller than half the smallest one before [rosenberg1975]. A face near a level is halved
/// until four readings, in the middles of its edges and of itself, are within half the tolerance, and, of
/// each line through it, both ends and the middle within the tolerance. What is promised is therefore: every
/// vertex of a contour line and the middle of each of its segments has been read, and its elevation differs
/// from the level by no more than the tolerance, but for `unresolved` faces. Contours of the mesh are as
/// sound as those of any TIN: whatever the tolerance, they do not cross. A hill narrower than the quarter of
/// a face can be missed.
///
/// `levels`: ascending. `tolerance`: above zero, in units of z. Throws UsageError when the lines would need
/// more than 5 * 10^7 new vertices, Cancelled. Readings in parallel inside the caller's task arena; the
/// result does not depend on the number of threads or the order of faces.
TracedSurface trace_surface(const Tin& tin, const Interpolator& surface, std::span<const double> levels,
                            double tolerance, const Progress& progress = {});

}  // namespace tinwright

#endif
