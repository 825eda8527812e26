#ifndef TINWRIGHT_SURFACE_SMOOTH_HPP
#define TINWRIGHT_SURFACE_SMOOTH_HPP

#include <memory>
#include <vector>

#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

struct SmoothOptions {
    /// A candidate of which each vertex takes the one that predicts its neighbours best.
    struct Kernel {
        double exponent =
            1.5;              ///< of the distance, above 0 and below 4 but not 2; 0: none, the faces' planes
        double stretch = 1;   ///< of distances along which the slope varies most, 1 to 1000
        double handicap = 1;  ///< its prediction error counts times this

        friend bool operator==(const Kernel&, const Kernel&) = default;
    };
    std::vector<Kernel> kernels{{1.5, 1, 1}, {1, 4, 1.04}, {2.5, 1, 1}, {2.5, 2.5, 1.04}, {1.5, 4, 1.04}};
    int neighbors = 24;  ///< 8 to 200, spread over eight octants; those that the TIN has come beside them
    double guard =
        0.25;            ///< elevations keep within the neighbours' range grown by this share; infinite: free
    bool is_c1 = false;  ///< continuous gradients: kernels with exponents of 1.5 and more only
};

/// Throws UsageError for options out of range.
void check_smooth(const SmoothOptions& options);

/// A surface made of splines, one a vertex: the radial basis interpolant of the vertices around it, all of
/// which it passes through, with the kernel that foretells them best when each is left out in turn
/// [rippa1999]. On a face the splines of its corners are blended by barycentric shares, or where `is_c1` by
/// Clough and Tocher's functions. Sharp edges and the border are never looked across; a vertex on a sharp
/// edge has no spline but the plane of each face, so that sharp edges stay straight, and neither has one
/// where parts of the terrain touch in a point only. With `is_c1` the gradient is continuous but at the edges
/// that touch such vertices, or of quadrilaterals far from convex.
///
/// Splines are fitted when first asked for, by the thread that asks: some 60 microseconds and 400 bytes a
/// vertex with the defaults. What is held is limited, so a raster read row by row takes a part of that
/// (`spline_store.hpp`).
std::unique_ptr<Interpolator> make_smooth(const Tin& tin, const SharpEdges& sharp,
                                          const SmoothOptions& options = {});

}  // namespace tinwright

#endif
