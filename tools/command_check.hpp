#ifndef TINWRIGHT_TOOLS_COMMAND_CHECK_HPP
#define TINWRIGHT_TOOLS_COMMAND_CHECK_HPP

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "optimality_check.hpp"
#include "options_audit.hpp"
#include "options_crs.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"

namespace tinwright::io {
class OutputPositions;
}

namespace tinwright::tools {

class Console;
struct CheckedLines;
struct CheckedSurface;

/// `tinwright check`: audits TIN files, lines and samples, lists what is wrong with them, and repairs lines.
class CommandCheck : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    LineOptions lines;  ///< sources only
    AuditOptions audit;
    CrsOptions crs;
    OptimalityOptions optimality;
    OutputOptions output;
    TalkOptions talk;

  private:
    /// What the positional sources turn out to be.
    struct Sorted {
        std::vector<io::Source> tins;
        std::vector<io::Source> samples;
        std::vector<io::LineSource> lines;  ///< those of the roles too
    };
    /// Where results go.
    struct Targets {
        std::string violations;  ///< of TINs
        std::string conflicts;   ///< of lines and samples
        std::string folder;      ///< of repaired lines
    };
    [[nodiscard]] Sorted sort_sources() const;
    [[nodiscard]] std::vector<io::Source> all_sources() const;
    [[nodiscard]] Targets choose_targets(const Sorted& sorted) const;
    [[nodiscard]] CheckedLines check_lines_and_samples(const Sorted& sorted, const Targets& targets,
                                                       Console& console, std::vector<std::string>& outputs);
    /// Sets the system that is written.
    io::OutputPositions choose_output(CheckedLines& checked) const;
    void repair(CheckedLines& checked, const Sorted& sorted, const Targets& targets, Console& console,
                std::vector<std::string>& outputs);
};

}  // namespace tinwright::tools

#endif
