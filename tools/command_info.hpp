#ifndef TINWRIGHT_TOOLS_COMMAND_INFO_HPP
#define TINWRIGHT_TOOLS_COMMAND_INFO_HPP

#include "command.hpp"
#include "options_crs.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

/// `tinwright info`: what samples, or a TIN, are like.
class CommandInfo : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    TalkOptions talk;
};

}  // namespace tinwright::tools

#endif
