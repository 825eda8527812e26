#include "options_crs.hpp"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/length_unit.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kHeights =
    std::to_array<std::pair<std::string_view, bool>>({{"orthometric", false}, {"ellipsoidal", true}});

std::string unit_value(const std::string& option, const std::string& text) {
    const std::optional<io::LengthUnit> unit = io::find_length_unit(text);
    if (!unit) {
        throw UsageError(option + " takes a unit of length, metre, foot or us-survey-foot for example, not " +
                         io::quoted(text));
    }
    return unit->name;
}

/// "0.1%" or "0.1", percent, as a part of one.
double distortion_value(std::string text) {
    const std::string given = text;
    if (text.ends_with('%')) {
        text.pop_back();
    }
    const std::optional<double> percent = find_number(text);
    if (!percent || !(*percent > 0) || !(*percent <= 100)) {
        throw UsageError("--max-distortion takes percent, above 0 and up to 100, not " + io::quoted(given));
    }
    return *percent / 100;
}

double epoch_value(const std::string& text) {
    const double year = number_value("--epoch", text);
    if (!(year >= 1900 && year <= 2200)) {
        throw UsageError("--epoch takes a decimal year, 2020.5 for example, not " + io::quoted(text));
    }
    return year;
}

/// An option whose value, an unset variable of a shell say, must not be empty.
CLI::Option* add_filled(CLI::App& parser, const std::string& name, std::string& text,
                        const std::string& placeholder, const std::string& help) {
    return add_value(parser, name, text, placeholder, help)->each([name](const std::string& value) {
        if (value.empty()) {
            throw UsageError(name + " is empty: give it a value, or leave it out");
        }
    });
}

}  // namespace

void CrsOptions::add_to(CLI::App& parser, bool shows_heights) {
    add_filled(parser, "--source-crs", source_crs_text, "CRS", "CRS of sources that carry none (-a_srs)");
    add_filled(parser, "--crs", crs_text, "CRS", "CRS of what is made; projected: worked in as well");
    add_filled(parser, "--working-crs", working_crs_text, "CRS",
               "plane to work in: auto (default)|utm|local|CRS");
    const std::string group = shows_heights ? "Options" : "";
    add_filled(parser, "--z-unit", z_unit_text, "UNIT", "of sources that do not tell: metre|foot|...")
        ->group(group);
    add_filled(parser, "--z-scale", z_scale_text, "FACTOR", "elevations read count times this")->group(group);
    add_filled(parser, "--geoid", geoid_text, "FILE", "geoid to take off ellipsoidal heights (.pgm)")
        ->group(group);
    // Told of in the manual pages.
    add_filled(parser, "--max-distortion", max_distortion_text, "PERCENT", "of the plane (default 0.1)")
        ->group("");
    add_filled(parser, "--target-z-unit", target_z_unit_text, "UNIT", "elevations are converted to it")
        ->group("");
    add_filled(parser, "--heights", heights_text, "KIND", "with --geoid: orthometric|ellipsoidal")->group("");
    add_filled(parser, "--epoch", epoch_text, "YEAR", "when coordinates were measured")->group("");
}

void CrsOptions::finish() {
    if (!working_crs_text.empty()) {
        plane = io::parse_plane_request(working_crs_text);
    }
    if (!max_distortion_text.empty()) {
        plane.max_distortion = distortion_value(max_distortion_text);
        plane.is_limit_given = true;
    }
    if (!z_unit_text.empty()) {
        heights.source_unit = unit_value("--z-unit", z_unit_text);
    }
    if (!z_scale_text.empty()) {
        heights.scale = positive_value("--z-scale", z_scale_text);
    }
    if (!target_z_unit_text.empty()) {
        heights.unit = unit_value("--target-z-unit", target_z_unit_text);
    }
    if (!heights_text.empty()) {
        if (geoid_text.empty()) {
            throw UsageError("--heights says what --geoid makes: give --geoid FILE too");
        }
        heights.is_to_ellipsoid = choice_value("--heights", heights_text, kHeights);
    }
    heights.geoid = geoid_text;
    if (!epoch_text.empty()) {
        epoch = epoch_value(epoch_text);
    }
}

io::Crs CrsOptions::crs() const { return crs_text.empty() ? io::Crs() : io::Crs::parse(crs_text); }

io::Crs CrsOptions::source_crs() const {
    return source_crs_text.empty() ? io::Crs() : io::Crs::parse(source_crs_text);
}

void CrsOptions::apply_to(io::ReadOptions& options) const {
    options.crs = crs();
    options.source_crs = source_crs();
    options.plane = plane;
    options.heights = heights;
    options.epoch = epoch;
}

void CrsOptions::apply_to(io::ReadLinesOptions& options, const io::Samples& samples) const {
    options.crs = crs();
    options.source_crs = source_crs();
    options.plane = plane;
    options.heights = heights;
    options.epoch = epoch;
    if (samples.crs.is_known()) {
        if (options.crs.is_geographic() && !options.source_crs.is_known()) {
            options.source_crs = options.crs;  // as samples without a system are taken to be in it
        }
        options.crs = samples.crs;
        options.is_plane_decided = true;
    }
    options.z_unit = samples.z_unit;
}

std::string CrsOptions::option_for_samples_only() const {
    const std::array<std::pair<const char*, const std::string*>, 5> options{
        {{"--z-scale", &z_scale_text},
         {"--target-z-unit", &target_z_unit_text},
         {"--geoid", &geoid_text},
         {"--heights", &heights_text},
         {"--epoch", &epoch_text}}};
    for (const auto& [name, text] : options) {
        if (!text->empty()) {
            return name;
        }
    }
    return {};
}

std::string CrsOptions::canonical() const {
    std::string text;
    const auto add = [&text](const std::string& option, const std::string& value) {
        text += (text.empty() ? "" : " ") + option + " " + value;
    };
    using Rule = io::PlaneRequest::Rule;
    if (plane.rule != Rule::Auto) {
        add("--working-crs", plane.rule == Rule::Given
                                 ? plane.crs.code().empty() ? plane.crs.name() : plane.crs.code()
                             : plane.rule == Rule::Utm ? "utm"
                                                       : "local");
    }
    if (!heights.source_unit.empty()) {
        add("--z-unit", io::quoted(heights.source_unit));
    }
    if (heights.scale != 1) {
        add("--z-scale", decimal_text(heights.scale));
    }
    if (!heights.unit.empty()) {
        add("--target-z-unit", io::quoted(heights.unit));
    }
    if (!heights.geoid.empty()) {  // which geoid, not where its file is
        add("--geoid", io::quoted(std::filesystem::path(heights.geoid).stem().string()));
        add("--heights", choice_name(heights.is_to_ellipsoid, kHeights));
    }
    if (epoch) {
        add("--epoch", decimal_text(*epoch));
    }
    return text;
}

}  // namespace tinwright::tools
