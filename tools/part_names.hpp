#ifndef TINWRIGHT_TOOLS_PART_NAMES_HPP
#define TINWRIGHT_TOOLS_PART_NAMES_HPP

#include <cstdint>
#include <set>
#include <string>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

namespace tinwright::tools {

/// Names lines and samples by where they came from, as short as can be, for lists of findings.
class PartNames {
  public:
    /// Both must outlive it.
    PartNames(const io::Lines& lines, const io::Samples& samples);

    /// `roads.gpkg: feature 7`, with the layer where several of a file were read.
    [[nodiscard]] std::string of_line(std::uint32_t line) const;
    [[nodiscard]] std::string of_feature(const std::string& file, const std::string& layer,
                                         std::int64_t feature) const;
    [[nodiscard]] std::string of_sample(std::uint32_t sample) const;

  private:
    const io::Lines& lines_;
    const io::Samples& samples_;
    std::set<std::string> several_;  // files with several layers
};

/// To six decimals, as lists show numbers: places that were made have as many digits as a double holds.
double rounded(double value);

}  // namespace tinwright::tools

#endif
