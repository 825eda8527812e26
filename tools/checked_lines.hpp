#ifndef TINWRIGHT_TOOLS_CHECKED_LINES_HPP
#define TINWRIGHT_TOOLS_CHECKED_LINES_HPP

#include <cstddef>
#include <optional>
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
    LineCheckReport report;               ///< of what came in
    std::optional<LineCheckReport> left;  ///< after repairing; empty: not repaired
    std::string crossing_z;               ///< policy of the repair
    io::Crs output_crs;                   ///< of what is written, and of locations in the end

    /// What there is to look at.
    [[nodiscard]] const LineCheckReport& remaining() const { return left ? *left : report; }
    [[nodiscard]] bool is_empty() const { return lines.slices.empty() && samples.slices.empty(); }
    /// Features, rows and cells that could not be read.
    [[nodiscard]] std::size_t unusable() const;
    /// Conflicts that remain, and what could not be read.
    [[nodiscard]] std::size_t found() const { return remaining().conflicts.size() + unusable(); }
};

/// What an audit has to know of the lines that were read.
std::vector<LineTraits> traits_of(const io::Lines& lines);

/// One line a conflict that remains, of each kind a thousand at most, and one a feature that could not be
/// read.
std::string conflict_lines(const CheckedLines& checked);
/// "12 lines and 300 samples: 2 crossings, 1 touch", "12 lines: clean".
std::string lines_verdict(const CheckedLines& checked);
/// "repaired, z where lines meet: mean; left: 1 dangling end".
std::string repair_verdict(const CheckedLines& checked);
/// The key `lines` of the report.
JsonValue lines_json(const CheckedLines& checked);

}  // namespace tinwright::tools

#endif
