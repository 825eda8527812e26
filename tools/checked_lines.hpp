#ifndef TINWRIGHT_TOOLS_CHECKED_LINES_HPP
#define TINWRIGHT_TOOLS_CHECKED_LINES_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "tinwright/breaklines/line_check.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

#include "json_value.hpp"

namespace tinwright::tools {

/// Lines and samples after their audit.
struct CheckedLines {
    io::Lines lines;
    io::Samples samples;
    LineCheckReport report;

    [[nodiscard]] bool is_empty() const { return lines.slices.empty() && samples.slices.empty(); }
    /// Features, rows and cells that could not be read.
    [[nodiscard]] std::size_t unusable() const;
    /// Conflicts and what could not be read.
    [[nodiscard]] std::size_t found() const { return report.conflicts.size() + unusable(); }
};

/// What an audit has to know of the lines that were read.
std::vector<LineTraits> traits_of(const io::Lines& lines);

/// One line a conflict, of each kind a thousand at most, and one a feature that could not be read.
std::string conflict_lines(const CheckedLines& checked);
/// "2 crossings, 1 touch in 12 lines and 300 samples", "12 lines: clean".
std::string lines_verdict(const CheckedLines& checked);
/// The key `lines` of the report.
JsonValue lines_json(const CheckedLines& checked);

}  // namespace tinwright::tools

#endif
