#include "tinwright/io/vector_features.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ogrsf_frmts.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/vector_layer.hpp"

namespace tinwright::io {
namespace {

std::string type_name(const OGRGeometry& geometry) {
    return OGRToOGCGeomType(wkbFlatten(geometry.getGeometryType()));
}

bool is_curve_or_surface(OGRwkbGeometryType type) {
    return OGR_GT_IsSubClassOf(type, wkbCurve) != 0 || OGR_GT_IsSubClassOf(type, wkbSurface) != 0;
}

}  // namespace

std::string FeatureSamples::collect_point(double x, double y, bool has_z, double own_z,
                                          std::optional<double> z) {
    if (!z && !has_z) {
        return "has no z; give z=FIELD or z=NUMBER" +
               (plan_.numeric_fields.empty() ? "" : " (numeric fields: " + plan_.numeric_fields + ")");
    }
    const Point3 sample = {x, y, z.value_or(own_z)};
    if (!std::isfinite(sample.x) || !std::isfinite(sample.y) || !std::isfinite(sample.z)) {
        return "has a coordinate that is not finite";
    }
    points_.push_back(sample);
    return {};
}

/// Vertices of a line or ring; a last vertex that repeats the first is the same sample.
template <typename Curve>
std::string FeatureSamples::collect_curve(const Curve& curve, std::optional<double> z) {
    int count = curve.getNumPoints();
    const bool has_z = curve.Is3D() != 0;
    if (count > 1 && curve.getX(0) == curve.getX(count - 1) && curve.getY(0) == curve.getY(count - 1) &&
        (!has_z || z || curve.getZ(0) == curve.getZ(count - 1))) {
        --count;
    }
    for (int i = 0; i < count; ++i) {
        std::string error = collect_point(curve.getX(i), curve.getY(i), has_z, has_z ? curve.getZ(i) : 0, z);
        if (!error.empty()) {
            return error;
        }
    }
    return {};
}

std::string FeatureSamples::collect(const OGRGeometry& geometry, std::optional<double> z) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (geometry.IsEmpty() != 0) {
        return "has an empty geometry";
    }
    if (type == wkbPoint) {
        const OGRPoint& point = *geometry.toPoint();
        return collect_point(point.getX(), point.getY(), point.Is3D() != 0, point.getZ(), z);
    }
    const auto collect_all = [&](const auto& parts) {
        for (const auto* const part : parts) {
            std::string error = collect(*part, z);
            if (!error.empty()) {
                return error;
            }
        }
        return std::string();
    };
    if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
        return collect_all(*geometry.toGeometryCollection());
    }
    if (!plan_.vertices) {
        return "is a " + type_name(geometry) + ", no point; vertices=yes takes its vertices";
    }
    if (type == wkbLineString) {
        return collect_curve(*geometry.toLineString(), z);
    }
    if (type == wkbPolygon || type == wkbTriangle) {
        return collect_all(*geometry.toPolygon());
    }
    if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
        return collect_all(*geometry.toPolyhedralSurface());
    }
    return "is a " + type_name(geometry) + ", which has no vertices to take";
}

void FeatureSamples::add(const OGRGeometry* geometry, std::optional<double> z, std::int64_t id) {
    if (geometry == nullptr) {
        add_bad(id, "has no geometry");
        return;
    }
    const std::size_t before = points_.size();
    std::string error;
    if (geometry->hasCurveGeometry() != 0 &&
        (plan_.vertices || !is_curve_or_surface(geometry->getGeometryType()))) {
        const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
        error = linear ? collect(*linear, z) : "has a curve that cannot be made straight";
    } else {
        error = collect(*geometry, z);
    }
    if (!error.empty()) {
        points_.resize(before);
        add_bad(id, error);
        return;
    }
    for (std::size_t i = before; i < points_.size(); ++i) {
        slice_.ids.add(id);
    }
}

void FeatureSamples::add(const OGRFeature& feature) {
    const std::int64_t id = feature.GetFID();
    std::optional<double> z = plan_.z_constant;
    if (plan_.z_field >= 0) {
        double value = 0;
        const std::string error = field_number(feature, plan_.z_field, value);
        if (!error.empty()) {
            add_bad(id, error);
            return;
        }
        z = value;
    }
    if (plan_.x_field < 0) {
        add(feature.GetGeometryRef(), z, id);
        return;
    }
    Point3 sample;
    std::string error = field_number(feature, plan_.x_field, sample.x);
    if (error.empty()) {
        error = field_number(feature, plan_.y_field, sample.y);
    }
    if (error.empty() && !z) {
        const OGRGeometry* const geometry = feature.GetGeometryRef();
        const bool is_point = geometry != nullptr && wkbFlatten(geometry->getGeometryType()) == wkbPoint;
        if (is_point && geometry->Is3D() != 0 && geometry->IsEmpty() == 0) {
            z = geometry->toPoint()->getZ();
        }
    }
    const std::size_t before = points_.size();
    if (error.empty()) {
        error = collect_point(sample.x, sample.y, false, 0, z);
    }
    if (!error.empty()) {
        points_.resize(before);
        add_bad(id, error);
        return;
    }
    slice_.ids.add(id);
}

void FeatureSamples::add_bad(std::int64_t id, const std::string& why) {
    slice_.bad.add(plan_.where + ", feature " + std::to_string(id) + ": " + why);
}

void read_features(const VectorPlan& plan, const SliceRequest& request, std::vector<Point3>& points,
                   RawSlice& slice) {
    const GdalMessages messages;
    OGRLayer& layer = *plan.layer;
    const bool is_counted = layer.TestCapability(OLCFastFeatureCount) != 0;
    const double total = is_counted ? std::max(1.0, static_cast<double>(layer.GetFeatureCount())) : 0.0;
    FeatureSamples samples(plan, points, slice);
    constexpr int kFeaturesBetweenReports = 16384;
    double done = 0;
    int until_report = kFeaturesBetweenReports;
    layer.ResetReading();
    while (const std::unique_ptr<OGRFeature> feature{layer.GetNextFeature()}) {
        samples.add(*feature);
        done += 1;
        if (--until_report == 0) {
            until_report = kFeaturesBetweenReports;
            report_progress(request.progress, total > 0 ? std::min(1.0, done / total) : done / (done + 1e6));
        }
    }
    if (!messages.last_error().empty()) {
        if (done == 0 && request.source.where) {  // some drivers look at the filter only now
            throw InputError(plan.where + ": where=" + quoted(*request.source.where) + " cannot be used" +
                             messages.suffix());
        }
        throw IoError("cannot read " + plan.where + messages.suffix());
    }
}

}  // namespace tinwright::io
