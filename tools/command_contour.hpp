#ifndef TINWRIGHT_TOOLS_COMMAND_CONTOUR_HPP
#define TINWRIGHT_TOOLS_COMMAND_CONTOUR_HPP

#include <string>
#include <vector>

#include "tinwright/io/write_contours.hpp"

#include "command.hpp"
#include "options_contour.hpp"
#include "options_crs.hpp"
#include "options_interpolation.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright {
struct Contours;
}

namespace tinwright::tools {

struct Surface;
class Console;

/// `tinwright contour`: sources, or one existing TIN, to contour lines or the bands between them.
class CommandContour : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    InterpolationChoice interpolation;
    ContourChoice contours;
    OutputOptions output;
    TalkOptions talk;
    std::string layer_name;
    std::vector<std::string> layer_options;

  private:
    [[nodiscard]] io::WriteContoursOptions write_options() const;
    [[nodiscard]] Contours make(const Surface& surface, Console& console) const;
    [[nodiscard]] io::WrittenContours write(const Contours& made, const Surface& surface,
                                            const io::WriteContoursOptions& options) const;
    void warn_about(const Contours& made, Console& console) const;
};

}  // namespace tinwright::tools

#endif
