#include "tinwright/io/read_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <gdal_priv.h>

#include "tinwright/io/cell_centers.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

/// One band on its way into samples.
class BandReader {
  public:
    BandReader(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points)
        : dataset_(dataset),
          request_(request),
          points_(points),
          band_(find_band()),
          number_(request.source.band.value_or(1)),
          columns_(dataset.GetRasterXSize()),
          rows_(dataset.GetRasterYSize()),
          stride_(std::min(request.source.stride.value_or(1), std::max(columns_, rows_))),
          centers_(transform(), std::max(columns_, rows_)),
          slice_(SampleSlice::Kind::Raster, request.options.skip_bad) {}

    RawSlice read() {
        slice_.layer = "band " + std::to_string(number_);
        slice_.crs = Crs::from_gdal(dataset_.GetSpatialRef());
        slice_.z_unit = band_.GetUnitType();
        scale_ = band_.GetScale();
        offset_ = band_.GetOffset();
        is_masked_ = (band_.GetMaskFlags() & GMF_ALL_VALID) == 0;
        int block_columns = 0;
        int block_rows = 0;
        band_.GetBlockSize(&block_columns, &block_rows);
        // Whole blocks, unless they are so tall that a strip of them would take more than 64 MiB.
        const std::int64_t most_rows = (std::int64_t{64} << 20U) / 9 / columns_;
        const int strip =
            static_cast<int>(std::clamp<std::int64_t>(block_rows, 1, std::max<std::int64_t>(1, most_rows)));
        for (int top = 0; top < rows_; top += strip) {
            read_strip(top, std::min(strip, rows_ - top));
            report_progress(request_.progress, std::min(1.0, static_cast<double>(top + strip) / rows_));
        }
        return std::move(slice_);
    }

  private:
    GDALRasterBand& find_band() {
        const int number = request_.source.band.value_or(1);
        const int count = dataset_.GetRasterCount();
        if (number > count) {
            throw InputError(request_.file + ": no band " + std::to_string(number) + "; the raster has " +
                             std::to_string(count));
        }
        GDALRasterBand* const band = dataset_.GetRasterBand(number);
        if (band == nullptr) {
            throw IoError("cannot read " + request_.file + messages_.suffix());
        }
        if (GDALDataTypeIsComplex(band->GetRasterDataType()) != 0) {
            throw InputError(request_.file + ": band " + std::to_string(number) +
                             " has complex numbers, no elevations; choose another with band=");
        }
        return *band;
    }

    std::array<double, 6> transform() {
        std::array<double, 6> numbers{};
        if (dataset_.GetGeoTransform(numbers.data()) != CE_None) {
            throw InputError(
                request_.file +
                (dataset_.GetGCPCount() > 0
                     ? ": the raster is placed by control points only; warp it first (gdalwarp)"
                     : ": the raster has no position; give it one first (gdal_edit.py -a_ullr)"));
        }
        return numbers;
    }

    /// First wanted row at or after `row`.
    [[nodiscard]] int next_wanted(int row) const {
        const std::int64_t wanted = (std::int64_t{row} + stride_ - 1) / stride_ * stride_;
        return static_cast<int>(std::min<std::int64_t>(wanted, rows_));
    }

    void read_strip(int top, int height) {
        int first = next_wanted(top);
        if (stride_ >= height) {  // at most one row of the strip is wanted
            if (first >= top + height) {
                return;
            }
            top = first;
            height = 1;
        }
        const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(height);
        values_.resize(cells);
        read_into(band_, values_.data(), GDT_Float64, top, height);
        if (is_masked_) {
            mask_.resize(cells);
            read_into(*band_.GetMaskBand(), mask_.data(), GDT_Byte, top, height);
        }
        for (; first < top + height && first < rows_; first = next_wanted(first + 1)) {
            add_row(first, static_cast<std::size_t>(first - top) * static_cast<std::size_t>(columns_));
        }
    }

    void read_into(GDALRasterBand& band, void* target, GDALDataType type, int top, int height) {
        if (band.RasterIO(GF_Read, 0, top, columns_, height, target, columns_, height, type, 0, 0, nullptr) !=
            CE_None) {
            throw IoError("cannot read " + request_.file + ", band " + std::to_string(number_) +
                          messages_.suffix());
        }
    }

    void add_row(int row, std::size_t begin) {
        for (std::int64_t next = 0; next < columns_; next += stride_) {
            const int column = static_cast<int>(next);
            const std::size_t i = begin + static_cast<std::size_t>(column);
            if (std::isnan(values_[i]) || (is_masked_ && mask_[i] == 0)) {
                continue;
            }
            const double z = values_[i] * scale_ + offset_;
            if (!std::isfinite(z)) {
                slice_.bad.add(request_.file + ", band " + std::to_string(number_) + ", column " +
                               std::to_string(column) + ", row " + std::to_string(row) + ": z is not finite");
                continue;
            }
            const Point2 center = centers_.center(column, row);
            points_.push_back({center.x, center.y, z});
            slice_.ids.add(static_cast<std::int64_t>(row) * columns_ + column);
        }
    }

    GdalMessages messages_;
    GDALDataset& dataset_;
    const SliceRequest& request_;
    std::vector<Point3>& points_;
    GDALRasterBand& band_;
    int number_;
    int columns_;
    int rows_;
    int stride_;
    CellCenters centers_;
    RawSlice slice_;
    double scale_ = 1;
    double offset_ = 0;
    bool is_masked_ = false;
    std::vector<double> values_;
    std::vector<std::uint8_t> mask_;
};

}  // namespace

RawSlice read_raster(GDALDataset& dataset, const SliceRequest& request, std::vector<Point3>& points) {
    if (request.source.z && *request.source.z != "geometry") {
        throw UsageError(request.file + ": z= does not go with a raster; choose its values with band=");
    }
    return BandReader(dataset, request, points).read();
}

}  // namespace tinwright::io
