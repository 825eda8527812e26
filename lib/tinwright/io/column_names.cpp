#include "tinwright/io/column_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

namespace tinwright::io {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Lower case letters and digits only, without what stands in brackets: "X-Coord [m]" is "xcoord".
std::string normalised(std::string_view name) {
    std::string key;
    for (const char c : name.substr(0, name.find_first_of("([{"))) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || byte >= 0x80) {
            key += lower(c);
        }
    }
    return key;
}

using Names = std::span<const std::string_view>;

std::optional<std::size_t> find_first(const std::vector<std::string>& keys, Names names) {
    for (const std::string_view name : names) {
        const auto found = std::find(keys.begin(), keys.end(), name);
        if (found != keys.end()) {
            return static_cast<std::size_t>(found - keys.begin());
        }
    }
    return std::nullopt;
}

constexpr std::array<std::string_view, 11> kXNames = {
    "x", "xcoord", "xcoordinate", "coordx", "coordinatex", "pointx", "posx", "xpos", "geomx", "xutm", "utmx"};
constexpr std::array<std::string_view, 11> kYNames = {
    "y", "ycoord", "ycoordinate", "coordy", "coordinatey", "pointy", "posy", "ypos", "geomy", "yutm", "utmy"};
constexpr std::array<std::string_view, 9> kEastNames = {"easting", "eastings",   "east",    "e",  "ecoord",
                                                        "utme",    "rechtswert", "ostwert", "ost"};
constexpr std::array<std::string_view, 9> kNorthNames = {"northing", "northings", "north",    "n",   "ncoord",
                                                         "utmn",     "hochwert",  "nordwert", "nord"};
constexpr std::array<std::string_view, 6> kLonNames = {"longitude", "lon",    "long",
                                                       "lng",       "londeg", "longdeg"};
constexpr std::array<std::string_view, 3> kLatNames = {"latitude", "lat", "latdeg"};
constexpr std::array<std::string_view, 21> kZNames = {
    "z",      "elevation", "elev", "ele",    "el",          "height", "h",
    "hgt",    "altitude",  "alt",  "zcoord", "zcoordinate", "coordz", "coordinatez",
    "pointz", "posz",      "zpos", "geomz",  "level",       "hoehe",  "h\xC3\xB6he"};

}  // namespace

NamedColumns recognise_columns(const std::vector<std::string>& names) {
    std::vector<std::string> keys(names.size());
    std::transform(names.begin(), names.end(), keys.begin(), normalised);
    struct Family {
        Names x;
        Names y;
        bool is_lon_lat;
    };
    const std::array<Family, 3> families = {
        {{kXNames, kYNames, false}, {kEastNames, kNorthNames, false}, {kLonNames, kLatNames, true}}};
    NamedColumns columns;
    columns.z = find_first(keys, kZNames);
    for (const Family& family : families) {
        columns.x = find_first(keys, family.x);
        columns.y = find_first(keys, family.y);
        if (columns.x && columns.y) {
            columns.is_lon_lat = family.is_lon_lat;
            return columns;
        }
    }
    columns.x.reset();
    columns.y.reset();
    for (const Family& family : {families[0], families[1]}) {  // "x" beside "northing": strange, but clear
        columns.x = columns.x ? columns.x : find_first(keys, family.x);
        columns.y = columns.y ? columns.y : find_first(keys, family.y);
    }
    return columns;
}

std::optional<std::size_t> find_column(const std::vector<std::string>& names, std::string_view name) {
    const auto exact = std::find(names.begin(), names.end(), name);
    if (exact != names.end()) {
        return static_cast<std::size_t>(exact - names.begin());
    }
    const auto same_letters = [&](const std::string& other) {
        return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                          [](char a, char b) { return lower(a) == lower(b); });
    };
    const auto found = std::find_if(names.begin(), names.end(), same_letters);
    return found == names.end() ? std::nullopt
                                : std::optional<std::size_t>(static_cast<std::size_t>(found - names.begin()));
}

}  // namespace tinwright::io
