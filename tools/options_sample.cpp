#include "options_sample.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kSlopeUnits = std::to_array<std::pair<std::string_view, SlopeUnit>>(
    {{"degree", SlopeUnit::Degree}, {"percent", SlopeUnit::Percent}, {"ratio", SlopeUnit::Ratio}});

bool is_negative_coordinate(const std::string& text) {
    return text.starts_with('-') && find_coordinate(text).has_value();
}

}  // namespace

std::optional<Point2> find_coordinate(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        return std::nullopt;
    }
    const std::size_t second = text.find_first_not_of(' ', comma + 1);
    const std::optional<double> x = find_number(text.substr(0, comma));
    const std::optional<double> y =
        second == std::string::npos ? std::nullopt : find_number(text.substr(second));
    return x && y ? std::optional(Point2{*x, *y}) : std::nullopt;
}

std::vector<std::string> rewrite_coordinates(const std::vector<std::string>& arguments) {
    std::vector<std::string> rewritten;
    rewritten.reserve(arguments.size());
    bool is_text = false;
    for (const std::string& token : arguments) {
        is_text = is_text || token == "--";
        if (is_text || !is_negative_coordinate(token)) {
            rewritten.push_back(token);
        } else if (!rewritten.empty() && rewritten.back() == "--at") {
            rewritten.back() += "=" + token;
        } else {
            rewritten.push_back("--at=" + token);
        }
    }
    return rewritten;
}

void SampleOptions::add_to(CLI::App& parser) {
    add_repeatable(parser, "--at", at_texts, "SOURCE|X,Y", "points or lines to read the surface at");
    add_value(parser, "--step", step_text, "LENGTH", "lines: a point every so often besides");
    add_slope_unit_to(parser);
    add_value(parser, "--plot", plot, "FILE", "lines: their profiles as .svg or .png");
}

void SampleOptions::add_slope_unit_to(CLI::App& parser) {
    add_value(parser, "--slope-unit", slope_unit_text, "UNIT", "degree, percent or ratio");
}

void SampleOptions::finish(const std::vector<std::string>& open_options) {
    at.clear();
    for (const std::string& text : at_texts) {
        const std::optional<Point2> position = find_coordinate(text);
        if (!position) {
            io::Source source = io::parse_source(text);
            source.open_options.insert(source.open_options.begin(), open_options.begin(), open_options.end());
            at.emplace_back(std::move(source));
        } else if (std::isfinite(position->x) && std::isfinite(position->y)) {
            at.emplace_back(*position);
        } else {
            throw UsageError("--at needs two finite numbers X,Y, not " + io::quoted(text));
        }
    }
    step = step_text.empty() ? 0 : positive_value("--step", step_text);
    slope_unit = choice_value("--slope-unit", slope_unit_text, kSlopeUnits);
    if (!plot.empty() && !plot.ends_with(".svg") && !plot.ends_with(".png")) {
        throw UsageError("--plot writes .svg and .png, not " + io::quoted(plot));
    }
}

std::vector<io::Source> SampleOptions::sources() const {
    std::vector<io::Source> sources;
    for (const Whereabouts& where : at) {
        if (const auto* const source = std::get_if<io::Source>(&where)) {
            sources.push_back(*source);
        }
    }
    return sources;
}

std::string SampleOptions::canonical() const {
    std::string text = slope_unit == SlopeUnit::Degree ? "" : "--slope-unit " + slope_unit_text;
    if (step > 0) {
        text += (text.empty() ? "--step " : " --step ") + decimal_text(step);
    }
    return text;
}

}  // namespace tinwright::tools
