#ifndef TINWRIGHT_TOOLS_OPTIONS_AUDIT_HPP
#define TINWRIGHT_TOOLS_OPTIONS_AUDIT_HPP

#include <string>

#include "tinwright/breaklines/line_check.hpp"
#include "tinwright/breaklines/noding.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// What counts as a conflict of lines, and whether lines are repaired.
struct AuditOptions {
    std::string snap_text;
    std::string dangling_text;
    std::string line_tolerance_text;
    std::string crossing_tolerance_text;
    std::string crossing_z_text;
    std::string conflicts;  ///< file for the conflicts; empty: none
    bool repair = false;

    // After `finish`:
    LineCheckOptions check;  ///< without traits and progress
    CrossingPolicy crossing_z = CrossingPolicy::Mean;

    void add_to(CLI::App& parser);
    /// Throws UsageError.
    void finish();
    /// "mean", "first", ...
    [[nodiscard]] std::string policy_name() const;
};

}  // namespace tinwright::tools

#endif
