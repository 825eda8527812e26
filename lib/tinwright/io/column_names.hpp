#ifndef TINWRIGHT_IO_COLUMN_NAMES_HPP
#define TINWRIGHT_IO_COLUMN_NAMES_HPP

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tinwright::io {

/// Columns or fields recognised by their names; positions from 0.
struct NamedColumns {
    std::optional<std::size_t> x;
    std::optional<std::size_t> y;
    std::optional<std::size_t> z;
    bool is_lon_lat = false;  ///< x and y are called longitude and latitude
};

/// Recognises x/y/z, easting/northing/elevation, lon/lat and their usual spellings; case, blanks, punctuation
/// and a unit in brackets do not matter. x and y come from one family of names where possible.
NamedColumns recognise_columns(const std::vector<std::string>& names);

/// Position of the column of this name: the same spelling, else the same but for case.
std::optional<std::size_t> find_column(const std::vector<std::string>& names, std::string_view name);

}  // namespace tinwright::io

#endif
