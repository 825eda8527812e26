#ifndef TINWRIGHT_TOOLS_HYDRO_REPORT_HPP
#define TINWRIGHT_TOOLS_HYDRO_REPORT_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "json_value.hpp"
#include "leveled_water.hpp"

/// What `tinwright hydro` has to tell.
namespace tinwright::tools {

/// Findings that are faults; with `left_only` those that repairing leaves.
std::size_t count_hydro_faults(const LeveledWater& leveled, bool left_only);
/// One line a finding, of each kind a thousand at most; with `left_only` of faults that repairing leaves.
std::string hydro_lines(const LeveledWater& leveled, bool left_only);
/// Of geographic sources: the plane that was worked in, and that lengths are geodesic; else empty.
std::string hydro_plane(const LeveledWater& leveled);
/// "1 lake, 3 rivers and 300 samples: 2 rises", "3 rivers: clean".
std::string hydro_verdict(const LeveledWater& leveled);
/// Of the raster: what was compared, with what tolerance, and what was found.
std::string raster_verdict(const CheckedRaster& raster);
/// "repaired; left: 1 dangling reach".
std::string hydro_repair_verdict(const LeveledWater& leveled);
/// The whole report. `command`: "hydro check" or "hydro repair".
JsonValue hydro_json(const LeveledWater& leveled, const std::string& command,
                     const std::vector<std::string>& outputs);

}  // namespace tinwright::tools

#endif
