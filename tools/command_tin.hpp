#ifndef TINWRIGHT_TOOLS_COMMAND_TIN_HPP
#define TINWRIGHT_TOOLS_COMMAND_TIN_HPP

#include "tinwright/io/write_tin.hpp"

#include "command.hpp"
#include "options_crs.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

/// `tinwright tin`: sources to a TIN file.
class CommandTin : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    OutputOptions output;
    TalkOptions talk;
    std::string geometry_text = "polygon";
    std::string layer_name;
    std::vector<std::string> layer_options;
    bool keep_ids = false;
    io::WriteTinOptions::Geometry geometry = io::WriteTinOptions::Geometry::Polygon;  ///< after `setup`

  private:
    [[nodiscard]] io::WriteTinOptions write_options() const;
};

}  // namespace tinwright::tools

#endif
