#ifndef TINWRIGHT_TESTS_IO_VECTOR_FILES_HPP
#define TINWRIGHT_TESTS_IO_VECTOR_FILES_HPP

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <cpl_vsi.h>
#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"

/// Vector files in memory, made feature by feature.
namespace tinwright_tests {

/// A vector file in memory under construction; closed, and with that complete, by close().
class VectorFile {
  public:
    VectorFile(const std::string& driver, const std::string& name) : path_("/vsimem/" + name) {
        tinwright::io::register_drivers();
        GDALDriver* const made_by = GetGDALDriverManager()->GetDriverByName(driver.c_str());
        REQUIRE(made_by != nullptr);
        dataset_.reset(made_by->Create(path_.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
        REQUIRE(dataset_ != nullptr);
    }
    VectorFile(const VectorFile&) = delete;
    VectorFile& operator=(const VectorFile&) = delete;
    ~VectorFile() {
        dataset_.reset();
        VSIRmdirRecursive(path_.c_str());
        VSIUnlink(path_.c_str());
    }

    OGRLayer& add_layer(const std::string& name, OGRwkbGeometryType type, const char* crs = nullptr,
                        const std::vector<std::pair<std::string, OGRFieldType>>& fields = {}) {
        OGRSpatialReference system;
        if (crs != nullptr) {
            system.SetFromUserInput(crs);
            system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        }
        OGRLayer* const layer = dataset_->CreateLayer(name.c_str(), crs == nullptr ? nullptr : &system, type);
        REQUIRE(layer != nullptr);
        for (const auto& [field, kind] : fields) {
            OGRFieldDefn definition(field.c_str(), kind);
            REQUIRE(layer->CreateField(&definition) == OGRERR_NONE);
        }
        return *layer;
    }
    const std::string& close() {
        dataset_.reset();
        return path_;
    }

  private:
    tinwright::io::GdalMessages messages_;  // what drivers say about file names and extensions
    std::string path_;
    std::unique_ptr<GDALDataset, tinwright::io::CloseDataset> dataset_;
};

/// `values`: one a field, as text; nullptr leaves it empty. `wkt` nullptr: no geometry.
inline void add_feature(OGRLayer& layer, const char* wkt, const std::vector<const char*>& values = {}) {
    OGRFeature feature(layer.GetLayerDefn());
    if (wkt != nullptr) {
        OGRGeometry* geometry = nullptr;
        REQUIRE(OGRGeometryFactory::createFromWkt(wkt, nullptr, &geometry) == OGRERR_NONE);
        feature.SetGeometryDirectly(geometry);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] != nullptr) {
            feature.SetField(static_cast<int>(i), values[i]);
        }
    }
    REQUIRE(layer.CreateFeature(&feature) == OGRERR_NONE);
}

}  // namespace tinwright_tests

#endif
