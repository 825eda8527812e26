#include "tinwright/io/read_vector.hpp"

#include <string>

#include <ogrsf_frmts.h>

#include "tinwright/io/axis_order.hpp"
#include "tinwright/io/column_names.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/vector_arrow.hpp"
#include "tinwright/io/vector_features.hpp"
#include "tinwright/io/vector_layer.hpp"

namespace tinwright::io {
namespace {

bool may_have_samples(OGRLayer& layer, const Source& source) {
    if (source.x_field) {
        return find_column(field_names(layer, false), *source.x_field).has_value();
    }
    const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    return type != wkbNone && (source.vertices || type == wkbPoint || type == wkbMultiPoint ||
                               type == wkbUnknown || type == wkbGeometryCollection);
}

/// Chooses a layer of a dataset and what to take from it.
class LayerPlanner {
  public:
    LayerPlanner(GDALDataset& dataset, const SliceRequest& request)
        : source_(request.source),
          layer_(dataset, request.source, request.file,
                 {[&](OGRLayer& layer) { return may_have_samples(layer, request.source); },
                  "no layer has points", "several layers may have samples",
                  ", and vertices=yes to take the vertices of lines and polygons"}),
          file_(request.file) {}

    VectorPlan plan() {
        plan_.layer = &layer_.layer();
        plan_.where = layer_.where();
        plan_.vertices = source_.vertices;
        plan_.has_filter = source_.where.has_value();
        plan_.numeric_fields = layer_.numeric_fields();
        find_position();
        find_z();
        check_geometry_type();
        return plan_;
    }

    [[nodiscard]] bool is_lon_lat() const { return is_lon_lat_; }

  private:
    /// Positions are in the geometry, in the fields named, or, in a table, in fields with telling names.
    void find_position() {
        if (source_.x_field.has_value() != source_.y_field.has_value()) {
            throw UsageError(file_ + ": xfield= and yfield= go together");
        }
        const std::vector<std::string> names = layer_.field_names();
        if (source_.x_field) {
            plan_.x_field = layer_.field("xfield", *source_.x_field);
            plan_.y_field = layer_.field("yfield", *source_.y_field);
        } else if (plan_.layer->GetGeomType() == wkbNone) {
            const NamedColumns named = recognise_columns(names);
            if (!named.x || !named.y) {
                throw InputError(
                    plan_.where + ": a table without geometries; give xfield=, yfield= and z= " +
                    (names.empty() ? "(it has no fields)" : "(fields: " + quoted_list(names) + ")"));
            }
            plan_.x_field = static_cast<int>(*named.x);
            plan_.y_field = static_cast<int>(*named.y);
        }
        if (plan_.x_field >= 0) {
            is_lon_lat_ = recognise_columns({names[static_cast<std::size_t>(plan_.x_field)],
                                             names[static_cast<std::size_t>(plan_.y_field)]})
                              .is_lon_lat;
        }
    }

    void find_z() {
        if (source_.z) {
            const VectorLayer::Elevation z = layer_.elevation(*source_.z);
            plan_.z_field = z.field;
            plan_.z_constant = z.constant;
        } else if (plan_.layer->GetGeomType() == wkbNone) {
            const NamedColumns named = recognise_columns(layer_.field_names());
            plan_.z_field = named.z ? static_cast<int>(*named.z) : -1;
        }
    }

    /// Refuses layers whose declared type says that no feature can be a sample, skipped bad ones or not.
    void check_geometry_type() const {
        const OGRwkbGeometryType declared = plan_.layer->GetGeomType();
        const OGRwkbGeometryType type = wkbFlatten(declared);
        if (plan_.x_field >= 0) {
            if (plan_.z_field < 0 && !plan_.z_constant && type == wkbNone) {
                throw_no_z("the rows have");
            }
            return;
        }
        const bool is_line_or_area =
            OGR_GT_IsSubClassOf(type, wkbCurve) != 0 || OGR_GT_IsSubClassOf(type, wkbSurface) != 0 ||
            OGR_GT_IsSubClassOf(type, wkbMultiCurve) != 0 || OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
        if (is_line_or_area && !plan_.vertices) {
            throw InputError(plan_.where + ": has " + OGRGeometryTypeToName(type) +
                             " features, no points; vertices=yes takes their vertices");
        }
        if (type != wkbUnknown && OGR_GT_HasZ(declared) == 0 && plan_.z_field < 0 && !plan_.z_constant) {
            throw_no_z("the geometries have");
        }
    }

    [[noreturn]] void throw_no_z(const std::string& subject) const {
        throw InputError(
            plan_.where + ": " + subject + " no z; give z=FIELD or z=NUMBER" +
            (plan_.numeric_fields.empty() ? "" : " (numeric fields: " + plan_.numeric_fields + ")"));
    }

    const Source& source_;
    VectorLayer layer_;
    std::string file_;
    VectorPlan plan_;
    bool is_lon_lat_ = false;
};

}  // namespace

RawSlice read_vector(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points) {
    LayerPlanner planner(dataset, request);
    const VectorPlan plan = planner.plan();
    RawSlice slice(SampleSlice::Kind::Vector, request.options.skip_bad);
    slice.layer = plan.layer->GetName();
    slice.is_lon_lat = planner.is_lon_lat();
    slice.crs = Crs::from_gdal(plan.layer->GetSpatialRef());
    slice.is_north_first = is_north_first(plan.layer->GetSpatialRef()) && plan.x_field < 0;
    if (!read_arrow(plan, request, points, slice)) {
        if (!plan.has_filter) {
            ignore_other_fields(*plan.layer, {plan.x_field, plan.y_field, plan.z_field});
        }
        read_features(plan, request, points, slice);
    }
    return slice;
}

}  // namespace tinwright::io
