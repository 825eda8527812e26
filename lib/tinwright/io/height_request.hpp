#ifndef TINWRIGHT_IO_HEIGHT_REQUEST_HPP
#define TINWRIGHT_IO_HEIGHT_REQUEST_HPP

#include <string>

namespace tinwright::io {

/// What the user says about elevations.
struct HeightRequest {
    std::string source_unit{};     ///< --z-unit: of sources that do not tell theirs, by `LengthUnit::name`
    double scale = 1;              ///< --z-scale: elevations that are read count times this
    std::string unit{};            ///< --target-z-unit: what they are brought to; empty: the first one known
    std::string geoid{};           ///< --geoid: a file for `Geoid`; empty: none
    bool is_to_ellipsoid = false;  ///< --heights ellipsoidal: with a geoid, the heights wanted
};

}  // namespace tinwright::io

#endif
