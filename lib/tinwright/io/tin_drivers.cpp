#include "tinwright/io/tin_drivers.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

struct KnownDriver {
    std::string_view name;
    std::string_view extensions;
    bool has_layers;
    MetadataPlace metadata;
    int significant_digits;
    const char* last_words;
};

// Tested with GDAL 3.6: these keep z. Any other driver has to prove it on a probe file (write_tin.cpp).
constexpr std::array<KnownDriver, 7> kKnownDrivers = {{
    {"GPKG", " gpkg ", true, MetadataPlace::Layer, 0, nullptr},
    {"ESRI Shapefile", " shp shz ", false, MetadataPlace::Nowhere, 0, nullptr},
    {"FlatGeobuf", " fgb ", false, MetadataPlace::Nowhere, 0, nullptr},
    {"GML", " gml ", true, MetadataPlace::Description, 15, "FeatureCollection>"},
    {"SQLite", " sqlite db sqlite3 ", true, MetadataPlace::Table, 0, nullptr},
    {"CSV", " csv ", false, MetadataPlace::Nowhere, 0, nullptr},
    {"GeoJSON", " geojson json ", false, MetadataPlace::Member, 0, "]}"},
}};

constexpr const char* kAlternatives = "use .gpkg, .shp, .fgb, .gml, .sqlite, .csv or .geojson";

bool is_vector_creator(GDALDriver* driver) {
    return driver->GetMetadataItem(GDAL_DCAP_VECTOR) != nullptr &&
           driver->GetMetadataItem(GDAL_DCAP_CREATE) != nullptr;
}

std::string lower_extension(const std::string& target) {
    std::string extension = CPLGetExtension(target.c_str());
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

GDALDriver* find_by_extension(const std::string& extension) {
    if (extension.empty()) {
        return nullptr;
    }
    GDALDriverManager& manager = *GetGDALDriverManager();
    for (const KnownDriver& known : kKnownDrivers) {
        if (known.extensions.find(" " + extension + " ") != std::string_view::npos) {
            return manager.GetDriverByName(std::string(known.name).c_str());
        }
    }
    for (int i = 0; i < manager.GetDriverCount(); ++i) {
        GDALDriver* const driver = manager.GetDriver(i);
        const char* const extensions = driver->GetMetadataItem(GDAL_DMD_EXTENSIONS);
        if (extensions == nullptr || !is_vector_creator(driver)) {
            continue;
        }
        const CPLStringList list(CSLTokenizeString(extensions));
        if (list.FindString(extension.c_str()) >= 0) {
            return driver;
        }
    }
    return nullptr;
}

bool has_option(const std::vector<std::string>& options, std::string_view key) {
    return std::any_of(options.begin(), options.end(), [&](const std::string& option) {
        return option.size() > key.size() && option[key.size()] == '=' &&
               EQUALN(option.c_str(), key.data(), key.size());
    });
}

// Decimals of the shortest text that reads back as the same number.
int decimals_of(double value) { return std::max(0, -shortest_decimal(value).exponent); }

int significant_digits_of(double value) {
    int count = 1;
    for (std::int64_t digits = shortest_decimal(value).digits / 10; digits != 0; digits /= 10) {
        ++count;
    }
    return count;
}

template <class Measure>
int largest(const Tin& tin, const WriteTinOptions& options, int stop, const Measure& measure) {
    int most = 0;
    for (std::uint32_t v = 0; v < tin.vertex_count() && most <= stop; ++v) {
        const Point3 p = written_position(tin, options, {v});
        most = std::max({most, measure(p.x), measure(p.y), measure(p.z)});
    }
    return most;
}

void append_json_string(std::string& json, std::string_view text) {
    json += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            json += '\\';
            json += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            std::array<char, 8> escape{};
            std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(c));
            json += escape.data();
        } else {
            json += c;
        }
    }
    json += '"';
}

void add_geojson_options(std::vector<std::string>& list, const Tin& tin, const Crs& crs, TinMetadata metadata,
                         const WriteTinOptions& options) {
    const std::vector<std::string>& given = options.layer_options;
    if (!has_option(given, "COORDINATE_PRECISION") && !has_option(given, "SIGNIFICANT_FIGURES")) {
        // GDAL cuts a last digit off that follows five zeros or nines, which up to five decimals cannot.
        constexpr int kSafeDecimals = 5;
        const int decimals = largest(tin, options, kSafeDecimals, decimals_of);
        list.push_back(decimals <= kSafeDecimals ? "COORDINATE_PRECISION=" + std::to_string(decimals)
                                                 : std::string("SIGNIFICANT_FIGURES=17"));
    }
    if (!has_option(given, "NATIVE_DATA")) {
        // A GeoJSON without a crs member means longitude and latitude, and that member holds only codes.
        if (!crs.is_known()) {
            metadata.emplace_back("TINWRIGHT_CRS", "none");
        } else if (crs.code().empty()) {
            metadata.emplace_back("TINWRIGHT_CRS", crs.wkt());
        }
        if (!metadata.empty()) {
            list.push_back("NATIVE_DATA={\"tinwright\":" + json_of(metadata) + "}");
            list.emplace_back("NATIVE_MEDIA_TYPE=application/vnd.geo+json");
        }
    }
}

}  // namespace

TinDriver find_tin_driver(const std::string& target, const std::string& driver) {
    register_drivers();
    TinDriver found;
    if (!driver.empty()) {
        found.gdal = GetGDALDriverManager()->GetDriverByName(driver.c_str());
        if (found.gdal == nullptr) {
            throw UsageError("GDAL has no driver " + quoted(driver) +
                             "; `ogrinfo --formats` lists those it has");
        }
        if (!is_vector_creator(found.gdal)) {
            throw UsageError("driver " + quoted(driver) + " writes no vector layers; " + kAlternatives);
        }
    } else {
        const std::string extension = lower_extension(target);
        found.gdal = find_by_extension(extension);
        if (found.gdal == nullptr) {
            throw UsageError(
                "no vector driver for " + quoted(target) + ": " +
                (extension.empty() ? std::string("it has no extension") : "unknown extension ." + extension) +
                "; name one with --of, or " + kAlternatives);
        }
    }
    found.name = found.gdal->GetDescription();
    const auto* const known = std::find_if(kKnownDrivers.begin(), kKnownDrivers.end(),
                                           [&](const KnownDriver& k) { return k.name == found.name; });
    if (known != kKnownDrivers.end()) {
        found.has_layers = known->has_layers;
        found.metadata = known->metadata;
        found.significant_digits = known->significant_digits;
        found.last_words = known->last_words;
    }
    return found;
}

std::vector<std::string> dataset_options(const TinDriver& driver, const TinMetadata& metadata,
                                         const WriteTinOptions& options) {
    std::vector<std::string> list;
    if (driver.metadata == MetadataPlace::Description && !metadata.empty()) {
        list.push_back("DESCRIPTION=" + json_of(metadata));
    }
    list.insert(list.end(), options.creation_options.begin(), options.creation_options.end());
    return list;
}

std::vector<std::string> layer_options(const TinDriver& driver, const std::string& layer, const Tin& tin,
                                       const Crs& crs, const TinMetadata& metadata,
                                       const WriteTinOptions& options) {
    std::vector<std::string> list;
    if (driver.name == "ESRI Shapefile") {
        list.emplace_back("DBF_DATE_LAST_UPDATE=2000-01-01");  // else the day of writing
    } else if (driver.name == "GPKG" && layer == "vertices") {
        list.emplace_back("SPATIAL_INDEX=NO");  // takes four fifths of the time and serves few
    } else if (driver.name == "GeoJSON") {
        add_geojson_options(list, tin, crs, metadata, options);
    }
    list.insert(list.end(), options.layer_options.begin(), options.layer_options.end());
    return list;
}

bool writes_own_wkt(const TinDriver& driver, const WriteTinOptions& options) {
    return driver.name == "CSV" && !has_option(options.layer_options, "GEOMETRY");
}

std::string json_of(const TinMetadata& metadata) {
    std::string json(1, '{');
    for (const auto& [key, value] : metadata) {
        if (json.size() > 1) {
            json += ',';
        }
        append_json_string(json, key);
        json += ':';
        append_json_string(json, value);
    }
    json += '}';
    return json;
}

Point3 written_position(const Tin& tin, const WriteTinOptions& options, VertexId v) {
    Point3 p = tin.position(v);
    if (!options.positions.empty()) {
        p.x = options.positions[v.value].x;
        p.y = options.positions[v.value].y;
    }
    return p;
}

bool needs_more_digits(const Tin& tin, const WriteTinOptions& options, int digits) {
    return largest(tin, options, digits, significant_digits_of) > digits;
}

const OGRSpatialReference& undefined_cartesian_system() {
    static const OGRSpatialReference system = [] {
        OGRSpatialReference undefined;
        undefined.SetLocalCS("Undefined Cartesian SRS");
        return undefined;
    }();
    return system;
}

}  // namespace tinwright::io
