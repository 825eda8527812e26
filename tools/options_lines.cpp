#include "options_lines.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kConstraints =
    std::to_array<std::pair<std::string_view, bool>>({{"constrained", false}, {"conforming", true}});

constexpr auto kMethods = std::to_array<std::pair<std::string_view, ConformingMethod>>(
    {{"split", ConformingMethod::Split}, {"blocking", ConformingMethod::Blocking}});

double not_negative_value(std::string_view option, const std::string& text) {
    const double value = number_value(option, text);
    if (value < 0) {
        throw UsageError(std::string(option) + " needs a number from 0 up, not " + io::quoted(text));
    }
    return value;
}

}  // namespace

void LineOptions::add_sources_to(CLI::App& parser) {
    add_repeatable(parser, "--breaklines", breakline_texts, "SOURCE", "lines that the surface follows");
    add_repeatable(parser, "--boundary", boundary_texts, "SOURCE", "polygons outside which is no surface");
    add_repeatable(parser, "--holes", hole_texts, "SOURCE", "polygons without surface");
}

void LineOptions::add_all_sources_to(CLI::App& parser) {
    add_sources_to(parser);
    water.add_sources_to(parser);
    water.add_levels_to(parser, false);
}

void LineOptions::add_fitting_to(CLI::App& parser) {
    add_value(parser, "--snap", snap_text, "D", "move together points of lines closer than this");
    add_value(parser, "--crossing-z", crossing_z_text, "POLICY", "error (default)|mean|first|min|max");
    add_value(parser, "--crossing-tolerance", crossing_tolerance_text, "DZ",
              "z of lines that differ less agree");
    add_value(parser, "--line-tolerance", line_tolerance_text, "D", "report samples this close to a line");
}

void LineOptions::add_constraints_to(CLI::App& parser) {
    add_value(parser, "--constraints", constraints_text, "KIND", "constrained (default)|conforming");
    add_value(parser, "--conforming-method", method_text, "METHOD", "split (default)|blocking");
    add_value(parser, "--max-steiner", max_steiner_text, "N", "most Steiner points of a conforming TIN");
    add_value(parser, "--conflicts", conflicts, "FILE", "write conflicts of lines as points");
}

void LineOptions::finish(const std::vector<std::string>& open_options) {
    sources.clear();
    const auto add = [&](const std::vector<std::string>& texts, LineRole role) {
        add_line_sources(texts, role, open_options, sources);
    };
    add(breakline_texts, LineRole::Breakline);
    add(boundary_texts, LineRole::Boundary);
    add(hole_texts, LineRole::Hole);
    water.finish(open_options);
    water.check_roles(water.roles());
    sources.insert(sources.end(), water.sources.begin(), water.sources.end());
    if (sources.empty() && !first_given().empty()) {
        throw UsageError(first_given() + " is for lines: give --breaklines, --boundary or --holes too");
    }
    if (!snap_text.empty()) {
        noding.snap = not_negative_value("--snap", snap_text);
    }
    if (!crossing_z_text.empty()) {
        noding.crossing_z = choice_value("--crossing-z", crossing_z_text, kCrossingPolicies);
    }
    if (!crossing_tolerance_text.empty()) {
        noding.crossing_tolerance = not_negative_value("--crossing-tolerance", crossing_tolerance_text);
    }
    if (!line_tolerance_text.empty()) {
        line_tolerance = not_negative_value("--line-tolerance", line_tolerance_text);
    }
    conforming.reset();
    if (!constraints_text.empty() && choice_value("--constraints", constraints_text, kConstraints)) {
        conforming.emplace();
    }
    if (!conforming && !(method_text.empty() && max_steiner_text.empty())) {
        throw UsageError(std::string(method_text.empty() ? "--max-steiner" : "--conforming-method") +
                         " is for a conforming TIN: give --constraints conforming too");
    }
    if (!method_text.empty()) {
        conforming->method = choice_value("--conforming-method", method_text, kMethods);
    }
    if (!max_steiner_text.empty()) {
        conforming->max_steiner = static_cast<std::size_t>(whole_value("--max-steiner", max_steiner_text, 1));
    }
}

std::string LineOptions::first_given() const {
    const std::array<std::pair<const char*, bool>, 11> options = {
        {{"--breaklines", !breakline_texts.empty()},
         {"--boundary", !boundary_texts.empty()},
         {"--holes", !hole_texts.empty()},
         {"--constraints", !constraints_text.empty()},
         {"--conforming-method", !method_text.empty()},
         {"--max-steiner", !max_steiner_text.empty()},
         {"--snap", !snap_text.empty()},
         {"--crossing-z", !crossing_z_text.empty()},
         {"--crossing-tolerance", !crossing_tolerance_text.empty()},
         {"--line-tolerance", !line_tolerance_text.empty()},
         {"--conflicts", !conflicts.empty()}}};
    for (const auto& [name, is_given] : options) {
        if (is_given) {
            return name;
        }
    }
    return water.first_given();
}

WaterOptions LineOptions::water_options() const {
    WaterOptions options = water.options;
    options.meeting_levels = noding.crossing_z;
    return options;
}

std::vector<io::Source> LineOptions::plain_sources() const {
    std::vector<io::Source> list;
    list.reserve(sources.size());
    for (const io::LineSource& source : sources) {
        list.push_back(source.source);
    }
    return list;
}

void LineOptions::apply_to(TriangulateOptions& options) const {
    options.noding = noding;
    options.line_tolerance = line_tolerance;
    options.conforming = conforming;
}

std::string LineOptions::constraints_name() const {
    return sources.empty() ? std::string() : choice_name(conforming.has_value(), kConstraints);
}

std::string LineOptions::method_name() const {
    return conforming ? choice_name(conforming->method, kMethods) : std::string();
}

std::string LineOptions::policy_name() const { return choice_name(noding.crossing_z, kCrossingPolicies); }

std::string LineOptions::canonical() const {
    if (sources.empty()) {
        return {};
    }
    std::string text = " --constraints " + constraints_name();
    if (conforming) {
        text += " --conforming-method " + method_name();
        if (conforming->max_steiner > 0) {
            text += " --max-steiner " + std::to_string(conforming->max_steiner);
        }
    }
    if (noding.snap > 0) {
        text += " --snap " + decimal_text(noding.snap);
    }
    text += " --crossing-z " + policy_name();
    if (noding.crossing_tolerance > 0) {
        text += " --crossing-tolerance " + decimal_text(noding.crossing_tolerance);
    }
    return text + water.canonical();
}

}  // namespace tinwright::tools
