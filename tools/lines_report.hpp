#ifndef TINWRIGHT_TOOLS_LINES_REPORT_HPP
#define TINWRIGHT_TOOLS_LINES_REPORT_HPP

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "json_value.hpp"
#include "options_lines.hpp"

namespace tinwright::tools {

/// What was read and what became of it.
struct LineCounts {
    std::size_t breaklines = 0;
    std::size_t boundaries = 0;
    std::size_t holes = 0;
    std::size_t lakes = 0;  ///< rings, as of boundaries and holes
    std::size_t banks = 0;
    std::size_t rivers = 0;
    std::size_t sections = 0;  ///< from bank to bank
    std::size_t points = 0;
    std::size_t sources = 0;
    std::size_t skipped = 0;  ///< unusable features
    std::size_t edges = 0;    ///< distinct edges that lines run along
    std::size_t crossing_vertices = 0;
    std::size_t draped_vertices = 0;
    std::size_t open_edges = 0;    ///< without an empty disk, when a conforming TIN was asked for
    bool is_budget_spent = false;  ///< more Steiner points would help
    ConflictCounts conflicts{};
};

/// What the lines of a TIN are and what became of them: of one made just now, or of a file by what it says.
struct LinesSummary {
    std::string constraints;  ///< "constrained" or "conforming"; empty: no lines, or unknown
    std::string method;       ///< "split" or "blocking"; empty unless conforming
    std::optional<bool> is_conforming;
    std::optional<std::size_t> steiner_vertices;

    std::optional<LineCounts> counts;  ///< of a TIN made just now only
};

/// The summary of a TIN made with `lines`; empty without any.
LinesSummary summarize_lines(const LineOptions& options, const io::Lines& lines, const Tin& tin,
                             const TriangulateReport& report);
/// What a file says. Keys that are missing or unreadable are left empty.
LinesSummary read_lines_summary(const io::TinMetadata& metadata);

/// TINWRIGHT_CONSTRAINTS and what belongs to it (docs/formats.md), without what is empty.
io::TinMetadata lines_metadata(const LinesSummary& summary);

/// The object `lines` of the JSON report; only where there are counts.
JsonValue lines_json(const LinesSummary& summary);

/// Labels and lines for people; none without lines.
std::vector<std::pair<std::string, std::string>> lines_lines(const LinesSummary& summary);

/// What the user has to be warned of: a TIN that was to conform and does not.
std::vector<std::string> lines_warnings(const LinesSummary& summary);

}  // namespace tinwright::tools

#endif
