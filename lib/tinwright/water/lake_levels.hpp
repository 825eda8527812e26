#ifndef TINWRIGHT_WATER_LAKE_LEVELS_HPP
#define TINWRIGHT_WATER_LAKE_LEVELS_HPP

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/water/lakes.hpp"
#include "tinwright/water/near_samples.hpp"
#include "tinwright/water/water.hpp"
#include "tinwright/water/water_network.hpp"

/// The levels of all lakes of a network together. Private to the room of water.
namespace tinwright {

class LakeLevels {
  public:
    /// `lines`: all that came in. `report`: gets the lakes and what is found. All must outlive the object.
    LakeLevels(const WaterNetwork& network, std::span<const Breakline> lines, NearSamples& samples,
               const WaterOptions& options, WaterReport& report)
        : network_(network), lines_(lines), samples_(samples), options_(options), report_(report) {}

    /// Measures each lake, and gives those that meet one level. Throws as `level_water` does.
    void measure();
    /// Brings lakes whose levels were measured into the order of flow; those with a level of their own stand.
    /// `falls`: between nodes of lakes.
    void order(std::span<const Fall> falls);
    /// Tells of samples beside the lakes that are below them. Returns those to be lifted, and their z.
    std::vector<std::pair<std::uint32_t, double>> look_at_shores();

    /// One a node that is a lake.
    [[nodiscard]] const std::vector<double>& levels() const { return levels_; }

  private:
    void agree(const std::vector<MeasuredLake>& measured);
    void report_meeting(const LakeLevel& first, const LakeLevel& other);
    [[nodiscard]] double choose_common(const std::vector<double>& levels, bool do_differ) const;

    const WaterNetwork& network_;
    std::span<const Breakline> lines_;
    NearSamples& samples_;
    const WaterOptions& options_;
    WaterReport& report_;
    std::vector<double> levels_;
    std::vector<std::vector<std::uint32_t>> beside_;  // of each lake: samples
};

}  // namespace tinwright

#endif
