#include "tinwright/io/feature_file.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

constexpr const char* kAlternatives = "use .gpkg, .shp, .fgb, .gml, .sqlite, .csv or .geojson";

bool is_given(const std::vector<std::string>& options, const std::string& key) {
    return std::any_of(options.begin(), options.end(), [&](const std::string& option) {
        return EQUALN(option.c_str(), (key + "=").c_str(), key.size() + 1);
    });
}

class PointCollector : public OGRDefaultConstGeometryVisitor {
  public:
    using OGRDefaultConstGeometryVisitor::visit;
    void visit(const OGRPoint* p) override { points.push_back({p->getX(), p->getY(), p->getZ()}); }
    std::vector<Point3> points;
};

KeptFeature read_probe(const std::string& path, const Crs& crs, const ProbeFeature& expected) {
    constexpr double kTolerance = 1e-3;
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    OGRLayer* const layer = dataset ? dataset->GetLayer(0) : nullptr;
    const OGRFeatureUniquePtr feature(layer == nullptr ? nullptr : layer->GetNextFeature());
    if (!feature || feature->GetGeometryRef() == nullptr) {
        return {};
    }
    PointCollector found;
    feature->GetGeometryRef()->accept(&found);
    KeptFeature kept;
    kept.positions = found.points.size() >= expected.points.size();
    kept.z = true;
    for (const Point3& p : found.points) {
        const auto same_place =
            std::find_if(expected.points.begin(), expected.points.end(), [&](const Point3& q) {
                return std::abs(p.x - q.x) < kTolerance && std::abs(p.y - q.y) < kTolerance;
            });
        const bool is_there = same_place != expected.points.end();
        kept.positions = kept.positions && is_there;
        kept.z = kept.z && is_there && std::abs(p.z - same_place->z) < kTolerance;
    }
    kept.fields = expected.has_fields(*feature);
    kept.crs = Crs::from_gdal(layer->GetSpatialRef()).is_same(crs);
    return kept;
}

std::string refusal_of(const TinDriver& driver) { return "driver " + quoted(driver.name) + " "; }

}  // namespace

WriteTinOptions feature_file_options(const TinDriver& driver,
                                     const std::vector<std::string>& creation_options,
                                     const std::vector<std::string>& layer_options,
                                     const TinMetadata& metadata) {
    WriteTinOptions result;
    result.driver = driver.name;
    result.creation_options = creation_options;
    result.layer_options = layer_options;
    result.metadata = metadata;
    // Crossings need all the digits there are, or rings would touch where they do not.
    if (driver.name == "GeoJSON" && !is_given(layer_options, "COORDINATE_PRECISION") &&
        !is_given(layer_options, "SIGNIFICANT_FIGURES")) {
        result.layer_options.emplace_back("SIGNIFICANT_FIGURES=17");
    }
    return result;
}

std::size_t write_features(const TinDriver& driver, const std::string& path, const std::string& target,
                           const Crs& crs, const WriteTinOptions& options, const FillFeatures& fill) {
    TinDataset dataset(driver, path, target, crs, options);
    const std::size_t features = fill(dataset);
    dataset.add_metadata_table();
    dataset.close();
    return features;
}

KeptFeature probe_features(const TinDriver& driver, const std::string& target, const Crs& crs,
                           const WriteTinOptions& options, const ProbeFeature& feature) {
    static std::atomic<int> count = 0;
    const std::string folder = "/vsimem/tinwright_feature_probe_" + std::to_string(++count);
    const std::string path = folder + "/" + CPLGetFilename(target.c_str());
    KeptFeature kept;
    const GdalMessages messages;
    VSIMkdir(folder.c_str(), 0755);
    try {
        write_features(driver, path, target, crs, options, feature.fill);
        kept = read_probe(path, crs, feature);
    } catch (const IoError& error) {
        VSIRmdirRecursive(folder.c_str());
        throw UsageError(refusal_of(driver) + "cannot write " + feature.subject + ": " + error.what() + "; " +
                         kAlternatives);
    } catch (const Error&) {
        VSIRmdirRecursive(folder.c_str());
        throw;
    }
    VSIRmdirRecursive(folder.c_str());
    if (!kept.positions) {
        throw UsageError(refusal_of(driver) + "does not keep the positions of " + feature.subject + "; " +
                         kAlternatives);
    }
    return kept;
}

Point3 probe_point(const Crs& crs, double east, double north, double z) {
    return crs.is_geographic() ? Point3{5 + east, 60 + north, z} : Point3{500010 + east, 6700020 + north, z};
}

void refuse_lost_elevations(const TinDriver& driver, const char* subject) {
    throw UsageError(refusal_of(driver) + "loses the elevations of " + subject + "; " + kAlternatives);
}

bool has_field_value(const OGRFeature& feature, const char* name, double value) {
    const int field = feature.GetFieldIndex(name);
    return field >= 0 && std::abs(feature.GetFieldAsDouble(field) - value) < 1e-6;
}

std::string lost_crs_warning(const TinDriver& driver, const KeptFeature& kept, const Crs& crs) {
    // A GeoJSON's other systems stand in its metadata, a CSV's in the .prj file beside it.
    const bool is_lost = !kept.crs && driver.metadata != MetadataPlace::Member && driver.name != "CSV";
    return is_lost ? refusal_of(driver) + "does not keep the CRS " + crs.name() : std::string();
}

}  // namespace tinwright::io
