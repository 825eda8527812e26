#include "tinwright/io/raster_cells.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <cpl_string.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

void check_keys(const Source& source) {
    const bool has_others = source.layer || source.where || source.sql || source.z || source.x_field ||
                            source.y_field || source.vertices || source.across || source.stride ||
                            source.format != Source::Format::Auto || source.as != Source::Kind::Auto;
    if (has_others) {
        throw UsageError("raster " + quoted(source.path) + " takes the keys band=, crs= and oo= only");
    }
}

GDALDatasetUniquePtr open(const Source& source) {
    const GdalMessages messages;
    CPLStringList options;
    for (const std::string& option : source.open_options) {
        options.AddString(option.c_str());
    }
    GDALDatasetUniquePtr dataset(GDALDataset::Open(source.path.c_str(),
                                                   GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                                   nullptr, options.List(), nullptr));
    if (dataset == nullptr) {
        throw IoError("cannot read " + quoted(source.path) + " as a raster" + messages.suffix());
    }
    return dataset;
}

GDALRasterBand& find_band(GDALDataset& dataset, const Source& source) {
    const int number = source.band.value_or(1);
    const std::string name = "raster " + quoted(source.path);
    if (number > dataset.GetRasterCount()) {
        throw InputError(name + ": no band " + std::to_string(number) + "; it has " +
                         std::to_string(dataset.GetRasterCount()));
    }
    GDALRasterBand& band = *dataset.GetRasterBand(number);
    if (GDALDataTypeIsComplex(band.GetRasterDataType()) != 0) {
        throw InputError(name + ": band " + std::to_string(number) +
                         " has complex numbers, no elevations; choose another with band=");
    }
    return band;
}

GridGeometry geometry_of(GDALDataset& dataset, const std::string& path) {
    std::array<double, 6> transform{};
    const std::string name = "raster " + quoted(path);
    if (dataset.GetGeoTransform(transform.data()) != CE_None) {
        throw InputError(name + ": says nothing about where it lies; place it first (gdal_edit.py -a_ullr)");
    }
    const bool is_north_up = transform[2] == 0 && transform[4] == 0 && transform[1] > 0 && transform[5] < 0;
    if (!is_north_up) {
        throw InputError(name +
                         ": is rotated, mirrored or has south up, and only north-up rasters can be checked; "
                         "gdalwarp makes it one");
    }
    return {transform[0],
            transform[3],
            transform[1],
            -transform[5],
            dataset.GetRasterXSize(),
            dataset.GetRasterYSize()};
}

}  // namespace

struct RasterCells::State {
    explicit State(const Source& source)
        : path(source.path),
          dataset(open(source)),
          band(find_band(*dataset, source)),
          geometry(geometry_of(*dataset, source.path)),
          crs(source.crs ? Crs::parse(*source.crs) : Crs::from_gdal(dataset->GetSpatialRef())),
          data_type(GDALGetDataTypeName(band.GetRasterDataType())),
          scale(band.GetScale()),
          offset(band.GetOffset()) {
        const int flags = band.GetMaskFlags();
        if ((flags & GMF_ALL_VALID) == 0) {
            mask = band.GetMaskBand();
        }
    }

    void require(CPLErr result, const GdalMessages& messages) const {
        if (result != CE_None) {
            throw IoError("cannot read raster " + quoted(path) + messages.suffix());
        }
    }

    std::string path;
    GDALDatasetUniquePtr dataset;
    GDALRasterBand& band;
    GDALRasterBand* mask = nullptr;  ///< null: every cell has a value
    GridGeometry geometry;
    Crs crs;
    std::string data_type;
    double scale;
    double offset;
    std::vector<std::uint8_t> valid;
};

RasterCells::RasterCells(const Source& source) {
    register_drivers();
    check_keys(source);
    state_ = std::make_unique<State>(source);
}

RasterCells::~RasterCells() = default;

const GridGeometry& RasterCells::geometry() const { return state_->geometry; }
const Crs& RasterCells::crs() const { return state_->crs; }
const std::string& RasterCells::data_type() const { return state_->data_type; }

void RasterCells::read(std::int64_t row, std::int64_t first, std::span<double> values) {
    const int y = static_cast<int>(row);
    const int x = static_cast<int>(first);
    const int count = static_cast<int>(values.size());
    const GdalMessages messages;
    state_->require(
        state_->band.RasterIO(GF_Read, x, y, count, 1, values.data(), count, 1, GDT_Float64, 0, 0), messages);
    if (state_->mask != nullptr) {
        state_->valid.resize(values.size());
        state_->require(
            state_->mask->RasterIO(GF_Read, x, y, count, 1, state_->valid.data(), count, 1, GDT_Byte, 0, 0),
            messages);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool has_value = std::isfinite(values[i]) && (state_->mask == nullptr || state_->valid[i] != 0);
        values[i] =
            has_value ? values[i] * state_->scale + state_->offset : std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace tinwright::io
