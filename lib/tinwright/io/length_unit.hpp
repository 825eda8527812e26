#ifndef TINWRIGHT_IO_LENGTH_UNIT_HPP
#define TINWRIGHT_IO_LENGTH_UNIT_HPP

#include <optional>
#include <string>
#include <string_view>

namespace tinwright::io {

/// A unit of lengths and elevations.
struct LengthUnit {
    std::string name;   ///< "metre", "foot", "US survey foot", ...
    double metres = 1;  ///< that one of it has; exact where the unit is defined by a fraction
};

/// The unit that files, authorities or users call `spelling`, letters' case and "-", "_" and blanks aside:
/// metre, m, meters, foot, ft, feet, US survey foot, us-ft, ftUS, kilometre, centimetre, millimetre, fathom,
/// yard, and others that PROJ and EPSG name. Empty for a name that is none.
std::optional<LengthUnit> find_length_unit(std::string_view spelling);

/// The unit of so many metres: by its usual name where it has one (files write the survey foot with 8 to 16
/// digits), else by `name`.
LengthUnit length_unit_of(double metres, const std::string& name);

/// What elevations in `from` are multiplied by to be in `to`: by names as `LengthUnit::name` has them; 1 when
/// either is unknown or empty.
double unit_factor(const std::string& from, const std::string& to);

}  // namespace tinwright::io

#endif
