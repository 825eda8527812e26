#ifndef TINWRIGHT_IO_TIN_SOURCE_HPP
#define TINWRIGHT_IO_TIN_SOURCE_HPP

#include <string>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/write_tin.hpp"

/// Private to the TIN reader: a dataset that may hold a TIN, and which of its layers has the faces.
namespace tinwright::io {

class TinSource {
  public:
    /// Opens what the source names. Without a vector driver for it, `is_open()` is false when the file is
    /// there, as rasters and text files are; IoError when it is not.
    explicit TinSource(const Source& source);
    ~TinSource();
    TinSource(const TinSource&) = delete;
    TinSource& operator=(const TinSource&) = delete;

    [[nodiscard]] bool is_open() const { return dataset_ != nullptr; }
    /// The layer with the faces, filters set; null if there is none. Looks at the first 1000 features of a
    /// layer that neither metadata nor its type tell to be a TIN. Throws IoError when the layer that the
    /// source asks for is not there, UsageError for a filter that cannot be.
    [[nodiscard]] OGRLayer* find_faces();
    /// Throws UsageError if the source has a `where`: for when reading fails.
    void refuse_filter(OGRLayer& layer) const;
    /// Another layer of the same TIN, or null; also null when a filter takes a part of the faces only.
    [[nodiscard]] OGRLayer* find_companion(OGRLayer& faces, const char* name);
    [[nodiscard]] TinMetadata metadata(OGRLayer& faces);
    [[nodiscard]] Crs crs(OGRLayer& faces, const TinMetadata& metadata) const;
    /// `"file", layer "faces"` for messages.
    [[nodiscard]] std::string describe(OGRLayer& layer) const;
    /// "; GDAL says: ..." or nothing.
    [[nodiscard]] std::string suffix() const { return messages_.suffix(); }
    [[nodiscard]] std::string layer_names() const;

  private:
    OGRLayer* choose_layer();
    [[nodiscard]] bool has_our_metadata(OGRLayer& layer);

    const Source& source_;
    GdalMessages messages_;
    GDALDataset* dataset_ = nullptr;
    OGRLayer* result_set_ = nullptr;
};

}  // namespace tinwright::io

#endif
