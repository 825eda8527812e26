#include "tinwright/io/line_plan.hpp"

#include <memory>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/read_lines.hpp"

namespace tinwright::io {
namespace {

bool may_have_lines(OGRLayer& layer) {
    const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    return type == wkbUnknown || type == wkbGeometryCollection || OGR_GT_IsSubClassOf(type, wkbCurve) != 0 ||
           OGR_GT_IsSubClassOf(type, wkbSurface) != 0 || OGR_GT_IsSubClassOf(type, wkbMultiCurve) != 0 ||
           OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
}

/// By the declared type, or where that says nothing by the first feature.
bool holds_lines(OGRLayer& layer) {
    const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    if (type != wkbUnknown && type != wkbGeometryCollection) {
        return may_have_lines(layer);
    }
    layer.ResetReading();
    const std::unique_ptr<OGRFeature> feature(layer.GetNextFeature());
    layer.ResetReading();
    return feature && feature->GetGeometryRef() != nullptr && feature->GetGeometryRef()->getDimension() > 0;
}

bool holds_polygon_type(OGRwkbGeometryType type) {
    return OGR_GT_IsSubClassOf(type, wkbSurface) != 0 || OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
}

bool holds_polygons(OGRLayer& layer) {
    const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    if (type == wkbUnknown || type == wkbGeometryCollection) {
        layer.ResetReading();
        const std::unique_ptr<OGRFeature> feature(layer.GetNextFeature());
        layer.ResetReading();
        return feature && feature->GetGeometryRef() != nullptr &&
               feature->GetGeometryRef()->getDimension() > 1;
    }
    return holds_polygon_type(type);
}

/// Fills z and sharpness into the plan for a layer, as the source's keys say.
void plan_attributes(LinePlan& plan, const VectorLayer& layer, const Source& source) {
    const std::string numeric = layer.numeric_fields();
    plan.advice = "; give z=FIELD, z=NUMBER, or z=drape to take it from the samples" +
                  (numeric.empty() ? "" : " (numeric fields: " + numeric + ")");
    plan.is_draped = source.z && *source.z == "drape";
    plan.may_lack_z = plan.role != LineRole::Breakline && !source.z;
    if (source.z && !plan.is_draped) {
        const VectorLayer::Elevation z = layer.elevation(*source.z);
        plan.z_field = z.field;
        plan.z_constant = z.constant;
    }
    if (source.across && *source.across == "smooth") {
        plan.is_sharp = false;
    } else if (source.across && *source.across != "sharp") {
        plan.across_field = layer.field("across", *source.across);
    }
}

/// Refuses layers whose declared type says that no feature can be used, skipped bad ones or not.
void check_geometry_type(const LinePlan& plan, OGRLayer& layer) {
    const OGRwkbGeometryType declared = layer.GetGeomType();
    const OGRwkbGeometryType type = wkbFlatten(declared);
    if (type == wkbNone) {
        throw InputError(plan.where +
                         ": a table without geometries; for text with a column of WKT name it with "
                         "oo=GEOM_POSSIBLE_NAMES=COLUMN");
    }
    if (type == wkbPoint || type == wkbMultiPoint) {
        throw InputError(plan.where + ": has " + OGRGeometryTypeToName(type) +
                         " features, no lines or polygons");
    }
    if (plan.role == LineRole::River && holds_polygon_type(type)) {
        throw InputError(plan.where + ": has " + OGRGeometryTypeToName(type) +
                         " features, and rivers are lines; polygons go with --banks or --lakes");
    }
    const bool has_z = OGR_GT_HasZ(declared) != 0 || plan.z_field >= 0 || plan.z_constant || plan.is_draped;
    if (type != wkbUnknown && !has_z && !plan.may_lack_z && !plan.keeps_faults) {
        throw InputError(plan.where + ": the geometries have no z" + plan.advice);
    }
}

}  // namespace

LinePlan make_line_plan(const VectorLayer& layer, const Source& source, LineRole role, bool keeps_faults) {
    LinePlan plan;
    plan.role = role;
    plan.where = layer.where();
    plan.keeps_faults = keeps_faults;
    plan_attributes(plan, layer, source);
    check_geometry_type(plan, layer.layer());
    return plan;
}

VectorLayer::Wanted wanted_lines() {
    return {may_have_lines, "no layer has lines or polygons", "several layers may have lines", ""};
}

bool has_lines(const Source& source) {
    const bool is_for_samples = source.vertices || source.format != Source::Format::Auto || source.x_field ||
                                source.y_field || source.band || source.stride ||
                                source.as != Source::Kind::Auto ||
                                source.path.find("/vsistdin") != std::string::npos;
    if (is_for_samples) {
        return false;
    }
    const GdalMessages messages;
    const OpenedSource opened = open_source(source);
    if (opened.kind != OpenedSource::Kind::Vector) {
        return false;
    }
    if (source.layer || source.sql) {
        const VectorLayer layer(*opened.dataset, source, "file " + quoted(source.path), {});
        return holds_lines(layer.layer());
    }
    std::size_t spatial = 0;
    bool are_lines = true;
    for (OGRLayer* const layer : opened.dataset->GetLayers()) {
        const bool is_spatial = layer->GetGeomType() != wkbNone;
        spatial += is_spatial ? 1U : 0U;
        are_lines = are_lines && (!is_spatial || holds_lines(*layer));
    }
    return spatial > 0 && are_lines;
}

bool has_polygons(const Source& source) {
    const GdalMessages messages;
    const OpenedSource opened = open_source(source);
    const VectorLayer layer(*opened.dataset, source, "file " + quoted(source.path), wanted_lines());
    return holds_polygons(layer.layer());
}

}  // namespace tinwright::io
