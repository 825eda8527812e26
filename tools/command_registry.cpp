#include "command_registry.hpp"

#include <array>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "command_check.hpp"
#include "command_contour.hpp"
#include "command_explain.hpp"
#include "command_grid.hpp"
#include "command_hydro.hpp"
#include "command_info.hpp"
#include "command_sample.hpp"
#include "command_tin.hpp"
#include "manual_pages.hpp"

namespace tinwright::tools {

namespace {

template <class Made>
std::unique_ptr<Command> make_command() {
    return std::make_unique<Made>();
}

const std::array kCommands{
    CommandEntry{"tin", "triangulates samples and writes the TIN", &make_command<CommandTin>},
    CommandEntry{"grid", "turns samples, or an existing TIN, into a raster", &make_command<CommandGrid>},
    CommandEntry{"contour", "draws contours of samples, or of an existing TIN",
                 &make_command<CommandContour>},
    CommandEntry{"sample", "reads a surface at points or along lines", &make_command<CommandSample>},
    CommandEntry{"explain", "tells why a surface is as it is at one place", &make_command<CommandExplain>},
    CommandEntry{"hydro", "checks lakes, rivers and banks, or puts them right", &make_command<CommandHydro>},
    CommandEntry{"info", "tells what samples or a TIN are like", &make_command<CommandInfo>},
    CommandEntry{"check", "audits TIN files", &make_command<CommandCheck>},
};

}  // namespace

std::span<const CommandEntry> all_commands() { return kCommands; }

const CommandEntry* find_command(std::string_view name) {
    for (const CommandEntry& entry : kCommands) {
        if (entry.name == name) {
            return &entry;
        }
    }
    return nullptr;
}

std::string overview() {
    std::string text =
        "Usage: tinwright COMMAND [options] SOURCE... -o OUTPUT\n"
        "Terrain surfaces (TIN, DEM) from survey points.\n\n"
        "Commands:\n";
    for (const CommandEntry& entry : kCommands) {
        text += "  " + std::string(entry.name) + std::string(10 - entry.name.size(), ' ') +
                std::string(entry.summary) + "\n";
    }
    return text +
           "  help      prints the manual page of a command\n\n"
           "  -h, --help     this screen; \"tinwright COMMAND --help\" lists a command's options\n"
           "      --version  the version\n\n"
           "Examples:\n"
           "  tinwright grid survey.csv -o dem.tif\n"
           "  tinwright tin survey.csv -o survey.gpkg\n";
}

std::string manual_page(std::string_view command) {
    const std::string page = command.empty() ? "tinwright" : "tinwright-" + std::string(command);
    for (const ManualPage& candidate : all_manual_pages()) {
        if (candidate.name == page) {
            return std::string(candidate.text);
        }
    }
    throw UsageError("no manual page for " + io::quoted(std::string(command)) +
                     ": \"tinwright --help\" lists the commands");
}

}  // namespace tinwright::tools
