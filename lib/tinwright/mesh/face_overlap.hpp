#ifndef TINWRIGHT_MESH_FACE_OVERLAP_HPP
#define TINWRIGHT_MESH_FACE_OVERLAP_HPP

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// A counter-clockwise face as indices of keys.
using FaceCorners = std::array<std::uint32_t, 3>;

inline constexpr std::uint32_t kNoFaceFound = 0xFFFFFFFFU;

/// For each face an earlier one whose interior meets its own, or kNoFaceFound. Exact.
///
/// `faces`: counter-clockwise, with an area. Of several earlier faces the first in a fixed spatial order is
/// given, so one face is compared with few others even where all of them overlap.
/// O(n log n) for the sizes found in practice, parallel inside the caller's task arena.
std::vector<std::uint32_t> find_overlaps(std::span<const Key2> keys, std::span<const FaceCorners> faces);

}  // namespace tinwright

#endif
