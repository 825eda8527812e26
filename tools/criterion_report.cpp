#include "criterion_report.hpp"

#include <array>
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

std::string unit_of(Criterion criterion, const io::Crs& crs) {
    switch (criterion_traits(criterion).unit) {
        case MeasureUnit::Degree:
            return "degree";
        case MeasureUnit::Ratio:
            return "ratio";
        case MeasureUnit::Length:
            break;
    }
    return crs.unit().empty() ? kUnknownLengthUnit : crs.unit();
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
                               TextKey{"TINWRIGHT_NORM", &CriterionReport::norm},
                               TextKey{"TINWRIGHT_SCOPE", &CriterionReport::scope},
                               TextKey{"TINWRIGHT_DELAUNAY_ORDER", &CriterionReport::delaunay_order},
                               TextKey{"TINWRIGHT_UNIT", &CriterionReport::unit},
                               TextKey{"TINWRIGHT_PROVEN", &CriterionReport::proven},
                               TextKey{"TINWRIGHT_STOPPED_BY", &CriterionReport::stopped_by}};

template <class Counts>
struct CountKey {
    const char* metadata;
    const char* json;
    std::size_t Counts::*value;
};

constexpr auto kCountKeys = std::to_array<CountKey<OptimizeReport>>(
    {{"TINWRIGHT_TIES", "ties", &OptimizeReport::ties},
     {"TINWRIGHT_FROZEN", "frozen", &OptimizeReport::frozen},
     {"TINWRIGHT_INSERTIONS", "insertions", &OptimizeReport::insertions},
     {"TINWRIGHT_TRIES", "tries", &OptimizeReport::tries},
     {"TINWRIGHT_CANDIDATES", "candidates", &OptimizeReport::candidates}});

constexpr auto kLengthKeys = std::to_array<CountKey<LengthReport>>(
    {{"TINWRIGHT_GRAPH_EDGES", "graph_edges", &LengthReport::graph_edges},
     {"TINWRIGHT_POLYGONS", "polygons", &LengthReport::polygons},
     {"TINWRIGHT_INCOMPLETE", "incomplete", &LengthReport::incomplete},
     {"TINWRIGHT_LARGEST_POLYGON", "largest_polygon", &LengthReport::largest},
     {"TINWRIGHT_CHANGED", "changed", &LengthReport::changed}});

/// Whole numbers, as many digits as they need.
constexpr std::array kFlipKeys{WorstKey{"TINWRIGHT_FLIPS", "flips", &CriterionReport::flips},
                               WorstKey{"TINWRIGHT_REFUSED", "refused", &CriterionReport::refused}};

/// All of them, or nothing.
template <class Counts, std::size_t N>
std::optional<Counts> read_counts(const io::TinMetadata& metadata,
                                  const std::array<CountKey<Counts>, N>& keys) {
    constexpr double kGreatestCount = 1e15;
    Counts counts;
    for (const CountKey<Counts>& key : keys) {
        const std::optional<double> count = find_number(metadata_value(metadata, key.metadata));
        if (!count || !(*count >= 0 && *count < kGreatestCount)) {
            return std::nullopt;
        }
        counts.*key.value = static_cast<std::size_t>(*count);
    }
    return counts;
}

template <class Counts, std::size_t N>
void add_counts(io::TinMetadata& metadata, const std::optional<Counts>& counts,
                const std::array<CountKey<Counts>, N>& keys) {
    for (const CountKey<Counts>& key : keys) {
        if (counts) {
            metadata.emplace_back(key.metadata, std::to_string((*counts).*key.value));
        }
    }
}

template <class Counts, std::size_t N>
void set_counts(JsonValue& json, const std::optional<Counts>& counts,
                const std::array<CountKey<Counts>, N>& keys) {
    for (const CountKey<Counts>& key : keys) {
        if (counts) {
            json.set(key.json, (*counts).*key.value);
        }
    }
}

JsonValue proven_json(const std::string& proven) {
    return proven == "false" ? JsonValue(false) : JsonValue(proven);
}

}  // namespace

double told_factor(Criterion criterion, double z_factor) {
    return criterion == Criterion::Slope ? z_factor : 1;
}

CriterionReport make_criterion_report(const TriangulationOptions& options, const TriangulateReport& result,
                                      const io::Crs& crs, double z_factor) {
    CriterionReport report;
    report.name = options.criterion_name();
    report.norm = options.norm_name();
    report.scope = options.scope_name();
    report.delaunay_order = options.order_name();
    if (options.optimize && result.optimize) {
        const OptimizeReport& optimum = *result.optimize;
        report.unit = unit_of(options.optimize->criterion, crs);
        const double factor = told_factor(options.optimize->criterion, z_factor);
        const auto told = [factor](std::optional<double> measure) {
            return measure ? std::optional(factor * *measure) : measure;
        };
        report.worst = told(optimum.after.all);
        report.worst_interior = told(optimum.after.interior);
        report.worst_delaunay = told(optimum.before.all);
        report.worst_interior_delaunay = told(optimum.before.interior);
        report.proven = choice_name(optimum.proof, kProofs);
        report.stopped_by = choice_name(optimum.stopped_by, kStops);
        report.length = optimum.length;
        if (!report.length) {
            report.counts = optimum;
        }
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
    report.counts = read_counts(metadata, kCountKeys);
    report.length = read_counts(metadata, kLengthKeys);
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
    add_counts(metadata, report.counts, kCountKeys);
    add_counts(metadata, report.length, kLengthKeys);
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
    if (!report.norm.empty()) {
        json.set("norm", report.norm);
    }
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
    set_counts(json, report.counts, kCountKeys);
    set_counts(json, report.length, kLengthKeys);
    for (const WorstKey& key : kFlipKeys) {
        if (const std::optional<double>& value = report.*key.value) {
            json.set(key.json, *value);
        }
    }
    return json;
}

}  // namespace tinwright::tools
