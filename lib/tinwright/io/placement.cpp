#include "tinwright/io/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>
#include <string_view>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/transform_points.hpp"

namespace tinwright::io {
namespace {

std::string label(const Source& source) { return "file " + quoted(source.path); }

std::string number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(15);
    text << value;
    return text.str();
}

/// Units as the files spell them, by one name each.
std::string z_unit_name(const std::string& unit) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kNames = {
        {{"m", "metre"},
         {"meter", "metre"},
         {"meters", "metre"},
         {"metres", "metre"},
         {"Metre", "metre"},
         {"Meter", "metre"},
         {"ft", "foot"},
         {"feet", "foot"},
         {"Feet", "foot"},
         {"US Survey Foot", "US survey foot"},
         {"us-ft", "US survey foot"},
         {"ftUS", "US survey foot"},
         {"US_survey_foot", "US survey foot"},
         {"survey_foot", "US survey foot"}}};
    for (const auto& [spelling, name] : kNames) {
        if (unit == spelling) {
            return std::string(name);
        }
    }
    return unit;
}

/// "EPSG:32612", the WGS 84 / UTM zone at the middle of points given in degrees; empty when they are not.
std::string utm_zone(std::span<const Point3> points) {
    const auto [west, east] = std::minmax_element(points.begin(), points.end(),
                                                  [](const Point3& a, const Point3& b) { return a.x < b.x; });
    const auto [south, north] = std::minmax_element(
        points.begin(), points.end(), [](const Point3& a, const Point3& b) { return a.y < b.y; });
    const double longitude = std::remainder((west->x + east->x) / 2, 360.0);
    const double latitude = (south->y + north->y) / 2;
    if (!(std::abs(latitude) <= 84) || !(std::abs(longitude) <= 180)) {
        return {};
    }
    const int zone = std::min(60, 1 + static_cast<int>(std::floor((longitude + 180) / 6)));
    return "EPSG:" + std::to_string((latitude < 0 ? 32700 : 32600) + zone);
}

}  // namespace

Placement::Placement(std::span<const Source> sources, Crs working, Crs assigned)
    : sources_(sources),
      crs_(std::move(working)),
      assigned_(std::move(assigned)),
      is_asked_for_(crs_.is_known()) {
    if (crs_.is_geographic()) {
        throw UsageError("--crs " + crs_.name() +
                         " is geographic: degrees cannot be measured as a plane; give a projected system");
    }
    for (const Source& source : sources) {
        given_.push_back(source.crs ? Crs::parse(*source.crs) : Crs());
    }
}

std::vector<std::size_t> Placement::place(std::size_t s, const CoordinateSystem& own,
                                          std::span<Point3> points, const Progress& progress) {
    const Crs crs = system_of(s, own);
    std::string z_unit = own.z_unit.empty() ? crs.z_unit() : z_unit_name(own.z_unit);
    std::vector<std::size_t> failed;
    if (!crs.is_known()) {
        without_crs_.push_back(s);
    } else if (!crs_.is_known()) {
        refuse_geographic(s, crs, points);
        crs_ = crs;
        decided_by_ = s;
    } else if (!crs.is_same(crs_)) {
        if (!is_asked_for_) {
            throw InputError(label(sources_[decided_by_]) + " is in " + crs_.name() + ", " +
                             label(sources_[s]) + " in " + crs.name() +
                             "; give the system to work in with --crs");
        }
        from_ = crs;
        failed = transform_points(points, crs, crs_, progress);
        if (!crs.z_unit().empty() && !crs_.z_unit().empty()) {
            z_unit = crs_.z_unit();
        }
    }
    note_z_unit(s, z_unit);
    return failed;
}

std::string Placement::failure(const Point3& point) const {
    std::string text = number(point.x) + ", " + number(point.y);
    text.insert(text.begin(), '(');
    return text + ") cannot be transformed from " + from_.name() + " to " + crs_.name();
}

std::vector<std::string> Placement::take_warnings() { return std::exchange(warnings_, {}); }

std::string Placement::missing_warning() const {
    if (without_crs_.empty() || !crs_.is_known()) {
        return {};
    }
    std::vector<std::string> files;
    for (const std::size_t s : without_crs_) {
        files.push_back(sources_[s].path);
    }
    return (files.size() == 1 ? "file " : "files ") + quoted_list(files) +
           (files.size() == 1 ? ": has" : ": have") + " no CRS; taken to be in " + crs_.name();
}

Crs Placement::system_of(std::size_t s, const CoordinateSystem& own) {
    if (given_[s].is_known()) {
        if (own.crs.is_known() && !own.crs.is_same(given_[s])) {
            warnings_.push_back(label(sources_[s]) + ": says " + own.crs.name() + "; read as " +
                                given_[s].name() + " because of crs=");
        }
        return given_[s];
    }
    if (own.crs.is_known()) {
        return own.crs;
    }
    if (own.is_lon_lat && !assigned_.is_known()) {
        throw InputError(label(sources_[s]) +
                         ": coordinates are longitude and latitude in an unknown system; give theirs, for "
                         "example crs=EPSG:4326, and a projected one with --crs");
    }
    return assigned_;
}

void Placement::refuse_geographic(std::size_t s, const Crs& crs, std::span<const Point3> points) const {
    if (!crs.is_geographic()) {
        return;
    }
    const std::string zone = utm_zone(points);
    throw InputError(label(sources_[s]) + ": coordinates are geographic, " + crs.name() +
                     ", and degrees cannot be measured as a plane; give a projected system with --crs" +
                     (zone.empty() ? "" : ", for example --crs " + zone));
}

void Placement::note_z_unit(std::size_t s, const std::string& unit) {
    if (unit.empty()) {
        return;
    }
    if (z_unit_.empty()) {
        z_unit_ = unit;
    } else if (z_unit_ != unit && !are_z_units_mixed_) {
        are_z_units_mixed_ = true;
        warnings_.push_back(label(sources_[s]) + ": elevations are in " + unit + ", those before in " +
                            z_unit_ + "; they are not converted");
    }
}

}  // namespace tinwright::io
