#include "tinwright/io/open_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_text.hpp"
#include "tinwright/io/text_layout.hpp"

namespace tinwright::io {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool has_text_name(const std::string& path) {
    std::string name = lower(path);
    for (const std::string_view packed : {".gz", ".zip"}) {
        if (name.ends_with(packed)) {
            name.resize(name.size() - packed.size());
        }
    }
    constexpr std::array<std::string_view, 11> kEndings = {".csv", ".tsv", ".txt", ".xyz", ".asc", ".pnezd",
                                                           ".pts", ".pnt", ".enz", ".neh", ".xyzi"};
    return std::any_of(kEndings.begin(), kEndings.end(),
                       [&](std::string_view end) { return name.ends_with(end); });
}

/// "ncols" is how every ESRI ASCII grid begins.
bool is_ascii_grid(std::string_view head) {
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && lower(std::string(head.substr(first, 5))) == "ncols";
}

/// Whole lines of the beginning, or all of it when there is no line end.
std::string_view whole_lines(const std::string& head) {
    const std::size_t end = head.rfind('\n');
    return std::string_view(head).substr(0, end == std::string::npos ? head.size() : end + 1);
}

/// A key that the user may have meant, for the message about a file that does not exist.
std::string unknown_key_hint(const std::string& path) {
    const std::size_t equals = path.find('=', std::min(path.find(','), path.size()));
    const std::size_t comma = equals == std::string::npos ? equals : path.rfind(',', equals);
    if (comma == std::string::npos || comma + 1 >= equals) {
        return {};
    }
    const std::string key = path.substr(comma + 1, equals - comma - 1);
    const bool is_word =
        std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
    return is_word ? "; " + quoted(key) + " is no key of a source" : std::string();
}

void refuse_mixed_keys(const Source& source) {
    const bool raster = source.band || source.stride;
    const bool vector = source.layer || source.sql || source.where || source.vertices;
    const bool text = source.format != Source::Format::Auto;
    const std::string file = "source " + quoted(source.path);
    if (raster && (vector || source.x_field || source.y_field)) {
        throw UsageError(file +
                         ": band= and stride= are for rasters, layer=, where=, sql=, vertices=, xfield= and "
                         "yfield= for tables");
    }
    if (text && (raster || vector || !source.open_options.empty())) {
        throw UsageError(file + ": format= is for text, which has no layers, bands or open options");
    }
}

bool is_readable(const std::string& path) {
    VSIStatBufL status;
    return path.starts_with("/vsistdin/") || VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

bool wants_raster(const Source& source) { return source.band || source.stride; }

bool wants_vector(const Source& source) {
    return source.layer || source.sql || source.where || source.vertices || source.x_field;
}

/// What GDAL is asked for: GDAL_OF_RASTER, GDAL_OF_VECTOR or both.
unsigned kinds_of(const Source& source) {
    return wants_raster(source)   ? GDAL_OF_RASTER
           : wants_vector(source) ? GDAL_OF_VECTOR
                                  : GDAL_OF_RASTER | GDAL_OF_VECTOR;
}

[[noreturn]] void refuse_unopened(const Source& source, const std::string& path, unsigned kinds,
                                  const GdalMessages& messages) {
    const std::string file = "cannot open file " + quoted(source.path);
    if (!is_readable(path)) {
        throw IoError(file + ": no such file" + unknown_key_hint(source.path));
    }
    throw IoError(file +
                  (kinds == GDAL_OF_RASTER   ? ": no raster that GDAL knows"
                   : kinds == GDAL_OF_VECTOR ? ": no vector layers that GDAL knows"
                                             : ": neither a raster nor a vector layer nor rows of numbers") +
                  messages.suffix());
}

OpenedSource open_with_gdal(const Source& source, std::string path, unsigned kinds) {
    CPLStringList options;
    for (const std::string& option : source.open_options) {
        options.AddString(option.c_str());
    }
    const GdalMessages messages;
    OpenedSource opened;
    opened.path = std::move(path);
    opened.dataset.reset(GDALDataset::Open(opened.path.c_str(),
                                           kinds | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr,
                                           options.List(), nullptr));
    const bool is_free = kinds == (GDAL_OF_RASTER | GDAL_OF_VECTOR) && source.open_options.empty();
    const std::string driver = opened.dataset && opened.dataset->GetDriver() != nullptr
                                   ? opened.dataset->GetDriver()->GetDescription()
                                   : "";
    if (is_free && (!opened.dataset || driver == "XYZ")) {
        constexpr std::size_t kEnough = 65536;
        if (looks_like_rows(whole_lines(read_head(opened.path, kEnough)))) {
            opened.dataset.reset();
            return opened;
        }
    }
    if (!opened.dataset) {
        refuse_unopened(source, opened.path, kinds, messages);
    }
    const bool is_raster =
        kinds == GDAL_OF_RASTER || (kinds != GDAL_OF_VECTOR && opened.dataset->GetLayerCount() == 0);
    opened.kind = is_raster ? OpenedSource::Kind::Raster : OpenedSource::Kind::Vector;
    if (!source.open_options.empty() && !messages.last_warning().empty()) {
        opened.warning = "file " + quoted(source.path) + ": GDAL says: " + messages.last_warning();
    }
    return opened;
}

/// The first key given that says how to find samples, or empty.
std::string key_for_samples(const Source& source) {
    const std::array<std::pair<const char*, bool>, 7> keys = {
        {{"band=", source.band.has_value()},
         {"stride=", source.stride.has_value()},
         {"vertices=", source.vertices},
         {"xfield=", source.x_field.has_value()},
         {"yfield=", source.y_field.has_value()},
         {"format=", source.format != Source::Format::Auto},
         {"as=", source.as != Source::Kind::Auto}}};
    const auto* const given =
        std::find_if(keys.begin(), keys.end(), [](const auto& key) { return key.second; });
    return given == keys.end() ? "" : given->first;
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

std::string gdal_path(const std::string& path) {
    if (path == "-" || path == "/dev/stdin") {
        return "/vsistdin/";
    }
    const std::string name = lower(path);
    const bool is_archive = path.starts_with("/vsitar/") || name.ends_with(".tar.gz");
    if (name.ends_with(".gz") && !is_archive && name.find("/vsigzip/") == std::string::npos) {
        return "/vsigzip/" + path;
    }
    if (name.ends_with(".zip") && has_text_name(path) && name.find("/vsizip/") == std::string::npos) {
        return "/vsizip/" + path;
    }
    return path;
}

OpenedSource open_source(const Source& source) {
    register_drivers();
    refuse_mixed_keys(source);
    const GdalMessages messages;
    OpenedSource opened;
    opened.path = gdal_path(source.path);
    const bool wants_gdal = source.band || source.stride || source.layer || source.sql || source.where ||
                            source.vertices || !source.open_options.empty();
    const bool is_stdin = opened.path == "/vsistdin/";
    if (source.format == Source::Format::Auto && (wants_gdal || !(is_stdin || has_text_name(source.path)))) {
        return open_with_gdal(source, opened.path, kinds_of(source));
    }
    if (source.path.starts_with("CSV:")) {
        // GDAL's way to name its driver; our own parser reads such files.
        opened.path = gdal_path(source.path.substr(4));
    }
    if (!is_readable(opened.path)) {
        throw IoError("cannot open file " + quoted(source.path) + ": no such file" +
                      unknown_key_hint(source.path));
    }
    if (source.format != Source::Format::Auto) {
        return opened;
    }
    constexpr std::size_t kEnough = 65536;
    const std::string head = read_head(opened.path, kEnough);
    const bool is_text = is_stdin ? looks_like_rows(whole_lines(head)) : !is_ascii_grid(head);
    return is_text ? std::move(opened) : open_with_gdal(source, opened.path, kinds_of(source));
}

OpenedSource open_line_source(const Source& source) {
    register_drivers();
    const std::string key = key_for_samples(source);
    if (!key.empty()) {
        throw UsageError("source " + quoted(source.path) + ": " + key + " is for samples, not for lines");
    }
    return open_with_gdal(source, gdal_path(source.path), GDAL_OF_VECTOR);
}

}  // namespace tinwright::io
