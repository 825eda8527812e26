#ifndef TINWRIGHT_TOOLS_COMMAND_CHECK_HPP
#define TINWRIGHT_TOOLS_COMMAND_CHECK_HPP

#include "command.hpp"
#include "optimality_check.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"

namespace tinwright::tools {

/// `tinwright check`: audits TIN files and lists what keeps them from being surfaces, or from being optimal.
class CommandCheck : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    OptimalityOptions optimality;
    OutputOptions output;
    TalkOptions talk;
};

}  // namespace tinwright::tools

#endif
