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

std::unique_ptr<Interpolator> make_natural_neighbor(const Tin& tin, const SharpEdges& sharp,
                                                    const NaturalNeighborOptions& options = {});

}  // namespace tinwright

#endif
