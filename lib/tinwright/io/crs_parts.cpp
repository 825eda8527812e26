#include <array>
#include <cctype>
#include <memory>
#include <utility>

#include <cpl_conv.h>
#include <cpl_json.h>
#include <ogr_spatialref.h>
#include <proj.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

struct EndContext {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct EndObject {
    void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, EndContext>;
using Object = std::unique_ptr<PJ, EndObject>;
using System = std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)>;

/// One a call: contexts belong to a thread, and systems are taken apart a few times a job.
Context make_context() {
    Context context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    return context;
}

System clone(const OGRSpatialReference& system) {
    return {system.Clone(), [](OGRSpatialReference* s) { s->Release(); }};
}

/// By its code if it has one: WKT tells codes of the whole only, not those of its parts.
Object to_proj(PJ_CONTEXT* context, const Crs& crs) {
    const std::string code = crs.code();
    Object by_code(code.empty() ? nullptr : proj_create(context, code.c_str()));
    return by_code ? std::move(by_code) : Object(proj_create(context, crs.wkt().c_str()));
}

std::string wkt_of(PJ_CONTEXT* context, const PJ* object) {
    const std::array<const char*, 2> options{"MULTILINE=NO", nullptr};
    const char* const wkt =
        object == nullptr ? nullptr : proj_as_wkt(context, object, PJ_WKT2_2019, options.data());
    return wkt == nullptr ? std::string() : std::string(wkt);
}

/// The same epoch as `like`; unknown when there is no such system.
Crs from_wkt(const std::string& wkt, const Crs& like) {
    OGRSpatialReference system;
    if (wkt.empty() || system.importFromWkt(wkt.c_str()) != OGRERR_NONE) {
        return {};
    }
    system.SetCoordinateEpoch(like.epoch().value_or(0));
    return Crs::from_gdal(&system);
}

/// The vertical part of a compound system, with its way to the ellipsoid where it knows one; null without.
Object vertical_part(PJ_CONTEXT* context, const Crs& crs) {
    if (!crs.is_known() || crs.gdal()->IsVertical() == 0) {
        return nullptr;
    }
    Object whole = to_proj(context, crs);
    if (whole == nullptr || crs.gdal()->IsCompound() == 0) {
        return whole;
    }
    return Object(proj_crs_get_sub_crs(context, whole.get(), 1));
}

bool is_bound(const PJ* crs) { return proj_get_type(crs) == PJ_TYPE_BOUND_CRS; }

/// What a bound system is, without the way to another that it carries; itself if it carries none.
Object unbound(PJ_CONTEXT* context, const PJ* crs) {
    return Object(is_bound(crs) ? proj_get_source_crs(context, crs) : proj_clone(context, crs));
}

Object datum_of(PJ_CONTEXT* context, const PJ* vertical) {
    const Object single = unbound(context, vertical);
    return Object(single ? proj_crs_get_datum_forced(context, single.get()) : nullptr);
}

/// "up" or "down"; empty when there is no telling.
std::string direction_of(PJ_CONTEXT* context, const PJ* vertical) {
    const Object single = unbound(context, vertical);
    const Object axes(single ? proj_crs_get_coordinate_system(context, single.get()) : nullptr);
    const char* direction = nullptr;
    if (axes == nullptr || proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, &direction,
                                                 nullptr, nullptr, nullptr, nullptr) == 0) {
        return {};
    }
    return direction == nullptr ? std::string() : std::string(direction);
}

/// Files that know a unit of z but not what it is measured from call that "unknown".
bool is_anonymous(PJ_CONTEXT* context, const PJ* vertical) {
    if (is_bound(vertical)) {
        return false;
    }
    const Object datum = datum_of(context, vertical);
    const char* const name = datum ? proj_get_name(datum.get()) : nullptr;
    std::string text = name == nullptr ? std::string() : std::string(name);
    for (char& c : text) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text.empty() || text.starts_with("unknown") || text.starts_with("unnamed") ||
           text.starts_with("undefined");
}

bool is_same_vertical(PJ_CONTEXT* context, const PJ* a, const PJ* b) {
    if (direction_of(context, a) != direction_of(context, b)) {
        return false;
    }
    if (is_bound(a) || is_bound(b)) {  // each may go to the ellipsoid by a way of its own
        return proj_is_equivalent_to(a, b, PJ_COMP_EQUIVALENT) != 0;
    }
    const Object datum = datum_of(context, a);
    const Object other = datum_of(context, b);
    return datum && other && proj_is_equivalent_to(datum.get(), other.get(), PJ_COMP_EQUIVALENT) != 0;
}

/// A name as WKT has it: quotes doubled.
std::string wkt_text(const std::string& name) {
    std::string text = "\"";
    for (const char c : name) {
        text.append(c == '"' ? 2 : 1, c);
    }
    return text + "\"";
}

/// Unknown where the two do not go together.
Crs compound(PJ_CONTEXT* context, const Crs& horizontal, const PJ* vertical) {
    const GdalMessages messages;
    const char* const name = horizontal.gdal()->GetName();
    const char* const z_name = proj_get_name(vertical);
    std::string both =
        (name == nullptr ? "unnamed" : name) + std::string(" + ") + (z_name == nullptr ? "" : z_name);
    return from_wkt(
        "COMPOUNDCRS[" + wkt_text(both) + "," + horizontal.wkt() + "," + wkt_of(context, vertical) + "]",
        horizontal);
}

bool is_three_dimensional(const OGRSpatialReference& system) {
    return system.IsCompound() == 0 && system.IsGeocentric() == 0 && system.GetAxesCount() == 3 &&
           (system.IsGeographic() != 0 || system.IsProjected() != 0);
}

/// The third axis as it is written in PROJ's JSON.
CPLJSONObject third_axis(const CPLJSONObject& system) {
    const CPLJSONObject source = system.GetObj("source_crs");
    const CPLJSONObject axes = (source.IsValid() ? source : system).GetObj("coordinate_system/axis");
    const CPLJSONArray list = axes.ToArray();
    return list.IsValid() && list.Size() == 3 ? list[2] : CPLJSONObject();
}

CPLJSONDocument json_of(const OGRSpatialReference& system) {
    CPLJSONDocument document;
    char* text = nullptr;
    if (system.exportToPROJJSON(&text, nullptr) == OGRERR_NONE) {
        document.LoadMemory(std::string(text));
    }
    CPLFree(text);
    return document;
}

/// Makes a unit of z other than the metre, which is what systems get that are made three-dimensional.
System with_z_unit_of(System system, const OGRSpatialReference& other) {
    const CPLJSONDocument document = json_of(*system);
    const CPLJSONDocument like = json_of(other);
    CPLJSONObject axis = third_axis(document.GetRoot());
    const CPLJSONObject unit = third_axis(like.GetRoot()).GetObj("unit");
    if (!axis.IsValid() || !unit.IsValid()) {
        return system;
    }
    axis.Delete("unit");
    axis.Add("unit", unit);
    System changed = clone(*system);
    const std::string text = document.SaveAsString();
    return changed->SetFromUserInput(text.c_str()) == OGRERR_NONE ? std::move(changed) : std::move(system);
}

/// The system by its code, which it loses on some of the ways to it.
Crs with_code(const OGRSpatialReference& system) {
    Crs nameless = Crs::from_gdal(&system);
    std::array<double, 7> shift{};
    const bool has_way_of_its_own = system.GetTOWGS84(shift.data(), 7) == OGRERR_NONE;
    if (!nameless.is_known() || !nameless.code().empty() || has_way_of_its_own) {
        return nameless;
    }
    const System match(system.FindBestMatch(70, "EPSG", nullptr),
                       [](OGRSpatialReference* s) { OGRSpatialReference::DestroySpatialReference(s); });
    if (match == nullptr) {
        return nameless;
    }
    match->SetCoordinateEpoch(system.GetCoordinateEpoch());
    const Crs named = Crs::from_gdal(match.get());
    return named.is_same(nameless) ? named : nameless;
}

}  // namespace

Crs::Heights Crs::heights() const {
    if (system_ == nullptr) {
        return Heights::Unknown;
    }
    const GdalMessages messages;
    if (system_->IsGeocentric() != 0 || is_three_dimensional(*system_)) {
        return Heights::Ellipsoidal;
    }
    const Context context = make_context();
    const Object vertical = vertical_part(context.get(), *this);
    return vertical && !is_anonymous(context.get(), vertical.get()) ? Heights::Gravity : Heights::Unknown;
}

Crs Crs::horizontal() const {
    if (system_ == nullptr || (system_->IsCompound() == 0 && !is_three_dimensional(*system_))) {
        return system_ != nullptr && system_->IsVertical() != 0 ? Crs() : *this;
    }
    const GdalMessages messages;
    const System part = clone(*system_);
    part->DemoteTo2D(nullptr);
    return with_code(*part);
}

Crs Crs::geographic() const {
    if (system_ == nullptr) {
        return {};
    }
    const GdalMessages messages;
    System base(system_->CloneGeogCS(), [](OGRSpatialReference* s) { s->Release(); });
    if (base == nullptr) {
        return {};
    }
    base->DemoteTo2D(nullptr);
    if (base->IsDerivedGeographic() != 0) {  // a turned globe
        const Context context = make_context();
        const Object derived(proj_create(context.get(), from_gdal(base.get()).wkt().c_str()));
        const Object source(derived ? proj_get_source_crs(context.get(), derived.get()) : nullptr);
        return from_wkt(wkt_of(context.get(), source.get()), *this);
    }
    base->SetCoordinateEpoch(system_->GetCoordinateEpoch());
    return with_code(*base);
}

Crs Crs::with_heights_of(const Crs& other) const {
    Crs base = horizontal();
    if (!base.is_known() || !other.is_known() || base.is_geocentric()) {
        return base;
    }
    if (is_three_dimensional(*other.system_)) {
        Crs promoted = base.with_ellipsoidal_heights();
        if (!promoted.is_known() || !is_three_dimensional(*promoted.system_) ||
            promoted.z_unit() == other.z_unit()) {
            return promoted;
        }
        const GdalMessages messages;
        return from_gdal(with_z_unit_of(clone(*promoted.system_), *other.system_).get());
    }
    const Context context = make_context();
    const Object vertical = vertical_part(context.get(), other);
    Crs both = vertical ? compound(context.get(), base, vertical.get()) : Crs();
    return both.is_known() ? both : base;
}

Crs Crs::with_vertical(const std::string& vertical_code) const {
    const Crs vertical = parse(vertical_code);
    if (vertical.system_->IsVertical() == 0) {
        throw UsageError("CRS " + quoted(vertical_code) +
                         ": not a vertical system; give for example EPSG:5773");
    }
    Crs both = with_heights_of(vertical);
    if (!both.is_known() || both.system_->IsCompound() == 0) {
        throw UsageError("CRS " + name() + " cannot have heights in " + vertical.name() +
                         "; give a projected or geographic system");
    }
    return both;
}

Crs Crs::with_ellipsoidal_heights() const {
    Crs base = horizontal();
    if (!base.is_known() || (system_->IsCompound() == 0 && is_three_dimensional(*system_))) {
        return base.is_known() ? *this : base;
    }
    const GdalMessages messages;
    const System promoted = clone(*base.system_);
    promoted->PromoteTo3D(nullptr);
    return from_gdal(promoted.get());
}

bool Crs::is_same_horizontally(const Crs& other) const { return horizontal().is_same(other.horizontal()); }

bool Crs::has_same_heights(const Crs& other) const {
    if (system_ == nullptr || other.system_ == nullptr || is_geocentric() || other.is_geocentric()) {
        return false;
    }
    const Heights own = heights();
    if (own == Heights::Unknown || own != other.heights()) {
        return false;
    }
    if (own == Heights::Ellipsoidal) {
        return geographic().is_same(other.geographic());
    }
    const Context context = make_context();
    const Object a = vertical_part(context.get(), *this);
    const Object b = vertical_part(context.get(), other);
    return is_same_vertical(context.get(), a.get(), b.get());
}

}  // namespace tinwright::io
