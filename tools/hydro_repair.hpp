#ifndef TINWRIGHT_TOOLS_HYDRO_REPAIR_HPP
#define TINWRIGHT_TOOLS_HYDRO_REPAIR_HPP

#include <string>
#include <vector>

#include "tinwright/io/write_tin.hpp"

#include "leveled_water.hpp"
#include "repair.hpp"

namespace tinwright::tools {

/// What became of each line that came in, running downstream: rivers drawn against the flow are turned
/// round, those drawn against it in part come in several parts.
RepairedLines downstream_lines(const LeveledWater& leveled);

/// Where all that goes: as `plan_repair` says, and `folder/hydro.gpkg`. Throws what that throws.
struct HydroPlan {
    RepairPlan lines;
    std::string water;  ///< hydro.gpkg
};
HydroPlan plan_hydro(const LeveledWater& leveled, const std::string& folder, bool overwrite,
                     std::span<const io::Source> sources);

/// Writes all of it, into a new folder if there is none. Returns the lines for the report.
std::vector<std::string> write_hydro(const LeveledWater& leveled, const HydroPlan& plan, bool overwrite,
                                     const io::TinMetadata& metadata);

}  // namespace tinwright::tools

#endif
