#ifndef TINWRIGHT_SURFACE_RING_PREDICTION_HPP
#define TINWRIGHT_SURFACE_RING_PREDICTION_HPP

#include <optional>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/vertex_fan.hpp"

namespace tinwright {

/// The elevation of a vertex less what the Delaunay triangulation of the vertices around it has in its place:
/// the error of linear interpolation when the vertex is left out. Empty where the fan is open, and for hubs
/// of more than kMostSpokes faces, which nothing is to be told from.
inline constexpr int kMostSpokes = 16;
std::optional<double> ring_prediction_error(const Tin& tin, const VertexFan& fan);

}  // namespace tinwright

#endif
