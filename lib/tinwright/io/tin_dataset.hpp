#ifndef TINWRIGHT_IO_TIN_DATASET_HPP
#define TINWRIGHT_IO_TIN_DATASET_HPP

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ogrsf_frmts.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/tin_drivers.hpp"

/// Private to the TIN writer: a dataset being written, every failure an IoError.
namespace tinwright::io {

struct TinField {
    const char* name;
    OGRFieldType type;
};

class TinDataset;

/// A layer being written, and the one feature that all of it is written through.
class TinLayer {
  public:
    TinLayer(TinDataset& dataset, OGRLayer& layer, std::span<const TinField> fields, int wkt_field);

    /// Sets field `i` of those the layer was made with; a field that the driver refused is left out.
    void set(std::size_t i, int value);
    void set(std::size_t i, std::int64_t value);
    void set(std::size_t i, double value);
    void set(std::size_t i, const std::string& value);
    void set_null(std::size_t i);

    /// The feature's geometry, made of the given kind at the first call and then the same object.
    template <class Geometry>
    Geometry& geometry() {
        if (!geometry_) {
            geometry_ = std::make_unique<Geometry>();
            geometry_->set3D(TRUE);
        }
        return *static_cast<Geometry*>(geometry_.get());
    }
    /// Writes the feature as it is set. Throws IoError.
    void write();
    [[nodiscard]] std::size_t written() const { return written_; }

  private:
    TinDataset& dataset_;
    OGRLayer& layer_;
    OGRFeature feature_;
    std::unique_ptr<OGRGeometry> geometry_;
    std::vector<int> fields_;
    int wkt_field_;  // -1: the layer has geometries
    std::size_t written_ = 0;
};

class TinDataset {
  public:
    /// Creates `path`; messages name `target`; `counts` join the metadata of `options`. The references are
    /// kept. Throws IoError.
    TinDataset(const TinDriver& driver, std::string path, std::string target, const Crs& crs,
               const WriteTinOptions& options, const TinMetadata& counts = {});
    /// Closes, without a word, what was not closed.
    ~TinDataset();
    TinDataset(const TinDataset&) = delete;
    TinDataset& operator=(const TinDataset&) = delete;

    TinLayer add_layer(const std::string& name, OGRwkbGeometryType type, std::span<const TinField> fields,
                       const Tin& tin);
    /// Writes the metadata table of formats that have one.
    void add_metadata_table();
    /// Finishes all files. Throws IoError when anything of it failed, a full disk for instance.
    void close();

    [[noreturn]] void fail(const std::string& what) const;

  private:
    void require_whole_file() const;
    void write_side_car_crs() const;

    const TinDriver& driver_;
    std::string path_;
    std::string target_;
    const Crs& crs_;
    TinMetadata metadata_;
    const WriteTinOptions& options_;
    GdalMessages messages_;
    std::optional<std::string> former_date_;
    GDALDataset* dataset_ = nullptr;
    bool in_transaction_ = false;
};

}  // namespace tinwright::io

#endif
