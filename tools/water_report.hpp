#ifndef TINWRIGHT_TOOLS_WATER_REPORT_HPP
#define TINWRIGHT_TOOLS_WATER_REPORT_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/water/water.hpp"

#include "json_value.hpp"

namespace tinwright::tools {

/// A feature as reports name it.
struct FeatureName {
    std::string file;
    std::string layer;
    std::int64_t feature = 0;
};

/// What became of the water of a surface.
struct WaterSummary {
    WaterReport report;                      ///< reaches without their points
    std::vector<FeatureName> lake_names;     ///< one a lake of the report
    std::vector<FeatureName> banks_names;    ///< one a `BanksReport`
    std::size_t lifted = 0;                  ///< samples on shores that got another z
    std::size_t rivers = 0;                  ///< lines of role River
    std::optional<double> burn;              ///< --burn
    std::optional<std::size_t> river_cells;  ///< of a raster: that got a river's elevation
};

/// `lines`: those that the report numbers.
WaterSummary summarize_water(const Water& water, const io::Lines& lines, const WaterOptions& options);

/// The object `water` of the JSON report.
JsonValue water_json(const WaterSummary& summary);
/// Labels and lines for people.
std::vector<std::pair<std::string, std::string>> water_lines(const WaterSummary& summary);
/// What the user has to be warned of: faults that were put right, and those that were not.
std::vector<std::string> water_warnings(const WaterSummary& summary);
/// TINWRIGHT_LAKES and what belongs to it (docs/formats.md).
io::TinMetadata water_metadata(const WaterSummary& summary);
/// What a TIN file says of its water, for people: "1 lake, 3 reaches, 12 sections"; empty without.
std::string file_water_text(const io::TinMetadata& metadata);
/// Its keys of water, for what is made of it.
io::TinMetadata water_metadata_of(const io::TinMetadata& metadata);

}  // namespace tinwright::tools

#endif
