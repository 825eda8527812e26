#include "tinwright/io/plane_candidates.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include <GeographicLib/UTMUPS.hpp>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/proj_handles.hpp"

namespace tinwright::io {
namespace {

constexpr double kPole = 90;

std::string geographic_name(const Crs& geographic) {
    const char* const name = geographic.gdal()->GetName();
    return name == nullptr ? std::string("unnamed") : std::string(name);
}

/// A projected system on the datum of `geographic`; `project` sets the projection.
Crs make_projected(const Crs& geographic, const std::string& name,
                   const std::function<OGRErr(OGRSpatialReference&)>& project) {
    const GdalMessages messages;
    OGRSpatialReference system;
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const bool is_made = system.SetProjCS(name.c_str()) == OGRERR_NONE &&
                         system.CopyGeogCSFrom(geographic.gdal()) == OGRERR_NONE &&
                         project(system) == OGRERR_NONE &&
                         system.SetLinearUnits(SRS_UL_METER, 1.0) == OGRERR_NONE;
    if (!is_made) {
        throw InputError("no plane can be made on the datum of " + geographic.name() +
                         "; name a projected one with --working-crs" + messages.suffix());
    }
    return Crs::from_gdal(&system);
}

/// The authority's own system of that name, where it is the same as `made`; else `made`.
Crs prefer_coded(const Crs& made, const std::string& name) {
    const ProjContext context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    const std::array<PJ_TYPE, 1> types{PJ_TYPE_PROJECTED_CRS};
    const ProjList found(proj_create_from_name(context.get(), "EPSG", name.c_str(), types.data(),
                                               types.size(), 0, 1, nullptr));
    if (!found || proj_list_get_count(found.get()) == 0) {
        return made;
    }
    const ProjObject system(proj_list_get(context.get(), found.get(), 0));
    const char* const code = system ? proj_get_id_code(system.get(), 0) : nullptr;
    if (code == nullptr) {
        return made;
    }
    Crs coded = Crs::parse(std::string("EPSG:") + code);
    return coded.is_same(made) ? coded : made;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

std::string place_text(double longitude, double latitude) {
    std::array<char, 64> text{};
    (void)std::snprintf(text.data(), text.size(), "%.2f %c %.2f %c", std::abs(longitude),
                        longitude < 0 ? 'W' : 'E', std::abs(latitude), latitude < 0 ? 'S' : 'N');
    return text.data();
}

/// `make` gives the plane for a scale at the centre. Scale is proportional to it, so that one look at the
/// plane of scale 1 tells the scale whose greatest errors either way are the same.
PlaneCandidate make_balanced(const GeographicExtent& extent, const std::string& kind,
                             const std::function<Crs(double)>& make) {
    PlaneCandidate candidate{make(1), kind, std::nullopt};
    const std::optional<ScaleRange> plain = find_scale_range(candidate.crs, extent);
    if (plain) {
        const double k = rounded(2 / (plain->least + plain->greatest), 1e6);
        if (k > 0) {
            candidate.crs = make(k);
            candidate.scale = find_scale_range(candidate.crs, extent);
        }
    }
    return candidate;
}

}  // namespace

double PlaneCandidate::distortion() const {
    return scale ? scale->distortion() : std::numeric_limits<double>::infinity();
}

PlaneCandidate make_utm(const Crs& geographic, const GeographicExtent& extent) {
    // Longitudes count from the system's own prime meridian, zones from Greenwich.
    const double prime = geographic.gdal()->GetPrimeMeridian();
    const double latitude = extent.center_latitude();
    const int zone = GeographicLib::UTMUPS::StandardZone(latitude, extent.center_longitude() + prime);
    const bool is_north = latitude >= 0;
    const std::string base = geographic_name(geographic);
    PlaneCandidate candidate;
    if (zone == GeographicLib::UTMUPS::UPS) {
        candidate.kind = is_north ? "UPS North" : "UPS South";
        const std::string name = base + " / " + candidate.kind + " (E,N)";
        candidate.crs = prefer_coded(make_projected(geographic, name,
                                                    [&](OGRSpatialReference& system) {
                                                        return system.SetPS(is_north ? kPole : -kPole, -prime,
                                                                            0.994, 2e6, 2e6);
                                                    }),
                                     name);
    } else {
        const std::string number = std::to_string(zone);
        candidate.kind = "UTM zone " + number + (is_north ? "N" : "S");
        const std::string name = base + " / " + candidate.kind;
        const Crs made = make_projected(geographic, name, [&](OGRSpatialReference& system) {
            return system.SetTM(0, 6 * zone - 183 - prime, 0.9996, 5e5, is_north ? 0 : 1e7);
        });
        candidate.crs = prefer_coded(made, name);
        if (candidate.crs.code().empty()) {  // Australia's name for the same
            candidate.crs = prefer_coded(made, base + " / MGA zone " + number);
        }
    }
    candidate.scale = find_scale_range(candidate.crs, extent);
    return candidate;
}

PlaneCandidate make_local_transverse_mercator(const Crs& geographic, const GeographicExtent& extent) {
    const double longitude = rounded(extent.center_longitude(), 100);
    const double latitude = rounded(extent.center_latitude(), 100);
    const std::string name = "tinwright local transverse Mercator at " + place_text(longitude, latitude);
    return make_balanced(extent, "a local transverse Mercator", [&](double k) {
        return make_projected(geographic, name, [&](OGRSpatialReference& system) {
            return system.SetTM(latitude, longitude, k, 0, 0);
        });
    });
}

PlaneCandidate make_local_stereographic(const Crs& geographic, const GeographicExtent& extent) {
    const double longitude = rounded(extent.center_longitude(), 100);
    const double latitude = rounded(extent.center_latitude(), 100);
    const std::string name = "tinwright local stereographic at " + place_text(longitude, latitude);
    return make_balanced(extent, "a local stereographic", [&](double k) {
        return make_projected(geographic, name, [&](OGRSpatialReference& system) {
            // With a scale of just one, formats of the old kind take it for another method (variant B).
            const double polar = k == 1 ? 0.999999 : k;
            return std::abs(latitude) == kPole ? system.SetPS(latitude, longitude, polar, 0, 0)
                                               : system.SetOS(latitude, longitude, k, 0, 0);
        });
    });
}

}  // namespace tinwright::io
