#include "tinwright/io/write_grid.hpp"

#include <cmath>
#include <csignal>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <sys/resource.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/surface/scan_conversion.hpp"

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// A 40 by 30 grid of samples a metre apart on z = low + step * (x + 2 y), and a notch without faces.
Tin slope_tin(double low, double step) {
    Tin tin = delaunay_tin(grid_keys(41, 31));
    for (std::size_t v = 0; v < tin.keys.size(); ++v) {
        tin.z[v] = low + step * (tin.keys[v].x + 2 * tin.keys[v].y);
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            const Key2 key = tin.key(tin.mesh.face({f}).vertex[0]);
            if (key.x < 10 && key.y > 20) {
                tin.mesh.set_terrain({f}, false);
            }
        }
    }
    return tin;
}

GridGeometry half_metre() { return {-1, 31, 0.5, 0.5, 84, 64}; }

struct ReadBack {
    std::vector<double> values;
    double nodata = 0;
    std::string type;
    std::string driver;
    std::string area_or_point;
    std::string version;
    std::array<double, 6> transform{};
    bool has_nodata = false;
    std::string crs;
};

ReadBack read_back(const std::string& path) {
    io::register_drivers();
    GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    REQUIRE(dataset != nullptr);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    ReadBack back;
    back.values.resize(static_cast<std::size_t>(band.GetXSize()) * static_cast<std::size_t>(band.GetYSize()));
    REQUIRE(band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), back.values.data(),
                          band.GetXSize(), band.GetYSize(), GDT_Float64, 0, 0, nullptr) == CE_None);
    int has_nodata = 0;
    back.nodata = band.GetNoDataValue(&has_nodata);
    back.has_nodata = has_nodata != 0;
    back.type = GDALGetDataTypeName(band.GetRasterDataType());
    back.driver = dataset->GetDriver()->GetDescription();
    const auto item = [&](const char* key) {
        const char* const value = dataset->GetMetadataItem(key);
        return std::string(value == nullptr ? "" : value);
    };
    back.area_or_point = item("AREA_OR_POINT");
    back.version = item("TINWRIGHT_VERSION");
    dataset->GetGeoTransform(back.transform.data());
    back.crs = io::Crs::from_gdal(dataset->GetSpatialRef()).code();
    return back;
}

/// What the cells hold, straight from the scan converter; NaN for none.
std::vector<double> expected_values(const Tin& tin, const GridGeometry& grid) {
    std::vector<double> values(static_cast<std::size_t>(grid.columns * grid.rows));
    ScanConverter(tin, grid, grid.rows)
        .fill(0, std::span<double>(values), std::numeric_limits<double>::quiet_NaN());
    return values;
}

void check_values(const ReadBack& back, const std::vector<double>& expected, double tolerance) {
    REQUIRE(back.values.size() == expected.size());
    REQUIRE(back.has_nodata);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const bool is_right = std::isnan(expected[i]) ? back.values[i] == back.nodata
                                                      : std::abs(back.values[i] - expected[i]) <= tolerance;
        wrong += is_right ? 0 : 1;
    }
    CHECK(wrong == 0);
}

template <class Failure>
std::string refusal_of(const Tin& tin, const std::string& path, const io::WriteGridOptions& options) {
    return message_of<Failure>([&] { io::write_grid(tin, {}, half_metre(), path, options); });
}

bool has_driver(const char* name) {
    io::register_drivers();
    return GetGDALDriverManager()->GetDriverByName(name) != nullptr;
}

/// Limits the size of files for a while: to a writer the same as a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &former_);
        rlimit limit = former_;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &former_); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit former_{};
};

}  // namespace

TEST_SUITE("io/write_grid") {
    TEST_CASE("a GeoTIFF is Float32 with -9999, georeferenced, and says who made it") {
        const TemporaryFolder folder;
        const Tin tin = slope_tin(100, 0.25);
        io::WriteGridOptions options;
        options.metadata = {{"TINWRIGHT_VERSION", "1.2.3"}};
        const io::WrittenGrid written =
            io::write_grid(tin, io::Crs::parse("EPSG:3875"), half_metre(), folder.file("dem.tif"), options);
        CHECK(folder.names() == std::set<std::string>{"dem.tif"});
        const ReadBack back = read_back(folder.file("dem.tif"));
        CHECK(back.driver == "GTiff");
        CHECK(back.type == "Float32");
        CHECK(back.nodata == -9999);
        CHECK(back.area_or_point == "Area");
        CHECK(back.version == "1.2.3");
        CHECK(back.crs == "EPSG:3875");
        CHECK(back.transform == std::array<double, 6>{-1, 0.5, 0, 31, 0, -0.5});
        const std::vector<double> expected = expected_values(tin, half_metre());
        check_values(back, expected, 1e-5);
        CHECK(written.cells_with_value ==
              std::count_if(expected.begin(), expected.end(), [](double z) { return !std::isnan(z); }));
        CHECK(io::read_grid_geometry(folder.file("dem.tif")) == half_metre());
    }

    TEST_CASE("drivers that create and drivers that copy all hold the same values") {
        struct Form {
            const char* file;
            const char* driver;
            const char* type;
            double tolerance;
        };
        const Tin tin = slope_tin(100, 0.25);
        for (const Form& form : {Form{"a.tif", "", "Float64", 1e-12}, Form{"a.img", "", "Float32", 1e-5},
                                 Form{"a.asc", "", "Float32", 1e-5}, Form{"a.png", "", "UInt16", 0.5},
                                 Form{"b.tif", "COG", "Float32", 1e-5}, Form{"c.tif", "", "Int16", 0.5},
                                 Form{"d.tif", "", "Byte", 0.5}, Form{"a.bil", "", "Float32", 1e-5}}) {
            CAPTURE(form.file);
            const TemporaryFolder folder;
            io::WriteGridOptions options;
            options.driver = form.driver;
            options.data_type = std::string(form.file) == "a.png" ? "" : form.type;
            if (*form.driver != '\0' && !has_driver(form.driver)) {
                continue;
            }
            const io::WrittenGrid written =
                io::write_grid(tin, {}, half_metre(), folder.file(form.file), options);
            const ReadBack back = read_back(folder.file(form.file));
            CHECK(back.type == form.type);
            CHECK(written.data_type == form.type);
            CHECK(back.nodata == written.nodata);
            check_values(back, expected_values(tin, half_metre()), form.tolerance);
        }
    }

    TEST_CASE("threads, also the driver's, do not change the file") {
        const Tin tin = slope_tin(0, 1);
        const GridGeometry fine{0, 30, 0.05, 0.05, 800, 600};
        for (const std::vector<std::string>& creation :
             {std::vector<std::string>{},
              {"TILED=YES"},
              {"COMPRESS=DEFLATE", "NUM_THREADS=2", "TILED=YES"}}) {
            std::string reference;
            for (const int threads : {1, 2, 4}) {
                const TemporaryFolder folder;
                io::WriteGridOptions options;
                options.threads = threads;
                options.band_bytes = threads * 400000;  // 1 MiB in all
                options.creation_options = creation;
                io::write_grid(tin, {}, fine, folder.file("dem.tif"), options);
                const std::string bytes = read_bytes(folder.file("dem.tif"));
                reference = reference.empty() ? bytes : reference;
                CHECK(bytes == reference);
            }
        }
    }

    TEST_CASE("integers round to the nearest and get a nodata outside the data") {
        const TemporaryFolder folder;
        const io::WriteGridOptions byte{.data_type = "Byte"};
        CHECK(io::write_grid(slope_tin(0, 1), {}, half_metre(), folder.file("a.tif"), byte).nodata == 255);
        CHECK(io::write_grid(slope_tin(155, 1), {}, half_metre(), folder.file("b.tif"), byte).nodata == 0);
        const io::WriteGridOptions wide{.data_type = "Int16"};
        CHECK(io::write_grid(slope_tin(0, 1), {}, half_metre(), folder.file("c.tif"), wide).nodata == -9999);
        CHECK(io::write_grid(slope_tin(-10000, 1), {}, half_metre(), folder.file("d.tif"), wide).nodata ==
              32767);
    }

    TEST_CASE("values that do not fit, or are nodata, are refused with their cell") {
        const TemporaryFolder folder;
        CHECK(refusal_of<InputError>(slope_tin(200, 1), folder.file("a.tif"), {.data_type = "Byte"})
                  .ends_with(", which does not fit Byte (0 to 255); use --ot Int32 or Float32"));
        CHECK(refusal_of<InputError>(slope_tin(-5, 1), folder.file("a.png"), {})
                  .starts_with("the cell at column "));
        CHECK(
            refusal_of<InputError>(slope_tin(0, 2.55), folder.file("a.tif"), {.data_type = "Byte"})
                .starts_with("elevations from 0 to 255 leave no value of Byte for nodata; use a wider type"));
        CHECK(refusal_of<InputError>(slope_tin(5, 0), folder.file("a.tif"), {.nodata = 5})
                  .ends_with(
                      "has the elevation 5, which stands for nodata; choose another value with --nodata"));
        CHECK(refusal_of<InputError>(slope_tin(1e300, 0), folder.file("a.tif"), {}) ==
              "elevations from 1e+300 to 1e+300 do not fit Float32; use --ot Float64");
        CHECK(folder.names().empty());
    }

    TEST_CASE("a nodata within the elevations is taken where no cell holds it") {
        const TemporaryFolder folder;
        const Tin tin = slope_tin(0, 1);
        io::write_grid(tin, {}, half_metre(), folder.file("a.tif"), {.nodata = 17.1234});
        check_values(read_back(folder.file("a.tif")), expected_values(tin, half_metre()), 1e-4);
        io::write_grid(tin, {}, half_metre(), folder.file("b.tif"),
                       {.nodata = std::numeric_limits<double>::quiet_NaN()});
        CHECK(std::isnan(read_back(folder.file("b.tif")).nodata));
        CHECK(std::isnan(read_back(folder.file("b.tif")).values.front()));
    }

    TEST_CASE("targets that cannot be are refused before any work") {
        const auto usage = [](const std::string& path, const io::WriteGridOptions& options) {
            return message_of<UsageError>([&] { io::check_grid_target(path, options); });
        };
        CHECK(usage("dem", {}) ==
              "cannot tell the format of \"dem\": it has no extension; add one, such as .tif, or --of");
        CHECK(usage("dem.zzz", {}) ==
              "no raster driver writes files with the extension \".zzz\"; use another, such as .tif, or name "
              "the "
              "driver with --of");
        CHECK(usage("dem.tif", {.driver = "Nonsense"}) ==
              "unknown driver \"Nonsense\"; `gdalinfo --formats` lists GDAL's");
        CHECK(usage("dem.vrt", {.driver = "VRT"}) ==
              "the driver \"VRT\" cannot write a raster file; use another, such as GTiff");
        CHECK(usage("dem.tif", {.data_type = "Float16x"}) ==
              "unknown data type \"Float16x\"; use Float32, Float64, Byte, Int16, UInt16, Int32 or UInt32");
        CHECK(usage("dem.png", {.data_type = "Float32"}) ==
              "the driver \"PNG\" cannot write Float32; it writes Byte UInt16");
        CHECK(usage("dem.tif", {.data_type = "Byte", .nodata = -9999}) ==
              "--nodata -9999 is not a value of the type Byte");
        CHECK(usage("dem.tif", {.creation_options = {"COMPRESS"}}) ==
              "--co \"COMPRESS\" is not of the form NAME=VALUE");
        CHECK(usage("dem.tif", {.creation_options = {"COMPRES=ZSTD"}})
                  .starts_with("the driver \"GTiff\" does not take these creation options: "));
        CHECK(usage("dem.tif", {.preview = "dem.jpg"}) ==
              "--preview \"dem.jpg\" must be a PNG file; give it the extension .png");
    }

    TEST_CASE("what exists is kept unless it may be replaced") {
        const TemporaryFolder folder;
        write_bytes(folder.file("dem.tif"), "old");
        CHECK(refusal_of<IoError>(slope_tin(0, 1), folder.file("dem.tif"), {}).find("--overwrite") !=
              std::string::npos);
        CHECK(read_bytes(folder.file("dem.tif")) == "old");
        io::write_grid(slope_tin(0, 1), {}, half_metre(), folder.file("dem.tif"), {.overwrite = true});
        CHECK(read_back(folder.file("dem.tif")).type == "Float32");
    }

    TEST_CASE("a full disk and a cancelled run leave nothing") {
        const TemporaryFolder folder;
        {
            const FileSizeLimit limit(8192);
            CHECK(refusal_of<IoError>(slope_tin(0, 1), folder.file("dem.tif"), {}).starts_with("cannot "));
            CHECK(refusal_of<IoError>(slope_tin(0, 1), folder.file("dem.asc"), {}).starts_with("cannot "));
        }
        CHECK(folder.names().empty());
        for (const char* const file : {"dem.tif", "dem.asc"}) {
            CHECK_THROWS_AS(io::write_grid(slope_tin(0, 1), {}, half_metre(), folder.file(file),
                                           {.progress = [](double) { return false; }}),
                            Cancelled);
        }
        CHECK(folder.names().empty());
    }

    TEST_CASE("a raster larger than the disk is refused before it is begun") {
        const TemporaryFolder folder;
        const GridGeometry huge{0, 30, 1e-7, 1e-7, 2000000000, 2000000000};
        CHECK_THROWS_WITH_AS(io::write_grid(slope_tin(0, 1), {}, huge, folder.file("dem.tif"), {}),
                             doctest::Contains("not enough space for"), IoError);
        CHECK(folder.names().empty());
    }

    TEST_CASE("virtual files are written too") {
        const Tin tin = slope_tin(100, 0.25);
        io::write_grid(tin, {}, half_metre(), "/vsimem/tinwright_grid.tif", {});
        check_values(read_back("/vsimem/tinwright_grid.tif"), expected_values(tin, half_metre()), 1e-5);
        VSIUnlink("/vsimem/tinwright_grid.tif");
    }

    TEST_CASE("a preview is a picture of the same size, clear where there is no value") {
        const TemporaryFolder folder;
        io::write_grid(slope_tin(0, 0.01), {}, half_metre(), folder.file("dem.tif"),
                       {.preview = folder.file("dem.png")});
        CHECK(folder.names() == std::set<std::string>{"dem.png", "dem.tif"});
        const ReadBack back = read_back(folder.file("dem.png"));
        CHECK(back.type == "Byte");
        CHECK(back.values.size() == 84 * 64);
        CHECK(back.has_nodata);
        CHECK(back.values.front() == back.nodata);
        CHECK(back.values[32 * 84 + 42] != back.nodata);
    }

    TEST_CASE("a rotated raster, or one without a place, is no model for a grid") {
        io::register_drivers();
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        const char* const path = "/vsimem/tinwright_like.tif";
        GDALDatasetUniquePtr(driver->Create(path, 4, 3, 1, GDT_Byte, nullptr));
        CHECK_THROWS_WITH_AS(io::read_grid_geometry(path), doctest::Contains("no geotransform"), InputError);
        {
            GDALDatasetUniquePtr dataset(driver->Create(path, 4, 3, 1, GDT_Byte, nullptr));
            std::array<double, 6> transform{0, 1, 0.5, 0, 0.5, -1};
            dataset->SetGeoTransform(transform.data());
        }
        CHECK_THROWS_WITH_AS(io::read_grid_geometry(path), doctest::Contains("is rotated"), InputError);
        VSIUnlink(path);
        CHECK_THROWS_AS(io::read_grid_geometry("/nowhere/dem.tif"), IoError);
    }
}
