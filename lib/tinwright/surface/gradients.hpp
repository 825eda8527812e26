#ifndef TINWRIGHT_SURFACE_GRADIENTS_HPP
#define TINWRIGHT_SURFACE_GRADIENTS_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright {

/// How gradients at vertices are estimated, the second step of surface interpolation [tan1993, Sec. 1.1].
enum class GradientMethod : std::uint8_t {
    Ring,    ///< plane through the vertex, least squares over its neighbours, weights 1 / distance^2
    Octant,  ///< quadric through the vertex, least squares over the nearest two vertices of each octant,
             ///< mixed with Ring's plane by as much as it explains these vertices no better
    Sibson   ///< as Ring, with the vertex's natural-neighbour weights over distance^2, up to 256 neighbours
};
inline constexpr std::array kGradientMethods{std::pair{std::string_view("ring"), GradientMethod::Ring},
                                             std::pair{std::string_view("octant"), GradientMethod::Octant},
                                             std::pair{std::string_view("sibson"), GradientMethod::Sibson}};

/// The share of a vertex in a gradient.
struct GradientWeight {
    VertexId vertex{};
    Point2 weight{};
};

/// The gradient of the surface at each corner of each terrain face, z units over CRS units.
///
/// Estimated once for all faces around a vertex between one wall (a sharp edge or the border) and the next,
/// from vertices on their side of walls only (`vertex_neighbors.hpp`); where the octants'
/// quadric is poorly determined the ring's plane is taken. Interpolators keep sharp edges straight between
/// their vertices, so at a corner with a sharp edge the gradient has that edge's slope along it, on either
/// side of it, and along the corner's other edge what it was estimated to be: the surface is continuous
/// across sharp edges, and the faces of a fan agree but for the first edges beside a line, and there too
/// where the line is straight and its slope stays the same.
class CornerGradients {
  public:
    /// `tin` must outlive it. O(n), parallel inside the caller's task arena; the result does not depend on
    /// the number of threads.
    CornerGradients(const Tin& tin, const SharpEdges& sharp, GradientMethod method);
    ~CornerGradients();
    CornerGradients(const CornerGradients&) = delete;
    CornerGradients& operator=(const CornerGradients&) = delete;

    /// At the origin of a half-edge of a terrain face, as that face has it.
    [[nodiscard]] Point2 at(HalfEdgeId corner) const;
    /// The same gradient as a sum of weights times z, each vertex once; computed anew.
    [[nodiscard]] std::vector<GradientWeight> weights(HalfEdgeId corner) const;

    /// The same without sharp edges kept straight: as estimated, one for all faces between two walls.
    [[nodiscard]] Point2 of_fan(HalfEdgeId corner) const;
    [[nodiscard]] std::vector<GradientWeight> fan_weights(HalfEdgeId corner) const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
