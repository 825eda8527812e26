#ifndef TINWRIGHT_SURFACE_SCAN_AXIS_HPP
#define TINWRIGHT_SURFACE_SCAN_AXIS_HPP

#include <cstdint>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// One axis of the lattice that a TIN's vertices and a raster's cell centres share. Signs of orient2d do
/// not change when x and y are scaled apart, so each axis has its own scale.
struct ScanAxis {
    double scale = 1;             ///< key * scale is the vertex's coordinate, a whole number up to 2^52
    std::vector<double> centres;  ///< coordinates of the cell centres, whole numbers where they may be tested
    double inverse_step = 1;      ///< one over the distance of neighbouring centres
    /// How far (in cells) a coordinate computed as (x - centres[0]) * inverse_step, or by interpolation
    /// between two of them, may be off. Nearer to a centre than this, exact arithmetic has to decide.
    double uncertainty = 0;

    /// The centres in whole steps of which `steps` make one of the TIN's lattice.
    [[nodiscard]] std::vector<double> centres_at(double steps) const;
};

enum class AxisDirection { East, South };

/// Lattice for `count` centres at start + (i + 1/2) * step (East, start is x_min) or start - (i + 1/2) *
/// step (South, start is y_max), i < count.
///
/// Where start, step and the TIN's lattice are decimal and fit into 2^52 steps together, the centres are
/// exactly the decimal numbers the user means. Else they are the nearest multiples of quantum / 2^j to the
/// centres in double precision, j as large as the precision of the coordinates warrants.
/// `origin`, `key_limit`: the lattice's origin on this axis, and the largest key on it. O(count).
ScanAxis make_scan_axis(const Lattice& lattice, double origin, double key_limit, AxisDirection direction,
                        double start, double step, std::int64_t count);

}  // namespace tinwright

#endif
