#ifndef TINWRIGHT_IO_OPEN_SOURCE_HPP
#define TINWRIGHT_IO_OPEN_SOURCE_HPP

#include <memory>
#include <string>

#include "tinwright/io/source.hpp"

class GDALDataset;

namespace tinwright::io {

struct CloseDataset {
    void operator()(GDALDataset* dataset) const;
};

/// A source found out: text for our own parser, or a dataset of GDAL's.
struct OpenedSource {
    enum class Kind { Text, Vector, Raster };
    Kind kind = Kind::Text;
    std::string path;                                    ///< in GDAL's spelling, /vsi prefixes added
    std::unique_ptr<GDALDataset, CloseDataset> dataset;  ///< null for text
    std::string warning;                                 ///< GDAL's, about the open options; mostly empty
};

/// The path as GDAL wants it: "-" is standard input, compressed files are read through /vsigzip/ and
/// /vsizip/.
std::string gdal_path(const std::string& path);

/// Opens a source for reading samples. Text: by format=, or by its name (.xyz, .csv, .txt, .pnezd, ...)
/// unless keys ask for layers or bands; an ESRI ASCII grid is a raster whatever its name. Everything else is
/// what GDAL says, and text when GDAL does not know it and it looks like rows of numbers. Throws IoError when
/// it cannot be opened; UsageError for keys that exclude each other.
OpenedSource open_source(const Source& source);

/// Opens a source for reading lines: what GDAL says, text files too. Throws IoError when it is no vector
/// file; UsageError for keys that are for samples.
OpenedSource open_line_source(const Source& source);

}  // namespace tinwright::io

#endif
