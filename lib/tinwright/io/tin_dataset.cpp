#include "tinwright/io/tin_dataset.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <memory>
#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"

namespace tinwright::io {
namespace {

// GeoPackage stamps its tables with the time of writing unless told one.
constexpr const char* kDateOption = "OGR_CURRENT_DATE";
constexpr const char* kPinnedDate = "2000-01-01T00:00:00.000Z";

CPLStringList as_list(const std::vector<std::string>& options) {
    CPLStringList list;
    for (const std::string& option : options) {
        list.AddString(option.c_str());
    }
    return list;
}

void append_number(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(digits.data(), end.ptr);
}

void append_point(std::string& text, double x, double y, double z) {
    append_number(text, x);
    text += ' ';
    append_number(text, y);
    text += ' ';
    append_number(text, z);
}

void append_curve(std::string& text, const OGRSimpleCurve& curve) {
    text += '(';
    for (int i = 0; i < curve.getNumPoints(); ++i) {
        text += i == 0 ? "" : ",";
        if (curve.Is3D() != 0) {
            append_point(text, curve.getX(i), curve.getY(i), curve.getZ(i));
        } else {
            append_number(text, curve.getX(i));
            text += ' ';
            append_number(text, curve.getY(i));
        }
    }
    text += ')';
}

void append_polygons(std::string& text, const OGRMultiPolygon& polygons) {
    const char* before_polygon = "(";
    for (const OGRPolygon* const polygon : polygons) {
        text += before_polygon;
        const char* before_ring = "(";
        for (const OGRLinearRing* const ring : *polygon) {
            text += before_ring;
            append_curve(text, *ring);
            before_ring = ",";
        }
        text += ')';
        before_polygon = ",";
    }
    text += ')';
}

// GDAL's own WKT stops at 15 digits; this one reads back as the same numbers.
std::string exact_wkt(const OGRGeometry& geometry) {
    std::string text;
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPoint: {
            const OGRPoint& point = *geometry.toPoint();
            text = "POINT Z (";
            append_point(text, point.getX(), point.getY(), point.getZ());
            return text + ")";
        }
        case wkbLineString:
            text = "LINESTRING Z ";
            append_curve(text, *geometry.toLineString());
            return text;
        case wkbPolygon:
            text = "POLYGON Z (";
            append_curve(text, *geometry.toPolygon()->getExteriorRing());
            return text + ")";
        case wkbMultiPolygon:
            text = "MULTIPOLYGON ";
            append_polygons(text, *geometry.toMultiPolygon());
            return text;
        default: {
            text = "TIN Z (";
            const OGRTriangulatedSurface& surface = *geometry.toTriangulatedSurface();
            for (int i = 0; i < surface.getNumGeometries(); ++i) {
                text += i == 0 ? "(" : ",(";
                append_curve(text, *surface.getGeometryRef(i)->toPolygon()->getExteriorRing());
                text += ')';
            }
            return text + ")";
        }
    }
}

}  // namespace

TinLayer::TinLayer(TinDataset& dataset, OGRLayer& layer, std::span<const TinField> fields, int wkt_field)
    : dataset_(dataset), layer_(layer), feature_(layer.GetLayerDefn()), wkt_field_(wkt_field) {
    for (const TinField& field : fields) {
        fields_.push_back(layer.GetLayerDefn()->GetFieldIndex(field.name));
    }
}

void TinLayer::set(std::size_t i, int value) {
    if (fields_[i] >= 0) {
        feature_.SetField(fields_[i], value);
    }
}

void TinLayer::set(std::size_t i, std::int64_t value) {
    if (fields_[i] >= 0) {
        feature_.SetField(fields_[i], static_cast<GIntBig>(value));
    }
}

void TinLayer::set(std::size_t i, double value) {
    if (fields_[i] >= 0) {
        feature_.SetField(fields_[i], value);
    }
}

void TinLayer::set(std::size_t i, const std::string& value) {
    if (fields_[i] >= 0) {
        feature_.SetField(fields_[i], value.c_str());
    }
}

void TinLayer::set_null(std::size_t i) {
    if (fields_[i] >= 0) {
        feature_.SetFieldNull(fields_[i]);
    }
}

void TinLayer::write() {
    feature_.SetFID(OGRNullFID);
    if (geometry_ && wkt_field_ >= 0) {
        feature_.SetField(wkt_field_, exact_wkt(*geometry_).c_str());
    } else if (geometry_) {
        // Lent, not given: a feature frees its geometry, and making one for each face is what costs.
        feature_.SetGeometryDirectly(geometry_.release());
    }
    const OGRErr error = layer_.CreateFeature(&feature_);
    if (wkt_field_ < 0) {
        geometry_.reset(feature_.StealGeometry());
    }
    if (error != OGRERR_NONE) {
        dataset_.fail("layer " + quoted(layer_.GetName()) + ", feature " + std::to_string(written_));
    }
    ++written_;
}

TinDataset::TinDataset(const TinDriver& driver, std::string path, std::string target, const Crs& crs,
                       const WriteTinOptions& options, const TinMetadata& counts)
    : driver_(driver),
      path_(std::move(path)),
      target_(std::move(target)),
      crs_(crs),
      metadata_(options.metadata),
      options_(options) {
    metadata_.insert(metadata_.end(), counts.begin(), counts.end());
    if (const char* const date = CPLGetThreadLocalConfigOption(kDateOption, nullptr)) {
        former_date_ = date;
    }
    CPLSetThreadLocalConfigOption(kDateOption, kPinnedDate);
    CPLErrorReset();
    dataset_ = driver.gdal->Create(path_.c_str(), 0, 0, 0, GDT_Unknown,
                                   as_list(dataset_options(driver, metadata_, options)).List());
    if (dataset_ == nullptr) {
        CPLSetThreadLocalConfigOption(kDateOption, former_date_ ? former_date_->c_str() : nullptr);
        fail("driver " + driver.name);
    }
    in_transaction_ =
        dataset_->TestCapability(ODsCTransactions) != 0 && dataset_->StartTransaction() == OGRERR_NONE;
}

TinDataset::~TinDataset() {
    if (dataset_ != nullptr) {
        if (in_transaction_) {
            dataset_->RollbackTransaction();
        }
        GDALClose(dataset_);
    }
    CPLSetThreadLocalConfigOption(kDateOption, former_date_ ? former_date_->c_str() : nullptr);
}

TinLayer TinDataset::add_layer(const std::string& name, OGRwkbGeometryType type,
                               std::span<const TinField> fields, const Tin& tin) {
    const bool own_wkt = type != wkbNone && writes_own_wkt(driver_, options_);
    const OGRSpatialReference* system = crs_.gdal();
    if (system == nullptr && driver_.name == "GPKG") {
        system = &undefined_cartesian_system();
    }
    CPLStringList list = as_list(layer_options(driver_, name, tin, crs_, metadata_, options_));
    // The driver keeps a reference; it does not change the system, but its signature may.
    OGRLayer* const layer =
        dataset_->CreateLayer(name.c_str(), own_wkt ? nullptr : const_cast<OGRSpatialReference*>(system),
                              own_wkt ? wkbNone : type, list.List());
    if (layer == nullptr) {
        fail("layer " + quoted(name));
    }
    if (driver_.metadata == MetadataPlace::Layer) {
        for (const auto& [key, value] : metadata_) {
            layer->SetMetadataItem(key.c_str(), value.c_str());
        }
    }
    if (own_wkt) {
        const OGRFieldDefn definition("WKT", OFTString);
        static_cast<void>(layer->CreateField(const_cast<OGRFieldDefn*>(&definition)));
    }
    for (const TinField& field : fields) {
        OGRFieldDefn definition(field.name, field.type);
        static_cast<void>(layer->CreateField(&definition));
    }
    return {*this, *layer, fields, own_wkt ? layer->GetLayerDefn()->GetFieldIndex("WKT") : -1};
}

void TinDataset::add_metadata_table() {
    if (driver_.metadata != MetadataPlace::Table || metadata_.empty()) {
        return;
    }
    constexpr std::array<TinField, 2> kFields = {{{"key", OFTString}, {"value", OFTString}}};
    TinLayer table = add_layer("tinwright_metadata", wkbNone, kFields, Tin{});
    for (const auto& [key, value] : metadata_) {
        table.set(0, key);
        table.set(1, value);
        table.write();
    }
}

void TinDataset::write_side_car_crs() const {
    char* text = nullptr;
    if (crs_.gdal()->exportToWkt(&text) != OGRERR_NONE) {
        CPLFree(text);
        return;
    }
    const std::string wkt = text;
    CPLFree(text);
    VSILFILE* const file = VSIFOpenL(CPLResetExtension(path_.c_str(), "prj"), "wb");
    const bool is_written = file != nullptr && VSIFWriteL(wkt.data(), 1, wkt.size(), file) == wkt.size();
    if ((file != nullptr && VSIFCloseL(file) != 0) || !is_written) {
        fail("its .prj file");
    }
}

void TinDataset::close() {
    // Shapefile and FlatGeobuf drivers report some failures at closing only, and only as messages.
    CPLErrorReset();
    bool is_good = !in_transaction_ || dataset_->CommitTransaction() == OGRERR_NONE;
    in_transaction_ = false;
    dataset_->FlushCache(true);
    GDALClose(dataset_);
    dataset_ = nullptr;
    is_good = is_good && CPLGetLastErrorType() < CE_Failure;
    if (!is_good) {
        fail("closing it");
    }
    require_whole_file();
    if (crs_.is_known() && writes_own_wkt(driver_, options_)) {
        write_side_car_crs();
    }
}

// GDAL 3.6 does not look whether its text drivers' writes succeed: a full disk leaves a file that just ends.
void TinDataset::require_whole_file() const {
    const char* const end = driver_.last_words;
    if (end == nullptr) {
        return;
    }
    VSILFILE* const file = VSIFOpenL(path_.c_str(), "rb");
    std::string tail(64, '\0');
    if (file != nullptr) {
        VSIFSeekL(file, 0, SEEK_END);
        const vsi_l_offset size = VSIFTellL(file);
        VSIFSeekL(file, size - std::min<vsi_l_offset>(size, tail.size()), SEEK_SET);
        tail.resize(VSIFReadL(tail.data(), 1, tail.size(), file));
        VSIFCloseL(file);
    } else {
        tail.clear();
    }
    std::erase_if(tail, [](unsigned char c) { return std::isspace(c) != 0; });
    if (!tail.ends_with(end)) {
        fail("its end is missing");
    }
}

void TinDataset::fail(const std::string& what) const {
    const std::string suffix = messages_.suffix();
    throw IoError("cannot write " + quoted(target_) + ", " + what +
                  (suffix.empty() ? "; is the disk full?" : suffix));
}

}  // namespace tinwright::io
