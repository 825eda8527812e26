#include "tinwright/io/raster_driver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {

namespace {

std::string metadata_of(GDALDriver* driver, const char* key) {
    const char* const value = driver->GetMetadataItem(key);
    return value == nullptr ? "" : value;
}

bool has_capability(GDALDriver* driver, const char* key) {
    return EQUAL(metadata_of(driver, key).c_str(), "YES");
}

std::vector<std::string> words(const std::string& text) {
    const CPLStringList list(CSLTokenizeString2(text.c_str(), " ", 0));
    return {list.List(), list.List() + list.size()};
}

/// Whether the driver leaves a file with the values in it: MEM and VRT leave none.
bool can_write_values(GDALDriver* driver) {
    const std::string name = driver->GetDescription();
    return has_capability(driver, GDAL_DCAP_RASTER) && name != "MEM" && name != "VRT" && name != "DERIVED" &&
           (has_capability(driver, GDAL_DCAP_CREATE) || has_capability(driver, GDAL_DCAP_CREATECOPY));
}

GDALDriver* find_by_extension(const std::string& target) {
    const std::string extension = CPLGetExtension(target.c_str());
    if (extension.empty()) {
        throw UsageError("cannot tell the format of " + quoted(target) +
                         ": it has no extension; add one, such as .tif, or --of");
    }
    GDALDriver* copier = nullptr;
    for (int i = 0; i < GetGDALDriverManager()->GetDriverCount(); ++i) {
        GDALDriver* const driver = GetGDALDriverManager()->GetDriver(i);
        std::string extensions = metadata_of(driver, GDAL_DMD_EXTENSIONS);
        extensions = extensions.empty() ? metadata_of(driver, GDAL_DMD_EXTENSION) : extensions;
        const std::vector<std::string> known = words(extensions);
        const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& one) {
            return EQUAL(one.c_str(), extension.c_str());
        });
        if (!is_known || !can_write_values(driver)) {
            continue;
        }
        if (has_capability(driver, GDAL_DCAP_CREATE)) {
            return driver;
        }
        copier = copier == nullptr ? driver : copier;
    }
    if (copier == nullptr) {
        throw UsageError("no raster driver writes files with the extension " + quoted("." + extension) +
                         "; use another, such as .tif, or name the driver with --of");
    }
    return copier;
}

GDALDriver* find_by_name(const std::string& name) {
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(name.c_str());
    if (driver == nullptr) {
        throw UsageError("unknown driver " + quoted(name) + "; `gdalinfo --formats` lists GDAL's");
    }
    if (!can_write_values(driver)) {
        throw UsageError("the driver " + quoted(name) +
                         " cannot write a raster file; use another, such as GTiff");
    }
    return driver;
}

/// Types by how well they suit the products.
std::vector<const char*> suitable_types(const std::vector<Product>& products) {
    if (products == std::vector{Product::Hillshade}) {
        return {"Byte", "UInt16", "Int16", "Float32", "Float64"};
    }
    if (products == std::vector{Product::FaceNumber}) {
        return {"Int32", "UInt32", "Float64", "Float32"};
    }
    const bool has_numbers =
        std::find(products.begin(), products.end(), Product::FaceNumber) != products.end();
    if (has_numbers) {
        return {"Float64", "Float32", "Int32"};
    }
    return {"Float32", "Float64", "Int32", "Int16", "UInt16", "UInt32", "Byte"};
}

GDALDataType find_type(GDALDriver* driver, const std::string& asked, const std::vector<Product>& products) {
    const std::string list = metadata_of(driver, GDAL_DMD_CREATIONDATATYPES);
    const std::vector<std::string> possible = words(list);
    const auto is_possible = [&](const std::string& name) {
        return possible.empty() || std::find(possible.begin(), possible.end(), name) != possible.end();
    };
    if (asked.empty()) {
        for (const char* const name : suitable_types(products)) {
            if (is_possible(name)) {
                return GDALGetDataTypeByName(name);
            }
        }
        throw UsageError("the driver " + quoted(driver->GetDescription()) +
                         " writes no type that the values fit in; use another, such as GTiff");
    }
    const GDALDataType type = GDALGetDataTypeByName(asked.c_str());
    if (type == GDT_Unknown || GDALDataTypeIsComplex(type) != 0) {
        throw UsageError("unknown data type " + quoted(asked) +
                         "; use Float32, Float64, Byte, Int16, UInt16, Int32 or UInt32");
    }
    if (!is_possible(GDALGetDataTypeName(type))) {
        throw UsageError("the driver " + quoted(driver->GetDescription()) + " cannot write " +
                         GDALGetDataTypeName(type) + "; it writes " + list);
    }
    return type;
}

void check_creation_options(GDALDriver* driver, const std::vector<std::string>& options) {
    CPLStringList list;
    for (const std::string& option : options) {
        const std::size_t equals = option.find('=');
        if (equals == 0 || equals == std::string::npos) {
            throw UsageError("--co " + quoted(option) + " is not of the form NAME=VALUE");
        }
        list.AddString(option.c_str());
    }
    const GdalMessages messages;
    if (!options.empty() && GDALValidateCreationOptions(driver, list.List()) == 0) {
        const std::string warning = messages.last_warning();
        throw UsageError(
            "the driver " + quoted(driver->GetDescription()) +
            " does not take these creation options: " + (warning.empty() ? messages.last_error() : warning));
    }
}

void check_nodata(GDALDataType type, double nodata) {
    bool is_value = true;
    if (GDALDataTypeIsInteger(type) != 0) {
        const auto [lowest, highest] = integer_range(type);
        is_value = nodata >= lowest && nodata <= highest && nodata == std::round(nodata);
    } else if (type == GDT_Float32) {
        is_value = !std::isfinite(nodata) || std::abs(nodata) <= std::numeric_limits<float>::max();
    }
    if (!is_value) {
        throw UsageError("--nodata " + std::string(CPLSPrintf("%.17g", nodata)) +
                         " is not a value of the type " + GDALGetDataTypeName(type));
    }
}

/// Refuses what would write other values than asked for, or bands that mean something else to readers.
void check_keeps_values(const std::string& name, const std::vector<Product>& products) {
    if (name == "JPEG" && products != std::vector{Product::Hillshade}) {
        throw UsageError(
            "the driver \"JPEG\" changes values to save space, nodata too; use another, such as GTiff");
    }
    if (name == "PNG" && products.size() % 2 == 0) {
        throw UsageError(
            "the driver \"PNG\" takes the last of " + std::to_string(products.size()) +
            " bands for transparency; {product} in the name of the output writes each product to a "
            "file of its own");
    }
}

}  // namespace

IntegerRange integer_range(GDALDataType type) {
    switch (type) {
        case GDT_Byte:
            return {0, 255};
        case GDT_UInt16:
            return {0, 65535};
        case GDT_Int16:
            return {-32768, 32767};
        case GDT_UInt32:
            return {0, 4294967295.0};
        case GDT_Int32:
            return {-2147483648.0, 2147483647.0};
        case GDT_UInt64:
            return {0, 9007199254740992.0};
        default:  // Int64: whole numbers that a double tells apart
            return {-9007199254740992.0, 9007199254740992.0};
    }
}

RasterDriver find_raster_driver(const std::string& target, const WriteGridOptions& options) {
    register_drivers();
    RasterDriver found;
    found.driver = options.driver.empty() ? find_by_extension(target) : find_by_name(options.driver);
    check_keeps_values(found.name(), options.gridding.products);
    found.can_create = has_capability(found.driver, GDAL_DCAP_CREATE);
    found.type = find_type(found.driver, options.data_type, options.gridding.products);
    check_creation_options(found.driver, options.creation_options);
    if (options.nodata) {
        check_nodata(found.type, *options.nodata);
    }
    return found;
}

}  // namespace tinwright::io
