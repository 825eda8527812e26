#ifndef TINWRIGHT_IO_PLANE_CANDIDATES_HPP
#define TINWRIGHT_IO_PLANE_CANDIDATES_HPP

#include <optional>
#include <string>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/geographic_extent.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {

/// Private to the choice of a plane: a system that data could be worked in, on the datum of their own
/// geographic one.
struct PlaneCandidate {
    Crs crs;
    std::string kind;                 ///< "UTM zone 32N", "a local transverse Mercator", for people
    std::optional<ScaleRange> scale;  ///< over the extent; empty when the projection does not reach over it
    /// Infinite when the projection does not reach over the extent.
    [[nodiscard]] double distortion() const;
};

/// The zone of UTM at the centre of `extent`, south of the equator with a false northing, or UPS beyond 84 N
/// and 80 S; zones in Norway and Svalbard as they are drawn there. By its code where the authority has one.
PlaneCandidate make_utm(const Crs& geographic, const GeographicExtent& extent);

/// Transverse Mercator about the centre, rounded to hundredths of a degree, with the scale there, rounded to
/// millionths, that balances the errors.
PlaneCandidate make_local_transverse_mercator(const Crs& geographic, const GeographicExtent& extent);

/// Oblique stereographic in the same way, polar where the centre is a pole.
PlaneCandidate make_local_stereographic(const Crs& geographic, const GeographicExtent& extent);

}  // namespace tinwright::io

#endif
