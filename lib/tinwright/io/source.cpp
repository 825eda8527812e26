#include "tinwright/io/source.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

constexpr std::array<std::string_view, 14> kKnownKeys = {"layer",  "where",    "sql",    "z",    "xfield",
                                                         "yfield", "vertices", "across", "band", "stride",
                                                         "crs",    "format",   "as",     "oo"};

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
    throw UsageError("source " + quoted(std::string(text)) + ": " + why);
}

/// The known key that `text` starts with, followed by "="; empty when there is none.
std::string_view leading_key(std::string_view text) {
    for (const std::string_view key : kKnownKeys) {
        if (text.size() > key.size() && text.starts_with(key) && text[key.size()] == '=') {
            return key;
        }
    }
    return {};
}

struct Part {
    std::string_view key;  // empty for the path
    std::string value;
};

/// Splits before ",key=" and turns doubled commas into single ones.
std::vector<Part> split(std::string_view text) {
    std::vector<Part> parts(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != ',') {
            parts.back().value += text[i];
            continue;
        }
        if (i + 1 < text.size() && text[i + 1] == ',') {
            parts.back().value += ',';
            ++i;
            continue;
        }
        const std::string_view key = leading_key(text.substr(i + 1));
        if (key.empty()) {
            parts.back().value += ',';
            continue;
        }
        parts.push_back({key, {}});
        i += key.size() + 1;
    }
    return parts;
}

int parse_count(std::string_view text, const Part& part) {
    int value = 0;
    const char* const end = part.value.data() + part.value.size();
    const auto [stop, error] = std::from_chars(part.value.data(), end, value);
    if (error != std::errc() || stop != end || value < 1) {
        refuse(text, std::string(part.key) + "=" + " takes a whole number from 1, not " + quoted(part.value));
    }
    return value;
}

bool parse_yes_no(std::string_view text, const Part& part) {
    for (const std::string_view yes : {"yes", "true", "on", "1"}) {
        if (part.value == yes) {
            return true;
        }
    }
    for (const std::string_view no : {"no", "false", "off", "0"}) {
        if (part.value == no) {
            return false;
        }
    }
    refuse(text, std::string(part.key) + "= takes yes or no, not " + quoted(part.value));
}

Source::Format parse_format(std::string_view text, const Part& part) {
    if (part.value == "xyz") {
        return Source::Format::Xyz;
    }
    if (part.value == "pnezd") {
        return Source::Format::Pnezd;
    }
    if (part.value == "csv") {
        return Source::Format::Csv;
    }
    refuse(text, "format= takes xyz, pnezd or csv, not " + quoted(part.value));
}

Source::Kind parse_kind(std::string_view text, const Part& part) {
    if (part.value == "tin") {
        return Source::Kind::Tin;
    }
    if (part.value == "samples") {
        return Source::Kind::Samples;
    }
    refuse(text, "as= takes tin or samples, not " + quoted(part.value));
}

void store(Source& source, std::string_view text, Part&& part) {
    const std::array<std::pair<std::string_view, std::optional<std::string>*>, 8> texts = {
        {{"layer", &source.layer},
         {"where", &source.where},
         {"sql", &source.sql},
         {"z", &source.z},
         {"xfield", &source.x_field},
         {"yfield", &source.y_field},
         {"crs", &source.crs},
         {"across", &source.across}}};
    for (const auto& [key, member] : texts) {
        if (part.key == key) {
            *member = std::move(part.value);
            return;
        }
    }
    if (part.key == "vertices") {
        source.vertices = parse_yes_no(text, part);
    } else if (part.key == "band") {
        source.band = parse_count(text, part);
    } else if (part.key == "stride") {
        source.stride = parse_count(text, part);
    } else if (part.key == "format") {
        source.format = parse_format(text, part);
    } else if (part.key == "as") {
        source.as = parse_kind(text, part);
    } else {
        if (part.value.find('=') == std::string::npos || part.value.front() == '=') {
            refuse(text, "oo= takes NAME=VALUE, not " + quoted(part.value));
        }
        source.open_options.push_back(std::move(part.value));
    }
}

}  // namespace

Source parse_source(std::string_view text) {
    std::vector<Part> parts = split(text);
    Source source;
    source.path = std::move(parts.front().value);
    if (source.path.empty()) {
        refuse(text, "the path is missing; write PATH[,key=value...]");
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::string_view key = parts[i].key;
        const bool again = std::any_of(parts.begin() + 1, parts.begin() + static_cast<std::ptrdiff_t>(i),
                                       [&](const Part& earlier) { return earlier.key == key; });
        if (again && key != "oo") {
            refuse(text, std::string(key) + "= is given twice");
        }
        if (parts[i].value.empty()) {
            refuse(text, std::string(key) + "= has no value");
        }
        store(source, text, std::move(parts[i]));
    }
    if (source.sql && source.layer) {
        refuse(text, "sql= and layer= exclude each other; name the layer in the SQL");
    }
    return source;
}

}  // namespace tinwright::io
