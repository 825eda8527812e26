#include "tinwright/io/vector_layer.hpp"

#include <algorithm>
#include <cmath>

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/column_names.hpp"
#include "tinwright/io/read_number.hpp"

namespace tinwright::io {
namespace {

std::vector<std::string> layer_names(const std::vector<OGRLayer*>& layers) {
    std::vector<std::string> names;
    names.reserve(layers.size());
    for (OGRLayer* const layer : layers) {
        names.emplace_back(layer->GetName());
    }
    return names;
}

bool is_numeric(OGRFieldType type) { return type == OFTReal || type == OFTInteger || type == OFTInteger64; }

OGRLayer* find_layer(GDALDataset& dataset, const Source& source, const std::string& file,
                     const VectorLayer::Wanted& wanted) {
    const auto layers = dataset.GetLayers();
    const std::vector<OGRLayer*> all(layers.begin(), layers.end());
    if (source.layer) {
        OGRLayer* const named = dataset.GetLayerByName(source.layer->c_str());
        if (named == nullptr) {
            throw InputError(file + ": no layer " + quoted(*source.layer) + "; the layers are " +
                             quoted_list(layer_names(all)));
        }
        return named;
    }
    if (all.empty()) {
        throw InputError(file + ": has no layers");
    }
    if (all.size() == 1) {
        return all.front();
    }
    std::vector<OGRLayer*> candidates;
    std::copy_if(all.begin(), all.end(), std::back_inserter(candidates),
                 [&](OGRLayer* layer) { return wanted.may_be(*layer); });
    if (candidates.size() == 1) {
        return candidates.front();
    }
    if (candidates.empty()) {
        throw InputError(file + ": " + wanted.nothing + "; choose one of " + quoted_list(layer_names(all)) +
                         " with layer=" + wanted.hint);
    }
    throw InputError(file + ": " + wanted.several + "; choose one of " +
                     quoted_list(layer_names(candidates)) + " with layer=");
}

}  // namespace

VectorLayer::VectorLayer(GDALDataset& dataset, const Source& source, const std::string& file,
                         const Wanted& wanted)
    : dataset_(dataset), source_(source) {
    const GdalMessages messages;
    if (source.sql) {
        result_ = dataset.ExecuteSQL(source.sql->c_str(), nullptr, nullptr);
        if (result_ == nullptr) {
            throw InputError(file + ": sql=" + quoted(*source.sql) + " gives no table" + messages.suffix());
        }
        layer_ = result_;
    } else {
        layer_ = find_layer(dataset, source, file, wanted);
    }
    where_ = file + ", layer " + quoted(layer_->GetName());
    if (source.where && layer_->SetAttributeFilter(source.where->c_str()) != OGRERR_NONE) {
        const std::string suffix = messages.suffix();
        if (result_ != nullptr) {
            dataset_.ReleaseResultSet(result_);
        }
        throw InputError(where_ + ": where=" + quoted(*source.where) + " cannot be used" + suffix);
    }
}

VectorLayer::~VectorLayer() {
    if (result_ != nullptr) {
        dataset_.ReleaseResultSet(result_);
    }
}

std::vector<std::string> VectorLayer::field_names() const { return io::field_names(*layer_, false); }

std::string VectorLayer::numeric_fields() const { return quoted_list(io::field_names(*layer_, true)); }

int VectorLayer::field(const char* key, const std::string& name) const {
    const std::vector<std::string> names = field_names();
    if (const auto found = find_column(names, name)) {
        return static_cast<int>(*found);
    }
    throw InputError(where_ + ": no field " + quoted(name) + " for " + key + "=; " +
                     (names.empty() ? "the layer has no fields" : "the fields are " + quoted_list(names)));
}

VectorLayer::Elevation VectorLayer::elevation(const std::string& z) const {
    if (z == "geometry") {
        return {};
    }
    const auto constant = parse_number(z);
    if (!find_column(field_names(), z) && constant && std::isfinite(*constant)) {
        return {-1, constant};
    }
    return {field("z", z), std::nullopt};
}

void VectorLayer::require_no_error(const GdalMessages& messages, bool any_feature) const {
    if (messages.last_error().empty()) {
        return;
    }
    if (!any_feature && source_.where) {
        throw InputError(where_ + ": where=" + quoted(*source_.where) + " cannot be used" +
                         messages.suffix());
    }
    throw IoError("cannot read " + where_ + messages.suffix());
}

std::vector<std::string> field_names(OGRLayer& layer, bool only_numeric) {
    std::vector<std::string> names;
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        if (!only_numeric || is_numeric(definition.GetFieldDefn(i)->GetType())) {
            names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
        }
    }
    return names;
}

std::string field_number(const OGRFeature& feature, int field, double& value) {
    const OGRFieldDefn& definition = *feature.GetDefnRef()->GetFieldDefn(field);
    const std::string name = "field " + quoted(definition.GetNameRef());
    if (!feature.IsFieldSetAndNotNull(field)) {
        return name + " is empty";
    }
    if (is_numeric(definition.GetType())) {
        value = feature.GetFieldAsDouble(field);
    } else {
        const std::string text = feature.GetFieldAsString(field);
        const auto number = parse_number(text);
        if (!number) {
            return name + " is no number: " + quoted(text);
        }
        value = *number;
    }
    return std::isfinite(value) ? std::string() : name + " is not finite";
}

void ignore_other_fields(OGRLayer& layer, const std::vector<int>& used) {
    if (layer.TestCapability(OLCIgnoreFields) == 0) {
        return;
    }
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    CPLStringList ignored;
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        if (std::find(used.begin(), used.end(), i) == used.end()) {
            ignored.AddString(definition.GetFieldDefn(i)->GetNameRef());
        }
    }
    layer.SetIgnoredFields(const_cast<const char**>(ignored.List()));
}

}  // namespace tinwright::io
