#ifndef TINWRIGHT_OPTIMAL_LENGTH_CERTIFICATE_HPP
#define TINWRIGHT_OPTIMAL_LENGTH_CERTIFICATE_HPP

#include <array>
#include <cstddef>
#include <optional>

#include "tinwright/geometry/norm.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

struct LengthCertificateOptions {
    Norm norm;
    /// Polygons of more sides are not triangulated anew, which takes cubic time; empty: all are.
    std::optional<std::size_t> largest_polygon = 400;
    Progress progress;  ///< throws Cancelled when it says stop
};

struct LengthCertificate {
    double longest = 0;              ///< edge of the TIN, CRS units
    std::array<VertexId, 2> edge{};  ///< that edge; of equal ones the first, by numbers
    bool is_optimal = false;         ///< proven: no triangulation has a shorter longest edge
    /// A longest edge shorter than that which can be had; the least there is, unless polygons were left out.
    std::optional<double> attainable;
    std::size_t polygons = 0;  ///< that were triangulated anew to know
    std::size_t left_out = 0;  ///< polygons that matter, but are too large to be
};

/// Whether the longest edge of a TIN is as short as it can be, by other means than `minimize_longest_edge`:
/// what the constrained edges and the relative neighbourhood graph leave open is triangulated by dynamic
/// programming (`polygon_dp.hpp`), which knows no theorem on polygons. Only polygons whose faces in the
/// constrained Delaunay triangulation have an edge longer than what is needed elsewhere can matter; most
/// often there are none or few. `tin`: at least one terrain face, any triangulation of it. O(n log n) to find
/// the polygons, O(m^3) for each of m sides.
LengthCertificate certify_length(const Tin& tin, const LengthCertificateOptions& options);

}  // namespace tinwright

#endif
