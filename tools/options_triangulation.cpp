#include "options_triangulation.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "tinwright/geometry/decimal.hpp"

#include "flat_faces_report.hpp"
#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr const char* kDelaunay = "delaunay";
constexpr const char* kNoOrder = "none";

using CriterionChoice = std::variant<std::monostate, Criterion, CreaseMeasure>;

constexpr auto kCriterionChoices =
    std::to_array<std::pair<std::string_view, CriterionChoice>>({{kDelaunay, std::monostate{}},
                                                                 {"slope", Criterion::Slope},
                                                                 {"height", Criterion::Height},
                                                                 {"angle", Criterion::Angle},
                                                                 {"eccentricity", Criterion::Eccentricity},
                                                                 {"length", Criterion::Length},
                                                                 {"normal-angle", CreaseMeasure::NormalAngle},
                                                                 {"normal-jump", CreaseMeasure::NormalJump}});

constexpr auto kPolicies =
    std::to_array<std::pair<std::string_view, DuplicatePolicy>>({{"error", DuplicatePolicy::Error},
                                                                 {"first", DuplicatePolicy::First},
                                                                 {"last", DuplicatePolicy::Last},
                                                                 {"min", DuplicatePolicy::Min},
                                                                 {"max", DuplicatePolicy::Max},
                                                                 {"mean", DuplicatePolicy::Mean},
                                                                 {"median", DuplicatePolicy::Median}});

DomainRule parse_domain(const std::string& text) {
    if (text == "convex") {
        return {DomainRule::Kind::Convex, 0};
    }
    if (text == "trimmed") {
        return {DomainRule::Kind::Trimmed, 0};
    }
    constexpr std::string_view kConcave = "concave:";
    if (text.starts_with(kConcave)) {
        const std::string length = text.substr(kConcave.size());
        return {DomainRule::Kind::Concave, positive_value("--domain concave:LENGTH", length)};
    }
    throw UsageError("--domain takes convex, trimmed or concave:LENGTH, not " + io::quoted(text));
}

double share_value(std::string text) {
    const std::string given = text;
    if (text.ends_with('%')) {
        text.pop_back();
    }
    const std::optional<double> percent = find_number(text);
    if (!percent || !(*percent > 0 && *percent <= 100)) {
        throw UsageError("--scope top:P% needs a number above 0 and up to 100, not " + io::quoted(given));
    }
    return *percent;
}

double stop_value(Criterion criterion, const std::string& text) {
    constexpr const char* kOption = "--scope above:VALUE";
    if (criterion == Criterion::Height) {
        return positive_value(kOption, text);
    }
    const double value = number_value(kOption, text);
    if (criterion == Criterion::Angle && !(value >= 60 && value <= 180)) {
        throw UsageError(std::string(kOption) + " needs degrees from 60 to 180, not " + io::quoted(text));
    }
    if (value < 0) {
        throw UsageError(std::string(kOption) + " needs a number from 0 up, not " + io::quoted(text));
    }
    return value;
}

Scope parse_scope(Criterion criterion, const std::string& text) {
    constexpr std::string_view kTop = "top:";
    constexpr std::string_view kAbove = "above:";
    if (text == "max") {
        return {Scope::Kind::Max, 0};
    }
    if (text == "vector") {
        return {Scope::Kind::Vector, 0};
    }
    if (text.starts_with(kTop)) {
        return {Scope::Kind::Top, share_value(text.substr(kTop.size()))};
    }
    if (text.starts_with(kAbove)) {
        return {Scope::Kind::Above, stop_value(criterion, text.substr(kAbove.size()))};
    }
    throw UsageError("--scope takes max, vector, top:P% or above:VALUE, not " + io::quoted(text));
}

/// Empty: no limit.
std::optional<int> parse_order(const std::string& text) {
    if (text == kNoOrder) {
        return std::nullopt;
    }
    return static_cast<int>(whole_value("--delaunay-order", text, 0));
}

}  // namespace

void TriangulationOptions::add_to(CLI::App& parser, const std::string& default_domain) {
    add_value(parser, "--criterion", criterion_text, "NAME", "slope|height|angle|length|..., see the manual");
    add_value(parser, "--scope", scope_text, "SCOPE", "max|vector|top:P%|above:VALUE (default top:0.5%)");
    add_value(parser, "--norm", norm_text, "NORM", "for length: l1|l2 (default)|linf|lp:P")->group("");
    add_value(parser, "--delaunay-order", order_text, "K|none", "for normal-* (default 3)");
    add_value(parser, "--budget", budget_text, "SECONDS", "stop optimising after this time");
    add_value(parser, "--domain", domain_text, "RULE",
              "convex|trimmed|concave:LENGTH (default " + default_domain + ")");
    add_value(parser, "--max-edge", max_edge_text, "LENGTH", "faces with a longer edge are voids");
    add_value(parser, "--flat-faces", flat_faces_text, "HOW", "keep (default)|swap|insert relief")->group("");
    add_value(parser, "--duplicates", duplicates_text, "POLICY", "error|first|last|min|max|mean|median");
    add_value(parser, "--duplicate-tolerance", tolerance_text, "DZ", "z that differ less do not conflict");
}

void TriangulationOptions::add_threads_to(CLI::App& parser) {
    add_value(parser, "-j,--threads", threads_text, "N", "threads (default: all processors)");
}

void TriangulationOptions::finish_criterion() {
    optimize = {};
    data_dependent = {};
    const CriterionChoice choice = criterion_text.empty()
                                       ? CriterionChoice()
                                       : choice_value("--criterion", criterion_text, kCriterionChoices);
    const auto* criterion = std::get_if<Criterion>(&choice);
    const auto* measure = std::get_if<CreaseMeasure>(&choice);
    const std::optional<double> budget =
        budget_text.empty() ? std::nullopt : std::optional(positive_value("--budget", budget_text));
    if (!order_text.empty() && measure == nullptr) {
        throw UsageError("--delaunay-order is for flips: give --criterion normal-angle or normal-jump too");
    }
    if (!norm_text.empty() && (criterion == nullptr || *criterion != Criterion::Length)) {
        throw UsageError(
            "--norm says how edges are measured: it is for --criterion length, and for --graph "
            "mst and rng of tinwright tin");
    }
    if (criterion != nullptr) {
        finish_optimum(*criterion);
        optimize->budget_seconds = budget;
    } else if (!scope_text.empty()) {
        throw UsageError(measure == nullptr
                             ? "--scope is for optimising: give --criterion slope, height, angle or "
                               "eccentricity too"
                             : "--scope does not apply to --criterion " + criterion_text +
                                   ", a sum over all edges; --delaunay-order limits its flips");
    } else if (measure != nullptr) {
        data_dependent.emplace().measure = *measure;
        data_dependent->budget_seconds = budget;
        if (!order_text.empty()) {
            data_dependent->delaunay_order = parse_order(order_text);
        }
    } else if (budget) {
        throw UsageError(
            "--budget is for optimising: give --criterion slope, height, angle, eccentricity or length too");
    }
}

void TriangulationOptions::finish_optimum(Criterion criterion) {
    optimize.emplace().criterion = criterion;
    if (!scope_text.empty()) {
        optimize->scope = parse_scope(criterion, scope_text);
    }
    if (criterion == Criterion::Length) {
        if (!scope_text.empty() && optimize->scope.kind != Scope::Kind::Max) {
            throw UsageError(
                "--scope " + scope_text +
                " does not apply to --criterion length, which makes the longest edge as short as "
                "it can be and knows no order of the others: leave --scope out, or give max");
        }
        optimize->scope = {Scope::Kind::Max, 0};
        optimize->norm = norm_value(norm_text);
    }
}

void TriangulationOptions::finish(DomainRule::Kind default_domain, DuplicatePolicy default_policy) {
    finish_criterion();
    domain = domain_text.empty() ? DomainRule{default_domain, 0} : parse_domain(domain_text);
    if (!max_edge_text.empty()) {
        max_edge = positive_value("--max-edge", max_edge_text);
    }
    flat_faces = treatment_value(flat_faces_text);
    if (flat_faces == FlatFaces::Swap && !is_delaunay()) {
        throw UsageError("--flat-faces swap does not go with --criterion " + criterion_name() +
                         ", which decides those edges again: give --flat-faces insert, whose points stay");
    }
    finish_samples(default_policy);
}

void TriangulationOptions::finish_samples(DuplicatePolicy default_policy) {
    duplicates.policy =
        duplicates_text.empty() ? default_policy : choice_value("--duplicates", duplicates_text, kPolicies);
    if (!tolerance_text.empty()) {
        duplicates.tolerance = number_value("--duplicate-tolerance", tolerance_text);
        if (duplicates.tolerance < 0) {
            throw UsageError("--duplicate-tolerance needs a number from 0 up, not " +
                             io::quoted(tolerance_text));
        }
    }
    threads = threads_text.empty() ? 0 : static_cast<int>(whole_value("--threads", threads_text, 0));
}

std::string TriangulationOptions::option_for_faces() const {
    const std::array<std::pair<const char*, bool>, 7> options = {
        {{"--criterion", !criterion_text.empty()},
         {"--scope", !scope_text.empty()},
         {"--delaunay-order", !order_text.empty()},
         {"--budget", !budget_text.empty()},
         {"--domain", !domain_text.empty()},
         {"--max-edge", !max_edge_text.empty()},
         {"--flat-faces", !flat_faces_text.empty()}}};
    for (const auto& [name, is_given] : options) {
        if (is_given) {
            return name;
        }
    }
    return {};
}

std::string TriangulationOptions::option_for_samples_only() const {
    if (!criterion_text.empty()) {
        return "--criterion";
    }
    if (!domain_text.empty()) {
        return "--domain";
    }
    if (!flat_faces_text.empty()) {
        return "--flat-faces";
    }
    if (!duplicates_text.empty()) {
        return "--duplicates";
    }
    return tolerance_text.empty() ? std::string() : "--duplicate-tolerance";
}

TriangulateOptions TriangulationOptions::library_options(const Progress& progress,
                                                         const Progress& optimize_progress) const {
    TriangulateOptions options;
    options.duplicates = duplicates;
    options.domain = domain;
    options.max_edge = max_edge;
    options.optimize = optimize;
    if (options.optimize) {
        options.optimize->progress = optimize_progress;
    }
    options.data_dependent = data_dependent;
    if (options.data_dependent) {
        options.data_dependent->progress = optimize_progress;
    }
    options.threads = threads;
    options.progress = progress;
    return options;
}

std::string TriangulationOptions::criterion_name() const {
    if (data_dependent) {
        return choice_name(data_dependent->measure, kCreaseMeasures);
    }
    return optimize ? std::string(criterion_traits(optimize->criterion).name) : kDelaunay;
}

std::string TriangulationOptions::norm_name() const {
    return optimize && optimize->criterion == Criterion::Length ? tinwright::norm_name(optimize->norm)
                                                                : std::string();
}

std::string TriangulationOptions::scope_name() const {
    if (!optimize) {
        return {};
    }
    const Scope& scope = optimize->scope;
    switch (scope.kind) {
        case Scope::Kind::Max:
            return "max";
        case Scope::Kind::Vector:
            return "vector";
        case Scope::Kind::Top:
            return "top:" + decimal_text(scope.value) + "%";
        case Scope::Kind::Above:
            return "above:" + decimal_text(scope.value);
    }
    return {};
}

std::string TriangulationOptions::order_name() const {
    if (!data_dependent) {
        return {};
    }
    const std::optional<int>& order = data_dependent->delaunay_order;
    return order ? std::to_string(*order) : kNoOrder;
}

std::string TriangulationOptions::domain_name() const {
    switch (domain.kind) {
        case DomainRule::Kind::Convex:
            return "convex";
        case DomainRule::Kind::Trimmed:
            return "trimmed";
        case DomainRule::Kind::Concave:
            return "concave:" + decimal_text(domain.length);
    }
    return {};
}

std::string TriangulationOptions::policy_name() const { return choice_name(duplicates.policy, kPolicies); }

std::string TriangulationOptions::canonical() const {
    std::string text = "--criterion " + criterion_name();
    if (const std::string norm = norm_name(); !norm.empty()) {
        text += " --norm " + norm;
    }
    if (optimize) {
        text += " --scope " + scope_name();
    }
    if (data_dependent) {
        text += " --delaunay-order " + order_name();
    }
    const std::optional<double> budget = optimize         ? optimize->budget_seconds
                                         : data_dependent ? data_dependent->budget_seconds
                                                          : std::nullopt;
    if (budget) {
        text += " --budget " + decimal_text(*budget);
    }
    text += " --domain " + domain_name();
    if (max_edge) {
        text += " --max-edge " + decimal_text(*max_edge);
    }
    if (flat_faces != FlatFaces::Keep) {
        text += " --flat-faces " + treatment_name(flat_faces);
    }
    return text + " " + canonical_samples();
}

std::string TriangulationOptions::canonical_samples() const {
    std::string text = "--duplicates " + policy_name();
    if (duplicates.tolerance > 0) {
        text += " --duplicate-tolerance " + decimal_text(duplicates.tolerance);
    }
    return text;
}

Norm norm_value(const std::string& text) {
    if (text.empty()) {
        return {};
    }
    const std::optional<Norm> norm = find_norm(text);
    if (!norm) {
        throw UsageError("--norm takes l1, l2, linf or lp:P with a whole number P from 1 to " +
                         std::to_string(Norm::kLargestPower) + ", not " + io::quoted(text));
    }
    return *norm;
}

}  // namespace tinwright::tools
