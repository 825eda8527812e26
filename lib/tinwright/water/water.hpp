#ifndef TINWRIGHT_WATER_WATER_HPP
#define TINWRIGHT_WATER_WATER_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/water/isotonic_regression.hpp"
#include "tinwright/water/water_finding.hpp"

/// The front door to water: lakes, rivers and banks as they came in, lines with levels out, to be
/// triangulated with the rest.
namespace tinwright {

/// Which of many elevations a level is.
struct LevelRule {
    enum class Kind : std::uint8_t { Min, Percentile, Mean };
    Kind kind = Kind::Percentile;
    double percent = 5;  ///< Percentile only, 0 to 100
};

enum class FlowRule : std::uint8_t {
    Digitized,  ///< rivers run the way they were drawn
    Auto        ///< found from the elevations of ends and the network
};

struct WaterOptions {
    /// Level of a lake without one of its own: of the samples inside and at most `shore_width` from its
    /// shore; of one whose own z differ: of these.
    LevelRule lake_level;
    /// How far from a shore or river samples count (CRS units, > 0). Empty: twice the mean distance of
    /// samples, rounded down to 1, 2 or 5 times a power of ten.
    std::optional<double> shore_width;
    /// Samples no farther than `shore_width` from a lake that are below it are lifted to its level and this
    /// (unit of z, >= 0). Empty: they are reported only.
    std::optional<double> shore_clearance;
    FlowRule flow = FlowRule::Digitized;
    RiverFit river_fit = RiverFit::Isotonic;
    /// How far from a river without z of its own samples count (CRS units, >= 0); the lowest of them and of
    /// the terrain under it is its elevation. Empty: `shore_width`.
    std::optional<double> river_width;
    std::optional<double> max_drop;  ///< most that a river may be dug in (unit of z, >= 0)
    std::optional<double> max_lift;  ///< most that it may be lifted (unit of z, >= 0)
    /// Greatest distance of stations on banks and on rivers without z (CRS units, > 0). Empty: `shore_width`
    /// on rivers, half the mean width of the water on banks.
    std::optional<double> station_spacing;
    /// Rivers are lowered by this (unit of z, > 0) in the end: enforcement, for culverts and drains. Not with
    /// lakes or banks.
    std::optional<double> burn;
    double tolerance = 0.001;  ///< differences of levels up to this (unit of z, >= 0) are none
    /// Level of lakes that touch and do not agree; Error refuses them.
    CrossingPolicy meeting_levels = CrossingPolicy::Error;
    /// For audits: lakes that meet do not end the work under Error; the lower level is taken.
    bool keeps_faults = false;
    /// Of lengths and chainages in the report. Widths and distances that decide something are of the plane.
    GroundMeasures ground{};
    Progress progress;
};

/// A lake as it became.
struct LakeLevel {
    std::uint32_t line = 0;   ///< index of its first ring
    double level = 0;         ///< unit of z
    bool is_own = false;      ///< from its own z, rather than from samples
    double shore_length = 0;  ///< on the ground
    std::size_t samples_inside = 0;
    std::size_t samples_on_shore = 0;  ///< no farther outside than `shore_width`
    std::size_t samples_under = 0;     ///< of these, below the level
    Point2 location{};                 ///< a point of its shore, CRS units
};

/// A river, or part of one, between two places where water meets or ends; in flow direction. Of banks too:
/// the middle between them.
struct Reach {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::uint32_t line = 0;            ///< index of the river, or of the banks' first ring
    bool is_reversed = false;          ///< runs against the direction that the line was drawn in
    bool is_between_banks = false;     ///< made from banks
    std::uint32_t from = 0;            ///< number of the place where it begins
    std::uint32_t to = 0;              ///< and ends
    std::uint32_t downstream = kNone;  ///< the reach that goes on at `to`; of several the one that was drawn
                                       ///< on, else the first; kNone: none does
    std::uint32_t order = 1;           ///< after Strahler
    std::vector<Point3> points;        ///< CRS units
    double length = 0;                 ///< on the ground
    double most_dug = 0;               ///< furthest below the elevations that it was made from, unit of z
    double most_lifted = 0;            ///< above them
};

struct BanksReport {
    std::uint32_t line = 0;  ///< index of the first ring
    std::size_t sections = 0;
    double z_up = 0;  ///< highest and lowest level
    double z_down = 0;
    double mean_width = 0;  ///< of straight sections, on the ground
};

struct WaterReport {
    double shore_width = 0;  ///< as used, CRS units
    double river_width = 0;
    double station_spacing = 0;
    std::vector<LakeLevel> lakes;
    std::vector<Reach> reaches;
    std::vector<BanksReport> banks;
    /// Of the water as it came, by kind, then line, then chainage.
    std::vector<WaterFinding> findings;
    std::size_t rivers_turned = 0;  ///< under FlowRule::Auto: drawn against the flow, wholly or in part
    double seconds = 0;
};

/// What is to be triangulated instead of the samples and lines that came in.
struct Water {
    /// Those that came in, in their order: lakes, banks and rivers with levels and with points where they
    /// meet, each in the direction it was drawn; others as they were. Then sections.
    std::vector<Breakline> lines;
    std::vector<std::uint32_t>
        origin;  ///< of each line: the index it came from, of a section of a bank's ring
    /// Samples that get another z: index and z, ascending.
    std::vector<std::pair<std::uint32_t, double>> lifted;
    WaterReport report;
};

/// Gives lakes one level each, and rivers and banks levels that never rise downstream.
///
/// `samples`: those of the terrain, may be none where all water has z of its own. `lines`: those with a role
/// of water count, the others are handed through. Lakes and banks are closed rings. Points without z
/// (`kDraped`) are measured on the samples.
/// Every vertex where water meets water has one level. Rivers inside a lake have its level; between banks,
/// that of the sections. Levels of lakes with z of their own, and of those measured, are kept; rivers fit
/// in. Throws InputError: water without elevation and samples to take it from, lakes that meet at different
/// levels, what `find_lattice` throws; UsageError for options out of range; Cancelled.
/// O((n + m) log (n + m)) for n samples and m points of water in practice. Parallel inside the caller's task
/// arena; does not depend on the number of threads or the order of samples.
Water level_water(std::span<const Point3> samples, std::span<const Breakline> lines,
                  const WaterOptions& options = {});

}  // namespace tinwright

#endif
