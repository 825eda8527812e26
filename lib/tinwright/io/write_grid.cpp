#include "tinwright/io/write_grid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <span>
#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/preview.hpp"
#include "tinwright/io/raster_driver.hpp"
#include "tinwright/io/raster_values.hpp"

namespace tinwright::io {

namespace {

constexpr double kMemoryDatasetBytes = 256.0 * 1024 * 1024;

class Stopwatch {
  public:
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    ~Stopwatch() {
        seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Deletes a file at the end, however that comes.
class ScratchFile {
  public:
    explicit ScratchFile(const std::string& path) : path_(path) {}
    ~ScratchFile() { VSIUnlink(path_.c_str()); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

  private:
    const std::string& path_;
};

bool has_option(const std::vector<std::string>& options, const std::string& name) {
    return std::any_of(options.begin(), options.end(), [&](const std::string& option) {
        return option.size() > name.size() && option[name.size()] == '=' &&
               EQUALN(option.c_str(), name.c_str(), name.size());
    });
}

CPLStringList creation_options(const RasterDriver& driver, const std::vector<std::string>& asked,
                               bool is_multiband) {
    CPLStringList list;
    for (const std::string& option : asked) {
        list.AddString(option.c_str());
    }
    // Products are computed row by row, all at a time; apart, each is read as quickly as if it were alone.
    if (is_multiband && driver.name() == "GTiff" && !has_option(asked, "INTERLEAVE")) {
        list.SetNameValue("INTERLEAVE", "BAND");
    }
    // Compressed files grow unforeseen: past 2 GB of values they get 64-bit offsets.
    if ((driver.name() == "GTiff" || driver.name() == "COG") && !has_option(asked, "BIGTIFF")) {
        list.SetNameValue("BIGTIFF", "IF_SAFER");
    }
    return list;
}

/// One raster being written: where to, with what, and GDAL's messages about it.
class GridWriter {
  public:
    GridWriter(const Tin& tin, const Crs& crs, const GridGeometry& grid, const std::string& target,
               const WriteGridOptions& options)
        : tin_(tin),
          crs_(crs),
          grid_(grid),
          target_(target),
          options_(options),
          driver_(find_raster_driver(target, options)),
          values_(driver_, options.nodata,
                  [&](bool is_quick) { return find_value_range(tin, options, is_quick); }) {
        report_.driver = driver_.name();
        report_.data_type = driver_.type_name();
        report_.nodata = values_.nodata();
        for (const Product product : options.gridding.products) {
            report_.bands.emplace_back(product_name(product));
        }
    }

    /// Writes everything to `path`.
    WrittenGrid write(const std::string& path);

  private:
    [[noreturn]] void fail() const {
        throw IoError("cannot write " + quoted(target_) + " as " + driver_.name() + messages_.suffix());
    }
    [[nodiscard]] int band_count() const { return static_cast<int>(options_.gridding.products.size()); }
    [[nodiscard]] double bytes() const {
        return static_cast<double>(grid_.columns) * static_cast<double>(grid_.rows) *
               GDALGetDataTypeSizeBytes(driver_.type) * band_count();
    }
    [[nodiscard]] GDALDatasetUniquePtr create(GDALDriver* driver, const std::string& path,
                                              char** options) const;
    void describe(GDALDataset& dataset) const;
    [[nodiscard]] bool declare_nodata(GDALRasterBand& band) const;
    void close(GDALDatasetUniquePtr dataset) const;
    void copy(const std::string& path);
    void copy_from(GDALDataset& source, const std::string& path);

    [[nodiscard]] std::int64_t choose_band_rows(GDALRasterBand& raster, std::int64_t value_bytes) const;
    template <class Value>
    void fill(GDALDataset& dataset, double progress_share);
    void fill_any(GDALDataset& dataset, double progress_share) {
        driver_.type == GDT_Float32 ? fill<float>(dataset, progress_share)
                                    : fill<double>(dataset, progress_share);
    }

    const Tin& tin_;
    const Crs& crs_;
    const GridGeometry& grid_;
    const std::string& target_;
    const WriteGridOptions& options_;
    GdalMessages messages_;
    RasterDriver driver_;
    RasterValues values_;
    WrittenGrid report_;
};

GDALDatasetUniquePtr GridWriter::create(GDALDriver* driver, const std::string& path, char** options) const {
    GDALDatasetUniquePtr dataset(driver->Create(path.c_str(), static_cast<int>(grid_.columns),
                                                static_cast<int>(grid_.rows), band_count(), driver_.type,
                                                options));
    if (dataset == nullptr) {
        fail();
    }
    return dataset;
}

void GridWriter::describe(GDALDataset& dataset) const {
    std::array<double, 6> transform{grid_.x_min, grid_.cell_width, 0, grid_.y_max, 0, -grid_.cell_height};
    bool is_described = dataset.SetGeoTransform(transform.data()) == CE_None;
    if (crs_.is_known()) {
        is_described = dataset.SetSpatialRef(crs_.gdal()) == CE_None && is_described;
    }
    dataset.SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA);
    for (const auto& [key, value] : options_.metadata) {
        dataset.SetMetadataItem(key.c_str(), value.c_str());
    }
    const bool needs_names = options_.gridding.products != std::vector{Product::Elevation};
    for (int b = 1; b <= band_count(); ++b) {
        GDALRasterBand& band = *dataset.GetRasterBand(b);
        is_described = declare_nodata(band) && is_described;
        if (needs_names) {
            band.SetDescription(report_.bands[static_cast<std::size_t>(b - 1)].c_str());
        }
    }
    if (!is_described) {
        fail();
    }
}

bool GridWriter::declare_nodata(GDALRasterBand& band) const {
    if (driver_.type == GDT_Int64) {
        return band.SetNoDataValueAsInt64(static_cast<std::int64_t>(values_.nodata())) == CE_None;
    }
    if (driver_.type == GDT_UInt64) {
        return band.SetNoDataValueAsUInt64(static_cast<std::uint64_t>(values_.nodata())) == CE_None;
    }
    return band.SetNoDataValue(values_.nodata()) == CE_None;
}

// Closing writes what is still held back, and tells of failures by messages alone.
void GridWriter::close(GDALDatasetUniquePtr dataset) const {
    const GdalMessages closing;
    dataset.reset();
    if (!closing.last_error().empty()) {
        throw IoError("cannot finish writing " + quoted(target_) + closing.suffix());
    }
}

/// Rows of whole blocks if at all possible: each is then written once, whatever GDAL's cache does.
std::int64_t GridWriter::choose_band_rows(GDALRasterBand& raster, std::int64_t value_bytes) const {
    int block_columns = 0;
    int block_rows = 0;
    raster.GetBlockSize(&block_columns, &block_rows);
    const std::int64_t row_bytes = grid_.columns * value_bytes;
    const std::int64_t rows = std::max<std::int64_t>(options_.band_bytes / row_bytes, 1);
    if (rows >= block_rows) {
        return std::min(grid_.rows, rows - rows % block_rows);
    }
    return block_rows * row_bytes <= 4 * options_.band_bytes ? block_rows : std::min(rows, grid_.rows);
}

template <class Value>
void GridWriter::fill(GDALDataset& dataset, double progress_share) {
    constexpr GDALDataType kBufferType = sizeof(Value) == sizeof(float) ? GDT_Float32 : GDT_Float64;
    GDALRasterBand& raster = *dataset.GetRasterBand(1);
    const std::int64_t band_rows = choose_band_rows(raster, static_cast<std::int64_t>(sizeof(Value)));
    int block_columns = 0;
    int block_rows = 0;
    raster.GetBlockSize(&block_columns, &block_rows);
    const bool is_whole_blocks = band_rows % block_rows == 0;
    const std::size_t products = options_.gridding.products.size();
    std::unique_ptr<SurfaceGridder> gridder;
    {
        const Stopwatch watch(report_.interpolate_seconds);
        gridder =
            std::make_unique<SurfaceGridder>(tin_, options_.surface, grid_, band_rows, options_.gridding);
    }
    const std::int64_t bands = gridder->band_count();
    // Two bands of rows, each with an array a product.
    std::array<std::vector<LargeVector<Value>>, 2> buffer{std::vector<LargeVector<Value>>(products),
                                                          std::vector<LargeVector<Value>>(products)};
    const auto values_of = [&](std::int64_t band, std::size_t product) {
        const auto [first, end] = gridder->band_rows(band);
        return std::span(buffer[static_cast<std::size_t>(band % 2)][product])
            .first(static_cast<std::size_t>((end - first) * grid_.columns));
    };
    const auto compute = [&](std::int64_t band) {
        const Stopwatch watch(report_.interpolate_seconds);
        std::vector<std::span<Value>> values(products);
        for (std::size_t p = 0; p < products; ++p) {
            buffer[static_cast<std::size_t>(band % 2)][p].resize(
                static_cast<std::size_t>(band_rows * grid_.columns));
            values[p] = values_of(band, p);
        }
        report_.cells_with_value += gridder->fill(band, values, static_cast<Value>(values_.filler()));
        for (std::size_t p = 0; p < products && values_.must_check(); ++p) {
            values_.check(values[p], grid_, gridder->band_rows(band).first);
        }
    };
    const auto write = [&](std::int64_t band) {
        const Stopwatch watch(report_.write_seconds);
        const auto [first, end] = gridder->band_rows(band);
        const auto columns = static_cast<int>(grid_.columns);
        const auto rows = static_cast<int>(end - first);
        for (std::size_t p = 0; p < products; ++p) {
            GDALRasterBand& of_product = *dataset.GetRasterBand(static_cast<int>(p) + 1);
            if (of_product.RasterIO(GF_Write, 0, static_cast<int>(first), columns, rows,
                                    values_of(band, p).data(), columns, rows, kBufferType, 0, 0,
                                    nullptr) != CE_None ||
                (is_whole_blocks && products == 1 && of_product.FlushCache(false) != CE_None)) {
                fail();
            }
        }
        report_progress(options_.progress,
                        progress_share * static_cast<double>(band + 1) / static_cast<double>(bands));
    };
    compute(0);
    for (std::int64_t band = 0; band < bands; ++band) {
        // The next band is computed while this one is written, if there is a thread for it.
        tbb::task_group next;
        if (band + 1 < bands) {
            next.run([&] { compute(band + 1); });
        }
        try {
            write(band);
        } catch (...) {
            next.cancel();
            next.wait();
            throw;
        }
        next.wait();
    }
}

void GridWriter::copy_from(GDALDataset& source, const std::string& path) {
    struct Watch {
        const Progress& progress;
        std::exception_ptr stopped;
    } watch{options_.progress, nullptr};
    const auto on_progress = [](double share, const char*, void* data) -> int {
        auto& watched = *static_cast<Watch*>(data);
        try {
            report_progress(watched.progress, 0.5 + 0.5 * share);
        } catch (...) {
            watched.stopped = std::current_exception();
            return FALSE;
        }
        return TRUE;
    };
    const Stopwatch stopwatch(report_.write_seconds);
    CPLStringList list = creation_options(driver_, options_.creation_options, band_count() > 1);
    GDALDatasetUniquePtr dataset(
        driver_.driver->CreateCopy(path.c_str(), &source, FALSE, list.List(), on_progress, &watch));
    if (watch.stopped) {
        dataset.reset();
        std::rethrow_exception(watch.stopped);
    }
    if (dataset == nullptr && band_count() > 1) {
        throw IoError(
            "cannot write " + std::to_string(band_count()) + " bands to " + quoted(target_) + " as " +
            driver_.name() +
            "; perhaps {product} in its name, which writes each product to a file of its own, will do" +
            messages_.suffix());
    }
    if (dataset == nullptr) {
        fail();
    }
    close(std::move(dataset));
}

/// For drivers that only copy: a dataset in memory or, when large, a file beside the output comes first.
void GridWriter::copy(const std::string& path) {
    if (bytes() <= kMemoryDatasetBytes) {
        GDALDatasetUniquePtr source = create(GetGDALDriverManager()->GetDriverByName("MEM"), "", nullptr);
        describe(*source);
        fill_any(*source, 0.5);
        copy_from(*source, path);
        return;
    }
    const std::string raw = path.starts_with("/vsi")
                                ? std::string(CPLGenerateTempFilename("tinwright")) + ".tif"
                                : path + ".uncompressed.tif";
    require_free_space(raw, 2 * bytes());
    const ScratchFile scratch(raw);
    CPLStringList list;
    list.SetNameValue("BIGTIFF", "IF_SAFER");
    GDALDatasetUniquePtr source = create(GetGDALDriverManager()->GetDriverByName("GTiff"), raw, list.List());
    describe(*source);
    fill_any(*source, 0.5);
    copy_from(*source, path);
}

WrittenGrid GridWriter::write(const std::string& path) {
    require_free_space(target_, bytes());
    if (driver_.can_create) {
        CPLStringList list = creation_options(driver_, options_.creation_options, band_count() > 1);
        GDALDatasetUniquePtr dataset = create(driver_.driver, path, list.List());
        describe(*dataset);
        fill_any(*dataset, 1);
        const Stopwatch watch(report_.write_seconds);
        close(std::move(dataset));
    } else {
        copy(path);
    }
    return report_;
}

}  // namespace

void check_grid_target(const std::string& target, const WriteGridOptions& options) {
    find_raster_driver(target, options);
    if (!options.preview.empty()) {
        check_preview_target(options.preview);
    }
    for (const std::string& file : {target, options.preview}) {
        if (!file.empty() && !file.starts_with("/vsi")) {
            const AtomicOutput probe(file, options.overwrite);
        }
    }
}

namespace {

/// What a unit of the raster's CRS is in the TIN's plane, in the middle of the raster: shading compares
/// cells' sizes with elevations, and cells may be in degrees.
double plane_units_per_raster_unit(const GridGeometry& grid, const GriddingOptions& gridding) {
    if (!gridding.find_places) {
        return 1;
    }
    CellPlace here;
    gridding.find_places(grid.rows / 2, grid.columns / 2, {&here, 1});
    CellPlace above;
    gridding.find_places(std::max<std::int64_t>(0, grid.rows / 2 - 1), grid.columns / 2, {&above, 1});
    const double scale =
        std::hypot(here.position.x - above.position.x, here.position.y - above.position.y) / grid.cell_height;
    return scale > 0 && std::isfinite(scale) ? scale : 1;
}

/// A raster and its preview, complete but under temporary names until both are committed.
class PendingGrid {
  public:
    PendingGrid(const std::string& target, const WriteGridOptions& options)
        : output_(target, options.overwrite), target_(target) {
        if (!options.preview.empty()) {
            preview_ = std::make_unique<AtomicOutput>(options.preview, options.overwrite);
        }
    }

    WrittenGrid write(const Tin& tin, const Crs& crs, const GridGeometry& grid,
                      const WriteGridOptions& options) const {
        WrittenGrid written;
        tbb::task_arena arena(count_threads(options.threads));
        arena.execute([&] { written = GridWriter(tin, crs, grid, target_, options).write(output_.path()); });
        if (preview_) {
            write_preview(output_.path(), preview_->path(), preview_->target(),
                          choose_z_factor(tin) / plane_units_per_raster_unit(grid, options.gridding));
        }
        return written;
    }

    void commit() {
        output_.commit();
        if (preview_) {
            preview_->commit();
        }
    }

  private:
    AtomicOutput output_;
    const std::string& target_;
    std::unique_ptr<AtomicOutput> preview_;
};

}  // namespace

WrittenGrid write_grid(const Tin& tin, const Crs& crs, const GridGeometry& grid, const std::string& target,
                       const WriteGridOptions& options) {
    check_grid_target(target, options);
    PendingGrid pending(target, options);
    WrittenGrid written = pending.write(tin, crs, grid, options);
    pending.commit();
    return written;
}

WrittenGrid write_grids(const Tin& tin, const Crs& crs, const GridGeometry& grid,
                        std::span<const std::string> targets, const WriteGridOptions& options) {
    assert(targets.size() == options.gridding.products.size());
    std::vector<std::unique_ptr<PendingGrid>> pending;
    WrittenGrid all;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        WriteGridOptions of_target = options;
        of_target.gridding.products = {options.gridding.products[i]};
        of_target.preview = i == 0 ? options.preview : std::string();
        const auto share = [&](double at) {
            return (static_cast<double>(i) + at) / static_cast<double>(targets.size());
        };
        if (options.progress) {
            of_target.progress = [&options, share](double at) { return options.progress(share(at)); };
        }
        check_grid_target(targets[i], of_target);
        pending.push_back(std::make_unique<PendingGrid>(targets[i], of_target));
        const WrittenGrid written = pending.back()->write(tin, crs, grid, of_target);
        all.interpolate_seconds += written.interpolate_seconds;
        all.write_seconds += written.write_seconds;
        all.bands.insert(all.bands.end(), written.bands.begin(), written.bands.end());
        all.warnings.insert(all.warnings.end(), written.warnings.begin(), written.warnings.end());
        if (i == 0) {
            all.driver = written.driver;
            all.data_type = written.data_type;
            all.nodata = written.nodata;
            all.cells_with_value = written.cells_with_value;
        }
    }
    for (const std::unique_ptr<PendingGrid>& one : pending) {
        one->commit();
    }
    return all;
}

}  // namespace tinwright::io
