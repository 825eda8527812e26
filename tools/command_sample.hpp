#ifndef TINWRIGHT_TOOLS_COMMAND_SAMPLE_HPP
#define TINWRIGHT_TOOLS_COMMAND_SAMPLE_HPP

#include "command.hpp"
#include "options_crs.hpp"
#include "options_interpolation.hpp"
#include "options_lines.hpp"
#include "options_output.hpp"
#include "options_sample.hpp"
#include "options_sources.hpp"
#include "options_talk.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

class Console;
class SampleTable;
class SurfaceSampler;
struct Queries;
struct SampledCounts;

/// `tinwright sample`: a surface read at points or along lines.
class CommandSample : public Command {
  public:
    void setup(const std::vector<std::string>& arguments) override;
    Outcome run() override;

    SourceOptions sources;
    CrsOptions crs;
    TriangulationOptions triangulation;
    LineOptions lines;
    InterpolationChoice interpolation;
    SampleOptions sample;
    OutputOptions output;
    TalkOptions talk;

  private:
    void check_files() const;
    [[nodiscard]] Queries read_places(bool are_lines, const Surface& surface, Console& console) const;
    [[nodiscard]] SampledCounts write_samples(const Queries& queries, const Surface& surface,
                                              Console& console, std::string& driver) const;
    void report(const SampledCounts& counts, const Surface& surface, bool is_tin, const std::string& driver,
                Console& console) const;
};

}  // namespace tinwright::tools

#endif
