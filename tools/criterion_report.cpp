#include "criterion_report.hpp"

#include <array>
#include <cstdio>
#include <numbers>
#include <utility>

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kProofs = std::to_array<std::pair<std::string_view, Proof>>(
    {{"theorem", Proof::Theorem}, {"tested", Proof::Tested}, {"false", Proof::None}});

constexpr auto kStops = std::to_array<std::pair<std::string_view, StoppedBy>>(
    {{"finished", StoppedBy::Finished}, {"budget", StoppedBy::Budget}, {"interrupt", StoppedBy::Interrupt}});

constexpr const char* kUnknownUnit = "CRS unit";

std::string unit_of(Criterion criterion, const io::Crs& crs) {
    switch (criterion_traits(criterion).unit) {
        case MeasureUnit::Degree:
            return "degree";
        case MeasureUnit::Ratio:
            return "ratio";
        case MeasureUnit::Length:
            break;
    }
    return crs.unit().empty() ? kUnknownUnit : crs.unit();
}

/// The keys of the measures, in the metadata and in JSON.
struct WorstKey {
    const char* metadata;
    const char* json;
    std::optional<double> CriterionReport::*value;
};

constexpr std::array kWorstKeys{
    WorstKey{"TINWRIGHT_WORST", "worst", &CriterionReport::worst},
    WorstKey{"TINWRIGHT_WORST_INTERIOR", "worst_interior", &CriterionReport::worst_interior},
    WorstKey{"TINWRIGHT_WORST_DELAUNAY", "worst_delaunay", &CriterionReport::worst_delaunay},
    WorstKey{"TINWRIGHT_WORST_INTERIOR_DELAUNAY", "worst_interior_delaunay",
             &CriterionReport::worst_interior_delaunay},
    WorstKey{"TINWRIGHT_SUM", "sum", &CriterionReport::sum},
    WorstKey{"TINWRIGHT_SUM_DELAUNAY", "sum_delaunay", &CriterionReport::sum_delaunay}};

struct TextKey {
    const char* metadata;
    std::string CriterionReport::*value;
};

constexpr std::array kTextKeys{TextKey{"TINWRIGHT_CRITERION", &CriterionReport::name},
                               TextKey{"TINWRIGHT_SCOPE", &CriterionReport::scope},
                               TextKey{"TINWRIGHT_DELAUNAY_ORDER", &CriterionReport::delaunay_order},
                               TextKey{"TINWRIGHT_UNIT", &CriterionReport::unit},
                               TextKey{"TINWRIGHT_PROVEN", &CriterionReport::proven},
                               TextKey{"TINWRIGHT_STOPPED_BY", &CriterionReport::stopped_by}};

struct CountKey {
    const char* metadata;
    const char* json;
    std::size_t OptimizeReport::*value;
};

constexpr std::array kCountKeys{CountKey{"TINWRIGHT_TIES", "ties", &OptimizeReport::ties},
                                CountKey{"TINWRIGHT_FROZEN", "frozen", &OptimizeReport::frozen},
                                CountKey{"TINWRIGHT_INSERTIONS", "insertions", &OptimizeReport::insertions},
                                CountKey{"TINWRIGHT_TRIES", "tries", &OptimizeReport::tries},
                                CountKey{"TINWRIGHT_CANDIDATES", "candidates", &OptimizeReport::candidates}};

/// Whole numbers, as many digits as they need.
constexpr std::array kFlipKeys{WorstKey{"TINWRIGHT_FLIPS", "flips", &CriterionReport::flips},
                               WorstKey{"TINWRIGHT_REFUSED", "refused", &CriterionReport::refused}};

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
    } else if (report.unit != "ratio" && report.unit != kUnknownUnit && !report.unit.empty()) {
        unit = " " + report.unit;
    }
    std::string line =
        worst_name(report.name) + " " + change_text(report.worst_delaunay, report.worst) + unit;
    const std::string interior = change_text(report.worst_interior_delaunay, report.worst_interior);
    return interior.empty() ? line : line + " (interior " + interior + unit + ")";
}

std::string proof_line(const CriterionReport& report) {
    const std::string what = report.scope == "vector" ? "every face" : "the worst face";
    if (report.proven == "theorem") {
        return what + " proven optimal (theorem)";
    }
    if (report.proven == "tested") {
        return what + " tested to be optimal; equal measures, which the theorem excludes, were met";
    }
    if (report.stopped_by == "budget" || report.stopped_by == "interrupt") {
        return "not proven optimal: stopped by " +
               std::string(report.stopped_by == "budget" ? "the budget" : "an interrupt");
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
    lines.push_back(report.stopped_by == "budget" || report.stopped_by == "interrupt"
                        ? "stopped by " +
                              std::string(report.stopped_by == "budget" ? "the budget" : "an interrupt")
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

JsonValue proven_json(const std::string& proven) {
    return proven == "false" ? JsonValue(false) : JsonValue(proven);
}

/// Why slopes are not rise over run in one unit; empty if they are.
std::string slope_unit_doubt(const io::Crs& crs, const std::string& z_unit) {
    if (crs.is_geographic()) {
        return "the CRS is in degrees";
    }
    if (crs.unit().empty()) {
        return "the units are unknown";
    }
    if (z_unit.empty()) {
        return "the unit of z is unknown, that of the CRS is " + crs.unit();
    }
    return z_unit == crs.unit() ? std::string() : "z is in " + z_unit + ", the CRS in " + crs.unit();
}

}  // namespace

CriterionReport make_criterion_report(const TriangulationOptions& options, const TriangulateReport& result,
                                      const io::Crs& crs) {
    CriterionReport report;
    report.name = options.criterion_name();
    report.scope = options.scope_name();
    report.delaunay_order = options.order_name();
    if (options.optimize && result.optimize) {
        const OptimizeReport& optimum = *result.optimize;
        report.unit = unit_of(options.optimize->criterion, crs);
        report.worst = optimum.after.all;
        report.worst_interior = optimum.after.interior;
        report.worst_delaunay = optimum.before.all;
        report.worst_interior_delaunay = optimum.before.interior;
        report.proven = choice_name(optimum.proof, kProofs);
        report.stopped_by = choice_name(optimum.stopped_by, kStops);
        report.counts = optimum;
    } else if (options.data_dependent && result.data_dependent) {
        const DataDependentReport& flipped = *result.data_dependent;
        const bool is_angle = options.data_dependent->measure == CreaseMeasure::NormalAngle;
        const double unit = is_angle ? 180 / std::numbers::pi : 1;
        report.unit = is_angle ? "degree" : "ratio";
        report.sum = flipped.sum_after * unit;
        report.sum_delaunay = flipped.sum_before * unit;
        report.proven = choice_name(Proof::None, kProofs);
        report.stopped_by = choice_name(flipped.stopped_by, kStops);
        report.flips = static_cast<double>(flipped.flips);
        report.refused = static_cast<double>(flipped.refused);
    }
    return report;
}

CriterionReport read_criterion_report(const io::TinMetadata& metadata) {
    constexpr double kGreatestCount = 1e15;
    CriterionReport report;
    for (const TextKey& key : kTextKeys) {
        report.*key.value = metadata_value(metadata, key.metadata);
    }
    for (const WorstKey& key : kWorstKeys) {
        report.*key.value = find_number(metadata_value(metadata, key.metadata));
    }
    for (const WorstKey& key : kFlipKeys) {
        report.*key.value = find_number(metadata_value(metadata, key.metadata));
    }
    OptimizeReport counts;
    bool is_counted = true;
    for (const CountKey& key : kCountKeys) {
        const std::optional<double> count = find_number(metadata_value(metadata, key.metadata));
        is_counted = is_counted && count && *count >= 0 && *count < kGreatestCount;
        counts.*key.value = is_counted ? static_cast<std::size_t>(*count) : 0;
    }
    if (is_counted) {
        report.counts = counts;
    }
    report.is_from_file = true;
    return report;
}

io::TinMetadata criterion_metadata(const CriterionReport& report) {
    io::TinMetadata metadata;
    for (const TextKey& key : kTextKeys) {
        if (!(report.*key.value).empty()) {
            metadata.emplace_back(key.metadata, report.*key.value);
        }
    }
    for (const WorstKey& key : kWorstKeys) {
        if (const std::optional<double>& value = report.*key.value) {
            metadata.emplace_back(key.metadata, decimal_text(*value));
        }
    }
    for (const CountKey& key : kCountKeys) {
        if (report.counts) {
            metadata.emplace_back(key.metadata, std::to_string((*report.counts).*key.value));
        }
    }
    for (const WorstKey& key : kFlipKeys) {
        if (const std::optional<double>& value = report.*key.value) {
            metadata.emplace_back(key.metadata, decimal_text(*value));
        }
    }
    return metadata;
}

JsonValue criterion_json(const CriterionReport& report) {
    JsonValue json = JsonValue::object();
    json.set("name", report.name);
    if (!report.scope.empty()) {
        json.set("scope", report.scope);
    }
    if (const std::optional<double> order = find_number(report.delaunay_order)) {
        json.set("delaunay_order", *order);
    }
    for (const WorstKey& key : kWorstKeys) {
        if (const std::optional<double>& value = report.*key.value) {
            json.set(key.json, *value);
        }
    }
    if (!report.unit.empty()) {
        json.set("unit", report.unit);
    }
    if (!report.proven.empty()) {
        json.set("proven", proven_json(report.proven));
    }
    if (!report.stopped_by.empty()) {
        json.set("stopped_by", report.stopped_by);
    }
    for (const CountKey& key : kCountKeys) {
        if (report.counts) {
            json.set(key.json, (*report.counts).*key.value);
        }
    }
    for (const WorstKey& key : kFlipKeys) {
        if (const std::optional<double>& value = report.*key.value) {
            json.set(key.json, *value);
        }
    }
    return json;
}

std::vector<std::string> criterion_lines(const CriterionReport& report) {
    const std::string source = report.is_from_file ? " (as the file says)" : "";
    if (report.sum) {
        return crease_lines(report, source);
    }
    if (!report.worst) {
        return {};
    }
    std::vector<std::string> lines{report.name + ", scope " + report.scope + source};
    lines.push_back(worst_line(report));
    lines.push_back(proof_line(report));
    if (report.counts) {
        lines.push_back(counts_line(*report.counts));
    }
    return lines;
}

std::vector<std::string> criterion_warnings(const TriangulationOptions& options,
                                            const TriangulateReport& result, const io::Crs& crs,
                                            const std::string& z_unit) {
    std::vector<std::string> warnings;
    const bool is_slope =
        options.data_dependent || (options.optimize && options.optimize->criterion == Criterion::Slope);
    const std::string doubt = is_slope ? slope_unit_doubt(crs, z_unit) : std::string();
    if (!doubt.empty()) {
        const bool is_angle =
            options.data_dependent && options.data_dependent->measure == CreaseMeasure::NormalAngle;
        warnings.push_back((is_angle ? "angles between normals take z for CRS units: "
                                     : "slopes are z units per CRS unit: ") +
                           doubt);
    }
    const std::string what =
        options.data_dependent
            ? "the TIN is valid but flips could lower its sum of creases further"
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

std::string slope_warning(const io::Crs& crs, const std::string& z_unit) {
    const bool is_known = crs.is_geographic() || (!crs.unit().empty() && !z_unit.empty());
    const std::string doubt = is_known ? slope_unit_doubt(crs, z_unit) : std::string();
    return doubt.empty() ? doubt : "slopes are z units per CRS unit: " + doubt;
}

}  // namespace tinwright::tools
