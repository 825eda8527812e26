#ifndef TINWRIGHT_IO_TIN_DRIVERS_HPP
#define TINWRIGHT_IO_TIN_DRIVERS_HPP

#include <string>
#include <vector>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/mesh/tin.hpp"

class GDALDriver;

/// Private to the TIN writer: which driver writes a target, and what each of them needs to be told.
namespace tinwright::io {

/// Where a driver's files keep the metadata.
enum class MetadataPlace {
    Nowhere,
    Layer,        ///< GDAL's metadata items of the layer
    Table,        ///< a layer `tinwright_metadata` with fields key and value
    Member,       ///< the member `tinwright` of the GeoJSON collection
    Description,  ///< a JSON object as the dataset's description
};

struct TinDriver {
    GDALDriver* gdal = nullptr;
    std::string name;
    bool has_layers = false;  ///< faces, constrained edges and vertices go into one file
    MetadataPlace metadata = MetadataPlace::Nowhere;
    int significant_digits = 0;        ///< of coordinates written as text; 0: all that there are
    const char* last_words = nullptr;  ///< how a whole text file ends, blanks left out; null: not looked at
};

/// The driver named in `driver`, else the one for the target's extension. Throws UsageError.
TinDriver find_tin_driver(const std::string& target, const std::string& driver);

/// Creation options of the dataset: what pins the bytes and carries metadata, then the user's.
std::vector<std::string> dataset_options(const TinDriver& driver, const TinMetadata& metadata,
                                         const WriteTinOptions& options);

/// Creation options of one layer; `tin` and `crs` decide the digits and the extras of text formats.
std::vector<std::string> layer_options(const TinDriver& driver, const std::string& layer, const Tin& tin,
                                       const Crs& crs, const TinMetadata& metadata,
                                       const WriteTinOptions& options);

/// Whether geometries are written as a text field WKT of our own: CSV, unless its GEOMETRY option is given.
bool writes_own_wkt(const TinDriver& driver, const WriteTinOptions& options);

/// `metadata` as one JSON object of strings.
std::string json_of(const TinMetadata& metadata);

/// Where a vertex is in the CRS that is written.
Point3 written_position(const Tin& tin, const WriteTinOptions& options, VertexId v);

/// Whether some coordinate or elevation needs more than `digits` significant decimal digits. O(n).
bool needs_more_digits(const Tin& tin, const WriteTinOptions& options, int digits);

/// A coordinate reference system as GeoPackage wants an unknown one: srs_id -1.
const OGRSpatialReference& undefined_cartesian_system();

}  // namespace tinwright::io

#endif
