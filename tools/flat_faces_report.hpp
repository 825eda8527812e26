#ifndef TINWRIGHT_TOOLS_FLAT_FACES_REPORT_HPP
#define TINWRIGHT_TOOLS_FLAT_FACES_REPORT_HPP

#include <string>
#include <vector>

#include "tinwright/io/write_tin.hpp"
#include "tinwright/water/flat_faces.hpp"

#include "json_value.hpp"

namespace tinwright::tools {

/// Of the metadata that TIN files and rasters keep.
inline constexpr const char* kFlatFacesKey = "TINWRIGHT_FLAT_FACES";

/// What became of flat faces.
struct FlatFacesSummary {
    std::string treatment;  ///< "keep", "swap" or "insert"
    FlatFacesReport report;
    bool is_count_only = false;  ///< of a TIN file: only `after` is known
};

/// "swap", ...: as on the command line.
std::string treatment_name(FlatFaces how);
/// The treatment of that name; keep of an empty text. Throws UsageError.
FlatFaces treatment_value(const std::string& text);

JsonValue flat_faces_json(const FlatFacesSummary& summary);
/// For people.
std::string flat_faces_line(const FlatFacesSummary& summary);
/// The flat faces that a TIN has. `is_water`: by face slot. `metadata`: of the file it was read from.
FlatFacesSummary count_in_file(const Tin& tin, const std::vector<bool>& is_water,
                               const io::TinMetadata& metadata);
/// What a TIN file and a raster keep of it.
io::TinMetadata flat_faces_metadata(const FlatFacesSummary& summary);

}  // namespace tinwright::tools

#endif
