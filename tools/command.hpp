#ifndef TINWRIGHT_TOOLS_COMMAND_HPP
#define TINWRIGHT_TOOLS_COMMAND_HPP

#include <string>
#include <vector>

namespace tinwright::tools {

/// How a command that ran to its end turned out.
enum class Outcome { Done, ViolationsFound };

/// Thrown by `setup` when the user asked for help; not an error.
struct HelpRequest {
    std::string text;
};

/// One subcommand: `setup` understands the command line, `run` does the work.
class Command {
  public:
    Command() = default;
    virtual ~Command() = default;
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// Parses and checks what follows the command's name; touches no file.
    /// Throws UsageError or HelpRequest.
    virtual void setup(const std::vector<std::string>& arguments) = 0;

    /// Does the work. Throws tinwright::Error.
    virtual Outcome run() = 0;
};

}  // namespace tinwright::tools

#endif
