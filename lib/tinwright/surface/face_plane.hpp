#ifndef TINWRIGHT_SURFACE_FACE_PLANE_HPP
#define TINWRIGHT_SURFACE_FACE_PLANE_HPP

#include <algorithm>
#include <array>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// A face's corner, its position in whole numbers of magnitude up to 2^52.
struct SurfaceCorner {
    Key2 key{};
    double z = 0;
};

/// How a face's elevation runs along a row.
struct PlaneSection {
    double x = 0;         ///< of the face's first corner
    double gradient = 0;  ///< of z along x
    double lowest = 0;
    double highest = 0;

    /// `row_value`: FacePlane::row_value of the row.
    [[nodiscard]] double value(double row_value, double at_x) const {
        // Written so that a NaN (elevations near the end of the range) gives a corner's elevation.
        double z = row_value + gradient * (at_x - x);
        z = z < highest ? z : highest;
        return z > lowest ? z : lowest;
    }
};

/// The plane through a face's corners, clamped to their elevations. A pure function of the corners in the
/// order given.
///
/// The gradient comes from plain doubles, whose relative error grows with the face's aspect ratio; faces
/// flatter than kNeedle are evaluated by weights from exact determinants instead, slower but good to a few
/// roundings of the corners' elevations whatever the shape.
class FacePlane {
  public:
    /// Corners in counter-clockwise order; finite elevations.
    explicit FacePlane(const std::array<SurfaceCorner, 3>& corner);

    [[nodiscard]] bool is_needle() const { return is_needle_; }
    /// The part of the elevation that is the same for a whole row; not for needles.
    [[nodiscard]] double row_value(double y) const {
        return corner_[0].z + gradient_.y * (y - corner_[0].key.y);
    }
    [[nodiscard]] PlaneSection section() const { return {corner_[0].key.x, gradient_.x, lowest_, highest_}; }
    /// Elevation at a key inside a needle or on its border; right for every face.
    [[nodiscard]] double needle_value(Key2 at) const;

  private:
    static constexpr double kNeedle = 0x1p-20;

    std::array<SurfaceCorner, 3> corner_;
    Key2 gradient_{};
    double lowest_ = 0;
    double highest_ = 0;
    bool is_needle_ = false;
};

inline FacePlane::FacePlane(const std::array<SurfaceCorner, 3>& corner)
    : corner_(corner),
      lowest_(std::min(std::min(corner[0].z, corner[1].z), corner[2].z)),
      highest_(std::max(std::max(corner[0].z, corner[1].z), corner[2].z)) {
    const auto& [a, b, c] = corner_;
    const Key2 ab{b.key.x - a.key.x, b.key.y - a.key.y};
    const Key2 ac{c.key.x - a.key.x, c.key.y - a.key.y};
    const double first = ab.x * ac.y;
    const double second = ab.y * ac.x;
    const double area = first - second;
    is_needle_ = !(std::abs(area) > kNeedle * (std::abs(first) + std::abs(second)));
    const double inverse = 1 / area;
    const double ab_z = b.z - a.z;
    const double ac_z = c.z - a.z;
    gradient_ = {(ab_z * ac.y - ac_z * ab.y) * inverse, (ac_z * ab.x - ab_z * ac.x) * inverse};
}

inline double FacePlane::needle_value(Key2 at) const {
    const auto& [a, b, c] = corner_;
    const double area = doubled_area(a.key, b.key, c.key);
    const double z = (doubled_area(at, b.key, c.key) / area) * a.z +
                     (doubled_area(a.key, at, c.key) / area) * b.z +
                     (doubled_area(a.key, b.key, at) / area) * c.z;
    return std::max(lowest_, std::min(z, highest_));
}

}  // namespace tinwright

#endif
