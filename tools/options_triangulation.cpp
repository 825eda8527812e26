#include "options_triangulation.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kCriteria = std::to_array<std::pair<std::string_view, int>>({{"delaunay", 0}});

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

}  // namespace

void TriangulationOptions::add_to(CLI::App& parser, const std::string& default_domain) {
    add_value(parser, "--criterion", criterion, "NAME", "what the TIN is best at: delaunay");
    add_value(parser, "--domain", domain_text, "RULE",
              "convex|trimmed|concave:LENGTH (default " + default_domain + ")");
    add_value(parser, "--max-edge", max_edge_text, "LENGTH", "faces with a longer edge are voids");
    add_value(parser, "--duplicates", duplicates_text, "POLICY", "error|first|last|min|max|mean|median");
    add_value(parser, "--duplicate-tolerance", tolerance_text, "DZ", "z that differ less do not conflict");
}

void TriangulationOptions::add_threads_to(CLI::App& parser) {
    add_value(parser, "-j,--threads", threads_text, "N", "threads (default: all processors)");
}

void TriangulationOptions::finish(DomainRule::Kind default_domain, DuplicatePolicy default_policy) {
    choice_value("--criterion", criterion, kCriteria);
    domain = domain_text.empty() ? DomainRule{default_domain, 0} : parse_domain(domain_text);
    if (!max_edge_text.empty()) {
        max_edge = positive_value("--max-edge", max_edge_text);
    }
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

std::string TriangulationOptions::option_for_samples_only() const {
    if (!domain_text.empty()) {
        return "--domain";
    }
    if (!duplicates_text.empty()) {
        return "--duplicates";
    }
    return tolerance_text.empty() ? std::string() : "--duplicate-tolerance";
}

TriangulateOptions TriangulationOptions::library_options(const Progress& progress) const {
    TriangulateOptions options;
    options.duplicates = duplicates;
    options.domain = domain;
    options.max_edge = max_edge;
    options.threads = threads;
    options.progress = progress;
    return options;
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
    std::string text = "--criterion " + criterion + " --domain " + domain_name();
    if (max_edge) {
        text += " --max-edge " + decimal_text(*max_edge);
    }
    text += " --duplicates " + policy_name();
    if (duplicates.tolerance > 0) {
        text += " --duplicate-tolerance " + decimal_text(duplicates.tolerance);
    }
    return text;
}

}  // namespace tinwright::tools
