#include "options_contour.hpp"

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

std::vector<double> parse_levels(const std::string& text) {
    std::vector<double> levels;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        levels.push_back(number_value("--levels", text.substr(start, end - start)));
        start = end + 1;
    }
    return levels;
}

}  // namespace

void ContourChoice::add_to(CLI::App& parser) {
    add_value(parser, "--interval", interval_text, "D", "levels B + k D, for every whole k");
    add_value(parser, "--base", base_text, "B", "of --interval (default 0)");
    add_value(parser, "--levels", levels_text, "V,V,...", "these levels (too)");
    add_value(parser, "--index", index_text, "N", "mark every N-th line of --interval (is_index)");
    parser.add_flag("--polygons", is_bands, "the bands between levels, not lines");
    add_value(parser, "--tolerance", tolerance_text, "DZ", "of traced lines, in elevation (default D/20)");
}

void ContourChoice::finish(bool is_linear) {
    if (!interval_text.empty()) {
        request.interval = positive_value("--interval", interval_text);
    }
    if (!base_text.empty()) {
        request.base = number_value("--base", base_text);
        if (!request.interval) {
            throw UsageError("--base is where the levels of --interval start: give --interval too");
        }
    }
    if (!levels_text.empty()) {
        request.levels = parse_levels(levels_text);
    }
    if (!index_text.empty()) {
        request.index_every = static_cast<int>(whole_value("--index", index_text, 1));
        if (!request.interval) {
            throw UsageError("--index counts the lines of --interval: give --interval too");
        }
        if (is_bands) {
            throw UsageError("--index marks lines: it does not go with --polygons");
        }
    }
    if (!tolerance_text.empty()) {
        tolerance = positive_value("--tolerance", tolerance_text);
        if (is_linear) {
            throw UsageError(
                "--tolerance is for surfaces that are traced: lines of --method linear are exact");
        }
    }
    check_contours(request);
}

std::string ContourChoice::canonical() const {
    std::string text;
    const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
    if (request.interval) {
        add("--interval " + decimal_text(*request.interval));
        add("--base " + decimal_text(request.base));
    }
    if (!request.levels.empty()) {
        add("--levels");
        const char* separator = " ";
        for (const double level : request.levels) {
            text += separator + decimal_text(level);
            separator = ",";
        }
    }
    if (request.index_every > 0) {
        add("--index " + std::to_string(request.index_every));
    }
    if (is_bands) {
        add("--polygons");
    }
    if (tolerance) {
        add("--tolerance " + decimal_text(*tolerance));
    }
    return text;
}

}  // namespace tinwright::tools
