#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "tinwright/criteria/length.hpp"
#include "tinwright/geometry/decimal.hpp"

#include "criterion_report.hpp"

namespace tinwright::tools {

namespace {

constexpr std::string_view kLength = LengthCriterion::kTraits.name;

std::string short_number(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

/// "12.3 -> 4.91", or one of the two alone.
std::string change_text(std::optional<double> before, std::optional<double> after) {
    if (before && after) {
        return short_number(*before) + " -> " + short_number(*after);
    }
    return before || after ? short_number(before ? *before : *after) : std::string();
}

/// "largest angle", "least height", "greatest slope".
std::string worst_name(const std::string& criterion) {
    const std::optional<Criterion> known = find_criterion(criterion);
    const std::string measure(known ? criterion_traits(*known).measure : criterion);
    return measure.find(' ') == std::string::npos ? "greatest " + measure : measure;
}

/// "greatest slope 12.3 -> 4.91 (interior 8.2 -> 3.3)".
std::string worst_line(const CriterionReport& report) {
    std::string unit;
    if (report.unit == "degree") {
        unit = " deg";
    } else if (report.unit != "ratio" && report.unit != kUnknownLengthUnit && !report.unit.empty()) {
        unit = " " + report.unit;
    }
    std::string line =
        worst_name(report.name) + " " + change_text(report.worst_delaunay, report.worst) + unit;
    const std::string interior = change_text(report.worst_interior_delaunay, report.worst_interior);
    return interior.empty() ? line : line + " (interior " + interior + unit + ")";
}

std::string stop_text(const CriterionReport& report) {
    return "stopped by " + std::string(report.stopped_by == "budget" ? "the budget" : "an interrupt");
}

bool is_stopped(const CriterionReport& report) {
    return report.stopped_by == "budget" || report.stopped_by == "interrupt";
}

/// Of the longest edge, which has a proof or was stopped.
std::string length_proof_line(const CriterionReport& report) {
    if (is_stopped(report)) {
        return "not proven the shortest possible: " + stop_text(report);
    }
    if (report.proven != "theorem") {
        return "not proven the shortest possible";
    }
    return std::string("proven: no triangulation has a shorter longest edge") +
           (report.worst == report.worst_delaunay ? "; the Delaunay TIN's is as short" : "");
}

std::string proof_line(const CriterionReport& report) {
    if (report.name == kLength) {
        return length_proof_line(report);
    }
    const std::string what = report.scope == "vector" ? "every face" : "the worst face";
    if (report.proven == "theorem") {
        return what + " proven optimal (theorem)";
    }
    if (report.proven == "tested") {
        return what + " tested to be optimal; equal measures, which the theorem excludes, were met";
    }
    if (is_stopped(report)) {
        return "not proven optimal: " + stop_text(report);
    }
    return "not proven optimal: the scope ends before a face that cannot be improved; choose --scope max for "
           "a proof";
}

/// "normal-angle, Delaunay order 3", and how that went.
std::vector<std::string> crease_lines(const CriterionReport& report, const std::string& source) {
    const bool is_limited = !report.delaunay_order.empty() && report.delaunay_order != "none";
    std::vector<std::string> lines{
        report.name + (is_limited ? ", Delaunay order " + report.delaunay_order : ", no limit of order") +
        source};
    lines.push_back("sum of creases " + change_text(report.sum_delaunay, report.sum) +
                    (report.unit == "degree" ? " deg" : ""));
    lines.push_back(is_stopped(report)
                        ? stop_text(report)
                        : "a heuristic: no flip lowers the sum any more, which proves nothing of other TINs");
    if (report.flips && report.refused) {
        lines.push_back(decimal_text(*report.flips) + (*report.flips == 1 ? " flip, " : " flips, ") +
                        decimal_text(*report.refused) + " refused by the order");
    }
    return lines;
}

std::string counted(std::size_t count, const char* singular, const char* plural) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string counts_line(const OptimizeReport& counts) {
    return counted(counts.insertions, "edge", "edges") + " inserted of " + std::to_string(counts.candidates) +
           " considered, " + counted(counts.tries, "face", "faces") + " tried, " +
           std::to_string(counts.frozen) + " as good as can be, " +
           (counts.ties == 0 ? "no ties" : counted(counts.ties, "tie", "ties"));
}

/// Empty when it was stopped before any polygon was looked at.
std::string polygons_line(const LengthReport& length, bool was_stopped) {
    if (length.polygons == 0) {
        return was_stopped ? "" : "the longest edge is one of border, lines or relative neighbours";
    }
    const std::string sides = counted(length.largest, "side", "sides");
    return counted(length.polygons, "polygon", "polygons") + " between relative neighbours looked at, " +
           (length.polygons == 1 ? "of " + sides : "up to " + sides + " each") + ", " +
           std::to_string(length.changed) + " triangulated anew";
}

}  // namespace

std::vector<std::string> criterion_lines(const CriterionReport& report) {
    const std::string source = report.is_from_file ? " (as the file says)" : "";
    if (report.sum) {
        return crease_lines(report, source);
    }
    if (!report.worst) {
        return {};
    }
    std::vector<std::string> lines{report.name + (report.norm.empty() ? "" : ", norm " + report.norm) +
                                   ", scope " + report.scope + source};
    lines.push_back(worst_line(report));
    lines.push_back(proof_line(report));
    if (report.counts) {
        lines.push_back(counts_line(*report.counts));
    }
    if (report.length) {
        if (std::string polygons = polygons_line(*report.length, is_stopped(report)); !polygons.empty()) {
            lines.push_back(std::move(polygons));
        }
    }
    return lines;
}

std::vector<std::string> criterion_warnings(const TriangulationOptions& options,
                                            const TriangulateReport& result) {
    std::vector<std::string> warnings;
    const std::string what =
        options.data_dependent ? "the TIN is valid but flips could lower its sum of creases further"
        : options.criterion_name() == kLength
            ? "the TIN is valid but its longest edge is not proven the shortest possible"
            : "the TIN is valid but its worst " + options.criterion_name() + " is not proven optimal";
    const auto [stopped_by, budget] =
        result.optimize ? std::pair(result.optimize->stopped_by, options.optimize->budget_seconds)
        : result.data_dependent
            ? std::pair(result.data_dependent->stopped_by, options.data_dependent->budget_seconds)
            : std::pair(StoppedBy::Finished, std::optional<double>());
    if (stopped_by == StoppedBy::Budget) {
        warnings.push_back("the budget of " + decimal_text(budget.value_or(0)) + " s ran out: " + what +
                           "; give a longer --budget");
    } else if (stopped_by == StoppedBy::Interrupt) {
        warnings.push_back("interrupted while optimising: " + what);
    }
    return warnings;
}

bool is_about_slopes(const TriangulationOptions& options) {
    return options.data_dependent || (options.optimize && options.optimize->criterion == Criterion::Slope);
}

std::string slope_warning(const io::Crs& crs, const std::string& z_unit) {
    const std::string unit = crs.is_geographic() ? std::string() : crs.unit();
    if (unit.empty() == z_unit.empty()) {
        return {};  // both known, or nothing that could differ
    }
    return z_unit.empty() ? "the unit of z is unknown; taken to be that of the CRS, " + unit +
                                ", in slopes; --z-unit tells it"
                          : "the CRS's unit is unknown; slopes take z, in " + z_unit + ", to be in it";
}

}  // namespace tinwright::tools
