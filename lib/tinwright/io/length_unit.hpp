#ifndef TINWRIGHT_IO_LENGTH_UNIT_HPP
#define TINWRIGHT_IO_LENGTH_UNIT_HPP

#include <optional>
#include <string>
#include <string_view>

namespace tinwright::io {

/// A unit of lengths and elevations.
struct LengthUnit {
    std::string name;   ///< "metre", "foot", "US survey foot", ...
    double metres = 1;  ///< that one of it has, to the nearest double
};

/// The unit that files, authorities or users call `spelling`, letters' case and "-", "_" and blanks aside:
/// metre, m, meters, foot, ft, feet, US survey foot, us-ft, ftUS, kilometre, centimetre, millimetre, fathom,
/// yard, ..., any that EPSG or PROJ name ("Clarke's foot"), and "0.5 metre". Empty for a name that is none.
std::optional<LengthUnit> find_length_unit(std::string_view spelling);

/// The unit of so many metres: by its usual name where it has one (files write the survey foot with 8 to 16
/// digits); else by `name` where that is one of that length; else "0.5 metre", say, which tells its length.
/// `metres` is positive and finite.
LengthUnit length_unit_of(double metres, const std::string& name);

/// What elevations in `from` are multiplied by to be in `to`: by names as `LengthUnit::name` has them; 1 when
/// either is unknown or empty. The exact ratio to the nearest double where both are defined by fractions of
/// a metre, as the feet are: for others within 2 units in the last place of their defined metres' ratio.
double unit_factor(const std::string& from, const std::string& to);

}  // namespace tinwright::io

#endif
