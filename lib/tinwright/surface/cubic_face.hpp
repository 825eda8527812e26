#ifndef TINWRIGHT_SURFACE_CUBIC_FACE_HPP
#define TINWRIGHT_SURFACE_CUBIC_FACE_HPP

#include <array>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Shares of a face's corners in a place in it; they sum to one.
using Shares = std::array<double, 3>;

/// What a face's form has to do with its surface: for the edge from corner k to corner k + 1 how far along
/// it, from 0 to 1 (or beyond, in an obtuse face), the foot of the perpendicular from the centroid is.
struct CubicFaceForm {
    std::array<double, 3> foot{};

    /// `edge`: from corner k to corner k + 1, any unit.
    explicit CubicFaceForm(const std::array<Point2, 3>& edge) {
        for (unsigned k = 0; k < 3; ++k) {
            const Point2 e = edge[k];
            const Point2 back = edge[(k + 2) % 3];  // from corner k + 2 to corner k
            foot[k] = (1 - (back.x * e.x + back.y * e.y) / (e.x * e.x + e.y * e.y)) / 3;
        }
    }
};

/// What a face's surface is made of.
struct CubicFaceData {
    std::array<double, 3> z{};
    /// What the gradient at corner i gives along its edges to corners i + 1 and i + 2.
    std::array<std::array<double, 2>, 3> rise{};
};

/// The macro-element of Clough and Tocher [clough1965] on one face: three cubics that meet at the centroid,
/// together continuously differentiable, with given elevations and gradients at the corners.
///
/// Of the many such elements it is the one whose slope across each edge, perpendicular to it, changes
/// linearly along the edge. So along an edge the surface and its gradient follow from what is given at the
/// edge's ends, and the elements of two faces that agree there join smoothly, while each needs to know only
/// its own face. The other usual choice, the slope towards the neighbouring face's centroid
/// [alfeld1984], keeps its surface under any affine map, but is another for each of the two faces of a
/// border. Both reproduce quadratics.
class CubicFace {
  public:
    /// Elevation at a place; its change with the share of each corner, as if shares were three variables.
    struct Value {
        double z = 0;
        Shares change{};
    };

    CubicFace() = default;
    CubicFace(const CubicFaceForm& form, const CubicFaceData& data);

    [[nodiscard]] Value at(const Shares& share) const;

  private:
    // Bezier ordinates. Corner i: z_[i], the next ones to corners i + 1 and i + 2 along_[i][0], [1], towards
    // the centroid inward_[i], then near_[i], and center_. middle_[k] is that amid the cubic on edge k, k
    // + 1.
    std::array<double, 3> z_{};
    std::array<std::array<double, 2>, 3> along_{};
    std::array<double, 3> inward_{};
    std::array<double, 3> middle_{};
    std::array<double, 3> near_{};
    double center_ = 0;
};

inline CubicFace::CubicFace(const CubicFaceForm& form, const CubicFaceData& data) : z_(data.z) {
    for (unsigned i = 0; i < 3; ++i) {
        along_[i] = {z_[i] + data.rise[i][0] / 3, z_[i] + data.rise[i][1] / 3};
        inward_[i] = z_[i] + (data.rise[i][0] + data.rise[i][1]) / 9;
    }
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = k == 2 ? 0 : k + 1;
        const double foot = form.foot[k];
        const double from = along_[k][0];
        const double to = along_[next][1];
        // Slopes across the edge at its ends, times a third of the centroid's distance; their mean is that at
        // the middle.
        const double at_start = (inward_[k] - z_[k]) - foot * (from - z_[k]);
        const double at_end = (inward_[next] - to) - foot * (z_[next] - to);
        middle_[k] = from + foot * (to - from) + (at_start + at_end) / 2;
    }
    for (unsigned i = 0; i < 3; ++i) {
        near_[i] = (inward_[i] + middle_[i] + middle_[i == 0 ? 2 : i - 1]) / 3;
    }
    center_ = (near_[0] + near_[1] + near_[2]) / 3;
}

inline CubicFace::Value CubicFace::at(const Shares& share) const {
    // The cubic on the edge across from the corner with the least share, by de Casteljau's steps.
    unsigned c = share[1] < share[0] ? 1 : 0;
    c = share[2] < share[c] ? 2 : c;
    const unsigned i = c == 2 ? 0 : c + 1;
    const unsigned j = c == 0 ? 2 : c - 1;
    const double u = share[i] - share[c];
    const double v = share[j] - share[c];
    const double w = 3 * share[c];
    const auto step = [&](double a, double b, double d) { return u * a + v * b + w * d; };
    const double uu = step(z_[i], along_[i][0], inward_[i]);
    const double uv = step(along_[i][0], along_[j][1], middle_[i]);
    const double vv = step(along_[j][1], z_[j], inward_[j]);
    const double uw = step(inward_[i], middle_[i], near_[i]);
    const double vw = step(middle_[i], inward_[j], near_[j]);
    const double ww = step(near_[i], near_[j], center_);
    const double at_u = step(uu, uv, uw);
    const double at_v = step(uv, vv, vw);
    const double at_w = step(uw, vw, ww);
    Value value;
    value.z = step(at_u, at_v, at_w);
    value.change[i] = 3 * at_u;
    value.change[j] = 3 * at_v;
    value.change[c] = 3 * (3 * at_w - at_u - at_v);
    return value;
}

}  // namespace tinwright

#endif
