#include "tinwright/io/read_vector.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <ogrsf_frmts.h>

#include "tinwright/io/column_names.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_number.hpp"
#include "tinwright/io/vector_arrow.hpp"
#include "tinwright/io/vector_features.hpp"

namespace tinwright::io {
namespace {

std::vector<std::string> field_names(OGRLayer& layer, bool only_numeric) {
    std::vector<std::string> names;
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        const OGRFieldType type = definition.GetFieldDefn(i)->GetType();
        if (!only_numeric || type == OFTReal || type == OFTInteger || type == OFTInteger64) {
            names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
        }
    }
    return names;
}

/// Chooses a layer of a dataset and what to take from it.
class LayerPlanner {
  public:
    LayerPlanner(GDALDataset& dataset, const SliceRequest& request)
        : dataset_(dataset), request_(request), source_(request.source) {}
    LayerPlanner(const LayerPlanner&) = delete;
    LayerPlanner& operator=(const LayerPlanner&) = delete;
    ~LayerPlanner() {
        if (result_ != nullptr) {
            dataset_.ReleaseResultSet(result_);
        }
    }

    VectorPlan plan() {
        plan_.layer = source_.sql ? run_sql() : find_layer();
        plan_.where = request_.file + ", layer " + quoted(plan_.layer->GetName());
        plan_.vertices = source_.vertices;
        plan_.has_filter = source_.where.has_value();
        plan_.numeric_fields = quoted_list(field_names(*plan_.layer, true));
        if (source_.where && plan_.layer->SetAttributeFilter(source_.where->c_str()) != OGRERR_NONE) {
            throw InputError(plan_.where + ": where=" + quoted(*source_.where) + " cannot be used" +
                             messages_.suffix());
        }
        find_position();
        find_z();
        check_geometry_type();
        return plan_;
    }

    [[nodiscard]] bool is_lon_lat() const { return is_lon_lat_; }

  private:
    OGRLayer* run_sql() {
        result_ = dataset_.ExecuteSQL(source_.sql->c_str(), nullptr, nullptr);
        if (result_ == nullptr) {
            throw InputError(request_.file + ": sql=" + quoted(*source_.sql) + " gives no table" +
                             messages_.suffix());
        }
        return result_;
    }

    [[nodiscard]] static std::vector<std::string> layer_names(const std::vector<OGRLayer*>& layers) {
        std::vector<std::string> names;
        names.reserve(layers.size());
        for (OGRLayer* const layer : layers) {
            names.emplace_back(layer->GetName());
        }
        return names;
    }

    [[nodiscard]] bool may_have_samples(OGRLayer& layer) const {
        if (source_.x_field) {
            return find_column(field_names(layer, false), *source_.x_field).has_value();
        }
        const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
        return type != wkbNone && (source_.vertices || type == wkbPoint || type == wkbMultiPoint ||
                                   type == wkbUnknown || type == wkbGeometryCollection);
    }

    OGRLayer* find_layer() {
        const auto layers = dataset_.GetLayers();
        const std::vector<OGRLayer*> all(layers.begin(), layers.end());
        if (source_.layer) {
            OGRLayer* const named = dataset_.GetLayerByName(source_.layer->c_str());
            if (named == nullptr) {
                throw InputError(request_.file + ": no layer " + quoted(*source_.layer) +
                                 "; the layers are " + quoted_list(layer_names(all)));
            }
            return named;
        }
        if (all.empty()) {
            throw InputError(request_.file + ": has no layers");
        }
        if (all.size() == 1) {
            return all.front();
        }
        std::vector<OGRLayer*> candidates;
        std::copy_if(all.begin(), all.end(), std::back_inserter(candidates),
                     [&](OGRLayer* layer) { return may_have_samples(*layer); });
        if (candidates.size() == 1) {
            return candidates.front();
        }
        if (candidates.empty()) {
            throw InputError(request_.file + ": no layer has points; choose one of " +
                             quoted_list(layer_names(all)) +
                             " with layer=, and vertices=yes to take the vertices of lines and polygons");
        }
        throw InputError(request_.file + ": several layers may have samples; choose one of " +
                         quoted_list(layer_names(candidates)) + " with layer=");
    }

    [[nodiscard]] int field(const char* key, const std::string& name) const {
        const std::vector<std::string> names = field_names(*plan_.layer, false);
        if (const auto found = find_column(names, name)) {
            return static_cast<int>(*found);
        }
        throw InputError(
            plan_.where + ": no field " + quoted(name) + " for " + key + "=; " +
            (names.empty() ? "the layer has no fields" : "the fields are " + quoted_list(names)));
    }

    /// Positions are in the geometry, in the fields named, or, in a table, in fields with telling names.
    void find_position() {
        if (source_.x_field.has_value() != source_.y_field.has_value()) {
            throw UsageError(request_.file + ": xfield= and yfield= go together");
        }
        const std::vector<std::string> names = field_names(*plan_.layer, false);
        if (source_.x_field) {
            plan_.x_field = field("xfield", *source_.x_field);
            plan_.y_field = field("yfield", *source_.y_field);
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
        const std::vector<std::string> names = field_names(*plan_.layer, false);
        if (!source_.z) {
            if (plan_.layer->GetGeomType() == wkbNone) {
                const NamedColumns named = recognise_columns(names);
                plan_.z_field = named.z ? static_cast<int>(*named.z) : -1;
            }
            return;
        }
        if (*source_.z == "geometry") {
            return;
        }
        const auto constant = parse_number(*source_.z);
        if (!find_column(names, *source_.z) && constant && std::isfinite(*constant)) {
            plan_.z_constant = constant;
            return;
        }
        plan_.z_field = field("z", *source_.z);
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

    GdalMessages messages_;
    GDALDataset& dataset_;
    const SliceRequest& request_;
    const Source& source_;
    OGRLayer* result_ = nullptr;
    VectorPlan plan_;
    bool is_lon_lat_ = false;
};

/// Features carry only what is read; a filter may need more.
void ignore_other_fields(const VectorPlan& plan) {
    OGRLayer& layer = *plan.layer;
    if (plan.has_filter || layer.TestCapability(OLCIgnoreFields) == 0) {
        return;
    }
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    CPLStringList ignored;
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        if (i != plan.x_field && i != plan.y_field && i != plan.z_field) {
            ignored.AddString(definition.GetFieldDefn(i)->GetNameRef());
        }
    }
    layer.SetIgnoredFields(const_cast<const char**>(ignored.List()));
}

}  // namespace

RawSlice read_vector(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points) {
    LayerPlanner planner(dataset, request);
    const VectorPlan plan = planner.plan();
    RawSlice slice(SampleSlice::Kind::Vector, request.options.skip_bad);
    slice.layer = plan.layer->GetName();
    slice.is_lon_lat = planner.is_lon_lat();
    slice.crs = Crs::from_gdal(plan.layer->GetSpatialRef());
    if (!read_arrow(plan, request, points, slice)) {
        ignore_other_fields(plan);
        read_features(plan, request, points, slice);
    }
    return slice;
}

}  // namespace tinwright::io
