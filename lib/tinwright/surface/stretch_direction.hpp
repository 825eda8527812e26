#ifndef TINWRIGHT_SURFACE_STRETCH_DIRECTION_HPP
#define TINWRIGHT_SURFACE_STRETCH_DIRECTION_HPP

#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/vertex_fan.hpp"

namespace tinwright {

/// A unit vector: the direction along which the slope of the terrain varies most around a fan's vertex, from
/// the gradients of the faces of the fan and of the fans next to it, on this side of walls, weighted by area.
/// Along x where there is none. O(faces).
Point2 find_direction_of_change(const Tin& tin, const SharpEdges& sharp, const VertexFan& fan);

}  // namespace tinwright

#endif
