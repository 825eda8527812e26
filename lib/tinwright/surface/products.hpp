#ifndef TINWRIGHT_SURFACE_PRODUCTS_HPP
#define TINWRIGHT_SURFACE_PRODUCTS_HPP

#include <cstdint>

#include "tinwright/surface/interpolator.hpp"

/// What is told of a surface at a place, from its gradient.
namespace tinwright {

enum class SlopeUnit : std::uint8_t { Degree, Percent, Ratio };

/// Steepness: 0 is level. `gradient` in z units over CRS units.
double slope_of(Point2 gradient, SlopeUnit unit);

/// The direction that the surface falls to, degrees clockwise from north (the y axis), in [0, 360). NaN where
/// it is level.
double aspect_of(Point2 gradient);

/// Where the light of a hillshade comes from.
struct Light {
    double azimuth = 315;  ///< degrees clockwise from north
    double altitude = 45;  ///< degrees above the horizon
    double z_factor = 1;   ///< heights count times this
};

/// Brightness of the surface: 1 (in shade) to 255 (turned to the light), as gdaldem's.
double hillshade_of(Point2 gradient, const Light& light);

}  // namespace tinwright

#endif
