#include "tinwright/io/crs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

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

/// One spelling a unit, whichever driver or authority wrote it.
std::string unit_name(const std::string& unit, double metres) {
    constexpr double kFoot = 0.3048;
    constexpr double kSurveyFoot = 1200.0 / 3937.0;
    if (metres == 1.0) {
        return "metre";
    }
    if (std::abs(metres - kSurveyFoot) < 1e-10) {  // files write it with 8 to 16 digits; feet differ by 6e-7
        return "US survey foot";
    }
    if (std::abs(metres - kFoot) < 1e-10) {
        return "foot";
    }
    return unit;
}

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

Crs::Heights Crs::heights() const { return Heights::Unknown; }
Crs Crs::horizontal() const { return *this; }
Crs Crs::geographic() const { return *this; }
Crs Crs::with_heights_of(const Crs& /*other*/) const { return *this; }
Crs Crs::with_vertical(const std::string& /*vertical_code*/) const { return *this; }
Crs Crs::with_ellipsoidal_heights() const { return *this; }
bool Crs::is_same_horizontally(const Crs& other) const { return is_same(other); }
bool Crs::has_same_heights(const Crs& /*other*/) const { return false; }
std::string Crs::axis_directions() const { return {}; }
double Crs::metres_per_unit() const { return 1; }
std::optional<double> Crs::epoch() const { return std::nullopt; }

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
    const std::string own = text_or_empty(system_->GetName());
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
    const char* const authority = system_->GetAuthorityName(nullptr);
    const char* const number = system_->GetAuthorityCode(nullptr);
    return authority == nullptr || number == nullptr ? std::string()
                                                     : std::string(authority) + ":" + std::string(number);
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
    return unit_name(text_or_empty(unit), metres);
}

std::string Crs::z_unit() const {
    if (system_ == nullptr) {
        return {};
    }
    const GdalMessages messages;
    if (system_->IsCompound() != 0 || system_->IsVertical() != 0) {
        const char* unit = nullptr;
        const double metres = system_->GetTargetLinearUnits("VERT_CS", &unit);
        return unit_name(text_or_empty(unit), metres);
    }
    if (system_->GetAxesCount() == 3) {
        double metres = 0;
        system_->GetAxis(nullptr, 2, nullptr, &metres);
        return metres > 0 ? unit_name(std::string(), metres) : std::string();
    }
    return {};
}

}  // namespace tinwright::io
