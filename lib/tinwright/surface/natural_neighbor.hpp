#ifndef TINWRIGHT_SURFACE_NATURAL_NEIGHBOR_HPP
#define TINWRIGHT_SURFACE_NATURAL_NEIGHBOR_HPP

#include <cstdint>
#include <memory>

#include "tinwright/surface/gradients.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

struct NaturalNeighborOptions {
    enum class Kind : std::uint8_t {
        Sibson,   ///< shares of the area that a new vertex would take from its neighbours' Voronoi cells
        Laplace,  ///< lengths of the new cell's sides over the neighbours' distances
        C1        ///< Sibson's surface with the vertices' gradients
    };
    Kind kind = Kind::Sibson;
    GradientMethod gradients = GradientMethod::Octant;  ///< for C1
};

/// Natural neighbour interpolation: a place takes its elevation from the vertices that would be its
/// neighbours if it were one itself [sibson1981; christ1982; belikov1997]. How: `neighbor_cavity.hpp`.
///
/// Neighbours are those in the Delaunay triangulation of the terrain, constrained at the border and at sharp
/// edges and nowhere else, whatever the TIN's own criterion: the TIN is used as it is where it is that
/// triangulation, and copied and flipped where not. Its smooth constrained edges, and the choice of faces
/// that a criterion made, have no influence.
///
/// - Shares are positive, they sum to one, and planes are reproduced to rounding, on needles and beside
///   vertices, edges and the border too. Sibson's and Laplace's surfaces are within the neighbours' range.
/// - The surface is continuous. Between vertices and off sharp edges, Sibson's has a continuous gradient;
///   Laplace's has creases along the circles of the faces. At vertices both have peaks.
/// - Along *sharp edges* all three are linear, and seen from each side there is nothing beyond: neighbours
///   across are hidden, and cells run on without end.
/// - The *border* is as a sharp edge: no values are made up beyond. Sibson and Laplace are linear along it.
/// - C1 [sibson1981] blends Sibson's surface with those of the neighbours' gradients. It has a continuous
///   gradient, that of the vertex at a vertex, but not on sharp edges and their ends. It reproduces a (x^2 +
///   y^2) + plane where the gradients are exact, and can leave the range of the samples. Along the border it
///   is a cubic curve of sorts, given by the border edge's two ends. Beside a sharp edge the ends' gradients
///   give way to the edge's own slope.
///
/// `tin` must outlive it, `sharp` need not. Making it: O(n) in practice, parallel inside the caller's task
/// arena; memory: 64 bytes a vertex, a copy of the TIN where one is needed, and the gradients for C1.
/// Reading: O(k) for k neighbours, 6 on average, at most all; 0.2 to 0.3 microseconds. At a vertex, Sibson's
/// and Laplace's gradient is said to be that of the place's face.
std::unique_ptr<Interpolator> make_natural_neighbor(const Tin& tin, const SharpEdges& sharp,
                                                    const NaturalNeighborOptions& options = {});

}  // namespace tinwright

#endif
