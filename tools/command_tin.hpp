#ifndef TINWRIGHT_TOOLS_COMMAND_TIN_HPP
#define TINWRIGHT_TOOLS_COMMAND_TIN_HPP

#include "tinwright/io/write_graph.hpp"
#include "tinwright/io/write_tin.hpp"

#include "command.hpp"
#include "options_crs.hpp"
#include "options_graph.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

class Console;

/// `tinwright tin`: sources to a TIN file, or to the lines of a graph of neighbours.
class CommandTin : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    GraphOptions graph;
    OutputOptions output;
    TalkOptions talk;
    std::string geometry_text;  ///< empty: polygon
    std::string layer_name;
    std::vector<std::string> layer_options;
    bool keep_ids = false;
    io::WriteTinOptions::Geometry geometry = io::WriteTinOptions::Geometry::Polygon;  ///< after `setup`

  private:
    void finish_tin();
    void finish_graph();
    [[nodiscard]] io::WriteTinOptions write_options() const;
    [[nodiscard]] io::WriteGraphOptions write_graph_options() const;
    Outcome run_tin(Console& console);
    Outcome run_graph(Console& console);
};

}  // namespace tinwright::tools

#endif
