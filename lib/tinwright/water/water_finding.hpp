#ifndef TINWRIGHT_WATER_WATER_FINDING_HPP
#define TINWRIGHT_WATER_WATER_FINDING_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Something about water that cannot be so, or that one should know of.
struct WaterFinding {
    enum class Kind : std::uint8_t {
        RunsUphill,        ///< a river rises downstream; z: where the rise ends, other_z: where it begins
        WrongDirection,    ///< a river ends higher than it begins; z: of the end, other_z: of the beginning
        BeyondLimit,       ///< to run downhill here takes more than --max-drop or --max-lift; z: the level,
                           ///< other_z: what it would have to be
        DanglingReach,     ///< a river ends where there is neither water nor the end of the terrain
        Loop,              ///< water runs in a circle
        Braid,             ///< water divides and comes together again
        RiverThroughLake,  ///< a river passes a lake, and says another level; z: its own, other_z: the lake's
        LakeNotLevel,      ///< the shore as it came is not level; z: highest, other_z: lowest
        ShoreUnderWater,   ///< a sample beside a lake is lower than the lake; z: the sample's, other_z: level
        LakesMeet,         ///< two lakes touch or overlap; z, other_z: their levels
        LakesOutOfOrder,   ///< water runs from a lake to a higher one; z: the lower, other_z: the higher
        BanksNotLevel,     ///< the two ends of a section as they came differ; z: higher, other_z: lower
        WaterOverlaps,     ///< banks overlap a lake or other banks
        RasterRises,       ///< cells of a raster rise along a river; z: of the cell, other_z: lowest so far
        RasterLakeUneven   ///< cells of a raster inside a lake differ; z: highest, other_z: lowest
    };
    static constexpr std::size_t kKinds = 15;
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    Kind kind = Kind::RunsUphill;
    std::uint32_t line = kNone;        ///< index of a line: a river, or a ring of the polygon
    std::uint32_t other_line = kNone;  ///< of the other one, where there are two
    std::uint32_t sample = kNone;      ///< index of a sample
    Point2 location{};                 ///< CRS units; of a rise: where it ends
    double z = std::numeric_limits<double>::quiet_NaN();
    double other_z = std::numeric_limits<double>::quiet_NaN();
    double amount = 0;    ///< how much is wrong, unit of z, >= 0; 0 where it is not a question of how much
    double chainage = 0;  ///< of `location` from the start of the river as it was drawn, on the ground
    double length = 0;    ///< of a rise: from where it begins to where it ends, on the ground
    /// Whether it is put right when a surface is made.
    bool is_repaired = false;
};

/// Whether it is a fault, or only something to know: a braid, water that passes a lake at the lake's level,
/// lakes of one level that meet.
bool is_fault(const WaterFinding& finding);

using WaterFindingCounts = std::array<std::size_t, WaterFinding::kKinds>;
WaterFindingCounts count_findings(std::span<const WaterFinding> findings);

}  // namespace tinwright

#endif
