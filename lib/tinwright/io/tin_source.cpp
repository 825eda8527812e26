#include "tinwright/io/tin_source.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <cpl_json.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/tin_triangles.hpp"

namespace tinwright::io {
namespace {

constexpr const char* kMark = "TINWRIGHT_VERSION";
constexpr std::string_view kPrefix = "TINWRIGHT_";

void append_items(CSLConstList items, TinMetadata& metadata) {
    for (int i = 0; items != nullptr && items[i] != nullptr; ++i) {
        const std::string_view item = items[i];
        const std::size_t equals = item.find('=');
        if (item.starts_with(kPrefix) && equals != std::string_view::npos) {
            metadata.emplace_back(item.substr(0, equals), item.substr(equals + 1));
        }
    }
}

void append_json(const std::string& text, TinMetadata& metadata) {
    CPLJSONDocument document;
    if (!text.starts_with('{') || !document.LoadMemory(text)) {
        return;
    }
    for (const CPLJSONObject& member : document.GetRoot().GetChildren()) {
        if (member.GetName().starts_with(kPrefix)) {
            metadata.emplace_back(member.GetName(), member.ToString());
        }
    }
}

// The member `tinwright` that stands at the head of our GeoJSON files. GDAL's reader gives it only together
// with a copy of every feature.
std::string read_geojson_member(const std::string& path) {
    constexpr std::size_t kHeadSize = 1U << 16U;
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    if (file == nullptr) {
        return {};
    }
    std::string head(kHeadSize, '\0');
    head.resize(VSIFReadL(head.data(), 1, head.size(), file));
    VSIFCloseL(file);
    const std::size_t member = head.find("\"tinwright\":");
    const std::size_t start = member == std::string::npos ? member : head.find('{', member);
    if (start == std::string::npos) {
        return {};
    }
    bool is_text = false;
    for (std::size_t i = start; i < head.size(); ++i) {
        if (head[i] == '\\') {
            ++i;
        } else if (head[i] == '"') {
            is_text = !is_text;
        } else if (head[i] == '}' && !is_text) {
            return head.substr(start, i + 1 - start);  // values are texts: no object within
        }
    }
    return {};
}

bool may_hold_faces(OGRwkbGeometryType type) {
    switch (wkbFlatten(type)) {
        case wkbUnknown:
        case wkbPolygon:
        case wkbTriangle:
        case wkbMultiPolygon:
        case wkbTIN:
        case wkbPolyhedralSurface:
        case wkbGeometryCollection:
            return true;
        default:
            return false;
    }
}

bool holds_triangles_only(OGRLayer& layer) {
    constexpr int kLookedAt = 1000;
    if (!may_hold_faces(layer.GetGeomType())) {
        return false;
    }
    if (wkbFlatten(layer.GetGeomType()) == wkbTIN) {
        return true;
    }
    std::vector<Triangle> triangles;
    int count = 0;
    bool are_triangles = true;
    layer.ResetReading();
    while (are_triangles && count < kLookedAt) {
        const OGRFeatureUniquePtr feature(layer.GetNextFeature());
        if (!feature) {
            break;
        }
        ++count;
        triangles.clear();
        are_triangles = !append_triangles(feature->GetGeometryRef(), triangles);
    }
    layer.ResetReading();
    return are_triangles && count > 0;
}

}  // namespace

TinSource::TinSource(const Source& source) : source_(source) {
    register_drivers();
    CPLStringList options;
    for (const std::string& option : source.open_options) {
        options.AddString(option.c_str());
    }
    const char* const path = source.path.c_str();
    dataset_ = GDALDataset::Open(path, GDAL_OF_VECTOR, nullptr, options.List());
    VSIStatBufL status;
    if (dataset_ == nullptr && VSIStatL(path, &status) != 0) {
        const std::string suffix = messages_.suffix();
        const GDALDatasetUniquePtr raster(GDALDataset::Open(path, GDAL_OF_RASTER, nullptr, options.List()));
        if (!raster) {
            throw IoError("cannot open " + io::quoted(source.path) +
                          (suffix.empty() ? std::string(": no such file") : suffix));
        }
    }
}

TinSource::~TinSource() {
    if (result_set_ != nullptr) {
        dataset_->ReleaseResultSet(result_set_);
    }
    if (dataset_ != nullptr) {
        GDALClose(dataset_);
    }
}

std::string TinSource::layer_names() const {
    std::string names;
    for (OGRLayer* const layer : dataset_->GetLayers()) {
        names += (names.empty() ? "" : ", ") + io::quoted(layer->GetName());
    }
    return names.empty() ? "none" : names;
}

bool TinSource::has_our_metadata(OGRLayer& layer) {
    if (layer.GetMetadataItem(kMark) != nullptr) {
        return true;
    }
    const TinMetadata all = metadata(layer);
    return std::any_of(all.begin(), all.end(), [](const auto& item) { return item.first == kMark; });
}

OGRLayer* TinSource::choose_layer() {
    if (source_.sql) {
        result_set_ = dataset_->ExecuteSQL(source_.sql->c_str(), nullptr, nullptr);
        if (result_set_ == nullptr) {
            throw UsageError(io::quoted(source_.path) + ": sql " + io::quoted(*source_.sql) +
                             " gives no layer" + suffix());
        }
        return holds_triangles_only(*result_set_) ? result_set_ : nullptr;
    }
    if (source_.layer) {
        OGRLayer* const layer = dataset_->GetLayerByName(source_.layer->c_str());
        if (layer == nullptr) {
            throw IoError(io::quoted(source_.path) + " has no layer " + io::quoted(*source_.layer) +
                          "; it has " + layer_names());
        }
        return holds_triangles_only(*layer) ? layer : nullptr;
    }
    OGRLayer* const ours = dataset_->GetLayerByName("faces");
    if (ours != nullptr && may_hold_faces(ours->GetGeomType()) && has_our_metadata(*ours)) {
        return ours;
    }
    std::vector<OGRLayer*> spatial;
    for (OGRLayer* const layer : dataset_->GetLayers()) {
        if (layer->GetGeomType() != wkbNone) {
            spatial.push_back(layer);
        }
    }
    // Several layers: they are read as a TIN when it is plain which one, or when the user says it is one.
    std::vector<OGRLayer*> candidates;
    const bool is_asked = source_.as == Source::Kind::Tin;
    for (OGRLayer* const layer : spatial) {
        const bool may_be = spatial.size() == 1 || is_asked || layer == ours || has_our_metadata(*layer);
        if (may_be && holds_triangles_only(*layer)) {
            candidates.push_back(layer);
        }
    }
    if (std::find(candidates.begin(), candidates.end(), ours) != candidates.end()) {
        return ours;
    }
    if (candidates.size() > 1) {
        throw IoError(io::quoted(source_.path) +
                      " has several layers of triangles; choose with layer=: " + layer_names());
    }
    return candidates.empty() ? nullptr : candidates.front();
}

OGRLayer* TinSource::find_faces() {
    OGRLayer* const layer = choose_layer();
    if (layer != nullptr && source_.where &&
        layer->SetAttributeFilter(source_.where->c_str()) != OGRERR_NONE) {
        refuse_filter(*layer);
    }
    return layer;
}

void TinSource::refuse_filter(OGRLayer& layer) const {
    if (source_.where) {
        throw UsageError(describe(layer) + ": where " + io::quoted(*source_.where) + " is not understood" +
                         suffix());
    }
}

OGRLayer* TinSource::find_companion(OGRLayer& faces, const char* name) {
    // A part of the faces, or somebody else's: layers of those names have nothing to do with it.
    if (source_.sql || source_.where || !(EQUAL(faces.GetName(), "faces") || has_our_metadata(faces))) {
        return nullptr;
    }
    return dataset_->GetLayerByName(name);
}

TinMetadata TinSource::metadata(OGRLayer& faces) {
    TinMetadata metadata;
    append_items(faces.GetMetadata(), metadata);
    if (!metadata.empty()) {
        return metadata;
    }
    append_items(dataset_->GetMetadata(), metadata);
    if (const char* const description = dataset_->GetMetadataItem("DESCRIPTION")) {
        append_json(description, metadata);
    }
    if (EQUAL(dataset_->GetDriverName(), "GeoJSON")) {
        append_json(read_geojson_member(source_.path), metadata);
    }
    OGRLayer* const table = dataset_->GetLayerByName("tinwright_metadata");
    if (table != nullptr && table->GetLayerDefn()->GetFieldIndex("key") >= 0) {
        for (const auto& row : *table) {
            metadata.emplace_back(row->GetFieldAsString("key"), row->GetFieldAsString("value"));
        }
    }
    return metadata;
}

Crs TinSource::crs(OGRLayer& faces, const TinMetadata& metadata) const {
    if (source_.crs) {
        return Crs::parse(*source_.crs);
    }
    for (const auto& [key, value] : metadata) {
        if (key == "TINWRIGHT_CRS") {
            return value == "none" ? Crs() : Crs::parse(value);
        }
    }
    return Crs::from_gdal(faces.GetSpatialRef());
}

std::string TinSource::describe(OGRLayer& layer) const {
    return io::quoted(source_.path) + ", layer " + io::quoted(layer.GetName());
}

}  // namespace tinwright::io
