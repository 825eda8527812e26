#ifndef TINWRIGHT_TOOLS_COMMAND_HYDRO_HPP
#define TINWRIGHT_TOOLS_COMMAND_HYDRO_HPP

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "options_crs.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"
#include "options_water.hpp"

namespace tinwright::tools {

class Console;
struct LevelRequest;
struct LeveledWater;

/// `tinwright hydro check`: lists what is wrong with lakes, rivers and banks, and with a raster's cells on
/// them; `tinwright hydro repair`: writes them put right.
class CommandHydro : public Command {
  public:
    enum class Action { Check, Repair };

    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    Action action = Action::Check;
    SourceOptions sources;
    WaterChoice water;
    std::string crossing_z_text;
    std::string raster_text;
    std::string raster_tolerance_text;
    TriangulationOptions triangulation;  ///< threads only
    CrsOptions crs;
    OutputOptions output;
    TalkOptions talk;

    // After `setup`:
    CrossingPolicy meeting_levels = CrossingPolicy::Error;
    std::optional<io::Source> raster;
    double raster_tolerance = 0.001;

  private:
    /// The parser of an action; of none, the one that only helps.
    std::unique_ptr<CLI::App> make_parser_of(std::optional<Action> wanted);
    void finish_check();
    void finish_repair() const;
    /// Positional sources are samples, or lines that are rivers, or polygons that are lakes.
    [[nodiscard]] LevelRequest sort_sources(Console& console) const;
    [[nodiscard]] std::vector<io::Source> all_sources() const;
    void check_target() const;
    [[nodiscard]] std::string name() const;
    void say_plane(const LeveledWater& leveled, Console& console) const;
    Outcome run_check(Console& console);
    Outcome run_repair(Console& console);
    void report(const LeveledWater& leveled, const std::string& list,
                const std::vector<std::string>& outputs) const;
};

}  // namespace tinwright::tools

#endif
