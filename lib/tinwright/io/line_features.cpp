#include "tinwright/io/line_features.hpp"

#include <cmath>
#include <memory>

#include <cpl_port.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/vector_layer.hpp"

namespace tinwright::io {

void RawLines::resize(std::size_t size) {
    lines.resize(size);
    parts.resize(size);
    ordinals.resize(size);
}

void RawLines::add_bad(const LinePlan& plan, std::int64_t feature, const std::string& why) {
    if (plan.keeps_faults) {
        faults.push_back({0, {}, feature, why});
    } else {
        bad.add(plan.where + ", feature " + std::to_string(feature) + ": " + why);
    }
}

/// Closed lines of one feature are rings of one polygon.
std::uint32_t FeatureLines::polygon_of_lines() {
    if (!is_polygon_role(plan_.role)) {
        return 0;
    }
    if (!polygon_of_lines_) {
        polygon_of_lines_ = raw_.polygons++;
    }
    return *polygon_of_lines_;
}

/// Appends the points of a curve; `is_missing_z` is set where one without a finite z is kept.
std::string FeatureLines::append_points(const OGRSimpleCurve& curve, std::vector<Point3>& points,
                                        bool& is_missing_z) const {
    const bool has_z = curve.Is3D() != 0;
    const bool is_draped = !z_ && (plan_.is_draped || (!has_z && plan_.may_lack_z));
    for (int i = 0; i < curve.getNumPoints(); ++i) {
        Point3 point = {curve.getX(i), curve.getY(i), kDraped};
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
            return "has a coordinate that is not finite";
        }
        const double z = z_.value_or(has_z ? curve.getZ(i) : kDraped);
        if (!is_draped && std::isfinite(z)) {
            point.z = z;
        } else if (!is_draped && plan_.keeps_faults) {
            is_missing_z = true;
        } else if (!is_draped) {
            return has_z ? "has an elevation that is not finite at " + location_text({point.x, point.y}) +
                               plan_.advice
                         : "has no z" + plan_.advice;
        }
        points.push_back(point);
    }
    return {};
}

std::string FeatureLines::add_line(const OGRSimpleCurve& curve, bool is_ring, std::uint32_t polygon) {
    if (curve.getNumPoints() < 2 && !plan_.keeps_faults) {
        return "has a line of one point";
    }
    Breakline line;
    line.role = plan_.role;
    line.is_sharp = is_sharp_;
    line.polygon = polygon;
    line.points.reserve(static_cast<std::size_t>(curve.getNumPoints()) + 1);
    bool is_missing_z = false;
    std::string error = append_points(curve, line.points, is_missing_z);
    if (!error.empty()) {
        return error;
    }
    const Point3 first = line.points.front();
    const Point3 last = line.points.back();
    if (is_ring && !plan_.keeps_faults && (last.x != first.x || last.y != first.y)) {
        line.points.push_back(first);
    }
    raw_.lines.push_back(std::move(line));
    raw_.parts.push_back({id_, part_++, is_ring, is_missing_z});
    raw_.ordinals.push_back(raw_.count);
    return {};
}

std::string FeatureLines::collect(const OGRGeometry& geometry) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (geometry.IsEmpty() != 0) {
        return "has an empty geometry";
    }
    const auto collect_all = [&](const auto& parts) {
        for (const auto* const part : parts) {
            std::string error = collect(*part);
            if (!error.empty()) {
                return error;
            }
        }
        return std::string();
    };
    if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
        return collect_all(*geometry.toGeometryCollection());
    }
    if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
        return collect_all(*geometry.toPolyhedralSurface());
    }
    if (type == wkbLineString) {
        return add_line(*geometry.toLineString(), false, polygon_of_lines());
    }
    if (type == wkbPolygon || type == wkbTriangle) {
        const std::uint32_t polygon = raw_.polygons++;
        for (const OGRLinearRing* const ring : *geometry.toPolygon()) {
            std::string error = ring->IsEmpty() != 0 ? "has an empty ring" : add_line(*ring, true, polygon);
            if (!error.empty()) {
                return error;
            }
        }
        return {};
    }
    return std::string("is a ") + OGRToOGCGeomType(type) + ", neither line nor polygon";
}

std::string FeatureLines::read_attributes(const OGRFeature& feature) {
    z_ = plan_.z_constant;
    is_sharp_ = plan_.is_sharp;
    if (plan_.z_field >= 0) {
        double value = 0;
        std::string error = field_number(feature, plan_.z_field, value);
        if (error.empty()) {
            z_ = value;
        } else if (!plan_.keeps_faults) {
            return error;
        } else {
            z_ = kDraped;
        }
    }
    if (plan_.across_field >= 0) {
        const std::string word = feature.GetFieldAsString(plan_.across_field);
        is_sharp_ = EQUAL(word.c_str(), "sharp");
        if (!is_sharp_ && !EQUAL(word.c_str(), "smooth")) {
            const char* const name = feature.GetDefnRef()->GetFieldDefn(plan_.across_field)->GetNameRef();
            return "field " + quoted(name) + " is neither sharp nor smooth: " + quoted(word);
        }
    }
    return {};
}

void FeatureLines::add(const OGRFeature& feature) {
    id_ = feature.GetFID();
    polygon_of_lines_.reset();
    part_ = 0;
    const std::size_t before = raw_.lines.size();
    const std::uint32_t polygons_before = raw_.polygons;
    std::string error = read_attributes(feature);
    const OGRGeometry* const geometry = feature.GetGeometryRef();
    if (error.empty() && geometry == nullptr) {
        error = "has no geometry";
    } else if (error.empty() && geometry->hasCurveGeometry() != 0) {
        const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
        error = linear ? collect(*linear) : "has a curve that cannot be made straight";
    } else if (error.empty()) {
        error = collect(*geometry);
    }
    if (!error.empty()) {
        raw_.resize(before);
        raw_.polygons = polygons_before;
        raw_.add_bad(plan_, id_, error);
    }
    ++raw_.count;
}

}  // namespace tinwright::io
