#ifndef TINWRIGHT_TOOLS_OPTIONS_WATER_HPP
#define TINWRIGHT_TOOLS_OPTIONS_WATER_HPP

#include <string>
#include <utility>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/water/water.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// Sources of water, and how it gets its levels.
struct WaterChoice {
    std::vector<std::string> lake_texts;
    std::vector<std::string> river_texts;
    std::vector<std::string> bank_texts;
    std::string lake_level_text;
    std::string shore_width_text;
    std::string shore_clearance_text;
    std::string flow_text;
    std::string river_fit_text;
    std::string river_width_text;
    std::string max_drop_text;
    std::string max_lift_text;
    std::string station_spacing_text;
    std::string burn_text;
    std::string tolerance_text;

    // After `finish`:
    std::vector<io::LineSource> sources;  ///< lakes, then banks, then rivers, each in order
    WaterOptions options;                 ///< without progress and `meeting_levels`

    /// --lakes, --rivers and --banks.
    void add_sources_to(CLI::App& parser);
    /// All others. `are_shown`: on the screen of --help too, rather than in the manual page only.
    void add_levels_to(CLI::App& parser, bool are_shown);
    /// Reads the texts; `open_options` (--oo) join those of each source. Throws UsageError.
    void finish(const std::vector<std::string>& open_options);
    /// Throws UsageError for options without the water that they are for, and for burning together with
    /// flattening. `roles`: whether there is water of a role.
    struct Roles {
        bool lakes = false;
        bool rivers = false;
        bool banks = false;
    };
    void check_roles(const Roles& roles) const;
    /// What the options name, as opposed to positional sources.
    [[nodiscard]] Roles roles() const;

    /// The first of these options that was given, or empty.
    [[nodiscard]] std::string first_given() const;
    /// The options that affect levels, in a fixed order, each after a blank; empty without water.
    [[nodiscard]] std::string canonical() const { return canonical(roles()); }
    [[nodiscard]] std::string canonical(const Roles& given) const;

  private:
    [[nodiscard]] std::vector<std::pair<const char*, const std::string*>> level_texts() const;
    void finish_lakes();
    void finish_rivers();
};

/// "min", "percentile:5" or "mean".
std::string level_rule_name(const LevelRule& rule);

/// Appends the sources that `texts` name; `open_options` (--oo) join those of each. Throws UsageError.
void add_line_sources(const std::vector<std::string>& texts, LineRole role,
                      const std::vector<std::string>& open_options, std::vector<io::LineSource>& sources);

}  // namespace tinwright::tools

#endif
