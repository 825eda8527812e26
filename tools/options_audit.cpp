#include "options_audit.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kPolicies =
    std::to_array<std::pair<std::string_view, CrossingPolicy>>({{"mean", CrossingPolicy::Mean},
                                                                {"first", CrossingPolicy::First},
                                                                {"min", CrossingPolicy::Min},
                                                                {"max", CrossingPolicy::Max},
                                                                {"error", CrossingPolicy::Error}});

std::optional<double> distance_value(std::string_view option, const std::string& text) {
    if (text.empty()) {
        return std::nullopt;
    }
    const double value = number_value(option, text);
    if (value < 0) {
        throw UsageError(std::string(option) + " needs a number from 0 up, not " + io::quoted(text));
    }
    return value;
}

}  // namespace

void AuditOptions::add_to(CLI::App& parser) {
    add_value(parser, "--snap", snap_text, "D", "points nearer than this to a line miss it");
    add_value(parser, "--dangling", dangling_text, "D", "ends this far short of a line dangle");
    add_value(parser, "--line-tolerance", line_tolerance_text, "D", "list samples this close to a line");
    add_value(parser, "--crossing-tolerance", crossing_tolerance_text, "DZ", "z that differ less agree");
    add_value(parser, "--conflicts", conflicts, "FILE", "write the conflicts of lines as points");
    parser.add_flag("--repair", repair, "write repaired lines into the folder -o");
    add_value(parser, "--crossing-z", crossing_z_text, "POLICY",
              "repair: mean (default)|first|min|max|error");
}

void AuditOptions::finish() {
    check.snap = distance_value("--snap", snap_text);
    check.dangling = distance_value("--dangling", dangling_text);
    check.line_tolerance = distance_value("--line-tolerance", line_tolerance_text).value_or(0);
    check.crossing_tolerance = distance_value("--crossing-tolerance", crossing_tolerance_text).value_or(0);
    if (!crossing_z_text.empty()) {
        if (!repair) {
            throw UsageError("--crossing-z is for repaired lines: give --repair too");
        }
        crossing_z = choice_value("--crossing-z", crossing_z_text, kPolicies);
    }
}

std::string AuditOptions::policy_name() const { return choice_name(crossing_z, kPolicies); }

}  // namespace tinwright::tools
