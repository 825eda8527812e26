#ifndef TINWRIGHT_TOOLS_COMMAND_EXPLAIN_HPP
#define TINWRIGHT_TOOLS_COMMAND_EXPLAIN_HPP

#include "tinwright/geometry/point.hpp"

#include "command.hpp"
#include "options_crs.hpp"
#include "options_interpolation.hpp"
#include "options_lines.hpp"
#include "options_sample.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

/// `tinwright explain`: why a surface is as it is at one place.
class CommandExplain : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    InterpolationChoice interpolation;
    SampleOptions sample;
    TalkOptions talk;
    Point2 at;  ///< after `setup`

  private:
    void take_coordinate();
};

}  // namespace tinwright::tools

#endif
