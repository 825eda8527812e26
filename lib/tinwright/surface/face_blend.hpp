#ifndef TINWRIGHT_SURFACE_FACE_BLEND_HPP
#define TINWRIGHT_SURFACE_FACE_BLEND_HPP

#include <array>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Shares of the corners of a face in a surface at a place, and how they change with the first two
/// barycentric coordinates (the third being one less both).
struct FaceBlend {
    std::array<double, 3> share{};
    std::array<std::array<double, 3>, 3> slope{};  ///< [corner][barycentric coordinate], the others held
};

/// The barycentric coordinates themselves: continuous from face to face.
FaceBlend blend_linearly(const std::array<double, 3>& barycentric);

/// Clough and Tocher's functions [clough1965] with value 1 at one corner, 0 at the others and no gradient at
/// any, which sum to one. `foot`: for the edge opposite each corner, counter-clockwise around the face, where
/// on it (0: its first end, 1: its second) the surface's derivative across the edge points to the centroid.
/// Two faces whose derivatives have the same direction meet with one gradient.
FaceBlend blend_smoothly(const std::array<double, 3>& barycentric, const std::array<double, 3>& foot);

}  // namespace tinwright

#endif
