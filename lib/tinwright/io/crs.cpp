#include "tinwright/io/crs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/length_unit.hpp"

namespace tinwright::io {
namespace {

std::string text_or_empty(const char* text) { return text == nullptr ? std::string() : std::string(text); }

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// GeoPackage's srs_id 0 and -1, and the local systems that drivers make up when a file has none.
bool is_placeholder(const OGRSpatialReference& system) {
    const std::string name = lower(text_or_empty(system.GetName()));
    if (name.starts_with("undefined")) {
        return true;
    }
    const bool nameless = name.empty() || name.starts_with("unknown") || name.starts_with("unnamed");
    return system.IsEmpty() || (system.IsLocal() != 0 && nameless);
}

/// The unit by its one name, whichever driver or authority wrote it.
std::string unit_name(double metres, const std::string& unit) {
    const std::string plain = lower(unit);
    const bool is_nameless = plain.empty() || plain == "unknown";  // GDAL then says one metre
    const bool is_told = std::isfinite(metres) && metres > 0 && !(is_nameless && metres == 1);
    return is_told ? length_unit_of(metres, unit).name : std::string();
}

/// "EPSG:3067" of a part of a system by its node, null for the whole; empty without.
std::string code_of(const OGRSpatialReference& system, const char* part) {
    const char* const authority = system.GetAuthorityName(part);
    const char* const number = system.GetAuthorityCode(part);
    return authority == nullptr || number == nullptr ? std::string()
                                                     : std::string(authority) + ":" + std::string(number);
}

bool is_along_parallel(OGRAxisOrientation axis) { return axis == OAO_East || axis == OAO_West; }
bool is_along_meridian(OGRAxisOrientation axis) { return axis == OAO_North || axis == OAO_South; }

}  // namespace

Crs Crs::parse(const std::string& definition) {
    register_drivers();
    const GdalMessages messages;
    auto system = std::make_shared<OGRSpatialReference>();
    if (definition.empty() || system->SetFromUserInput(definition.c_str()) != OGRERR_NONE) {
        throw UsageError("CRS " + quoted(definition) +
                         ": not understood; give for example EPSG:3067, WKT or a PROJ string" +
                         messages.suffix());
    }
    system->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    Crs crs;
    crs.system_ = std::move(system);
    return crs;
}

Crs Crs::from_gdal(const OGRSpatialReference* system) {
    Crs crs;
    if (system == nullptr || is_placeholder(*system)) {
        return crs;
    }
    std::shared_ptr<OGRSpatialReference> copy(system->Clone(), [](OGRSpatialReference* s) { s->Release(); });
    copy->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    crs.system_ = std::move(copy);
    return crs;
}

bool Crs::is_geographic() const {
    return system_ != nullptr && (system_->IsGeographic() != 0 || system_->IsGeocentric() != 0);
}

bool Crs::is_geocentric() const { return system_ != nullptr && system_->IsGeocentric() != 0; }

std::string Crs::axis_directions() const {
    if (system_ == nullptr || system_->GetAxesCount() < 2) {
        return {};
    }
    const GdalMessages messages;
    std::array<OGRAxisOrientation, 2> axes{OAO_Other, OAO_Other};
    const std::vector<int>& order = system_->GetDataAxisToSRSAxisMapping();
    for (std::size_t i = 0; i < 2; ++i) {
        const int axis = i < order.size() ? std::abs(order[i]) - 1 : static_cast<int>(i);
        system_->GetAxis(nullptr, axis, &axes[i]);
    }
    // Axes of polar systems all point north or all south, each along a meridian of its own.
    const bool is_cross = (is_along_parallel(axes[0]) && is_along_meridian(axes[1])) ||
                          (is_along_meridian(axes[0]) && is_along_parallel(axes[1]));
    if (!is_cross || (axes[0] == OAO_East && axes[1] == OAO_North)) {
        return {};
    }
    return "x points " + lower(OSRAxisEnumToName(axes[0])) + " and y points " +
           lower(OSRAxisEnumToName(axes[1]));
}

double Crs::metres_per_unit() const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const std::string name = is_plane() || is_geocentric() ? unit() : std::string();
    const std::optional<LengthUnit> known = find_length_unit(name);
    return known ? known->metres : kNone;
}

std::optional<double> Crs::epoch() const {
    const double year = system_ == nullptr ? 0 : system_->GetCoordinateEpoch();
    return year > 0 ? std::optional(year) : std::nullopt;
}

bool Crs::is_same(const Crs& other) const {
    if (system_ == nullptr || other.system_ == nullptr) {
        return system_ == other.system_;
    }
    const GdalMessages messages;
    const std::array<const char*, 3> options{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                             "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
    return system_ == other.system_ || system_->IsSame(other.system_.get(), options.data()) != 0;
}

std::string Crs::name() const {
    if (system_ == nullptr) {
        return "none";
    }
    std::string own = text_or_empty(system_->GetName());
    if (lower(own) == "unknown") {  // as PROJ calls what PROJ strings define
        const std::string method = text_or_empty(system_->GetAttrValue("PROJECTION"));
        own = "unnamed" + (method.empty() ? method : ", " + method);
        std::replace(own.begin(), own.end(), '_', ' ');
    }
    const std::string authority = code();
    if (authority.empty()) {
        return own.empty() ? "unnamed" : own;
    }
    return own.empty() ? authority : authority + " (" + own + ")";
}

std::string Crs::code() const {
    if (system_ == nullptr) {
        return {};
    }
    std::string whole = code_of(*system_, nullptr);
    if (!whole.empty() || system_->IsCompound() == 0) {
        return whole;
    }
    const std::string_view prefix = "EPSG:";
    const std::string x_y = horizontal().code();
    const std::string z = code_of(*system_, "COMPD_CS|VERT_CS");
    return x_y.starts_with(prefix) && z.starts_with(prefix) ? x_y + "+" + z.substr(prefix.size())
                                                            : std::string();
}

std::string Crs::wkt() const {
    if (system_ == nullptr) {
        return {};
    }
    const GdalMessages messages;
    char* text = nullptr;
    const std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
    const OGRErr error = system_->exportToWkt(&text, options.data());
    std::string wkt = error == OGRERR_NONE ? text_or_empty(text) : std::string();
    CPLFree(text);
    return wkt;
}

std::string Crs::unit() const {
    if (system_ == nullptr) {
        return {};
    }
    const char* unit = nullptr;
    if (system_->IsGeographic() != 0) {
        system_->GetAngularUnits(&unit);
        return text_or_empty(unit);
    }
    const double metres = system_->GetLinearUnits(&unit);
    return unit_name(metres, text_or_empty(unit));
}

std::string Crs::z_unit() const {
    if (system_ == nullptr) {
        return {};
    }
    const GdalMessages messages;
    if (system_->IsCompound() != 0 || system_->IsVertical() != 0) {
        const char* unit = nullptr;
        const double metres = system_->GetTargetLinearUnits("VERT_CS", &unit);
        return unit_name(metres, text_or_empty(unit));
    }
    if (system_->GetAxesCount() == 3) {
        double metres = 0;
        system_->GetAxis(nullptr, 2, nullptr, &metres);
        return unit_name(metres, "axis");
    }
    return {};
}

}  // namespace tinwright::io
