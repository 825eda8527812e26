#ifndef TINWRIGHT_TOOLS_OPTIONS_LINES_HPP
#define TINWRIGHT_TOOLS_OPTIONS_LINES_HPP

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "options_water.hpp"
#include "parse_options.hpp"

namespace tinwright::tools {

/// Names of policies, as `--crossing-z` takes them.
inline constexpr auto kCrossingPolicies =
    std::to_array<std::pair<std::string_view, CrossingPolicy>>({{"error", CrossingPolicy::Error},
                                                                {"mean", CrossingPolicy::Mean},
                                                                {"first", CrossingPolicy::First},
                                                                {"min", CrossingPolicy::Min},
                                                                {"max", CrossingPolicy::Max}});

/// Sources of lines, and how lines are fitted together and into the TIN. Water is lines, too.
struct LineOptions {
    WaterChoice water;
    std::vector<std::string> breakline_texts;
    std::vector<std::string> boundary_texts;
    std::vector<std::string> hole_texts;
    std::string snap_text;
    std::string crossing_z_text;
    std::string crossing_tolerance_text;
    std::string line_tolerance_text;
    std::string constraints_text;
    std::string method_text;
    std::string max_steiner_text;
    std::string conflicts;  ///< file for the conflicts; empty: none

    // After `finish`:
    std::vector<io::LineSource> sources;  ///< breaklines, boundaries, holes, then water, each in order
    NodingOptions noding;                 ///< without progress
    double line_tolerance = 0;
    std::optional<ConformingOptions> conforming;  ///< empty: constrained; without progress

    /// --breaklines, --boundary and --holes.
    void add_sources_to(CLI::App& parser);
    /// --snap, --crossing-z, --crossing-tolerance and --line-tolerance.
    void add_fitting_to(CLI::App& parser);
    /// The same and --lakes, --rivers and --banks, and how water gets its levels.
    void add_all_sources_to(CLI::App& parser);
    /// --constraints, --conforming-method, --max-steiner and --conflicts.
    void add_constraints_to(CLI::App& parser);
    /// Reads the texts; `open_options` (--oo) join those of each source. Throws UsageError, also for options
    /// that do nothing without lines.
    void finish(const std::vector<std::string>& open_options);

    [[nodiscard]] bool has_breaklines() const { return !breakline_texts.empty(); }
    [[nodiscard]] bool has_water() const { return !water.sources.empty(); }
    /// How water gets its levels; without progress.
    [[nodiscard]] WaterOptions water_options() const;
    /// The first of these options that was given, or empty.
    [[nodiscard]] std::string first_given() const;
    /// The sources without their roles.
    [[nodiscard]] std::vector<io::Source> plain_sources() const;
    void apply_to(TriangulateOptions& options) const;

    /// "constrained" or "conforming"; empty without lines.
    [[nodiscard]] std::string constraints_name() const;
    /// "split" or "blocking"; empty unless conforming.
    [[nodiscard]] std::string method_name() const;
    /// "error", "mean", ...
    [[nodiscard]] std::string policy_name() const;
    /// The options that affect a TIN, in a fixed order, each after a blank; empty without lines.
    [[nodiscard]] std::string canonical() const;
};

}  // namespace tinwright::tools

#endif
