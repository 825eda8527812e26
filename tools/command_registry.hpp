#ifndef TINWRIGHT_TOOLS_COMMAND_REGISTRY_HPP
#define TINWRIGHT_TOOLS_COMMAND_REGISTRY_HPP

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "command.hpp"

namespace tinwright::tools {

struct CommandEntry {
    std::string_view name;
    std::string_view summary;  ///< one line, for the overview
    std::unique_ptr<Command> (*make)();
};

/// Every command there is, in the order of the overview.
std::span<const CommandEntry> all_commands();

/// The command of that name, or null.
const CommandEntry* find_command(std::string_view name);

/// What `tinwright --help` prints.
std::string overview();

/// The manual page of a command, or of the program for an empty name, as text. Throws UsageError for an
/// unknown command.
std::string manual_page(std::string_view command);

}  // namespace tinwright::tools

#endif
